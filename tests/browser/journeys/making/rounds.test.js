// Rounds: futures of one car are kept and rejected, drawn again from that, and one of them is taken.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

/** Contents of the cards: `{ letter, name, facts, verdict, why }`. */
const cards = (e) =>
  e.page.locator('.rcard').evaluateAll((all) =>
    all.map((el) => ({
      letter: el.dataset.card,
      name: el.querySelector('.nm').textContent,
      facts: el.querySelector('small').textContent,
      verdict: el.querySelector('.face .tag')?.textContent ?? null,
      why: el.querySelector('select').selectedOptions[0].textContent,
    })),
  );
const drawn = async (e) => (await cards(e)).map(({ name, facts }) => `${name}, ${facts}`);
const round = (e) => e.text('.rounds h2');
const learnt = (e) => e.page.locator('.wishrow b').allInnerTexts();

async function open(e) {
  await e.key('Shift+K');
  await e.page.waitForSelector('.rcard');
  await e.settled();
}

async function next(e) {
  await e.key('Enter');
  await e.frames(2);
  // The round of a whole scene plans everybody six times.
  await e.page.waitForSelector('main.stage[aria-busy="false"]', { timeout: 60_000 });
  await e.settled();
}

/** Keeps the two calmest and rejects the three that are driven hardest; returns the letter of the worst. */
async function judge(e) {
  const { cards: like } = e.wire.last().event('final').feedback;
  const order = like.map((c, i) => ({ i, v: c.features.harshness_mps2 })).sort((a, b) => a.v - b.v);
  for (const { i } of order.slice(0, 2)) {
    await e.key(String(i + 1));
    await e.key('k');
  }
  for (const { i } of order.slice(-3)) {
    await e.key(String(i + 1));
    await e.key('j');
  }
  await e.settled();
  return 'ABCDEF'[order.at(-1).i];
}

