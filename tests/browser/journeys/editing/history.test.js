// The history is a list: a click goes to a step, abandoned steps stay as a branch, and the view follows.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove, selectMovingCar } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

const time = (e) => e.value('goal-time');

journeys('history', (stage) => {
  it('goes to any step and keeps the abandoned ones', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    for (const t of ['8.0', '7.0', '6.0']) await e.type('goal-time', t);
    await e.page.evaluate(() => document.activeElement.blur());
    await e.key('Control+h');
    await e.page.waitForSelector('.history');
    assert.match(await e.text('.history h2'), /3 of 3 steps/);
    const step = (n) => e.page.locator('.past [data-step]').nth(n);
    await step(2).click();
    await e.settled();
    assert.equal(await time(e), 8);
    assert.match(await e.text('.history h2'), /1 of 3 steps/);
    await e.type('goal-time', '5.0');
    assert.match(await e.text('.history h2'), /2 of 2 steps/);
    assert.equal(await e.page.locator('.past .branch').count(), 2);
    await e.picture('history');
    await e.page.locator('.past .branch [data-step]').first().click();
    await e.settled();
    assert.equal(await time(e), 6, 'the branch is back');
    await e.page.locator('[data-step="first"]').click();
    await e.settled();
    assert.equal(await time(e), 9);
    await step(0).hover();
    await e.page.locator('.step button[title="Name this step"]').first().click();
    await e.page.keyboard.type('In a hurry');
    await e.key('Enter');
    assert.equal(await e.page.locator('.past .named b').innerText(), 'In a hurry');
  });

  it('restores the view with undo, and offers a way back to the scene', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await selectMovingCar(e);
    const before = await e.view();
    await e.drag([car.to[0] + 9, car.to[1] - 26], [before.box.x + 4, before.box.y + 300], { moves: 4 });
    // At the edge the picture scrolls.
    await e.until(
      ([x, z]) => Math.abs(Number(document.querySelector('main.stage').dataset.view.split(' ')[0]) - x) * z > 30,
      [before.cx, before.zoom],
    );
    await e.release();
    await e.key('Control+z');
    await e.until(
      (x) => Math.abs(Number(document.querySelector('main.stage').dataset.view.split(' ')[0]) - x) < 0.01,
      before.cx,
    );
    await e.key('h');
    const { box } = before;
    const seen = () => e.page.locator('.wayback').isVisible();
    for (let i = 0; i < 12 && !(await seen()); i++) {
      await e.page.mouse.move(box.x + box.width * 0.7, box.y + box.height * 0.7);
      await e.page.mouse.down();
      await e.page.mouse.move(box.x + 120, box.y + 80);
      await e.page.mouse.up();
      await e.frames(2);
    }
    await e.page.locator('.wayback button').click();
    await e.page.waitForSelector('.wayback', { state: 'detached' });
  });
});
