// Outside influences: a recorded file, and an unreachable generator.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { it } from 'node:test';
import { selectMovingCar } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';
import { recording } from '../../support/where.js';

journeys('files and outages', (stage) => {
  it(
    'opens a recorded scene dropped on the picture and shows the log behind a change',
    { timeout: 60_000 },
    async () => {
      const file = recording();
      const e = await stage.open();
      await e.begin();
      await e.drop(file.name, readFileSync(file.path));
      await e.until(() => /imported\./.test(document.querySelector('.toast')?.textContent ?? ''));
      assert.notEqual(await e.page.inputValue('.title input'), 'Rosa & 5th');
      await e.settled();
      await e.picture('womd');
      const car = await selectMovingCar(e);
      const back = 0.35;
      await e.drag(
        [car.to[0] + 9, car.to[1] - 26],
        [car.to[0] + (car.from[0] - car.to[0]) * back + 9, car.to[1] + (car.from[1] - car.to[1]) * back - 26],
      );
      await e.release();
      assert.match(await e.text('.toast'), new RegExp(`^Goal of ${car.name} moved`));
      await e.page.click('[data-menu="layers"]');
      await e.page.click('[data-action="layer-log"]');
      assert.equal(await e.page.locator('[data-action="layer-log"]').getAttribute('aria-pressed'), 'true');
      await e.key('Escape');
      await e.settled();
      assert.match(await e.text('.hint'), /Compared with the recording.*Largest distance: [\d.]+ m at \d\.\d s/s);
      const playhead = e.page.getByRole('slider', { name: 'Playhead' });
      for (let i = 0; i < 5; i++) await playhead.press('Shift+ArrowRight');
      assert.match(await e.text('.tm'), /^5\.0 s/);
      await e.settled();
      await e.picture('womd-ghost');
    },
  );

  it(
    'keeps working while the generator is unreachable, and catches up when it is back',
    { timeout: 60_000 },
    async () => {
      const e = await stage.open();
      await e.begin();
      const car = await selectMovingCar(e);
      await stage.program.kill();
      const to = [car.to[0] + (car.from[0] - car.to[0]) * 0.3 + 9, car.to[1] + (car.from[1] - car.to[1]) * 0.3 - 26];
      await e.drag([car.to[0] + 9, car.to[1] - 26], to);
      await e.page.waitForSelector('.banner');
      assert.match(await e.text('.banner'), /The generator is not answering\. Nothing is lost\./);
      const during = await e.goal();
      await e.page.mouse.move(to[0] + (car.from[0] - car.to[0]) * 0.15, to[1] + (car.from[1] - car.to[1]) * 0.15, {
        steps: 6,
      });
      await e.until(() => /sketch/.test(document.querySelector('aside.insp').textContent));
      await e.frames(2);
      assert.notDeepEqual(await e.goal(), during, 'the flag still follows the hand');
      await e.page.mouse.up();
      await e.until(() => /1 change is waiting/.test(document.querySelector('.banner').textContent));
      await e.picture('generator-away');
      // A newly selected road user has a plain sketch, and G sets its goal there.
      const pick = (id) => e.page.locator(`[data-agent="${id}"]`).evaluate((el) => el.click());
      const other = (await e.roadUsers()).find((u) => u.kind === 'Car' && u.id !== car.id && u.speed > 2.5);
      await pick(other.id);
      await e.page.evaluate(() => document.activeElement?.blur());
      await e.key('g');
      await e.until(() => /2 changes are waiting/.test(document.querySelector('.banner').textContent));
      await pick(car.id);
      await stage.program.run();
      await e.page.waitForSelector('.banner', { state: 'detached' });
      await e.until(() =>
        /The generator is back\. 2 changes computed/.test(document.querySelector('.toast')?.textContent ?? ''),
      );
      await e.settled();
      const last = e.wire.last();
      assert.equal(last.body.react, true);
      assert.ok(last.event('final').samples[0].agents[car.id]);
      assert.match(await e.text('.hint'), /^(Reache[ds]|Only)/);
    },
  );

  it('asks for a goal set during an outage beyond the edge of the picture', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await selectMovingCar(e);
    const { box } = await e.view();
    const flag = [car.to[0] + 9, car.to[1] - 26];
    // At the edge the picture scrolls, away from the car.
    const edge = car.to[0] > car.from[0] ? box.x + box.width - 8 : box.x + 8;
    await e.drag(flag, [edge, flag[1]], { moves: 8 });
    await stage.program.kill();
    const before = await e.view();
    await e.until(
      (cx) => Math.abs(Number(document.querySelector('main.stage').dataset.view.split(' ')[0]) - cx) > 25,
      before.cx,
    );
    await e.page.mouse.up();
    await e.until(() => /1 change is waiting/.test(document.querySelector('.banner')?.textContent ?? ''));
    const goal = await e.goal();
    const pick = (id) => e.page.locator(`[data-agent="${id}"]`).evaluate((el) => el.click());
    const other = (await e.roadUsers()).find((u) => u.kind === 'Car' && u.id !== car.id && u.speed > 2.5);
    await pick(other.id);
    await e.page.evaluate(() => document.activeElement?.blur());
    await e.key('g');
    await e.until(() => /2 changes are waiting/.test(document.querySelector('.banner').textContent));
    await pick(car.id);
    await stage.program.run();
    await e.page.waitForSelector('.banner', { state: 'detached' });
    await e.settled();
    // Once from the answer, once from what was saved.
    for (const reloaded of [false, true]) {
      if (reloaded) {
        await e.page.reload();
        await e.ready();
        await e.begin();
        await e.choose(car.id);
      }
      assert.deepEqual(await e.goal(), goal);
      const asked = e.wire.asked.findLast((a) => a.body.conditions?.[car.id]?.goal && a.event('final'));
      const sent = asked.body.conditions[car.id].goal;
      assert.ok(Math.hypot(sent.x_m - goal.x, sent.y_m - goal.y) < 0.2, `asked for ${JSON.stringify(sent)}`);
      const { agents } = asked.event('final').samples[0];
      const { x_m, y_m } = agents[car.id].modes[agents[car.id].chosen];
      const missed = Math.hypot(x_m.at(-1) - goal.x, y_m.at(-1) - goal.y);
      const verdict = await e.text('.hint');
      assert.equal(/^Reache[ds]/.test(verdict), missed < 1, `${missed.toFixed(1)} m off: ${verdict}`);
    }
  });
});
