// The first minute again, in Firefox: painting by a worker, dragging and streaming work the same.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { distance } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';
import { Pixels } from '../../support/pixels.js';

journeys(
  'the first minute in Firefox',
  (stage) => {
    it('is viewed, clicked, dragged, played and undone', { timeout: 90_000 }, async () => {
      const e = await stage.open();
      assert.equal(await e.page.inputValue('.title input'), 'Rosa & 5th');
      await e.begin();
      const car = await carOnTheMove(e);
      await e.page.mouse.click(...(await e.at(car.start.x, car.start.y)));
      await e.page.waitForSelector('.fu');
      await e.settled();
      assert.equal(await e.page.locator('.fu[data-future]').count(), 6);
      const before = await e.goal();
      // A worker paints the canvases: the page's elements do not show the result.
      const pixels = await Pixels.open(stage.browser);
      const still = await e.picture('firefox-selected');
      const flag = await e.at(car.end.x, car.end.y);
      const target = await e.at(
        car.start.x + (car.end.x - car.start.x) * 0.7,
        car.start.y + (car.end.y - car.start.y) * 0.7,
      );
      const said = await e.listen('.bl .status');
      await e.drag([flag[0] + 9, flag[1] - 26], [target[0] + 9, target[1] - 26], { moves: 12 });
      const dragged = await e.picture('firefox-drag');
      await e.release();
      await e.page.waitForSelector('.toast');
      assert.match(await e.text('.toast'), new RegExp(`^Goal of ${car.name} moved\\.`));
      assert.ok((await pixels.differing(still, dragged)).share > 0.01, 'the flag and the futures moved in the picture');
      assert.ok((await said()).some((words) => /Refining|First draft|Six futures/.test(words)));
      const after = await e.goal();
      assert.ok(distance(after, before) > 3, 'the flag has moved');
      await e.picture('firefox-released');

      await e.key('Space');
      await e.until(() => parseFloat(document.querySelector('.tm').textContent) > 0.3);
      await e.key('Space');
      await e.key('Control+z');
      await e.settled();
      assert.ok(distance(await e.goal(), before) < 0.1, 'the undo put the flag back');
    });
  },
  { browser: 'firefox' },
);
