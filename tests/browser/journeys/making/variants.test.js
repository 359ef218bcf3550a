// Variants: alternatives of the scene, made at once, side by side on one clock, kept, compared and exported.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

/** Contents of the cards: `{ id, name, kept, starred, shown, verdict }`. */
const cards = (e) =>
  e.page.locator('.vcard[data-variant]').evaluateAll((all) =>
    all.map((el) => ({
      id: Number(el.dataset.variant),
      name: el.querySelector('.named b')?.textContent.replace(/^\d+\s*/, '') ?? null,
      kept: el.querySelector('.keep').getAttribute('aria-pressed') === 'true',
      starred: el.querySelector('.star').getAttribute('aria-pressed') === 'true',
      shown: el.querySelector('.face').getAttribute('aria-pressed') === 'true',
      verdict: el.querySelector('.tag').textContent,
    })),
  );

const ids = async (e) => (await cards(e)).map((c) => c.id);

/** The pixels of a card's picture, as one number. */
const picture = (e, id) =>
  e.page.locator(`[data-variant="${id}"] canvas`).evaluate((c) => {
    const { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) sum = (sum * 31 + data[i] + data[i + 1] + data[i + 2]) >>> 0;
    return sum;
  });

const face = (e, id) => e.page.locator(`[data-variant="${id}"] .face`);
const take = async (e, id) => {
  await face(e, id).click();
  await e.settled();
};

/** All requested variants have their cards. */
async function allMade(e) {
  // Ten times all road users: on a busy machine that takes longer than one answer does.
  await e.page.waitForSelector('.vcard:is(.waiting, .arrived)', { state: 'detached', timeout: 60_000 });
  await e.settled();
}

async function make(e) {
  await e.key('Control+Enter');
  await e.frames(2);
  await allMade(e);
}

async function begin(stage, options) {
  const e = await stage.open(options);
  await e.begin();
  await e.key('b');
  await e.key('Shift+V');
  await e.page.waitForSelector('.strip');
  return e;
}

/** Removes the focus: keys go to the page again. */
const leave = (e) => e.page.evaluate(() => document.activeElement?.blur?.());

const setTime = async (e, seconds) => {
  await leave(e);
  await e.key('Home');
  for (let i = 0; i < seconds * 10; i++) await e.key('.');
  await e.settled();
};

