// Corrects a recorded scene: a waiting car gets a goal, others give way, the recording is shown behind, undo goes half
// way back; and all replan every three seconds.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { distance } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';
import { along } from '../../support/maps.js';

const leave = (e) => e.page.evaluate(() => document.activeElement?.blur?.());

/** An example as a record of the Waymo motion data set, so that no recorded file is needed. */
async function record(e) {
  const url = new URL('/v1/scenes/demo-crossing/export?format=womd&mode=log', e.page.url());
  return (await e.page.request.get(url.href)).body();
}

/** The path along the lanes from a place in a direction. */
function lanesFrom(map, start) {
  const road = map.lanes.filter((l) => !['bike_lane', 'sidewalk', 'parking'].includes(l.type));
  const heading = ([ax, ay], [bx, by]) => Math.atan2(by - ay, bx - ax);
  const near = road
    .map((l) => {
      const i = l.points_m.findIndex((p) => Math.hypot(p[0] - start.x, p[1] - start.y) < 2.5);
      const q = i < 0 ? null : (l.points_m[i + 1] ?? null);
      return q && Math.cos(heading(l.points_m[i], q) - start.heading) > 0.9 ? { l, i } : null;
    })
    .find(Boolean);
  if (!near) return null;
  const line = near.l.points_m.slice(near.i);
  const byId = new Map(road.map((l) => [l.id, l]));
  for (let l = near.l; l && line.length < 400;) {
    // Straight on where there is a choice.
    const next = (l.successors ?? []).flatMap((id) => byId.get(id) ?? []);
    const turned = (o) => Math.abs(Math.sin((heading(o.points_m.at(-2), o.points_m.at(-1)) - start.heading) / 2));
    [l] = next.sort((p, q) => turned(p) - turned(q));
    if (l) line.push(...l.points_m.slice(1));
  }
  return line;
}

/** A waiting car in a lane with 100 m of road ahead, and the place there. */
async function waitingCar(e, map) {
  const tried = [];
  for (const u of (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed === 0)) {
    await e.choose(u.id);
    const start = await e.pose('Start');
    const line = lanesFrom(map, start);
    const goal = line && along(line, 100);
    if (goal && distance(start, { x: goal[0], y: goal[1] }) > 60) return { ...u, start, goal };
    tried.push(u.name);
    await e.letGo();
  }
  throw new Error(`nobody waits with 100 m ahead: ${tried.join(', ')}`);
}

journeys('correcting a log', (stage) => {
  it('a waiting car goes, others give way, and the recording is shown behind', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.drop('crossing.tfrecord', await record(e));
    await e.until(() => /imported\./.test(document.querySelector('.toast')?.textContent ?? ''));
    await e.settled();
    const { scenes } = await e.get('/v1/scenes');
    const own = await e.get(`/v1/scenes/${scenes.find((s) => !s.readonly).id}`);
    const { map } = own.map.ref ? { map: await e.get(`/v1/maps/${own.map.ref}`) } : own;
    const car = await waitingCar(e, map);
    await leave(e);
    await e.key('g');
    await e.settled();
    await e.type('goal-pos', car.goal[0].toFixed(1), 0);
    await e.type('goal-pos', car.goal[1].toFixed(1), 1);
    await e.type('goal-speed', '20 m/s');
    assert.equal(await e.value('goal-speed'), 72);
    const answer = e.wire.last();
    assert.equal(answer.body.react, true);
    assert.ok(Math.abs(answer.body.conditions[car.id].goal.speed_mps - 20) < 0.1);
    const { samples, scores } = answer.event('final');
    // Each road user that gives way is listed with its reaction, in the panel as in the answer.
    const others = Object.keys(samples[0].agents).filter((id) => id !== car.id);
    const named = await e.page.locator('.insp').innerText();
    for (const id of others.slice(0, 3)) {
      const who = (await e.roadUsers()).find((u) => u.id === id);
      if (samples[0].agents[id].reaction) assert.match(named, new RegExp(who.name), `${who.name} answers`);
    }
    // The headline is about the chosen one: good only without faults.
    const { modes, chosen } = samples[0].agents[car.id];
    const hint = e.page.locator('.hint').first();
    const bad = (modes[chosen].faults ?? []).length > 0;
    assert.equal(/\bok\b/.test(await hint.getAttribute('class')), !bad, await hint.innerText());
    const hits = scores[0].scene.collisions.some((c) => !c.in_log && [c.a, c.b].includes(car.id));
    if (hits) assert.match(await hint.getAttribute('class'), /collision/);
    await e.picture('log-corrected');

    // The recording behind it: the car stood there.
    await leave(e);
    await e.key('o');
    for (let i = 0; i < 50; i++) await e.key('.');
    await e.settled();
    await e.picture('log-behind');
    const apart = distance(await e.pose('Start'), car.start);
    assert.ok(apart < 0.11, 'the log begins where it begins');
    await e.key('o');
    await e.key('Home');

    // Half of it undone, and redone.
    const done = await e.inspector();
    for (let i = 0; i < 2; i++) {
      await e.key('Control+z');
      await e.settled();
    }
    assert.notDeepEqual(await e.inspector(), done);
    assert.notEqual(await e.value('goal-speed'), 72);
    for (let i = 0; i < 2; i++) {
      await e.key('Control+Shift+z');
      await e.settled();
    }
    assert.deepEqual(await e.inspector(), done);
  });

  it('all replan every three seconds, over twelve', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const again = e.page.getByRole('group', { name: 'Planning window of all road users' });
    await e.page.click('[data-menu="generate"]');
    await e.page.getByRole('group', { name: 'Computed length' }).getByRole('button', { name: '12' }).click();
    await e.settled();
    const mark = e.wire.asked.length;
    await again.getByRole('button', { name: '3', exact: true }).click();
    await e.settled();
    const asked = e.wire.since(mark).at(-1);
    assert.equal(asked.body.replan_interval_s, 3);
    assert.equal(asked.body.horizon_s, 12);
    const { agents } = asked.event('final').samples[0];
    const longest = Math.max(...Object.values(agents).map((a) => a.modes[0].x_m.length));
    assert.ok(longest >= 119, `${longest} states`);
    assert.equal(await again.getByRole('button', { name: '3', exact: true }).getAttribute('aria-pressed'), 'true');
    assert.match(await e.text('.tm'), /12\.0 s/);
    await leave(e);
    await e.key('Control+z');
    await e.settled();
    assert.equal(await again.getByRole('button', { name: '9 s', exact: true }).getAttribute('aria-pressed'), 'true');
  });
});
