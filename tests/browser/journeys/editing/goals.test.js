// Unreachable goals, typed values and turned handles, and undo.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove, cyclistOnTheMove, pedestrianOnTheMove, selectMovingCar } from '../../support/casting.js';
import { distance, turn } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';

/** Pixels from the rear of a box to its turning knob, and from its nose to the start of the speed arrow. */
const STALK = 24,
  GAP = 5;
const SHORTEST_RIDER_PX = 17;

/** Half way along a road user's shown future, in metres. */
async function middleOf(e, { id }) {
  const answer = e.wire.asked.findLast((a) => a.event('final')?.samples[0].agents[id]).event('final');
  const { chosen, modes } = answer.samples[0].agents[id];
  const { x_m, y_m } = modes[chosen];
  return [x_m[x_m.length >> 1], y_m[y_m.length >> 1]];
}

/** The followed motions of the last complete answer to a change, and the result code. */
async function resultOf(e) {
  const answer = e.wire.asked.findLast((a) => a.body.react !== false && a.event('final')).event('final');
  return { code: await e.code(), sample: answer.samples[0] };
}

journeys('goals and values', (stage) => {
  it('gives a quick and a slow drag to one place the same futures', { timeout: 120_000 }, async () => {
    const e = await stage.visit(`${stage.program.url}?scene=demo-roundabout`);
    await e.begin();
    const walkers = (await e.roadUsers()).filter((u) => u.kind === 'Pedestrian' && u.speed > 0.5);
    let compared = 0;
    for (const { id, name } of walkers) {
      await e.choose(id);
      await e.key('z');
      await e.settled();
      const [start, goal] = [await e.pose('Start'), await e.pose('Goal')];
      const ahead = Math.atan2(goal.y - start.y, goal.x - start.x) - 0.4;
      const away = distance(start, goal);
      const [from, to] = [
        await e.at(goal.x, goal.y),
        await e.at(start.x + away * Math.cos(ahead), start.y + away * Math.sin(ahead)),
      ].map(([x, y]) => [x + 9, y - 26]);
      if (away < 4 || !(await e.open(from)) || !(await e.open(to))) continue;
      const results = [];
      for (const moves of [3, 40]) {
        await e.drag(from, to, { moves });
        if (moves > 3) await e.settled();
        await e.release();
        results.push(await resultOf(e));
        await e.key('Control+z');
        await e.settled();
      }
      assert.deepEqual(results[1], results[0], name);
      if (++compared === 3) break;
    }
    assert.ok(compared === 3, `${compared} road users with a flag in view`);
  });

  it('explains an unreachable goal and fixes it with one click, in German too', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await selectMovingCar(e);
    await e.drag(
      [car.to[0] + 9, car.to[1] - 26],
      [car.to[0] + (car.from[0] - car.to[0]) * 0.1 + 9, car.to[1] + (car.from[1] - car.to[1]) * 0.1 - 26],
    );
    await e.release();
    await e.type('goal-time', '2');
    assert.match(await e.text('.hint'), /Too far for 2\.0 s/);
    assert.match(await e.text('.hint'), /\d+ m/);
    assert.match(await e.text('.status'), /nearest reachable/);
    const ways = await e.page.locator('.opt').allInnerTexts();
    assert.ok(
      ways.some((w) => w.startsWith('Use nearest reachable')),
      ways.join(' | '),
    );
    assert.ok(ways.length >= 2, ways.join(' | '));
    await e.picture('unreachable');
    for (const [i, way] of ways.entries()) {
      const mark = e.wire.asked.length;
      await e.page.locator('.opt').nth(i).click();
      await e.settled();
      const hints = (await e.page.locator('.hint').allInnerTexts()).join(' | ');
      assert.doesNotMatch(hints, /Too far|Out of reach/, `${way.replace(/\s+/g, ' ')} mends it`);
      // The first complete answer is to the click: the button under the pointer afterwards is tried too. Another road
      // user may block an earlier arrival; its own motion no longer does.
      const answer = e.wire.since(mark).flatMap((a) => a.event('final') ?? [])[0];
      const { status, limiting } = answer.resolved[car.id].reach;
      assert.ok(status !== 'unreachable' || limiting === 'traffic', `${way}: ${limiting}`);
      await e.key('Control+z');
      await e.settled();
      assert.match(await e.text('.hint'), /Too far for 2\.0 s/);
    }
    await e.page.locator('[data-menu="file"]').click();
    await Promise.all([e.page.waitForEvent('load'), e.page.locator('[data-action="language"]').click()]);
    for (const reloaded of [false, true]) {
      if (reloaded) await e.page.reload();
      await e.ready();
      await e.choose(car.id);
      assert.equal(await e.text('.ih h2'), car.name.replace('Car', 'Pkw'));
      const { x, y } = await e.goal();
      const flag = await e.at(x, y);
      await e.drag([flag[0] + 9, flag[1] - 26], [flag[0] + 12, flag[1] - 26]);
      await e.release();
      assert.match(await e.text('.hint'), /^Zu weit für 2,0 s\s+Das Ziel ist \d+ m entfernt\. In 2,0 s kommt /);
      assert.match(await e.text('.status'), /nächsten erreichbaren Punkt/);
      assert.match((await e.page.locator('.opt').allInnerTexts()).join(), /Nächsten erreichbaren Punkt nehmen/);
    }
  });

  it(
    'leads a car over a place on its way: put, dragged, widened, timed and taken away',
    { timeout: 90_000 },
    async () => {
      const e = await stage.open();
      await e.begin();
      const car = await carOnTheMove(e);
      await e.choose(car.id);
      const on = await middleOf(e, car);
      await e.page.keyboard.down('Shift');
      await e.page.mouse.click(...(await e.at(...on)));
      await e.page.keyboard.up('Shift');
      await e.settled();
      const asked = () => e.wire.last().body.conditions[car.id].via[0];
      const answered = () => e.wire.asked.findLast((a) => a.event('final'))?.event('final').resolved[car.id].via[0];
      assert.ok(distance({ x: asked().x_m, y: asked().y_m }, { x: on[0], y: on[1] }) < 1, 'where the path was clicked');
      assert.equal(asked().tolerance_m, 1);
      assert.ok(answered().passed, JSON.stringify(answered()));
      assert.match(await e.text('.toast'), new RegExp(`Via point of ${car.name} added`));

      // Dragged to the side: the futures follow.
      const at = await e.at(asked().x_m, asked().y_m);
      const heading = car.start.heading;
      const side = await e.at(asked().x_m - 1.2 * Math.sin(heading), asked().y_m + 1.2 * Math.cos(heading));
      const mark = e.wire.asked.length;
      await e.page.keyboard.down('Alt');
      await e.drag(at, side);
      assert.ok(e.wire.since(mark).length > 0, 'asked while the hand moves');
      await e.release();
      await e.page.keyboard.up('Alt');
      assert.ok(answered().passed, JSON.stringify(answered()));
      await e.picture('via-point');

      await e.type('via-0-tolerance', '2.5');
      assert.equal(asked().tolerance_m, 2.5);
      const fixed = e.page.getByRole('switch', { name: 'Via point time fixed' });
      await fixed.click();
      await e.settled();
      const time = asked().time_s;
      assert.ok(time > 0.5 && time < 9, `${time} s`);
      const slider = e.page.getByRole('slider', { name: 'Via point time' });
      await slider.focus();
      await e.key('Shift+ArrowUp');
      await e.settled();
      assert.ok(Math.abs(asked().time_s - time - 1) < 0.06, `${asked().time_s} s after ${time} s`);

      await e.page.getByRole('slider', { name: 'Via point position' }).focus();
      await e.key('Delete');
      await e.settled();
      assert.equal(await e.page.locator('.viarows').count(), 0);
      await e.key('Control+z');
      await e.settled();
      assert.equal(await e.page.locator('.viarows').count(), 1);
      assert.equal(asked().tolerance_m, 2.5);
    },
  );

  it('takes typed, freed and dragged values, and undoes and redoes all of them', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const walker = await pedestrianOnTheMove(e);
    const rider = await cyclistOnTheMove(e);
    await e.key('Control+s');
    await e.until(() => document.querySelector('.title small').textContent === 'Saved');
    const id = await own(e);
    const before = await stored(e, id);

    await e.choose(walker.id);
    await e.type('goal-speed', '1.2+0.4');
    const pill = e.page.getByRole('switch', { name: 'Goal speed fixed' });
    assert.equal(await pill.getAttribute('aria-checked'), 'true');
    assert.equal(e.wire.last().body.conditions[walker.id].goal.speed_mps, 1.6);
    await e.picture('pedestrian-typed');
    await pill.click();
    await e.settled();
    assert.equal(await pill.getAttribute('aria-checked'), 'false');
    assert.ok((await e.page.inputValue('[data-field="goal-speed"]')).startsWith('≈'), 'what the generator chose');
    assert.equal((await stored(e, id))[walker.id].conditions?.goal?.speed_mps, undefined);
    await pill.click();
    await e.settled();
    assert.equal(await pill.getAttribute('aria-checked'), 'true');

    await e.choose(rider.id);
    await e.key('z');
    await e.settled();
    await tiller(e, 20);
    const turned = (await e.pose('Start')).heading;
    assert.ok(turn(turned, rider.start.heading) > 0.1, `turned by ${turn(turned, rider.start.heading).toFixed(2)} rad`);
    assert.ok(Math.abs(e.wire.last().body.conditions[rider.id].start.heading_rad - turned) < 0.02);
    const slow = (await e.pose('Start')).speed;
    await arrow(e, 10 / 3.6);
    const fast = (await e.pose('Start')).speed;
    assert.ok(Math.abs(fast - slow - 10 / 3.6) < 0.4, `${slow} m/s, then ${fast} m/s`);

    await e.page.locator('.fu[data-future="C"]').click();
    await e.settled();
    assert.equal(await e.page.locator('.fu[aria-checked="true"]').getAttribute('data-future'), 'C');
    const play = e.page.getByRole('button', { name: 'Play or pause' });
    await play.click();
    await e.until(() => parseFloat(document.querySelector('.tm').textContent) > 0.5);
    await play.click();
    await e.page.click('[data-menu="playback"]');
    await e.page.click('.menu [data-action="to-start"]');
    await e.key('Escape');
    await e.settled();

    const done = { page: await e.inspector(), scene: await stored(e, id) };
    const steps = await all(e, 'undo', 'Control+z');
    assert.ok(steps >= 6, `${steps} steps`);
    assert.deepEqual(await stored(e, id), before);
    assert.equal(await all(e, 'redo', 'Control+Shift+z'), steps);
    assert.deepEqual(await e.inspector(), done.page);
    assert.deepEqual(await stored(e, id), done.scene);
  });
});

