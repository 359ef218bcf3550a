// The editor at a scene with a collision.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carBehindAnother } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

journeys('judging', (stage) => {
  it('marks a collision on the timeline, lists it and goes to it', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const { car, obstacle } = await carBehindAnother(e);
    await e.page.click('[data-menu="others"]');
    await e.page.click('.menu [data-action="others-still"]');
    await e.settled();
    await e.choose(car.id);
    await e.type('goal-pos', String(obstacle.start.x), 0);
    await e.type('goal-pos', String(obstacle.start.y), 1);
    const badge = e.page
      .getByRole('button', { name: new RegExp(`^Collision \\d\\.\\d s: .*\\b${car.name}\\b`) })
      .first();
    // The shown future stops short of the other car; the collision is among the six.
    const futures = e.page.locator('.fu');
    for (let i = 0; i < (await futures.count()) && !(await badge.isVisible()); i++) {
      await futures.nth(i).click();
      await e.settled();
    }
    await badge.waitFor();
    const [, at] = /Collision (\d\.\d) s/.exec(await badge.getAttribute('aria-label'));
    await badge.click();
    await e.page.waitForSelector('.evrow');
    assert.ok((await e.text('.tm')).startsWith(at), `the playhead stands at ${at} s`);
    assert.match(await e.text('aside.insp'), /Collision at \d\.\d s[\s\S]*Remedies/);
    await e.settled();
    await e.picture('events');
    // Thresholds belong to the scene: a higher one for hard braking, then the usual one again.
    const harsh = e.page.locator('[data-field="threshold-harsh-brake-mps2"]');
    assert.equal(await harsh.inputValue(), '4.0');
    const mark = e.wire.asked.length;
    await e.type('threshold-harsh-brake-mps2', '0.3');
    assert.equal(e.wire.since(mark).length, 0, 'no motion is asked for');
    await e.until(() => /changed in this scene/.test(document.querySelector('.counts').textContent));
    await e.until(() =>
      /Hard braking/.test(document.querySelector('aside.insp').textContent.replace('Hard braking above', '')),
    );
    await e.page.getByRole('button', { name: 'Reset to default' }).click();
    await e.until(() => /^Thresholds\s*default/.test(document.querySelector('.counts').textContent));
    await e.settled();
    await badge.click();
    await e.page.getByRole('button', { name: `Change ${car.name}`, exact: true }).click();
    await e.page.waitForSelector('.fu');
    assert.equal(await e.text('.ih h2'), car.name);
  });
});
