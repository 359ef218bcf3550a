// A run that another program steps is shown as it goes on, read-only.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { journeys } from '../../support/journey.js';

const BAR = '.drivebar';

/** The crossing itself, without bars and panels: nothing but a run moves there. */
const middle = async ({ page }) => {
  const { width, height } = page.viewportSize();
  return page.screenshot({ clip: { x: width / 2 - 150, y: height / 2 - 120, width: 400, height: 240 } });
};

journeys('following', (stage) => {
  it('shows a run that is driven from outside, and its end', { timeout: 90_000 }, async () => {
    const send = async (method, path, body) => {
      const head = { method, headers: { 'Content-Type': 'application/json' } };
      const reply = await fetch(new URL(path, stage.program.url), { ...head, body: body && JSON.stringify(body) });
      assert.ok(reply.ok, `${method} ${path}: ${reply.status}`);
      return reply.status === 204 ? null : reply.json();
    };
    const begun = await send('POST', '/v1/runs', { scene_id: 'demo-crossing', egos: ['4'], seed: 7 });
    const run = `/v1/runs/${begun.run}`;
    const e = await stage.visit(`${stage.program.url}#run=${begun.run}`);
    await e.page.waitForSelector(BAR);
    await e.until(() => /Controlled externally: .*0\.0 s/.test(document.querySelector('.drivebar').textContent));
    assert.match(await e.text('.banner'), /controlled by another program and read-only/);
    await e.settled();
    await e.picture('follow-start');
    const before = await middle(e);

    // Car 4 drives on and turns a little; the others react. The page goes with each step.
    let { x_m, y_m } = begun.present.states['4'];
    for (let number = 1; number <= 20; number++) {
      x_m -= 0.45;
      y_m += 0.05;
      const ego = { id: '4', x_m, y_m, heading_rad: 3.03, vx_mps: -4.5, vy_mps: 0.5 };
      await send('POST', `${run}/step`, { number, egos: [ego] });
    }
    await e.until(() => /2\.0 s/.test(document.querySelector('.drivebar').textContent));
    await e.settled();
    await e.picture('follow');
    assert.ok(!before.equals(await middle(e)), 'road users are where they are in the run');
    assert.equal(await e.text('.tm'), '2.0 s', 'the clock is that of the run');
    const playhead = e.page.getByRole('slider', { name: 'Playhead' });
    assert.equal(await playhead.getAttribute('aria-valuenow'), '2.0');
    const seen = await send('GET', run);
    assert.equal(seen.present.number, 20);

    await send('DELETE', run);
    await e.until(() => /The run has ended · 2\.0 s/.test(document.querySelector('.drivebar').textContent));

    // A copy is an own scene.
    await e.page.getByRole('button', { name: 'Make a copy' }).first().click();
    await e.page.waitForSelector('.banner', { state: 'detached' });
    await e.page.waitForSelector(BAR, { state: 'detached' });
    assert.equal(new URL(e.page.url()).hash, '');
    assert.match(await e.text('.tm'), /\/ 9\.0 s$/, 'the clock is that of the scene again');
  });

  it('says that a run is not there', { timeout: 60_000 }, async () => {
    const e = await stage.visit(`${stage.program.url}#run=nothing`);
    await e.until(() => /The run cannot be shown/.test(document.querySelector('.toast')?.textContent));
    await e.page.waitForSelector('.drivebar', { state: 'detached' });
  });
});
