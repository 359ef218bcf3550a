// A calm page: few controls at once, few labels over the road, and everything else found by keys.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { controlsInSight, underLabels } from '../../support/calm.js';
import { carOnTheMove } from '../../support/casting.js';
import { devices } from '../../support/devices.js';
import { Fingers } from '../../support/fingers.js';
import { journeys } from '../../support/journey.js';

const MOST = { first: 30, listsClosed: 20, selected: 45, released: 45, phone: 9, phoneSelected: 21 };
/** Of the road's pixels. */
const MOST_COVERED = 0.04;
/** Height of the picture above the half-open sheet of a phone. */
const PHONE_ROAD_PX = 300;

const atMost = async (e, state) => {
  const all = await controlsInSight(e.page);
  assert.ok(all.length <= MOST[state], `${state}: ${all.length} controls of ${MOST[state]}: ${all.join(', ')}`);
};

/** The part of the picture without cards over it. */
async function picture(e, height = 500) {
  const { x, y, width } = await e.page.locator('main.stage').boundingBox();
  return e.page.screenshot({ clip: { x: x + 70, y: y + 60, width: width - 140, height } });
}

async function fewLabels(page, empty, labelled, leastRoad) {
  const { all, share } = await underLabels(page, empty, labelled);
  assert.ok(all > leastRoad, `${all} pixels of road`);
  assert.ok(share <= MOST_COVERED, `${(100 * share).toFixed(1)} % of the road is under labels`);
}

