// The editor on touch devices: a phone, a phone in landscape, a tablet.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carInSight } from '../../support/casting.js';
import { devices } from '../../support/devices.js';
import { Fingers } from '../../support/fingers.js';
import { distance, turn } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';

const LEAST_PX = 44;

async function open(stage, device = 'phone') {
  const e = await stage.open(devices[device]);
  await e.begin();
  return { e, f: new Fingers(e) };
}

/** A car is tapped, and its flag is in the picture. */
async function select({ e, f }) {
  const car = await carInSight(e);
  await f.tap(await e.at(car.start.x, car.start.y));
  await e.page.waitForSelector('.fu');
  await e.settled();
  assert.equal(await e.text('.ih h2 .sr'), car.name);
  return car;
}

const sheet = async (e) => (await e.page.locator('.sheet').boundingBox()).height;
/** The sheet is at rest. */
const rested = async (e) => {
  for (let was = -1, now = await sheet(e); was !== now; was = now, now = await sheet(e)) await e.frames(6);
  return sheet(e);
};

/** All visible controls are large enough for a finger, and nothing overflows at the side. */
async function fits(e, where) {
  const wrong = await e.page.evaluate((least) => {
    const seen = (el) => {
      const r = el.getBoundingClientRect();
      if (!r.width || !r.height || getComputedStyle(el).visibility === 'hidden') return false;
      const [x, y] = [r.x + r.width / 2, r.y + r.height / 2];
      if (x < 0 || y < 0 || x >= innerWidth || y >= innerHeight) return false;
      const top = document.elementFromPoint(x, y);
      return top !== null && (el.contains(top) || top.contains(el));
    };
    const pressable = [...document.querySelectorAll('button, select, input[type=range], [role=slider]')];
    const small = pressable
      .filter((el) => !el.closest('.sr') && seen(el))
      .map((el) => [el, el.getBoundingClientRect()])
      .filter(([, r]) => r.width < least - 0.5 || r.height < least - 0.5)
      .map(([el, r]) => `${el.getAttribute('aria-label') ?? el.textContent} ${r.width}×${r.height}`);
    const wide =
      document.documentElement.scrollWidth > innerWidth ? [`page is ${document.documentElement.scrollWidth} wide`] : [];
    const out = [...document.querySelectorAll('.flyout, .dlg, .menu, .drawer, .strip, .hint, .toast, .panel')]
      .map((el) => [el, el.getBoundingClientRect()])
      .filter(([, r]) => r.width && (r.left < -0.5 || r.right > innerWidth + 0.5))
      .map(([el, r]) => `${el.className} from ${r.left} to ${r.right}`);
    return [...small, ...wide, ...out];
  }, LEAST_PX);
  assert.deepEqual(wrong, [], where);
}

/** By its button, or in the menu that contains it where there is no room for one. */
async function press(e, id) {
  const button = e.page.locator(`.top [data-action="${id}"]:visible`);
  if (await button.count()) return button.first().tap();
  for (const menu of ['file', 'more']) {
    const name = e.page.locator(`[data-menu="${menu}"]:visible`);
    if (!(await name.count())) continue;
    await name.tap();
    const item = e.page.locator(`.menu [data-action="${id}"]`);
    if (await item.count()) return item.tap();
    await name.tap();
  }
  throw new Error(`nothing to press for ${id}`);
}