/** Id of the visitor's only own scene. */
async function own(e) {
  const list = await (await e.page.request.get(new URL('/v1/scenes', e.page.url()).href)).json();
  return list.scenes.find((s) => !s.readonly).id;
}

/** The user's conditions on the server, once saving is done. */
async function stored(e, id) {
  await e.until(() => document.querySelector('.title small').textContent === 'Saved');
  const scene = await (await e.page.request.get(new URL(`/v1/scenes/${id}`, e.page.url()).href)).json();
  return Object.fromEntries(
    scene.agents.map((a) => [a.id, { conditions: a.conditions, length: a.length_m, width: a.width_m }]),
  );
}

/** Undoes or redoes until none is left; returns the number of steps. */
async function all(e, action, key) {
  const off = () => e.page.locator(`header [data-action="${action}"]`).getAttribute('aria-disabled');
  let n = 0;
  for (; n < 50 && (await off()) !== 'true'; n++) {
    await e.key(key);
    await e.settled();
  }
  return n;
}

async function handles(e) {
  await e.moreFields();
  const p = await e.pose('Start');
  const { zoom } = await e.view();
  const half = Math.max((await e.page.getByLabel('length in metres').inputValue()) * zoom, SHORTEST_RIDER_PX) / 2;
  const [x, y] = await e.at(p.x, p.y);
  const c = Math.cos(p.heading),
    s = Math.sin(p.heading);
  return { p, zoom, half, ahead: (d, aside = 0) => [x + c * d - s * aside, y - s * d - c * aside] };
}

async function tiller(e, aside) {
  const { half, ahead } = await handles(e);
  await e.drag(ahead(-half - STALK), ahead(-half - STALK + 3, aside));
  await e.release();
}

async function arrow(e, faster) {
  const { p, zoom, half, ahead } = await handles(e);
  const tip = half + GAP + p.speed * 2 * zoom;
  await e.drag(ahead(tip), ahead(tip + faster * 2 * zoom));
  await e.release();
}