journeys('a calm page', (stage) => {
  it('shows at most 30 controls at first and 45 with a car selected', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.page.waitForSelector('.scn');
    await atMost(e, 'first');
    await e.key('b');
    await e.settled();
    await atMost(e, 'listsClosed');
    const car = await carOnTheMove(e);
    const empty = await picture(e);
    await e.page.mouse.click(...(await e.at(car.start.x, car.start.y)));
    await e.page.waitForSelector('.fu');
    await e.settled();
    await e.page.mouse.move(700, 120);
    await e.frames(2);
    await atMost(e, 'selected');
    await fewLabels(e.page, empty, await picture(e), 50_000);
    const flag = [car.to[0] + 9, car.to[1] - 26];
    await e.drag(flag, [flag[0] + (car.from[0] - car.to[0]) / 3, flag[1] + (car.from[1] - car.to[1]) / 3], {
      moves: 6,
    });
    await e.release();
    await e.page.mouse.move(700, 120);
    await atMost(e, 'released');
  });

  it('shows no more on a phone than before', { timeout: 60_000 }, async () => {
    const e = await stage.open(devices.phone);
    // In the first seconds, which play automatically, the car leaves the place that is tapped.
    await e.begin();
    await atMost(e, 'phone');
    const car = (await e.roadUsers()).find((u) => u.kind === 'Car' && u.speed > 3);
    await e.choose(car.id);
    await atMost(e, 'phoneSelected');
    const { x, y } = await e.pose('Start');
    await e.letGo();
    // Now the car is in sight: a tap does not move the picture.
    const at = await e.at(x, y);
    const empty = await picture(e, PHONE_ROAD_PX);
    await new Fingers(e).tap(at);
    await e.page.waitForSelector('.fu');
    await e.settled();
    await e.frames(2);
    assert.deepEqual(await e.at(x, y), at);
    await fewLabels(e.page, empty, await picture(e, PHONE_ROAD_PX), 50_000);
  });

  it('answers the keys that find things in other programs', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    for (const key of ['Control+k', 'Control+f', '/', 'Control+p', 'Control+Shift+p']) {
      await e.key(key);
      await e.page.waitForSelector('.pal input:focus');
      await e.page.keyboard.type('/lasso');
      assert.equal(await e.page.inputValue('.pal input'), '/lasso', 'a typed / is text');
      await e.key('Escape');
      await e.page.waitForSelector('.pal', { state: 'detached' });
    }
    // Everything that left the page is found by its name.
    for (const words of ['Seed', 'Lasso', 'Measure', 'Place a truck', 'Loop', 'Keep in view', 'Light or dark']) {
      await e.key('/');
      await e.page.fill('.pal input', words);
      assert.match(await e.text('.pal [role="option"]'), new RegExp(words.split(' ')[0], 'i'), words);
      await e.key('Escape');
    }
    await e.key('F1');
    await e.page.waitForSelector('.dlg.keys');
    const groups = await e.page.locator('.dlg.keys h3').allInnerTexts();
    assert.ok(groups.includes('Add road users') && groups.length >= 10, groups.join(', '));
    await e.key('Escape');
    const zoom = () => e.text('.zoomnum');
    const before = await zoom();
    await e.key('Control++');
    await e.until((was) => document.querySelector('.zoomnum').textContent !== was, before);
  });

  it('says where keys without a meaning here have one', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    for (const [key, name] of [
      ['s', 'Star variant'],
      ['j', 'Reject card'],
      ['c', 'Place a car'],
      ['q', 'Q'],
      ['Control+g', 'Ctrl G'],
    ]) {
      await e.key(key);
      await e.until(
        (said) => document.querySelector('.toast')?.textContent.startsWith(`${said}: not available here`),
        name,
      );
    }
  });

  it('leaves half of a low page to the road, and shows the curves on request', { timeout: 60_000 }, async () => {
    const e = await stage.open({ viewport: { width: 1000, height: 700 } });
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    const { y } = await e.page.locator('.sheet').boundingBox();
    const { top } = await e.page.locator('main.stage').evaluate((el) => el.getBoundingClientRect());
    assert.ok(y - top >= 350, `${y - top} px of road`);
    for (const letter of 'ABCDEF') {
      const row = await e.page.locator(`.fu[data-future="${letter}"]`).boundingBox();
      assert.ok(row.y + row.height < 700 - 52, `${letter} is in sight`);
    }
    assert.equal(await e.shows('.plot'), false);
    await e.page.evaluate(() => document.activeElement?.blur?.());
    await e.key('t');
    assert.equal(await e.shows('.plot'), true);
  });

  it(
    'has a tag at the edge for a flag outside the picture, dragged as the flag itself',
    { timeout: 60_000 },
    async () => {
      const e = await stage.open();
      await e.begin();
      await e.key('b');
      await e.page.locator('[data-menu="file"]').focus();
      await e.key('/');
      await e.page.fill('.pal input', 'Ring road');
      await e.key('Enter');
      await e.until(() => document.querySelector('.title input').value.startsWith('Ring road'));
      await e.begin();
      const cars = [];
      for (const u of (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 10)) {
        await e.choose(u.id);
        cars.push({ ...u, start: await e.pose('Start'), goal: await e.pose('Goal') });
        await e.letGo();
      }
      // The list has moved the picture to each; a new page shows the scene as at first.
      await e.page.reload();
      await e.ready();
      await e.begin();
      const { box } = await e.view();
      await e.key('b');
      await e.settled();
      const edge = { left: box.x + 98, right: box.x + box.width - 42 };
      for (const u of cars) {
        const [from, to] = [await e.at(u.start.x, u.start.y), await e.at(u.goal.x, u.goal.y)];
        const outside = to[0] < edge.left - 60 || to[0] > edge.right + 60;
        if (!outside || !(await e.open(from)) || from[0] < edge.left + 200 || from[0] > edge.right - 200) continue;
        await e.page.mouse.click(...from);
        await e.page.waitForSelector('.fu');
        await e.settled();
        const x = to[0] < from[0] ? edge.left : edge.right;
        const y = from[1] + ((to[1] - from[1]) * (x - from[0])) / (to[0] - from[0]);
        // It keeps clear of road users: on the way, or beside it.
        const grabs = () => e.page.evaluate(() => document.querySelector('main.stage').dataset.cursor === 'grab');
        let tag = null;
        for (const down of [0, -30, 30]) {
          await e.page.mouse.move(x, y + down);
          await e.frames(2);
          if (!tag && (await grabs())) tag = [x, y + down];
        }
        assert.ok(tag, `no tag of ${u.name} at ${x}, ${y}`);
        await e.picture('flag-at-the-edge');
        const hand = [x + (from[0] - x) / 2, y + (from[1] - y) / 2];
        await e.drag(tag, hand, { moves: 6 });
        await e.release();
        assert.match(await e.text('.toast'), new RegExp(`Goal of ${u.name}`));
        const { x: gx, y: gy } = await e.goal();
        const at = await e.at(gx, gy);
        assert.ok(Math.abs(at[0] + 9 - hand[0]) < 12, `the flag is at ${at}, the hand was at ${hand}`);
        return;
      }
      assert.fail('every flag is in the picture');
    },
  );
});
