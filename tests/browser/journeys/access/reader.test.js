// With a screen reader: the accessibility tree, keys, and spoken messages. No picture, no pointer.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { it } from 'node:test';
import { devices } from '../../support/devices.js';
import { distance } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';
import { ear, press, tree } from '../../support/reader.js';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

journeys('by a screen reader', (stage) => {
  it('the page has a heading, landmarks, and a name for everything', { timeout: 40_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const all = await tree(e);
    const named = (role) => all.filter((n) => n.role === role).map((n) => n.name);
    assert.deepEqual(
      all.filter((n) => n.role === 'heading' && n.properties.level === 1).map((n) => n.name),
      ['Rosa & 5th, DragTraffic'],
    );
    assert.equal(named('main').length, 1);
    assert.equal(named('banner').length, 1);
    assert.equal(named('complementary').length, 1);
    assert.ok(named('navigation').some((n) => /^Road users, \d+$/.test(n)));
    assert.ok(named('navigation').includes('Tools'));
    for (const tool of ['Select and drag', 'Pan the view', 'Add, and more tools'])
      assert.ok(
        named('button').some((n) => n.startsWith(tool)),
        `${tool} among ${named('button').join(', ')}`,
      );
    const mute = all.filter((n) => n.focusable && !n.name && n.role !== 'RootWebArea');
    assert.deepEqual(mute, []);
    assert.ok(
      named('button').every((n) => n.trim().length > 1 || /^\d$/.test(n)),
      'no button is read as a letter',
    );
  });

  it('select, set a goal, choose a future, hear the verdict, undo', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const { hears } = await ear(e);
    /** The inspector's verdict, as a pattern. */
    const verdict = async () => {
      const words = await e.text('.hint b, .hint button.to');
      return new RegExp(words.replace(/[.*+?^${}()|[\]\\]/g, '\\$&'));
    };
    const users = await e.roadUsers();
    const car = users.find((u) => u.kind === 'Car' && u.speed > 4);
    await press(e, 'button', new RegExp(`^${car.name}, `));
    await hears(new RegExp(`${car.name} selected|Six futures`));
    await e.settled();
    await hears(/Six futures\. Shown: .+, rank \d/);
    // The goal at the end of the likeliest future, and a little further.
    await e.key('g');
    await e.settled();
    const slider = e.page.getByRole('slider', { name: 'Goal position', exact: true });
    const before = await e.goal();
    await slider.focus();
    for (let i = 0; i < 2; i++) await e.key('Shift+ArrowUp');
    await e.settled();
    // Where the likeliest future has a fault, the reason for another one is said last.
    await hears(new RegExp(`Goal of ${car.name} moved|is shown: `));
    await hears(new RegExp(`${(await verdict()).source}|is shown: `));
    const moved = await e.goal();
    assert.ok(distance(before, moved) > 1);
    const futures = (await tree(e)).filter((n) => n.role === 'radio' && /^[A-F]/.test(n.name));
    assert.equal(futures.length, 6);
    const taken = futures.find((n) => n.properties.checked === 'true') ?? futures[0];
    const other = futures.find((n) => n !== taken);
    await press(e, 'radio', other.name);
    await e.settled();
    await hears(await verdict());
    await e.key('Control+z');
    await hears(/^Undone: /);
    await e.settled();
    await e.key('Control+z');
    await e.settled();
    assert.ok(distance(await e.goal(), moved) > 0.5, 'the goal is back');
  });

  it('Tab goes round the whole page without a trap', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.page.locator('[data-menu="file"]').focus();
    const groups = new Set();
    let last = '';
    for (let i = 0; i < 120; i++) {
      const here = await e.page.evaluate(() => {
        const a = document.activeElement;
        return { group: a.closest('[data-group]')?.dataset.group ?? a.className, what: a.outerHTML.slice(0, 120) };
      });
      groups.add(here.group);
      if (i > 5 && here.what === last) throw new Error(`Tab stays at ${here.what}`);
      last = here.what;
      if (here.group === 'users') await e.key('F6');
      else await e.key('Tab');
    }
    for (const g of ['top', 'users', 'tools', 'inspector', 'timeline'])
      assert.ok(groups.has(g), `${g} among ${[...groups]}`);
  });

  it('the list of road users is a panel too, with filters', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const everybody = await e.roadUsers();
    await press(e, 'button', 'Road users');
    await e.page.waitForSelector('.drawer.users');
    await e.picture('road-users');
    const shown = await e.page.locator('.users li button').first().boundingBox();
    assert.ok(shown.width > 150 && shown.height >= 36, 'one sees it too');
    await press(e, 'radio', 'Cyclists');
    await e.until((n) => document.querySelectorAll('[data-agent]').length < n, everybody.length);
    const cyclists = await e.roadUsers();
    assert.ok(cyclists.length && cyclists.every((u) => u.kind === 'Cyclist'));
    await press(e, 'radio', 'Vehicles');
    await press(e, 'button', 'With a goal');
    await e.page.getByText('No matches.').waitFor();
    await press(e, 'button', 'With a goal');
    const car = (await e.roadUsers()).find((u) => u.kind === 'Car' && u.speed > 4);
    await press(e, 'button', new RegExp(`^${car.name}, `));
    await e.settled();
    await e.key('g');
    await e.settled();
    await press(e, 'button', 'With a goal');
    await e.until(() => document.querySelectorAll('[data-agent]').length === 1);
    assert.deepEqual(
      (await e.roadUsers()).map((u) => u.id),
      [car.id],
    );
    // Closed, it contains all road users.
    await e.key('w');
    await e.until((n) => document.querySelectorAll('[data-agent]').length === n, everybody.length);
  });

  for (const scheme of ['light', 'dark'])
    for (const [device, options] of [
      ['desk', { viewport: { width: 1440, height: 900 } }],
      ['phone', devices.phone],
    ])
      it(`axe finds nothing, ${scheme}, ${device}`, { timeout: 120_000 }, async () => {
        const e = await stage.open({ ...options, colorScheme: scheme, bypassCSP: true });
        await e.begin();
        await e.page.evaluate(axe);
        const look = async (state) => {
          const found = await e.page.evaluate(() =>
            window.axe
              .run(document, { resultTypes: ['violations'] })
              .then((r) =>
                r.violations.map(
                  (v) => `${v.id}: ${v.nodes.map((n) => `${n.target} ${n.any[0]?.message ?? ''}`).join(' | ')}`,
                ),
              ),
          );
          assert.deepEqual(found, [], state);
        };
        await look('nothing selected');
        const car = (await e.roadUsers()).find((u) => u.kind === 'Car' && u.speed > 4);
        await e.choose(car.id);
        await look('selected');
        await e.key('g');
        await e.settled();
        await look('with a goal');
        for (const key of ['w', 'b', 'Control+h']) {
          await e.key(key);
          await e.page.waitForSelector('.drawer');
          await look(`drawer ${key}`);
        }
        await e.key('Control+h');
        await e.key('?');
        await e.page.waitForSelector('.dlg');
        await look('keys');
        await e.key('Escape');
        await e.key('Alt+f');
        await e.page.waitForSelector('.seek', { state: 'attached' });
        await look('a case, before the search');
        await e.page.locator('[data-action="case-search"]').evaluate((el) => el.click());
        await e.page.waitForSelector('.seeking', { state: 'attached' });
        await look('a case that is looked for');
      });
});
