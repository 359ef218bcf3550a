// A goal on the other side of a median: the flag is held back, and there are remedies.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carBesideMedian } from '../../support/casting.js';
import { distance } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';

/** Longest lag of a flag, and the rounding of shown values, pixels. */
const LAG_PX = 24,
  ROUNDING_PX = 2;

journeys('kerbs', (stage) => {
  it('holds the flag back at a median until Alt, and offers the way by the road', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const { car, across } = await carBesideMedian(e);
    await e.choose(car.id);
    await e.key('z');
    await e.settled();
    const { zoom } = await e.view();
    const flag = async (p) => {
      const [x, y] = await e.at(p.x, p.y);
      return [x + 9, y - 26];
    };
    const behind = async () => distance(await e.goal(), across) * zoom;

    await e.drag(await flag(car.end), await flag(across));
    await e.until(() => document.querySelector('.helpbar')?.textContent.includes('stops at the kerb or median'));
    // The panel shows the flag's place a moment later than the picture.
    await e.settled();
    assert.ok(Math.abs((await behind()) - LAG_PX) < ROUNDING_PX, `${await behind()} px behind the hand`);
    await e.picture('kerb-held');
    await e.page.keyboard.down('Alt');
    await e.until(() => !document.querySelector('.helpbar')?.textContent.includes('kerb'));
    await e.settled();
    assert.ok((await behind()) < ROUNDING_PX, 'at once');
    await e.page.keyboard.up('Alt');
    await e.settled();
    assert.ok((await behind()) < 3 * LAG_PX, 'snapped to a lane at most');
    assert.doesNotMatch(await e.text('.helpbar'), /kerb/);
    await e.release();

    // By the road: from the panel, by key, and at the hollow flag on the picture.
    const set = await e.goal();
    const answer = e.wire.asked.map((a) => a.event('final')).findLast((f) => f?.resolved?.[car.id]);
    const road = answer.resolved[car.id].by_road;
    assert.ok(road, JSON.stringify(answer.resolved[car.id]));
    const place = { x: road.x_m, y: road.y_m };
    const offer = e.page.getByRole('button', { name: /^By road: \d+ m / });
    const ways = [
      async () => offer.click(),
      async () => e.key('Enter'),
      async () => e.page.mouse.click(...(await flag(place))),
    ];
    for (const take of ways) {
      await offer.waitFor();
      await e.frames(2);
      await take();
      await e.settled();
      assert.ok(distance(await e.goal(), place) < 0.1, `the goal is where the road leads`);
      await e.key('Control+z');
      await e.settled();
      assert.deepEqual(await e.goal(), set);
    }
    await e.picture('by-road');

    // Permission is offered only where the answer names the crossed edges.
    const { modes, chosen } = answer.samples[0].agents[car.id];
    const edges = [...new Set(modes[chosen].faults.flatMap((f) => f.edge ?? []))];
    const leave = e.page.getByRole('button', { name: /^Allow crossing this/ });
    assert.equal(await leave.count(), edges.length ? 1 : 0);
    if (!edges.length) return;
    await e.key('Alt+Enter');
    await e.settled();
    assert.deepEqual(e.wire.last().body.conditions[car.id].goal.may_cross, edges);
    await e.page.getByRole('button', { name: /^Undo: Crossing allowed$/ }).click();
    await e.settled();
    assert.equal(await e.page.locator('.leave').count(), 0);
    await leave.waitFor();
  });

  it('takes the way by the road during a drag, as one step', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const { car, across } = await carBesideMedian(e);
    await e.choose(car.id);
    const at = async (p) => {
      const [x, y] = await e.at(p.x, p.y);
      return [x + 9, y - 26];
    };
    await e.drag(await at(car.end), await at(across));
    await e.page.getByRole('button', { name: /^By road: \d+ m / }).waitFor();
    await e.key('Enter');
    await e.settled();
    const goal = await e.goal();
    await e.page.mouse.up();
    await e.settled();
    assert.deepEqual(await e.goal(), goal);
    assert.ok(distance(goal, car.end) < distance(goal, across), 'on this side of the median');
    await e.key('Control+z');
    await e.settled();
    assert.equal(await e.page.locator('header [data-action="undo"]').getAttribute('aria-disabled'), 'true');
  });
});