journeys('variants', (stage) => {
  it('makes ten variants of all, keeps the good ones and draws the others again', { timeout: 120_000 }, async () => {
    const e = await begin(stage);
    const count = e.page.getByLabel('Number of variants');
    await count.fill('10');
    await count.press('Enter');
    await leave(e);
    await make(e);
    const first = await cards(e);
    assert.equal(first.length, 10);
    assert.equal(new Set(first.map((c) => c.name)).size, 10, `names are told apart: ${first.map((c) => c.name)}`);
    assert.deepEqual(
      first.filter((c) => c.shown).map((c) => c.id),
      [1],
    );
    await e.picture('variants');
    // Kept, starred and named, each a separate step.
    await take(e, 3);
    await e.key('Control+d');
    await take(e, 5);
    await e.key('s');
    await face(e, 5).focus();
    await e.key('F2');
    await e.page.locator('.vcard input').fill('My favourite');
    await e.key('Enter');
    await e.settled();
    const marked = await cards(e);
    assert.deepEqual(marked[0], { ...marked[0], id: 5, starred: true, shown: true, name: 'My favourite' });
    assert.equal(marked.find((c) => c.id === 3).kept, true);
    await e.page.getByRole('radio', { name: /^Starred/ }).click();
    assert.deepEqual(await ids(e), [5]);
    await e.page.getByRole('radio', { name: /^With events/ }).click();
    const eventful = (all) => all.filter((c) => !['No conflict', 'Close'].includes(c.verdict)).map((c) => c.id);
    assert.deepEqual(await ids(e), eventful(marked));
    await e.page.getByRole('radio', { name: /^All/ }).click();
    // Kept and starred ones stay; the rest is new, drawn with unused seeds.
    await leave(e);
    await count.fill('4');
    await count.press('Enter');
    await leave(e);
    await make(e);
    assert.deepEqual(await ids(e), [5, 3, 11, 12, 13, 14]);
    const again = await cards(e);
    assert.equal(again[0].name, 'My favourite');
    assert.equal(again.find((c) => c.id === 11).shown, true);
    const seeds = e.wire.asked.filter((a) => a.body.agents === 'all').map((a) => a.body.seed);
    assert.equal(new Set(seeds).size, seeds.length, `no seed twice: ${seeds}`);
    // All of it can be undone, step by step.
    await e.key('Control+z');
    await e.settled();
    assert.deepEqual(
      (await ids(e)).sort((a, b) => a - b),
      marked.map((c) => c.id).sort((a, b) => a - b),
    );
    await e.key('Control+z');
    await e.settled();
    assert.notEqual((await cards(e)).find((c) => c.id === 5).name, 'My favourite');
    await e.key('Control+z');
    await e.settled();
    assert.equal((await cards(e)).find((c) => c.id === 5).starred, false);
    // If two are kept, these two are compared.
    await take(e, 5);
    await e.key('Control+d');
    await e.key('c');
    await e.page.waitForSelector('.insp .ih:has-text("Compare")');
    assert.match(await e.text('.insp .ih'), /Variant [35] and variant [35]/);
  });

  it("runs all pictures at the playhead's time", { timeout: 90_000 }, async () => {
    const e = await begin(stage);
    await make(e);
    const all = await ids(e);
    const at = async (seconds) => {
      await setTime(e, seconds);
      await e.frames(4);
      return Promise.all(all.map((id) => picture(e, id)));
    };
    const start = await at(0);
    const later = await at(2);
    assert.ok(
      later.every((p, i) => p !== start[i]),
      'every picture has moved on',
    );
    assert.deepEqual(await at(0), start);
    // Space starts playback also while a card has the focus.
    await face(e, all[1]).focus();
    await e.key('Space');
    await e.until(() => parseFloat(document.querySelector('.tm').textContent) > 1);
    await e.key('Space');
    await e.settled();
    const paused = Math.round(parseFloat(await e.text('.tm')) * 10) / 10;
    assert.ok(paused >= 1);
    const now = await Promise.all(all.map((id) => picture(e, id)));
    assert.ok(now.every((p, i) => p !== start[i]));
  });

  it('shows the variant of the future that was shown', { timeout: 120_000 }, async () => {
    const e = await begin(stage);
    const shown = () => e.page.locator('.fu[aria-checked="true"]').getAttribute('data-future');
    let letter = 'A';
    for (const { id, speed } of (await e.roadUsers()).filter((u) => u.kind === 'Car')) {
      if (!(speed > 2)) continue;
      await e.choose(id);
      const { x, y } = await e.pose('Start');
      await e.type('goal-pos', String(Math.round(x)), 0);
      await e.type('goal-pos', String(Math.round(y + 45)), 1);
      letter = await shown();
      if (letter !== 'A') break;
      await leave(e);
      for (let i = 0; i < 2; i++) await e.key('Control+z');
      await e.settled();
      await e.letGo();
    }
    assert.notEqual(letter, 'A', 'the likeliest future is shown of each car');
    await leave(e);
    await make(e);
    assert.equal(await shown(), letter);
    const [card] = (await cards(e)).filter((c) => c.shown);
    assert.equal(card.name, await e.text(`[data-future="${letter}"] .nm`));
  });

  it('makes a variant of each future of a road user, and compares two', { timeout: 120_000 }, async () => {
    const e = await begin(stage);
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    const futures = await e.page.locator('.fu').allInnerTexts();
    await make(e);
    const made = await cards(e);
    assert.equal(made.length, 6);
    assert.match(await e.text('.strip header'), new RegExp(`futures of ${car.name}`));
    for (const c of made)
      assert.ok(
        futures.some((f) => f.includes(c.name)),
        `${c.name} of ${futures}`,
      );
    // Each is that future on the picture too.
    for (const c of made.slice(0, 3)) {
      await take(e, c.id);
      assert.match(await e.text('.fu[aria-checked="true"], .fu[aria-pressed="true"], .fu.on'), new RegExp(c.name));
    }
    await take(e, 4);
    await face(e, 1).focus();
    await e.key('c');
    await e.page.waitForSelector('.pane');
    await e.settled();
    assert.match(await e.text('.insp .ih'), /Compare\s+Variant 4 and variant 1/);
    const rows = await e.page.locator('.compare tr.differs th').allInnerTexts();
    assert.ok(rows.includes(car.name), `${rows}`);
    const moments = e.page.locator('.moment');
    assert.ok((await moments.count()) >= 1 && (await moments.count()) <= 6);
    const [words] = await moments.allInnerTexts();
    await moments.first().click();
    await e.settled();
    assert.ok(words.startsWith((await e.text('.tm')).split(' ')[0]), `${words}: ${await e.text('.tm')}`);
    // From one to the next by a key, and round again.
    await leave(e);
    const told = [...new Set((await moments.allInnerTexts()).map((w) => w.split(' ')[0]))];
    for (const time of [...told.slice(1), told[0]]) {
      await e.key('e');
      await e.settled();
      assert.equal((await e.text('.tm')).split(' ')[0], time);
    }
    // The timeline shows the followed road user in both, and the events of each by its number.
    const plotted = (await e.page.locator('.plot .seek svg text').allTextContents()).join('; ');
    assert.ok(plotted.includes(`${car.name} in 4, dashed: in 1`), plotted);
    const eventful = (await e.page.locator('.compare td').allInnerTexts()).some((w) => /collision|near/.test(w));
    assert.ok(!eventful || /\b[14]: /.test(plotted), plotted);
    const who = e.page.getByLabel('Speed of', { exact: true });
    const [, other] = await who.locator('option').allInnerTexts();
    if (other) {
      await who.selectOption({ label: other });
      await e.until((name) => document.querySelector('.plot .seek svg').textContent.includes(`${name} in 4`), other);
    }
    await leave(e);
    await e.picture('compared');
    // One camera for both.
    const layers = () =>
      e.page.evaluate(() => {
        const of = (s) => document.querySelector(s).getBoundingClientRect();
        return { left: of('main.stage').width, right: of('.pane').width };
      });
    const { left, right } = await layers();
    assert.ok(Math.abs(left - right) <= 2, `${left} and ${right} px`);
    await leave(e);
    await e.key('x');
    await e.settled();
    assert.match(await e.text('.insp .ih'), /Variant 1 and variant 4/);
    assert.equal((await cards(e)).find((c) => c.shown).id, 1);
    await e.key('Escape');
    await e.until(() => !document.querySelector('.pane'));
    // A change of the scene leaves the variants unchanged.
    const before = await cards(e);
    await e.type('start-speed', '20');
    assert.deepEqual(
      (await cards(e)).map((c) => [c.id, c.name, c.verdict]),
      before.map((c) => [c.id, c.name, c.verdict]),
    );
    assert.equal(
      (await cards(e)).some((c) => c.shown),
      false,
      'it is none of them any more',
    );
  });

  it(
    'goes through a range of a number, waits when it is told to, and says what it cannot ask',
    { timeout: 120_000 },
    async () => {
      const e = await begin(stage);
      const { id, name } = await carOnTheMove(e);
      await e.choose(id);
      const by = e.page.getByLabel('New variants differ by');
      await by.selectOption('by start speed');
      const range = e.page.getByRole('group', { name: 'Range of the new variants' });
      assert.match(await range.innerText(), new RegExp(`^${name} starts at`));
      const fill = async (which, text) => {
        const field = range.locator(`[data-field="range-${which}"]`);
        await field.fill(text);
        await field.press('Enter');
      };
      await fill('from', '20');
      await fill('to', '50');
      await fill('step', '10');
      await e.picture('variants-range');
      assert.equal(await range.getByRole('button').innerText(), 'Make 4 variants');
      await range.getByRole('button').click();
      await allMade(e);
      assert.deepEqual(
        (await cards(e)).map((c) => c.name),
        [20, 30, 40, 50].map((v) => `Starts at ${v} km/h`),
      );
      await e.picture('variants-of-range');
      // The shown one has its number in the inspector, and its motion.
      await take(e, 3);
      assert.equal(await e.page.locator('[data-field="start-speed"]').inputValue(), '40');
      // Too many steps are reported, and cannot be made.
      await fill('step', '2');
      assert.match(await range.innerText(), /Make 16 variants/);
      await fill('step', '1');
      assert.match(await range.innerText(), /31 values; room for 30/);
      assert.equal(await range.getByRole('button').count(), 0);
      // Without a goal there is no goal time.
      await by.selectOption('by goal time');
      assert.match(await range.innerText(), /has no goal yet/);
      // Made again by seed, enough of them that there is time to stop; it pauses, and continues.
      await by.selectOption('by seed');
      const count = e.page.getByLabel('Number of variants');
      await count.fill('16');
      await count.press('Enter');
      await leave(e);
      await e.key('Control+Enter');
      await e.page.getByRole('button', { name: 'Pause', exact: true }).click();
      await e.page.getByText('paused').waitFor();
      const then = await e.page.locator('.vcard.waiting').count();
      await e.frames(40);
      assert.ok((await e.page.locator('.vcard.waiting').count()) >= then - 1, 'nothing is made while it waits');
      // Variants made so far are shown, with their events.
      const here = await e.page.locator('.vcard.arrived').allInnerTexts();
      assert.equal(here.length, Number((await e.text('.strip [role="status"]')).split(' ')[0]));
      for (const words of here) assert.match(words, /No conflict|Close|Collision|Near miss|Rule violation|Goal missed/);
      await e.page.getByRole('button', { name: 'Resume' }).click();
      await allMade(e);
      // All of it is one step.
      await e.key('Control+z');
      await e.settled();
      assert.equal((await cards(e)).filter((c) => /^Starts at/.test(c.name)).length, 4);
    },
  );

  it('is restored after a reload, and exported as files', { timeout: 120_000 }, async () => {
    const e = await begin(stage);
    await e.key('Control+s');
    await e.until(() => document.querySelector('.title small').textContent === 'Saved');
    await e.settled();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    await make(e);
    await take(e, 2);
    await e.key('Control+d');
    await take(e, 4);
    await e.key('Control+d');
    await e.settled();
    const before = await cards(e);
    await e.until(() => document.querySelector('.title small').textContent === 'Saved');
    // The file has the scene's own motion and, beside it, that of the kept ones.
    const { scenes: list } = await e.get('/v1/scenes');
    const own = await e.get(`/v1/scenes/${list.find((s) => !s.readonly).id}`);
    assert.equal(own.generated.samples.length, 3);
    assert.deepEqual(
      own.x_editor.variants.map((v) => [v.id, v.kept ?? false, v.sample ?? null]),
      before.map((c) => [c.id, c.kept, c.kept ? (c.id === 2 ? 1 : 2) : null]),
    );
    await e.page.reload();
    await e.ready();
    await e.settled();
    await e.key('Shift+V');
    await e.page.waitForSelector('.vcard canvas');
    await e.settled();
    await e.until(() => ![...document.querySelectorAll('.vcard .tag')].some((t) => t.textContent === '…'));
    assert.deepEqual(await cards(e), before);
    // The kept ones as one file of records: one record each.
    await e.page.locator('.strip [data-action="export-variants"]').click();
    await e.page.waitForSelector('.export [data-scope="kept"][aria-checked="true"]');
    const save = async (kind) => {
      await e.page.locator(`[data-kind="${kind}"]`).click();
      await e.until(() => !document.querySelector('.kind[aria-checked="true"] .tag').textContent.includes('…'));
      const files = [];
      e.page.on('download', (d) => files.push(d));
      await e.page.locator('.export .dfoot .btn.pri').click();
      await e.until(() => /saved/.test(document.querySelector('.toast')?.textContent ?? ''));
      const wanted = kind === 'womd' ? 1 : 2;
      while (files.length < wanted) await e.page.waitForEvent('download').catch(() => undefined);
      e.page.removeAllListeners('download');
      return Promise.all(
        files.map(async (d) => ({ name: d.suggestedFilename(), bytes: readFileSync(await d.path()) })),
      );
    };
    const [records] = await save('womd');
    let n = 0;
    for (let at = 0; at < records.bytes.length; n++) at += 16 + Number(records.bytes.readBigUInt64LE(at));
    assert.equal(n, 2, 'two records in one file');
    await e.page.locator('.strip [data-action="export-variants"]').click();
    await e.page.waitForSelector('.export');
    const scenes = (await save('dragtraffic')).map((f) => JSON.parse(f.bytes));
    assert.equal(scenes.length, 2);
    const kept = before.filter((c) => c.kept);
    for (const [i, c] of kept.entries()) assert.ok(scenes[i].name.endsWith(`, ${c.id} ${c.name}`), scenes[i].name);
    const way = (s) => {
      const f = s.generated.samples[0].agents[car.id];
      return JSON.stringify(f.modes[f.chosen].x_m);
    };
    assert.notEqual(way(scenes[0]), way(scenes[1]), 'each has its own motion');
  });
});
