// Labels leave the road free: in all examples, on a desk and on a phone, light and dark.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { LABEL_BESIDE_HANDLES_PX, underLabels } from '../../support/calm.js';
import { devices } from '../../support/devices.js';
import { Fingers } from '../../support/fingers.js';
import { journeys } from '../../support/journey.js';

/** Of the road's pixels. */
const MOST_COVERED = 0.04;
/** Pixels of road that a measured part of the picture has at least. */
const LEAST_ROAD = 40_000;
const EXAMPLES = ['crossing', 'roundabout', 'residential', 'arterial', 'motorway'];

const PAGES = [
  { on: 'a desk', side: 70, height: 500, touch: false, least: undefined, page: {} },
  // Above the half-open sheet.
  { on: 'a phone', side: 0, height: 300, touch: true, least: LABEL_BESIDE_HANDLES_PX, page: devices.phone },
];

/** The part of the picture with few cards over it: `side` pixels are left out on the left and on the right. */
async function picture(e, { side, height }) {
  await e.frames(2);
  const { x, y, width } = await e.page.locator('main.stage').boundingBox();
  return e.page.screenshot({ clip: { x: x + side, y: y + 60, width: width - 2 * side, height } });
}

/** A vehicle on the move in the measured part of the picture, and where it is; nobody is selected afterwards. */
async function mover(e, height) {
  const { x, y, width } = await e.page.locator('main.stage').boundingBox();
  const all = (await e.roadUsers()).filter((u) => ['Car', 'Bus', 'Truck'].includes(u.kind) && u.speed > 3);
  for (const u of all.sort((a, b) => b.speed - a.speed)) {
    await e.choose(u.id);
    const start = await e.pose('Start');
    await e.letGo();
    const at = await e.at(start.x, start.y);
    const inside = at[0] > x + 30 && at[0] < x + width - 30 && at[1] > y + 70 && at[1] < y + height;
    if (inside && (await e.open(at))) return { ...u, at };
  }
  throw new Error('no vehicle in the picture is on the move');
}

journeys('labels', (stage) => {
  const few = async (e, what, [empty, labelled], least) => {
    const { all, share } = await underLabels(e.page, empty, labelled, least);
    assert.ok(all > LEAST_ROAD, `${what}: ${all} pixels of road`);
    assert.ok(share <= MOST_COVERED, `${what}: ${(100 * share).toFixed(1)} % of the road is under labels`);
    return share;
  };

  for (const { on, touch, page, ...part } of PAGES)
    for (const colorScheme of ['light', 'dark'])
      it(`cover at most 4 % of the road on ${on}, ${colorScheme}`, { timeout: 120_000 }, async () => {
        const shares = [];
        for (const name of EXAMPLES) {
          const e = await stage.visit(`${stage.program.url}?scene=demo-${name}`, { ...page, colorScheme });
          await e.begin();
          const car = await mover(e, part.height);
          const empty = await picture(e, part);
          if (touch) await new Fingers(e).tap(car.at);
          else await e.page.mouse.click(...car.at);
          await e.page.waitForSelector('.fu');
          await e.settled();
          // The pointer is no longer on the car.
          if (!touch) await e.page.mouse.move(700, 60);
          shares.push(await few(e, `${name}, ${car.name}`, [empty, await picture(e, part)], part.least));
          const seen = await e.page.getAttribute('main.stage', 'data-view');
          await e.key('g');
          await e.settled();
          // Where the goal is brought into sight, the pictures are not of one place.
          if (seen !== (await e.page.getAttribute('main.stage', 'data-view'))) continue;
          shares.push(await few(e, `${name}, goal of ${car.name}`, [empty, await picture(e, part)], part.least));
        }
        console.log(`${on}, ${colorScheme}: at most ${(100 * Math.max(...shares)).toFixed(1)} % under labels`);
      });
});
