// A road user is driven by the keyboard while the others react; the drive is one step, replayed by the timeline.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { distance } from '../../support/editor.js';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

const BAR = '.drivebar';

const begin = async (e) => {
  await e.key('Shift+E');
  await e.page.waitForSelector(BAR);
  await e.settled();
};

/** Seconds that have been driven. */
const driven = (e) => e.page.evaluate(() => Number(/\d+\.\d/.exec(document.querySelector('.tm').textContent)?.[0]));

journeys('driving', (stage) => {
  it('is recorded as one step, replayed, undone and stored', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    const start = await e.pose('Start');
    await begin(e);
    assert.match(await e.text(BAR), /Press a key to start/);
    await e.picture('drive-ready');

    // Time stands still until the first key. Then it runs, and the road user follows the keys.
    await e.frames(20);
    assert.equal(await driven(e), 0);
    await e.page.keyboard.down('w');
    await e.page.keyboard.down('ArrowLeft');
    await e.until(() => Number(/\d+\.\d/.exec(document.querySelector('.tm').textContent)?.[0]) > 1.2);
    await e.page.keyboard.up('ArrowLeft');
    await e.page.keyboard.up('w');
    await e.page.keyboard.down('Space');
    await e.until(() => Number(/\d+\.\d/.exec(document.querySelector('.tm').textContent)?.[0]) > 3);
    await e.picture('drive');
    await e.page.keyboard.up('Space');
    await e.key('Enter');
    await e.page.waitForSelector(BAR, { state: 'detached' });
    await e.settled();
    assert.match(await e.text('.toast'), /driven for 3\.\d s/);
    await e.picture('drive-kept');

    // Replayed at its end: it stands there, on its left, and the recording ends with the drive.
    await e.key('End');
    await e.settled();
    const end = await driven(e);
    assert.ok(end > 3 && end < 4.5, `${end} s`);
    const { agents } = await e.get('/v1/scenes/demo-crossing');
    assert.ok(agents.some((a) => a.id === car.id));
    await e.key('Home');
    await e.settled();
    const users = await e.roadUsers();

    // Another page of this browser has it; undo restores the scene before.
    await e.page.reload();
    await e.ready();
    await e.begin();
    assert.deepEqual(
      (await e.roadUsers()).map((u) => u.id),
      users.map((u) => u.id),
    );
    await e.key('End');
    await e.settled();
    assert.equal(await driven(e), end);
    await e.key('Home');
    await e.key('Control+z');
    await e.settled();
    await e.key('End');
    await e.settled();
    assert.equal(await driven(e), 9);
    await e.key('Home');
    await e.choose(car.id);
    assert.ok(distance(await e.pose('Start'), start) < 0.01);
  });

  it('ends with the window, and leaves nothing when it is cancelled', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    await begin(e);
    await e.page.keyboard.down('s');
    await e.until(() => Number(/\d+\.\d/.exec(document.querySelector('.tm').textContent)?.[0]) > 0.6);
    await e.key('Escape');
    await e.page.waitForSelector(BAR, { state: 'detached' });
    await e.settled();
    assert.equal(await e.page.locator('.toast').count(), 0);
    assert.equal(await e.page.locator('[data-action="undo"][aria-disabled="true"]').count(), 1);
    assert.equal(await driven(e), 0);
    assert.ok(await e.shows('.fu'), 'the futures are back');

    await begin(e);
    await e.page.keyboard.press('w');
    await e.page.waitForSelector(BAR, { state: 'detached', timeout: 40_000 });
    await e.settled();
    assert.match(await e.text('.toast'), /driven for 9\.0 s/);
  });
});
