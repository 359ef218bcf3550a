// The first minute: look, click a car, drag its goal, release.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { drawnTexts } from '../../support/drawing.js';
import { distance } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';
import { Wire } from '../../support/wire.js';

/** Scripts, style, font, the scene and the thumbnails of all examples, as transferred. */
const MOST_BYTES_AT_FIRST = 400_000;

journeys('the first minute', (stage) => {
  it('opens the example crossing, plays it once and waits to be clicked', { timeout: 40_000 }, async () => {
    const e = await stage.open();
    await e.until(() => parseFloat(document.querySelector('.tm').textContent) > 0.3);
    assert.equal(await e.page.inputValue('.title input'), 'Rosa & 5th');
    const users = await e.roadUsers();
    const named = await e.page.getByRole('navigation', { name: /^Road users, \d+$/ }).getAttribute('aria-label');
    assert.ok(users.length > 20 && users.length <= Number(named.match(/\d+/)[0]), named);
    for (const kind of ['Car', 'Cyclist', 'Pedestrian'])
      assert.ok(
        users.some((u) => u.kind === kind && u.speed > 0),
        `a ${kind} that moves`,
      );
    assert.match(await e.text('.coach'), /Click a car/);
    await e.until(() => document.querySelector('.tm').textContent.startsWith('0.0'));
    await e.settled();
    await e.picture('first-view');
    // All of it, thumbnails too, before any action.
    const pictures = () => document.querySelectorAll('.scn canvas[data-done]').length >= 5;
    await e.until(pictures);
    assert.ok(e.wire.bytes < MOST_BYTES_AT_FIRST, `${e.wire.bytes} bytes were loaded`);
    await e.key('Space');
    await e.until(() => parseFloat(document.querySelector('.tm').textContent) > 0.5);
    await e.key('Space');
  });

  it('lists six futures of a clicked car', { timeout: 40_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    const at = await e.at(car.start.x, car.start.y);
    await e.page.mouse.move(...at, { steps: 4 });
    await e.until(() => document.querySelector('.card.tip')?.offsetParent !== null);
    assert.ok((await e.text('.card.tip')).startsWith(`${car.name} · `));
    await e.picture('hover');
    await e.page.mouse.down();
    await e.page.mouse.up();
    await e.page.waitForSelector('.fu');
    await e.settled();
    assert.equal(await e.text('.ih h2'), car.name);
    const rows = await e.page.locator('.fu[data-future]').evaluateAll((all) =>
      all.map((f) => ({
        letter: f.dataset.future,
        name: f.querySelector('.nm').textContent,
        rank: f.querySelector('.rank').textContent,
      })),
    );
    assert.deepEqual(
      rows.map((r) => r.letter),
      ['A', 'B', 'C', 'D', 'E', 'F'],
    );
    assert.ok(
      rows.every((r) => r.name.length > 3),
      'every future has a name',
    );
    assert.deepEqual(
      rows.map((r) => r.rank),
      ['#1', '#2', '#3', '#4', '#5', '#6'],
    );
    // A known answer is not requested again.
    const asked = e.wire.asked.findLast((a) => a.body.agents?.includes(car.id));
    const { calibrated, samples } = asked.event('final');
    assert.equal(calibrated, false, 'the page shows ranks as long as the probabilities are not calibrated');
    const { modes } = samples[0].agents[car.id];
    assert.ok(Math.abs(modes.reduce((s, m) => s + m.probability, 0) - 1) < 1e-6);
    await e.picture('selected');
  });

  it('marks no fault before anything is asked, except of the future pointed at', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const faulty = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 2.5);
    const marks = e.page.locator('.fu .mk:not([class="mk"])');
    const worst = ['collision', 'over_median', 'off_road', 'red_light'];
    for (const { id } of faulty) {
      await e.choose(id);
      const asked = e.wire.asked.findLast((a) => a.body.agents?.includes(id));
      const { modes } = asked.event('final').samples[0].agents[id];
      const bad = modes.findIndex((m) => m.faults?.some((f) => worst.includes(f.kind)));
      if (bad < 0) continue;
      assert.equal(await marks.count(), 0);
      const letter = 'ABCDEF'[bad];
      await e.page.locator(`.fu[data-future="${letter}"]`).focus();
      await e.until((l) => document.querySelector(`.fu[data-future="${l}"] .mk[role="img"]`), letter);
      assert.equal(await marks.count(), 1);
      await e.picture('fault-pointed-at');
      return;
    }
    assert.fail('a car has a future with a fault');
  });

  it('says of which time a speed is, and how a goal is set', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    assert.ok((await drawnTexts(e)).includes('Drag to set a goal'));
    for (let i = 0; i < 20; i++) await e.key('.');
    await e.settled();
    const texts = await drawnTexts(e);
    assert.ok(
      texts.some((t) => /^\d+ km\/h at 2\.0 s$/.test(t)),
      texts.join(', '),
    );
  });

  it('steers a goal flag: futures follow the drag, and the others react', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.page.mouse.click(...(await e.at(car.start.x, car.start.y)));
    await e.page.waitForSelector('.fu');
    await e.settled();
    const flag = await e.at(car.end.x, car.end.y);
    const grip = [flag[0] + 9, flag[1] - 26];
    const target = await e.at(
      car.start.x + (car.end.x - car.start.x) * 0.7,
      car.start.y + (car.end.y - car.start.y) * 0.7,
    );
    const mark = e.wire.asked.length;
    await e.drag(grip, [target[0] + 9, target[1] - 26], {
      moves: 72,
      then: (i) => (i === 48 ? e.picture('mid-drag') : null),
    });
    assert.match(await e.text('.helpbar'), /where others would wait/);
    await e.settled();
    assert.match(await e.text('.status'), /Six futures/);
    const [previews, previewed] = [false, true].map((react) =>
      e.wire.since(mark).filter((a) => a.body.react === react),
    );
    assert.ok(previews.length > 3, `${previews.length} requests while moving`);
    assert.ok([...previews, ...previewed].every((a) => a.body.conditions[car.id]?.goal));
    const revisions = previews.map((a) => a.body.revision);
    assert.ok(
      revisions.every((r, i) => i === 0 || r > revisions[i - 1]),
      `rising revisions: ${revisions}`,
    );
    assert.ok(Wire.crowd(previews) <= 3, 'at most one on the way beside the two it passes');
    // Reactions are requested on a connection of their own, the last one for the present place of the flag.
    assert.ok(previewed.length && Wire.crowd(previewed) <= 2, 'at most one on the way beside the one it replaces');
    assert.ok(previewed.every((a) => a.body.client !== previews[0].body.client));
    assert.deepEqual(previewed.at(-1).body.conditions, previews.at(-1).body.conditions);
    const wouldChange = await e.page.locator('.previewed .ch').allInnerTexts();
    // The time of the computation is there for those who point at the line.
    assert.match(await e.page.getAttribute('.bl .status .row', 'title'), /^Computed in \d+ ms$/);
    assert.doesNotMatch(await e.text('.status'), /\d ms/);
    // As many drafts as a screen can show before the answer: none where that comes at once.
    for (const names of previews.map((a) => a.events().map((v) => `${v.event} ${v.step ?? ''}`.trim()))) {
      const drawn = names.filter((name) => /initial|step/.test(name));
      assert.deepEqual(drawn, [...new Set(drawn)].sort(), 'no step comes twice or late');
    }
    assert.ok(previews.some((a) => a.events().at(-1).event === 'final'));

    const released = e.wire.asked.length;
    await e.page.mouse.up();
    await e.page.waitForSelector('.toast');
    assert.match(
      await e.text('.toast'),
      new RegExp(
        `^Goal of ${car.name} moved\\. (No other road user is affected|Collision with|\\d+ others? changed)\\.`,
      ),
    );
    await e.settled();
    assert.deepEqual(
      e.wire.since(released).filter((a) => a.body.react === true),
      [],
      'the release is answered by what was previewed',
    );
    assert.deepEqual(await e.page.locator('.ch').allInnerTexts(), wouldChange);
    const commit = previewed.at(-1);
    const asked = commit.body.conditions[car.id].goal;
    const answer = commit.event('final').samples[0].agents[car.id];
    const chosen = answer.modes[answer.chosen];
    const step = Math.round(asked.time_s * 10) - chosen.first_step;
    const missed = Math.hypot(chosen.x_m[step] - asked.x_m, chosen.y_m[step] - asked.y_m);
    assert.ok(missed <= 0.1, `the chosen future ends ${missed.toFixed(3)} m from the flag`);
    const shown = await e.goal();
    assert.ok(Math.hypot(shown.x - asked.x_m, shown.y - asked.y_m) <= 0.08, 'the inspector shows the flag');
    assert.ok(distance(shown, car.end) > 3, 'the flag has moved');
    assert.match(await e.text('.hint'), /^(Reached|Only)/);
    await e.settled();
    await e.picture('after-release');
  });
});