journeys('rounds', (stage) => {
  it('draws by preference, round after round, and takes one of them', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.key('Control+s');
    await e.until(() => document.querySelector('.title small').textContent === 'Saved');
    await e.settled();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    const usual = await e.page.locator('.fu .nm').allInnerTexts();
    await open(e);
    const first = await drawn(e);
    assert.equal(first.length, 6);
    assert.equal(new Set(first).size, 6, `${first}`);
    assert.equal(await round(e), 'Round 1');
    const asked = e.wire.last();
    assert.deepEqual(
      [asked.body.agents, asked.body.react, asked.body.feedback],
      [[car.id], false, { answers: [], wishes: [], forgotten: [] }],
    );
    const worst = await judge(e);
    await e.page.getByLabel(`Why, ${worst}`).selectOption({ label: 'too harsh' });
    await e.settled();
    const judged = await cards(e);
    assert.deepEqual(judged.map((c) => c.verdict).sort(), ['Kept', 'Kept', 'Rejected', 'Rejected', 'Rejected', null]);
    assert.equal(judged.find((c) => c.letter === worst).why, 'too harsh');
    assert.match(await e.text('.counts'), /2 kept\s*3 rejected\s*1 open/);
    await e.picture('rounds-judged');
    // The next six are based on it, none of them was judged before, and the learned preferences are listed.
    await next(e);
    assert.equal(await round(e), 'Round 2');
    const sent = e.wire.last().body.feedback.answers;
    assert.deepEqual(sent.map((a) => a.verdict).sort(), ['keep', 'keep', 'reject', 'reject', 'reject']);
    assert.deepEqual(
      sent.flatMap((a) => a.why ?? []),
      [{ trait: 'harshness', wants: 'less' }],
    );
    const second = await drawn(e);
    assert.equal(second.length, 6);
    assert.notDeepEqual(second, first);
    const wishes = await learnt(e);
    assert.ok(wishes.length >= 1, 'something is learnt');
    assert.ok(wishes.includes('Smoother'), `${wishes}`);
    assert.match(await e.text('[data-wish="Smoother"] p'), /kept [\d.]+, rejected [\d.]+ m\/s²/);
    await e.picture('rounds-second');
    // Undo shows the first six again, with their verdicts.
    await e.key('Control+z');
    await e.settled();
    assert.equal(await round(e), 'Round 1');
    assert.deepEqual(await cards(e), judged);
    await e.key('Control+Shift+z');
    await e.settled();
    assert.deepEqual(await drawn(e), second);
    // A preference is forgotten, another is added: both are plain steps.
    await e.page.getByRole('button', { name: 'Remove: Smoother' }).first().click();
    assert.ok(!(await learnt(e)).includes('Smoother'));
    await e.key('Control+z');
    assert.ok((await learnt(e)).includes('Smoother'));
    await e.page.getByLabel('Add a preference').selectOption({ label: 'Waits longer' });
    assert.ok((await learnt(e)).includes('Waits longer'));
    await e.key('2');
    await e.key('k');
    await e.settled();
    // No road user has reacted to the cards; a taken card gets reactions like any picked future.
    const mark = e.wire.asked.length;
    const [, taken] = await cards(e);
    await e.page.locator('[data-take="B"]').click();
    await e.settled();
    assert.equal(await e.page.locator('.rcard').count(), 0);
    const picked = e.wire.since(mark).find((q) => q.body.pinned);
    assert.deepEqual([picked.body.agents, picked.body.pinned, picked.body.react], [[car.id], [car.id], true]);
    const row = e.page.locator('.fu[aria-checked="true"]');
    assert.equal(await row.getAttribute('data-future'), 'B');
    assert.equal(await row.locator('.nm').innerText(), taken.name);
    await e.picture('rounds-taken');
    // Undone, the usual six are as before.
    await e.key('Control+z');
    await e.settled();
    assert.deepEqual(await e.page.locator('.fu .nm').allInnerTexts(), usual);
    await e.key('Control+Shift+z');
    await e.settled();
    assert.equal(await row.locator('.nm').innerText(), taken.name);
    // Saved and opened again, the feedback is still there and counts.
    await e.until(() => document.querySelector('.title small').textContent === 'Saved');
    const { scenes } = await e.get('/v1/scenes');
    const own = await e.get(`/v1/scenes/${scenes.find((s) => !s.readonly).id}`);
    assert.equal(own.x_editor.feedback[car.id].answers.length, 6);
    await e.page.reload();
    await e.ready();
    await e.settled();
    await e.choose(car.id);
    assert.equal(await row.locator('.nm').innerText(), taken.name);
    await open(e);
    assert.equal(await round(e), 'Round 3');
    assert.equal(e.wire.last().body.feedback.answers.length, 6);
    assert.deepEqual(e.wire.last().body.feedback.wishes, [{ trait: 'standing', wants: 'more' }]);
    assert.match(await e.text('.roundlist'), /Round 1\s*2 kept, 3 rejected\s*Round 2\s*1 kept, 0 rejected/);
    const download = e.page.waitForEvent('download');
    await e.page.locator('[data-action="round-table"]').click();
    const table = readFileSync(await (await download).path(), 'utf8')
      .trim()
      .split('\r\n');
    assert.equal(table.length, 7);
    assert.match(table[0], /^round,letter,name,verdict,why,pace_mps,gap_s,harshness_mps2,standing_s/);
    assert.ok(
      table.some((l) => l.startsWith('1,') && l.includes('reject,too harsh')),
      table.join('\n'),
    );
    await e.key('Escape');
    await e.until(() => !document.querySelector('.rcard'));
    assert.ok(await e.shows('.fu'), 'the road user is still selected');
  });

  it('closes after another change of the scene, and keeps the feedback', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    await open(e);
    await e.key('k');
    await e.key('ArrowRight');
    await e.key('j');
    await e.settled();
    const said = await cards(e);
    assert.deepEqual(
      said.map((c) => c.verdict),
      ['Kept', 'Rejected', null, null, null, null],
    );
    await e.key('Escape');
    await open(e);
    assert.deepEqual(await cards(e), said, 'the same question has the same cards');
    // The same key again clears the verdict.
    await e.key('k');
    assert.equal((await cards(e))[0].verdict, null);
    await e.key('Control+z');
    await e.key('r');
    await e.settled();
    assert.equal(await e.page.locator('.rcard').count(), 0, 'another seed is another question');
    await open(e);
    assert.equal(await round(e), 'Round 2');
    assert.equal(e.wire.last().body.feedback.answers.length, 2);
  });

  it("ends with the kept ones as variants, each with the others' reactions", { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    await open(e);
    const names = (await cards(e)).map((c) => c.name);
    for (const key of ['1', 'k', '3', 'k', '4', 'j']) await e.key(key);
    await e.settled();
    await e.page.getByRole('button', { name: 'Keep 2 as variants' }).click();
    await e.until(() => document.querySelectorAll('.vcard[data-variant]').length === 2);
    await e.settled();
    assert.equal(await e.page.locator('.rcard').count(), 0);
    const pinned = e.wire.asked.filter((q) => q.body.pinned);
    assert.deepEqual(
      pinned.map((q) => q.body.pinned),
      [[car.id], [car.id]],
    );
    for (const [id, name] of [
      [2, names[2]],
      [1, names[0]],
    ]) {
      await e.page.locator(`[data-variant="${id}"] .face`).click();
      await e.settled();
      assert.equal(await e.page.locator('.fu[aria-checked="true"] .nm').innerText(), name);
    }
    assert.equal(await e.page.locator('.vcard .keep[aria-pressed="true"]').count(), 2);
  });

  it(
    'of the whole scene are joint ways: pulled up kept, down rejected, one taken for everybody',
    { timeout: 150_000 },
    async () => {
      const e = await stage.open();
      await e.begin();
      await e.key('b');
      await e.key('Alt+K');
      await e.page.waitForSelector('.rcard', { timeout: 60_000 });
      await e.settled();
      const asked = e.wire.last();
      assert.deepEqual([asked.body.agents, asked.body.feedback.answers], ['all', []]);
      const { samples } = asked.event('final');
      const all = await cards(e);
      assert.equal(all.length, samples.length);
      assert.equal(new Set(all.map((c) => c.name)).size, all.length, 'names are told apart');
      assert.match(await e.text('.rounds header'), /six futures of the scene/);
      const pull = async (nth, by) => {
        const r = await e.page.locator('.rcard .face').nth(nth).boundingBox();
        const [x, y] = [r.x + r.width / 2, r.y + r.height / 2];
        await e.drag([x, y], [x, y + by], { moves: 4 });
        await e.release();
      };
      await pull(0, -60);
      await pull(1, 60);
      await pull(2, 20);
      assert.deepEqual(
        (await cards(e)).map((c) => c.verdict),
        ['Kept', 'Rejected', ...all.slice(2).map(() => null)],
      );
      await e.picture('rounds-scene');
      await next(e);
      assert.equal(await round(e), 'Round 2');
      const sent = e.wire.last().body.feedback.answers;
      assert.deepEqual(
        sent.map((a) => a.verdict),
        ['keep', 'reject'],
      );
      assert.ok(Object.keys(sent[0].places).length > 1, 'everybody is in it');
      // One of them becomes the motion of all, at once: without a request.
      const drawn = e.wire.last().event('final').samples[2].agents;
      const mark = e.wire.asked.length;
      await e.page.locator('[data-take="C"]').click();
      await e.settled();
      assert.equal(await e.page.locator('.rcard').count(), 0);
      assert.equal(e.wire.since(mark).length, 0);
      const [id, { modes, chosen }] = Object.entries(drawn).find(([, f]) => {
        const m = f.modes[f.chosen];
        return Math.hypot(m.x_m.at(-1) - m.x_m[0], m.y_m.at(-1) - m.y_m[0]) > 10;
      });
      await e.choose(id);
      const end = await e.pose('Goal');
      const m = modes[chosen];
      assert.ok(Math.hypot(end.x - m.x_m.at(-1), end.y - m.y_m.at(-1)) < 0.2, 'it goes where the card says');
      await e.letGo();
      await e.key('Control+z');
      await e.settled();
      await e.key('Alt+K');
      await e.settled();
      assert.equal(await round(e), 'Round 2', 'what was said is still there');
    },
  );
});
