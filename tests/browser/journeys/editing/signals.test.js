// Parts of the map are clicked: the phases of a signal are dragged on the timeline, and all road users follow; a lane
// has its limit and its users, a crosswalk who goes first.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { pixelsOf } from '../../support/pixels.js';
import { journeys } from '../../support/journey.js';

const PANEL = 'aside.insp';
const EDGE = '.phases .edge';

journeys('signals, lanes and crosswalks', (stage) => {
  it('an edge of a phase is dragged, moved by keys, undone and stored', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const { map, signals } = await e.get('/v1/scenes/demo-crossing');
    const { lane, stop_m, states } = signals.find((s) => s.states.length === 2 && s.states[0][1] === 'go');
    const pick = async ([x, y]) => {
      await e.page.mouse.click(...(await e.at(x, y)));
      await e.frames(2);
    };
    const edge = e.page.locator(EDGE);
    const time = async () => Number(await edge.first().getAttribute('aria-valuenow'));
    await pick(stop_m);
    await edge.waitFor();
    assert.match(await e.text(PANEL), /Signal[^]*Phases[^]*Green[^]*Amber/);
    assert.equal(await time(), states[1][0] / 10);

    // Dragged to 3 s: the edge follows the hand, and the release computes all road users with the new phases.
    const [box, plot] = [await edge.boundingBox(), await e.page.locator('.plot').boundingBox()];
    const perSecond = (plot.width - 74) / 9;
    const asked = e.wire.asked.length;
    // At 4 s the stop line is green before, and amber as soon as the edge is dragged past that time.
    for (let i = 0; i < 40; i++) await e.key('.');
    await e.settled();
    const [sx, sy] = await e.at(...stop_m);
    const amber = async () => {
      const clip = { x: sx - 14, y: sy - 14, width: 28, height: 28 };
      const pixels = await pixelsOf(e.page, await e.page.screenshot({ clip }));
      return pixels.evaluate(({ data }) => {
        let n = 0;
        for (let i = 0; i < data.length; i += 4)
          if (data[i] > 150 && data[i] > data[i + 2] + 90 && data[i + 1] > 90) n++;
        return n;
      });
    };
    const before = await amber();
    const from = [box.x + box.width / 2, box.y + box.height / 2];
    await e.drag(from, [from[0] - ((await time()) - 3) * perSecond, from[1]], { moves: 4 });
    assert.equal(await time(), 3);
    await e.frames(3);
    const dragged = await amber();
    assert.ok(dragged > before + 20, `${dragged} amber pixels of the stop line, ${before} before`);
    assert.equal(e.wire.asked.length, asked, 'nothing is asked in the drag');
    await e.release();
    const { body } = e.wire.last();
    assert.equal(body.agents, 'all');
    const group = signals.filter((s) => JSON.stringify(s.states) === JSON.stringify(states)).map((s) => s.lane);
    const sent = new Map(body.scene.signals.map((s) => [s.lane, s.states]));
    for (const s of signals) {
      const expected = group.includes(s.lane) ? [states[0], [30, states[1][1]]] : s.states;
      assert.deepEqual(sent.get(s.lane), expected, s.lane);
    }
    assert.ok(group.includes(lane) && group.length > 1);
    await e.picture('signal-dragged');

    // Keys move it, too; an undo restores it, and the signal stays picked.
    await edge.focus();
    await e.key('Shift+ArrowRight');
    await e.settled();
    assert.equal(await time(), 4);
    for (const expected of [3, states[1][0] / 10]) {
      await e.key('Control+z');
      await e.settled();
      assert.equal(await time(), expected);
    }
    await e.key('Control+Shift+z');
    await e.settled();
    assert.equal(await time(), 3);

    // Another page has it.
    await e.page.reload();
    await e.ready();
    await e.begin();
    await pick(stop_m);
    await edge.waitFor();
    assert.equal(await time(), 3);

    // Esc lets go of the signal; a crosswalk and a lane have their own words.
    await e.key('Escape');
    await e.until(() => !document.querySelector('.phases'));
    const [p, , q] = map.crosswalks[0].polygon_m;
    await pick([(p[0] + q[0]) / 2, (p[1] + q[1]) / 2]);
    assert.match(await e.text(PANEL), /Crosswalk[^]*Priority[^]*By the signals/);
    const free = map.lanes.find((l) => l.type === 'surface_street' && l.id === lane) ?? map.lanes[0];
    const [x, y] = free.points_m[Math.floor(free.points_m.length / 2)];
    await pick([x, y]);
    assert.match(await e.text(PANEL), /Lane[^]*Speed limit[^]*Who may use it/);
    await e.picture('lane-picked');
  });

  it('the limit of a lane and its users are changed, undone and stored', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const { map } = await e.get('/v1/scenes/demo-crossing');
    // A lane of an arm in sight; its middle is clicked.
    const streets = map.lanes.filter((l) => l.type === 'surface_street' && l.speed_limit_mps && !l.interpolating);
    const places = await Promise.all(streets.map((l) => e.at(...l.points_m[l.points_m.length >> 1])));
    const pick = async () => {
      for (const [i, place] of places.entries()) {
        if (!(await e.open(place))) continue;
        await e.page.mouse.click(...place);
        await e.frames(2);
        if (await e.page.locator('[data-field="lane-limit"]').count()) return streets[i];
        await e.key('Escape');
      }
      return assert.fail('a lane is in sight');
    };
    const picked = await pick();
    const pickAgain = async () => {
      await e.page.mouse.click(...places[streets.indexOf(picked)]);
      await e.page.waitForSelector('[data-field="lane-limit"]');
    };
    const shown = () => e.value('lane-limit');
    const was = Math.round(picked.speed_limit_mps * 3.6);
    assert.equal(await shown(), was);
    const sent = () => e.wire.last().body;
    const ruleSent = () => {
      const { type, speed_limit_mps } = sent().scene.map.lanes.find((l) => l.id === picked.id);
      return [type, speed_limit_mps && Math.round(speed_limit_mps * 3.6)];
    };
    await e.type('lane-limit', '30');
    assert.equal(sent().agents, 'all');
    assert.deepEqual(ruleSent(), ['surface_street', 30]);
    assert.match(await e.text(PANEL), new RegExp(`In the map: ${was} km/h`));
    await e.page.selectOption('[data-field="lane-users"]', 'bus_lane');
    await e.settled();
    assert.deepEqual(ruleSent(), ['bus_lane', 30]);
    assert.match(await e.text(PANEL), /In the map: Motor vehicles and cyclists/);
    await e.picture('lane-changed');
    const users = () => e.page.locator('[data-field="lane-users"]').inputValue();
    await e.key('Control+z');
    await e.settled();
    assert.deepEqual([await shown(), await users()], [30, 'surface_street']);

    // Another page has it, and so has a saved copy, whose undo leads back to the rule of the map.
    await e.page.reload();
    await e.ready();
    await e.begin();
    await pickAgain();
    assert.equal(await shown(), 30);
    await e.key('Control+s');
    const saved = () => e.until(() => document.querySelector('.title small').textContent === 'Saved');
    await saved();
    const name = await e.page.inputValue('.title input');
    const { id } = (await e.get('/v1/scenes')).scenes.find((s) => s.name === name);
    const stored = async () => {
      const json = await e.get(`/v1/scenes/${id}`);
      return Math.round(json.map.lanes.find((l) => l.id === picked.id).speed_limit_mps * 3.6);
    };
    assert.equal(await stored(), 30);
    await e.page.reload();
    await e.ready();
    await e.begin();
    const undo = e.page.locator('[data-action="undo"]').first();
    await undo.click();
    await e.settled();
    assert.equal(await undo.isDisabled(), true);
    // Saved a moment after the step.
    while ((await stored()) !== was) await e.frames(10);
    await pickAgain();
    assert.equal(await shown(), was);
  });
});
