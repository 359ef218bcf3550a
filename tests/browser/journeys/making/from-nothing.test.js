// An empty map becomes a scene: placing, goals, events, all of it saved.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { distance } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';
import { along, boxOf, lanesBeside, openEmpty } from '../../support/maps.js';

const saved = (e) => e.until(() => document.querySelector('.title small').textContent === 'Saved');

/** The open scene, as the server has it. */
async function stored(e) {
  const get = async (path) => (await e.page.request.get(new URL(path, e.page.url()).href)).json();
  const { scenes } = await get('/v1/scenes');
  const name = await e.page.inputValue('.title input');
  return get(`/v1/scenes/${scenes.find((s) => s.name === name && !s.readonly).id}`);
}

/** Removes the focus from a field: keys go to the picture again. */
const leaveField = (e) => e.page.evaluate(() => document.activeElement?.blur?.());

const clickAt = async (e, x, y) => {
  const at = await e.at(x, y);
  await e.page.mouse.move(...at, { steps: 3 });
  await e.page.mouse.click(...at);
  await e.settled();
};

journeys('from nothing', (stage) => {
  it('a cut-in: two cars, a goal in the other lane, all of it saved', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    const { a, b } = lanesBeside(await openEmpty(e));
    assert.match(await e.text('.nobody'), /No road users yet/);
    await e.picture('nobody');
    await e.key('c');
    assert.equal(await e.shows('.nobody'), false);
    await clickAt(e, ...along(a, 8));
    assert.equal((await e.roadUsers()).length, 1);
    const [first] = await e.roadUsers();
    assert.equal(first.kind, 'Car');
    await e.picture('placed');
    // A little ahead in the adjacent lane, with the same tool: several in a row.
    await clickAt(e, ...along(b, 16));
    const [, second] = await e.roadUsers();
    await e.key('Escape');
    await e.type('start-speed', '30');
    await e.choose(first.id);
    await e.type('start-speed', '14 m/s');
    assert.equal(await e.value('start-speed'), 50);
    const behind = await e.pose('Start');
    const box = e.page.locator('[data-agent]');
    assert.equal(await box.count(), 2);

    // The one ahead changes into the lane of the faster one.
    await e.choose(second.id);
    const ahead = await e.pose('Start');
    assert.ok(Math.abs(distance(behind, ahead) - Math.hypot(8, 3.4)) < 3, `${distance(behind, ahead)} m apart`);
    const [gx, gy] = along(a, 52);
    await e.type('goal-pos', gx.toFixed(1), 0);
    await e.type('goal-pos', gy.toFixed(1), 1);
    await e.type('goal-time', '5');
    const answer = e.wire.last().event('final');
    assert.ok(answer.samples[0].agents[second.id], 'the one with the goal is worked out');
    // The headline is good only for the shown future, and only without faults.
    const { modes, chosen } = answer.samples[0].agents[second.id];
    const said = e.page.locator('.hint').first();
    const wrong = (modes[chosen].faults ?? []).map((f) => f.kind);
    assert.equal(/\bok\b/.test(await said.getAttribute('class')), !wrong.length, `${await said.innerText()}: ${wrong}`);
    const ranked = [...modes].sort((p, q) => q.probability - p.probability);
    for (const [i, mode] of ranked.entries()) {
      const hits = (mode.faults ?? []).some((f) => f.kind === 'collision');
      const mark = e.page.locator('.fu[data-future]').nth(i).locator('.mk');
      if (hits) assert.match(await mark.getAttribute('class'), /collision/, `${i}`);
    }
    await e.picture('cut-in');
    const events = await e.page.locator('.badge').count();
    const words = await e.text('.status');
    assert.ok(events > 0 || /futures|near|collision|rule/i.test(words), words);

    // A picked future with a collision has it in the headline too, unless the other one gives way.
    const collides = e.page.locator('.fu:has(.mk.collision)').first();
    if (await collides.count()) {
      await collides.click();
      await e.settled();
      if (/collision/.test(await said.getAttribute('class')))
        assert.match(await said.innerText(), new RegExp(`hits ${first.name} at \\d\\.\\d s`, 'i'));
      else assert.match(await e.text('section[aria-label="Others that changed"]'), new RegExp(`${first.name}\\b`));
      await e.key('Control+z');
      await e.settled();
    }

    // Its pennant stays when another road user is selected, and leads back to it.
    await leaveField(e);
    await e.key('z');
    await e.settled();
    await e.choose(first.id);
    const [px, py] = await e.at(gx, gy);
    assert.ok(await e.open([px + 5, py - 14], 4), 'the pennant is in view');
    await e.page.mouse.click(px + 5, py - 14);
    await e.page.waitForSelector('.fu');
    await e.settled();
    assert.equal(await e.text('.ih h2'), second.name);

    // In playback both move from the first moment.
    await leaveField(e);
    await e.key('Space');
    await e.until(() => parseFloat(document.querySelector('.tm').textContent) > 1);
    await e.key('Space');
    await e.key('Home');
    await saved(e);
    const scene = await stored(e);
    assert.deepEqual(
      scene.agents.map((v) => [v.id, v.type, v.track.x_m.length]),
      [
        [first.id, 'vehicle', 1],
        [second.id, 'vehicle', 1],
      ],
    );
    assert.ok(Math.abs(scene.agents[1].conditions.goal.x_m - gx) < 0.06);
    const before = await e.inspector();
    await e.page.reload();
    await e.ready();
    await e.settled();
    await e.choose(second.id);
    assert.deepEqual(await e.inspector(), before);
  });

  it('a crowd at a crosswalk, and a cyclist that passes through it', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    const { map } = await openEmpty(e);
    // The crosswalk on the right-hand side, clear of all panels.
    const walk = map.crosswalks.map((c) => boxOf(c.polygon_m)).sort((p, q) => q.x0 - p.x0)[0];
    await e.key('6');
    await e.page.getByRole('radio', { name: 'Over an area' }).click();
    assert.equal(await e.page.inputValue('[data-field="place-count"]'), '20');
    await e.drag(await e.at(walk.x0, walk.y1), await e.at(walk.x1, walk.y0), { moves: 6 });
    await e.picture('crowd-in-hand');
    await e.release();
    assert.equal((await e.roadUsers()).length, 20);
    assert.match(await e.text('.ih'), /20 road users\s+20 pedestrians/);
    await e.key('Escape');

    // One value for all of them, as one step.
    const speed = e.page.locator('[data-field="all-start-speed"]');
    await speed.click();
    await speed.fill('1.1');
    await speed.press('Enter');
    await e.settled();
    assert.ok((await e.roadUsers()).every((u) => u.speed === 1.1));
    await speed.fill('+0.2');
    await speed.press('Enter');
    await e.settled();
    assert.ok((await e.roadUsers()).every((u) => Math.abs(u.speed - 1.3) < 0.01));
    await speed.fill('40');
    await speed.press('Enter');
    assert.match(await e.text('.field .why'), /0 to 6 m\/s/);
    await speed.press('Escape');
    await leaveField(e);
    await e.key('Control+z');
    await e.settled();
    assert.ok((await e.roadUsers()).every((u) => u.speed === 1.1));
    await e.picture('crowd');

    // A cyclist on the bike lane that leads over the crosswalk.
    const leads = map.lanes.filter((l) => l.type === 'bike_lane').map((l) => l.points_m);
    const over = leads.find((p) => {
      const [start, end] = [p[0], p.at(-1)];
      return start[0] < walk.x0 - 30 && end[0] > walk.x0 && Math.abs(start[1] - end[1]) < 10;
    });
    assert.ok(over, 'a bike lane leads over the crosswalk');
    await e.key('5');
    await clickAt(e, ...along(over, 12));
    await e.key('Escape');
    const rider = (await e.roadUsers()).find((u) => u.kind === 'Cyclist');
    assert.ok(rider.speed > 3, rider.words);
    const exit = map.lanes.find(
      (l) =>
        l.type === 'bike_lane' && Math.hypot(l.points_m[0][0] - over.at(-1)[0], l.points_m[0][1] - over.at(-1)[1]) < 1,
    );
    const [gx, gy] = along(exit.points_m, 14);
    await e.type('goal-pos', gx.toFixed(1), 0);
    await e.type('goal-pos', gy.toFixed(1), 1);

    await leaveField(e);
    // All at once: the closest two, and when.
    await e.key('Control+a');
    await e.settled();
    assert.match(await e.text('.ih'), /21 road users/);
    const closest = e.page.locator('.closest');
    const words = await closest.innerText();
    const [, who, metres, seconds] =
      /^(.+): ([\d.]+ m|in contact)\s+at ([\d.]+) s$/.exec(words.replace(/\s+/g, ' ')) ?? [];
    assert.match(who ?? words, /Cyclist/);
    await closest.click();
    await e.settled();
    assert.ok((await e.text('.tm')).startsWith(seconds), `${await e.text('.tm')}, ${words}`);
    await e.picture('closest');
    assert.ok(metres === 'in contact' || parseFloat(metres) < 12, words);
    await e.key('Home');
    await saved(e);
    assert.equal((await stored(e)).agents.length, 21);
  });
});
