// A cut-in from nothing: two cars are placed, and the goal of one is typed relative to the other. It keeps its relation
// when the other one moves.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { distance } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';
import { along, lanesBeside, openEmpty } from '../../support/maps.js';

const FIELD = '[data-text="relation"]';
const GAP_M = 12;
/** Places of words around a place, pixels. */
const AROUND = [-60, 0, 60].flatMap((dx) => [-20, -36, -52, 52, 36, 20].map((dy) => [dx, dy]));

async function clickAt(e, x, y) {
  const at = await e.at(x, y);
  await e.page.mouse.move(...at, { steps: 3 });
  await e.page.mouse.click(...at);
  await e.settled();
}

async function relate(e, words) {
  await e.page.click(FIELD);
  await e.page.fill(FIELD, words);
  await e.page.press(FIELD, 'Enter');
  await e.settled();
}

/** The last answer with futures of a road user. */
const answerOf = (e, id) =>
  e.wire.asked
    .map((asked) => asked.event('final'))
    .filter((final) => final?.resolved?.[id])
    .at(-1);

/** Where it put the goal of the road user. */
const placed = (e, id) => answerOf(e, id).resolved[id].goal;

/** Gap between the goal and the other one then, along the goal's heading, metres. */
function gapOf(goal, other, lengths) {
  const h = goal.heading_rad.value;
  const ahead = (goal.x_m.value - other[0]) * Math.cos(h) + (goal.y_m.value - other[1]) * Math.sin(h);
  return ahead - lengths;
}

/** Presses the words of the offer: they are around the middle between the goal and the other one behind it. */
async function pressWords(e, goal, gap) {
  const back = (gap + 4.7) / 2;
  const at = await e.at(goal.x - back * Math.cos(goal.heading), goal.y - back * Math.sin(goal.heading));
  for (const [dx, dy] of AROUND) {
    await e.page.mouse.move(at[0] + dx, at[1] + dy);
    await e.frames(2);
    if (!(await e.page.evaluate(() => document.querySelector('main.stage').dataset.cursor === 'pointer'))) continue;
    await e.page.mouse.down();
    await e.page.mouse.up();
    return true;
  }
  return false;
}