journeys('fingers', (stage) => {
  it('takes a signal that is nearer to the finger than a car', { timeout: 60_000 }, async () => {
    const { e, f } = await open(stage);
    const { agents, map, signals } = await e.get('/v1/scenes/demo-crossing');
    const lanes = new Set(map.lanes.map((l) => l.id));
    /** A finger on the stop line is beside a car, too. */
    const isBesideCar = ([x, y]) =>
      agents.some(({ type, track: { first_step, x_m, y_m } }) => {
        const far = first_step ? Infinity : Math.hypot(x_m[0] - x, y_m[0] - y);
        return type === 'vehicle' && far > 2.8 && far < 6;
      });
    let taken = 0;
    for (const { lane, stop_m } of signals.filter((s) => s.stop_m && isBesideCar(s.stop_m))) {
      const at = lanes.has(lane) && (await e.at(...stop_m));
      if (!at || !(await e.open(at, 12))) continue;
      await f.tap(at);
      await e.until(() => /^Signal/.test(document.querySelector('.toast')?.textContent ?? ''));
      assert.equal(await e.page.locator('.fu').count(), 0, 'no car is selected');
      await e.letGo();
      taken++;
    }
    assert.ok(taken > 0, 'a car waits at a stop line in sight');
  });

  it('a tap selects, a finger drags the flag under a loupe, two fingers undo', { timeout: 60_000 }, async () => {
    const { e, f } = await open(stage);
    const car = await select({ e, f });
    const [x, y] = await e.at(car.end.x, car.end.y);
    const mark = e.wire.asked.length;
    assert.equal(await e.shows('canvas.loupe'), false);
    await f.drag([x, y], [x + 8, y + 34]);
    assert.equal(await e.shows('canvas.loupe'), true);
    const loupe = await e.page.locator('canvas.loupe').boundingBox();
    const finger = [x + 8, y + 34];
    assert.ok(
      finger[0] < loupe.x || finger[0] > loupe.x + loupe.width || finger[1] > loupe.y + loupe.height,
      'the loupe stands away from the finger',
    );
    const { height } = devices.phone.viewport;
    assert.ok((await sheet(e)) <= 0.62 * height);
    await e.until(() => document.querySelector('.status').textContent.includes('Six futures'));
    await e.picture('touch-dragging');
    await f.up();
    await e.settled();
    assert.equal(await e.shows('canvas.loupe'), false);
    assert.ok(e.wire.since(mark).length > 0, 'futures were asked for');
    assert.match(await e.text('.toast'), new RegExp(`Goal of ${car.name}`));
    const there = await e.goal();
    assert.ok(distance(there, car.end) > 1, 'the goal moved');
    assert.ok((await e.text('.vline')).length > 3, 'the head of the sheet has the verdict');
    await f.tap([40, 120], [110, 110]);
    await e.settled();
    assert.equal(
      await e.page.locator('.fx[aria-checked="true"]', { hasText: 'Fixed' }).count(),
      3,
      'the goal is free again',
    );
    await f.tap([40, 120], [110, 110], [180, 120]);
    await e.settled();
    assert.deepEqual(await e.goal(), there);
  });

  it('one finger moves the picture, two zoom and turn it, and the page itself stays', { timeout: 40_000 }, async () => {
    const { e, f } = await open(stage);
    const before = await e.view();
    const ground = await e.at(before.cx - 20, before.cy + 30);
    await f.drag(ground, [ground[0] + 60, ground[1] + 120]);
    await f.up();
    const panned = await e.view();
    assert.ok(Math.abs((panned.cx - before.cx) * before.zoom + 60) < 2, 'to the side');
    assert.ok(Math.abs((panned.cy - before.cy) * before.zoom - 120) < 2, 'downwards');
    await f.down([150, 300], [240, 300]);
    for (let i = 1; i <= 8; i++) await f.move([150 - 8 * i, 300], [240 + 8 * i, 300]);
    await f.up();
    const zoomed = await e.view();
    assert.ok(zoomed.zoom > 1.8 * panned.zoom, `${panned.zoom} to ${zoomed.zoom}`);
    assert.equal(zoomed.turn, 0, 'drawn apart they do not turn it');
    const pair = (angle) => [-60, 60].map((r) => [195 + r * Math.cos(angle), 300 - r * Math.sin(angle)]);
    await f.down(...pair(0));
    for (let i = 1; i <= 10; i++) await f.move(...pair(0.08 * i));
    await f.up();
    const turned = await e.view();
    assert.ok(turned.turn > 0.5 && turned.turn < 0.9, `turned by ${turned.turn}`);
    await e.page.locator('.compass [data-action="north-up"]').tap();
    await e.settled();
    assert.equal((await e.view()).turn, 0, 'north is up');
    const page = await e.page.evaluate(() => [visualViewport.scale, scrollX, scrollY, document.body.scrollTop]);
    assert.deepEqual(page, [1, 0, 0, 0]);
    assert.equal(await e.page.locator('.fu[data-future]').count(), 0, 'nobody was selected by it');
  });

  it('a resting finger opens the menu of the object under it', { timeout: 40_000 }, async () => {
    const { e, f } = await open(stage);
    const car = await carInSight(e);
    await f.down(await e.at(car.start.x, car.start.y));
    await e.page.waitForSelector('.menu.ctx');
    await f.up();
    await fits(e, 'menu of a road user');
    const menu = await e.page.locator('.menu.ctx').boundingBox();
    assert.ok(menu.y >= 0 && menu.y + menu.height <= devices.phone.viewport.height, 'the menu is on the page');
    await e.page.locator('.menu.ctx [data-action="set-goal"]').tap();
    await e.settled();
    assert.match(await e.text('.toast'), /Goal/);
  });

  it('two fingers on the selected road user turn it', { timeout: 40_000 }, async () => {
    const { e, f } = await open(stage);
    const car = await select({ e, f });
    const { zoom } = await e.view();
    const [x, y] = await e.at(car.start.x, car.start.y);
    const pair = (angle) => {
      const [dx, dy] = [Math.cos(angle) * 44, -Math.sin(angle) * 44];
      return [
        [x - dx, y - dy],
        [x + dx, y + dy],
      ];
    };
    await f.down(...pair(0));
    for (let k = 1; k <= 12; k++) await f.move(...pair(0.05 * k));
    await e.picture('touch-turning');
    await f.up();
    await e.settled();
    const now = await e.pose('Start');
    const turned = turn(now.heading, car.start.heading);
    assert.ok(Math.abs(turned - 0.6) < 0.1, `turned by ${turned.toFixed(2)} rad`);
    assert.ok(distance(now, car.start) < 0.1, 'it stays where it was');
    assert.equal((await e.view()).zoom, zoom);
    assert.match(await e.text('.toast'), new RegExp(`^Heading of ${car.name}`));
  });

  it('a finger that rests on a future opens its menu', { timeout: 60_000 }, async () => {
    const { e, f } = await open(stage);
    const car = await select({ e, f });
    const { chosen, modes } = e.wire.last().event('final').samples[0].agents[car.id];
    const { x_m, y_m } = modes[chosen];
    const far = (i) =>
      Math.min(distance({ x: x_m[i], y: y_m[i] }, car.start), distance({ x: x_m[i], y: y_m[i] }, car.end));
    const i = x_m.reduce((best, _, k) => (far(k) > far(best) ? k : best), 0);
    await f.down(await e.at(x_m[i], y_m[i]));
    const menu = e.page.getByRole('menu', { name: 'Actions for this future' });
    await menu.waitFor();
    await f.up();
    await fits(e, 'menu of a future');
    await e.picture('touch-future-menu');
    await menu.locator('[data-action="future-play"]').tap();
    await e.until(() => parseFloat(document.querySelector('.tm').textContent) > 0.3);
    assert.equal(await e.page.locator('.fu[aria-checked="true"]').count(), 1);
    await e.key('Home');
    await e.settled();
    assert.match(await e.text('.toast'), new RegExp(`${car.name}`));
  });

  it('the sheet has three heights: dragged, flicked and tapped', { timeout: 40_000 }, async () => {
    const { e, f } = await open(stage);
    assert.equal(await rested(e), 96);
    const grip = async () => {
      const r = await e.page.locator('.grip').boundingBox();
      return [r.x + r.width / 2, r.y + 10];
    };
    await e.page.locator('.grip').tap();
    assert.equal(await rested(e), 300);
    let at = await grip();
    await f.drag(at, [at[0], 120], 20);
    await f.up();
    assert.ok((await rested(e)) > 700, 'dragged to the top');
    at = await grip();
    // The finger pauses before the release: no flick.
    await f.drag(at, [at[0], at[1] + 200], 20);
    await e.frames(12);
    await f.up();
    assert.ok((await rested(e)) > 700, 'dropped near the top');
    at = await grip();
    await f.down(at);
    for (let i = 1; i <= 3; i++) await f.move([at[0], at[1] + 35 * i]);
    await f.up();
    assert.equal(await rested(e), 300, 'flicked down');
    await e.page.locator('.grip').focus();
    await e.key('ArrowDown');
    assert.equal(await rested(e), 96, 'by keys');
  });

  it('a number is changed by − and + beside it', { timeout: 40_000 }, async () => {
    const { e, f } = await open(stage);
    await select({ e, f });
    await e.page.locator('[data-field="goal-time"]').tap();
    await fits(e, 'a field in use');
    await e.page.getByRole('button', { name: 'Goal time in seconds, less' }).tap();
    await e.settled();
    assert.equal(await e.value('goal-time'), 8.9);
    assert.equal(await e.page.locator('[data-field="goal-time"]').getAttribute('inputmode'), 'decimal');
  });

  it('the + button places a pedestrian', { timeout: 40_000 }, async () => {
    const { e, f } = await open(stage);
    const count = (await e.roadUsers()).length;
    await e.page.getByRole('button', { name: 'Add', exact: true }).tap();
    await fits(e, 'the menu of the +');
    await e.page.locator('.adding [data-action="tool-place-pedestrian"]').tap();
    await e.page.waitForSelector('.placing');
    await fits(e, 'placing');
    const { cx, cy } = await e.view();
    await f.tap(await e.at(cx - 18, cy + 2));
    await e.until((n) => document.querySelectorAll('[data-agent]').length > n, count);
    await e.page.getByRole('button', { name: 'Done', exact: true }).tap();
    await e.page.getByRole('button', { name: 'Add', exact: true }).waitFor();
  });

  it(
    'a size of its own is typed, and who is put there comes out from under the sheet',
    { timeout: 40_000 },
    async () => {
      const { e, f } = await open(stage, 'tablet on its side');
      await e.page.locator('.rail [data-menu="add"]').tap();
      await e.page.locator('.menu [data-action="tool-place-car"]').tap();
      const length = e.page.getByLabel('Custom length in metres', { exact: true });
      await length.tap();
      await e.page.keyboard.type('6.2');
      await e.key('Enter');
      assert.equal(await length.inputValue(), '6.2');
      const { cx, cy } = await e.view();
      await f.tap(await e.at(cx + 6, cy - 22));
      await e.page.waitForSelector('.fu');
      await e.settled();
      const start = await e.pose('Start');
      const [, y] = await e.at(start.x, start.y);
      assert.ok(y < (await e.page.locator('.sheet').boundingBox()).y, 'the sheet lies over it');
    },
  );

  for (const device of Object.keys(devices)) {
    it(`everything can be pressed, and nothing overflows: ${device}`, { timeout: 60_000 }, async () => {
      const { e, f } = await open(stage, device);
      const name = device.replaceAll(' ', '-');
      await fits(e, 'at first');
      await select({ e, f });
      await fits(e, 'selected');
      await e.picture(`${name}-selected`);
      await e.page.locator('.grip').tap();
      await rested(e);
      await fits(e, 'all fields');
      await e.picture(`${name}-full`);
      // Controls further down are as large.
      await e.page.locator('.sheet .insp').evaluate((el) => el.scrollTo(0, 1e6));
      await e.frames(3);
      await fits(e, 'the end of the fields');
      await e.page.locator('.grip').tap();
      await rested(e);
      for (const menu of ['file', 'more']) {
        const button = e.page.locator(`[data-menu="${menu}"]`);
        if (!(await button.count())) continue;
        await button.tap();
        await fits(e, `menu ${menu}`);
        await button.tap();
      }
      for (const id of ['share', 'export']) {
        await press(e, id);
        await e.page.waitForSelector(`.flyout.${id}`);
        await fits(e, id);
        await e.picture(`${name}-${id}`);
        await e.key('Escape');
      }
      if (device !== 'phone') return;
      for (const id of ['variants', 'users']) {
        await e.page.locator('[data-menu="more"]').tap();
        await e.page.locator(`.menu [data-action="${id}"]`).tap();
        await e.page.waitForSelector(id === 'users' ? '.drawer.users' : '.strip');
        await fits(e, id);
      }
    });
  }
});
