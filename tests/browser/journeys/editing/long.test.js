// More than 9 s: planned window by window, shown and played as one.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

const chosenOf = (futures) => futures.modes[futures.chosen];

journeys('long', (stage) => {
  it('plans 20 s, replans every 6 s, and plays them to the end', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.page.click('[data-menu="generate"]');
    await e.page
      .getByRole('group', { name: 'Planning window of all road users' })
      .getByRole('button', { name: '6', exact: true })
      .click();
    await e.settled();
    await e.page.getByRole('group', { name: 'Computed length' }).getByRole('button', { name: '20 s' }).click();
    await e.settled();
    await e.key('Escape');
    assert.match(await e.text('.tm'), /0\.0 s\s+\/ 20\.0 s/);
    const { body } = e.wire.last();
    assert.deepEqual([body.agents, body.react, body.horizon_s, body.replan_interval_s], [[], true, 20, 6]);
    const final = e.wire.last().event('final');
    assert.equal(final.windows, 4);
    for (const [id, futures] of Object.entries(final.samples[0].agents)) {
      // Late arrivals start later; all continue to the end.
      const { first_step: first, x_m: x } = chosenOf(futures);
      assert.equal(first + x.length, 201, id);
    }
    await e.picture('long-scene');

    const car = await carOnTheMove(e);
    await e.choose(car.id);
    await e.picture('long-selected');
    // A goal late in the scene is reached there.
    await e.key('g');
    await e.settled();
    await e.type('goal-time', '16');
    const goal = await e.goal();
    const answer = e.wire.last().event('final');
    const future = chosenOf(answer.samples[0].agents[car.id]);
    assert.ok(
      Math.hypot(future.x_m[159] - goal.x, future.y_m[159] - goal.y) < 0.2,
      `${future.x_m[159]}, ${future.y_m[159]} for ${JSON.stringify(goal)}`,
    );
    assert.ok(answer.resolved[car.id].intermediate.length > 0);
    await e.page.evaluate(() => document.activeElement?.blur?.());
    await e.key('p');
    await e.key('End');
    assert.match(await e.text('.tm'), /^20\.0 s/);
    await e.picture('long-end');
    for (let i = 0; i < 10; i++) await e.key(',');
    await e.key('Space');
    await e.until(() => document.querySelector('.tm').textContent.startsWith('20.0 s'));

    // Another future is picked: its shown part is kept, and continued past 9 s.
    await e.key('Home');
    await e.key('Shift+g');
    await e.settled();
    await e.page.locator('.fu[data-future][aria-checked="false"]').first().click();
    await e.settled();
    // The others may be asked once more, with the continued future as it is.
    const picked = e.wire.asked.map((q) => q.event('final')?.samples[0].agents[car.id]).findLast(Boolean);
    assert.equal(chosenOf(picked).x_m.length, 200);
    assert.equal(await e.page.locator('.fu[data-future]').count(), 6);
    await e.picture('long-picked');
  });
});