journeys('goals relative to another road user', (stage) => {
  it('a cut-in is typed, and kept when the other car moves', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    const { a, b } = lanesBeside(await openEmpty(e));
    await e.key('c');
    await clickAt(e, ...along(a, 8));
    await clickAt(e, ...along(b, 16));
    const [first, second] = await e.roadUsers();
    await e.key('Escape');
    await e.choose(first.id);
    await e.type('start-speed', '10 m/s');
    const leading = e.wire.last().event('final').samples[0].agents[first.id];
    const ahead = leading.modes[leading.chosen];
    await e.choose(second.id);
    await e.type('start-speed', '10 m/s');
    const start = await e.pose('Start');

    // The lane of the other one is beside the own one, on the left or on the right.
    const [ax, ay] = along(a, 16);
    const left = (ax - start.x) * -Math.sin(start.heading) + (ay - start.y) * Math.cos(start.heading);
    await relate(e, 'somewhere ahead');
    assert.match(await e.text('.goalsec [role="alert"]'), /Name another road user/);
    await relate(e, `${GAP_M} m ahead of ${first.name} at 5 s, 2 m/s slower`);
    const said = await e.page.inputValue(FIELD);
    assert.match(said, new RegExp(`^12 m ahead of ${first.name} at 5\\.0 s, 7\\.2 km/h slower$`));
    const asked = e.wire.last();
    const relation = { to: first.id, ahead_m: GAP_M, slower_mps: 2 };
    assert.deepEqual(asked.body.conditions[second.id].goal, { time_s: 5, relation });
    const goal = placed(e, second.id);
    assert.equal(goal.x_m.from, 'relation');
    // In the lane of the other one.
    const aside = (ax - goal.x_m.value) * -Math.sin(start.heading) + (ay - goal.y_m.value) * Math.cos(start.heading);
    assert.ok(Math.abs(left) > 2 && Math.abs(aside) < 1, `${left.toFixed(1)} m, ${aside.toFixed(1)} m`);
    // Two below the speed that the other one has by then.
    const leader = Math.hypot(ahead.vx_mps[49], ahead.vy_mps[49]);
    assert.ok(Math.abs(goal.speed_mps.value - (leader - 2)) < 1, `${goal.speed_mps.value}, ${leader} m/s`);
    await e.picture('relation');
    const before = await e.pose('Goal');
    assert.ok(Math.abs(before.x - goal.x_m.value) < 0.1 && Math.abs(before.y - goal.y_m.value) < 0.1);

    // The other one starts further back: the goal goes with it.
    await e.choose(first.id);
    const behind = await e.pose('Start');
    await e.type('start-pos', (behind.x - 12 * Math.cos(behind.heading)).toFixed(1), 0);
    const moved = placed(e, second.id);
    const step = Math.hypot(moved.x_m.value - goal.x_m.value, moved.y_m.value - goal.y_m.value);
    assert.ok(step > 3, `the goal moved by ${step.toFixed(1)} m`);
    const { modes, chosen } = answerOf(e, second.id).samples[0].agents[first.id];
    const own = modes[chosen];
    const k = 50 - own.first_step;
    if (own.x_m) {
      const gap = gapOf(moved, [own.x_m[k], own.y_m[k]], 4.7);
      assert.ok(Math.abs(gap - GAP_M) < 1.5, `${gap.toFixed(1)} m`);
    }
    await e.choose(second.id);
    const after = await e.pose('Goal');
    assert.ok(Math.abs(distance(before, after) - step) < 0.3, `${distance(before, after)} m, ${step} m`);
    await e.picture('relation-moved');

    // Undo goes back, saving keeps it, and dragging the flag ends it.
    await e.page.evaluate(() => document.activeElement?.blur?.());
    await e.key('Control+z');
    await e.settled();
    assert.ok(distance(before, await e.pose('Goal')) < 0.3);
    await e.until(() => document.querySelector('.title small').textContent === 'Saved');
    await e.page.reload();
    await e.ready();
    await e.settled();
    await e.choose(second.id);
    assert.equal(await e.page.inputValue(FIELD), said);
    await e.page.getByRole('button', { name: 'Keep the position, end the relation' }).click();
    await e.settled();
    assert.equal(await e.shows(FIELD), false, 'a goal with a place of its own has the field under More fields');
    assert.ok(distance(before, await e.goal()) < 0.3, 'the goal stays where it was');

    // Dropped there, the flag offers to hold the gap; the words in the picture are pressed.
    await e.page.evaluate(() => document.activeElement?.blur?.());
    const offer = e.page.locator('.opt.gap');
    assert.equal(await offer.count(), 0, 'nothing is offered where a relation has just ended');
    const flag = await e.at(before.x, before.y);
    const pennant = [flag[0] + 6, flag[1] - 14];
    const further = await e.at(before.x + 3 * Math.cos(before.heading), before.y + 3 * Math.sin(before.heading));
    await e.drag(pennant, [pennant[0] + further[0] - flag[0], pennant[1] + further[1] - flag[1]], {
      then: async () => assert.equal(await offer.count(), 0, 'nothing is offered in a drag'),
    });
    await e.release();
    const kept = /^Keep (\d+) m ahead of (.+)$/.exec(await offer.innerText());
    assert.ok(kept?.[2] === first.name && Number(kept[1]) > GAP_M, await offer.innerText());
    await e.picture('gap-offered');
    assert.ok(await pressWords(e, await e.pose('Goal'), Number(kept[1])), 'the words are in the picture');
    await e.settled();
    assert.equal(await e.page.inputValue(FIELD), `${kept[1]} m ahead of ${first.name} at 5.0 s`);
    assert.equal(await offer.count(), 0);
    assert.deepEqual(await e.page.locator('.goalsec .fx').allInnerTexts(), ['Relative', 'Free']);
    await e.key('Control+z');
    await e.settled();
    assert.equal(await offer.count(), 0, 'an undo offers nothing');
  });

  it('a distance along the lane is typed in place of a coordinate', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    const start = await e.pose('Start');
    const ahead = ({ x, y }) => (x - start.x) * Math.cos(start.heading) + (y - start.y) * Math.sin(start.heading);
    await e.type('goal-pos', '20 m ahead');
    assert.ok(Math.abs(distance(await e.goal(), start) - 20) < 0.5 && ahead(await e.goal()) > 19);
    await e.type('goal-pos', '5 m back');
    assert.ok(Math.abs(ahead(await e.goal()) + 5) < 0.5);
    await e.type('goal-pos', '900 m ahead');
    assert.match(await e.text('.field .why'), /^The lane ends after \d+ m$/);
    // The page's own chord, and not the history of the browser; typed text is not lost.
    await e.key('Control+h');
    await e.page.waitForSelector('.history');
  });

  it('a car reaches a place after another one', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const cars = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 5);
    const [own, other] = cars;
    await e.choose(own.id);
    await relate(e, `0.5 s after ${other.name}`);
    assert.match(await e.text('.goalsec [role="alert"]'), /Set a goal first/);
    await relate(e, `12 m ahead of ${own.name}`);
    assert.match(await e.text('.goalsec [role="alert"]'), /Name another road user/);
  });
});
