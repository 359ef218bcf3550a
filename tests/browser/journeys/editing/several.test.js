// Several at once: selecting, moving, copying between tabs, removing, menus.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove, pedestrianOnTheMove } from '../../support/casting.js';
import { distance, Editor, turn } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';

const names = async (e) => (await e.roadUsers()).map((u) => u.name);
const pressed = (e) =>
  e.page.locator('[data-agent][aria-pressed="true"]').evaluateAll((all) => all.map((b) => b.dataset.agent));

journeys('several at once', (stage) => {
  it('selects with a marquee, moves, nudges and removes as one step each', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.key('b');
    const all = await e.roadUsers();
    const car = await carOnTheMove(e);
    const [x, y] = car.from;
    await e.page.mouse.move(x - 190, y - 130);
    await e.drag([x - 160, y - 110], [x + 40, y + 40], { moves: 5 });
    await e.picture('marquee');
    await e.page.mouse.up();
    await e.settled();
    const taken = await pressed(e);
    assert.ok(taken.includes(car.id), `${taken}`);
    if (taken.length === 1) {
      // No other was near: the next of the list is added.
      const other = all.find((u) => u.id !== car.id && u.kind === 'Car');
      await e.page
        .locator(`[data-agent="${other.id}"]`)
        .evaluate((el) => el.dispatchEvent(new MouseEvent('click', { bubbles: true, shiftKey: true })));
      await e.settled();
    }
    const some = await pressed(e);
    assert.ok(some.length > 1);
    assert.match(await e.text('.ih h2'), new RegExp(`^${some.length} road users`));
    assert.match(await e.text('.status'), new RegExp(`${some.length} of \\d+ selected|other|collision|miss|rule`));

    const step = () => e.page.locator('header [data-action="undo"]').getAttribute('title');
    await e.key('Shift+ArrowRight');
    await e.key('Shift+ArrowRight');
    await e.settled();
    await e.page.locator(`[data-agent="${car.id}"]`).evaluate((el) => el.click());
    await e.settled();
    assert.ok(Math.abs((await e.pose('Start')).x - car.start.x - 2) < 0.11, 'two metres to the right');
    await e.key('Control+z');
    await e.settled();
    assert.ok(distance(await e.pose('Start'), car.start) < 0.11, 'both nudges were one step');
    assert.ok(await step());

    await e.key('Control+a');
    await e.settled();
    assert.equal((await pressed(e)).length >= all.length, true);
    assert.equal(await e.page.evaluate(() => getSelection().isCollapsed), true);
    await e.key('Delete');
    await e.settled();
    assert.equal((await e.roadUsers()).length, 0);
    await e.key('Control+z');
    await e.settled();
    assert.deepEqual(
      await names(e),
      all.map((u) => u.name),
    );
  });

  it('mirrors two of them: twice restores them', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.key('b');
    const [one, two] = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 2.5);
    const start = async (id) => {
      await e.choose(id);
      return e.pose('Start');
    };
    const before = [await start(one.id), await start(two.id)];
    const both = async () => {
      await e.choose(one.id);
      await e.page
        .locator(`[data-agent="${two.id}"]`)
        .evaluate((el) => el.dispatchEvent(new MouseEvent('click', { bubbles: true, shiftKey: true })));
      await e.settled();
    };
    await both();
    await e.key('Alt+m');
    await e.settled();
    assert.match(await e.text('.toast'), /^2 cars mirrored/);
    await e.picture('mirrored');
    const now = [await start(one.id), await start(two.id)];
    assert.ok(Math.abs(distance(...now) - distance(...before)) < 0.2, 'as far apart');
    assert.ok(turn(now[0].heading, before[0].heading) < 0.02, 'the first looks where it looked');
    assert.ok(Math.abs(turn(now[1].heading, now[0].heading) - turn(before[1].heading, before[0].heading)) < 0.04);
    await both();
    await e.key('Alt+m');
    await e.settled();
    const again = [await start(one.id), await start(two.id)];
    assert.ok(
      again.every((pose, i) => distance(pose, before[i]) < 0.2 && turn(pose.heading, before[i].heading) < 0.02),
    );
  });

  it('copies between tabs, and pastes under the pointer', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    const context = e.page.context();
    await context.grantPermissions(['clipboard-read', 'clipboard-write']);
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    await e.page.evaluate(() => document.activeElement?.blur?.());
    await e.key('Control+c');
    await e.until(() => /copied/.test(document.querySelector('.toast')?.textContent ?? ''));
    const before = (await e.roadUsers()).length;

    // Another scene: this one is read-only in the second tab.
    const other = new Editor();
    other.page = await context.newPage();
    other.cdp = await context.newCDPSession(other.page);
    other.wire = e.wire;
    await other.page.goto(new URL('/?scene=demo-roundabout', e.page.url()).href);
    await other.ready();
    const there = (await other.roadUsers()).length;
    await other.page.bringToFront();
    const { box } = await other.view();
    await other.page.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.5, { steps: 3 });
    await other.page.keyboard.press('Control+v');
    await other.page.waitForFunction((n) => document.querySelectorAll('[data-agent]').length === n + 1, there);
    assert.equal((await pressed(other)).length, 1);
    assert.match(await other.text('.ih h2'), /^Car/);
    await other.page.close();
    await e.page.bringToFront();

    await e.key('Control+d');
    await e.settled();
    assert.equal((await e.roadUsers()).length, before + 1);
    await e.key('Backspace');
    await e.settled();
    assert.equal((await e.roadUsers()).length, before);

    // A road user added to an example is there again after a reload, like all other changes.
    await e.key('Control+z');
    await e.settled();
    const cast = await names(e);
    assert.equal(cast.length, before + 1);
    await e.page.reload();
    await e.ready();
    await e.settled();
    assert.deepEqual(await names(e), cast);
  });

  it('moves the picture with Space held, and plays with a tap of Space', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const before = await e.view();
    const { mouse, keyboard } = e.page;
    await mouse.move(700, 200);
    await keyboard.down('Space');
    await mouse.down();
    await mouse.move(760, 240, { steps: 4 });
    await mouse.up();
    await keyboard.up('Space');
    await e.frames(3);
    const after = await e.view();
    assert.ok(Math.abs((before.cx - after.cx) * after.zoom - 60) < 2);
    assert.ok((await e.text('.tm')).startsWith('0.0'), 'it does not play');
    await e.key('Space');
    await e.until(() => parseFloat(document.querySelector('.tm').textContent) > 0.3);
  });

  it('opens menus with the right button and with keys, and runs their entries', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const walker = await pedestrianOnTheMove(e);
    await e.page.mouse.click(...walker.from, { button: 'right' });
    const menu = e.page.locator('.menu.ctx');
    await menu.waitFor();
    assert.equal(await e.text('.ih h2'), walker.name);
    await e.picture('menu');
    const labels = await menu.locator('> button').allInnerTexts();
    for (const word of ['Copy', 'Duplicate', 'Delete', 'Lock', 'Replay log', 'Hold still'])
      assert.ok(
        labels.some((l) => l.startsWith(word)),
        `${word} in ${labels.join(' | ')}`,
      );
    await e.key('l');
    await e.key('Enter');
    await e.settled();
    assert.equal(await menu.isVisible(), false);
    assert.match(await e.text('.lockline'), /Locked/);
    await e.key('Delete');
    assert.ok((await names(e)).includes(walker.name), 'locked ones stay');
    await e.key('Control+l');
    await e.settled();

    // By keys only: another kind, whose expert the generator uses.
    await e.key('Shift+F10');
    await menu.waitFor();
    await e.key('t');
    await e.key('ArrowRight');
    await e.key('m');
    for (let i = 0; i < 8; i++) {
      const now = await e.page.evaluate(() => document.activeElement.textContent);
      if (/cyclist/.test(now)) break;
      await e.key('ArrowDown');
    }
    await e.key('Enter');
    await e.settled();
    const number = walker.name.match(/\d+/)[0];
    assert.equal(await e.text('.ih h2'), `Cyclist ${number}`);
    assert.equal(e.wire.last().body.conditions[walker.id].type, 'cyclist');
    assert.ok(e.wire.last().event('final'), 'and it is answered');
    await e.key('Control+z');
    await e.settled();
    assert.equal(await e.text('.ih h2'), walker.name);
  });
});
