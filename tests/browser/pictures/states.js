// States for pictures: how to reach each, with its number in the design. Each begins on a page of its own.
import { carBesideMedian, carOnTheMove, pedestrianOnTheMove } from '../support/casting.js';
import { devices } from '../support/devices.js';
import { Fingers } from '../support/fingers.js';
import { along, brokenScene, emptyScene, knobOfArm, lanesBeside } from '../support/maps.js';

/** A corner of the picture where the pointer is over no road user and no panel. */
const REST = [700, 120];
const rest = (e) => e.page.mouse.move(...REST);
const leave = (e) => e.page.evaluate(() => document.activeElement?.blur?.());
const gone = (e, selector) => e.page.waitForSelector(selector, { state: 'detached' });

/** The flag of a car's goal, moved by a share of the way back to the car. */
const flag = (car, share) => [
  car.to[0] + (car.from[0] - car.to[0]) * share + 9,
  car.to[1] + (car.from[1] - car.to[1]) * share - 26,
];

async function selected(e) {
  const car = await carOnTheMove(e);
  await e.choose(car.id);
  await leave(e);
  await rest(e);
  return car;
}

/** A standing car in the picture, with road ahead. */
async function waiting(e) {
  const parked = /parked|off the lanes/;
  for (const u of (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed === 0 && !parked.test(u.words))) {
    await e.choose(u.id);
    await leave(e);
    const p = await e.pose('Start');
    const ahead = [0, 30].map((d) => e.at(p.x + d * Math.cos(p.heading), p.y + d * Math.sin(p.heading)));
    const seen = await Promise.all(ahead.map(async (at) => e.open(await at)));
    if (seen.every(Boolean)) return u;
    await e.letGo();
  }
  throw new Error('nobody waits in the picture');
}

/** The drag pauses: all refinement steps are done, and the futures have the names that they have at rest. */
async function refined(e) {
  await e.until(() => document.querySelector('[aria-label="Futures"] small').textContent.startsWith('six, #1'));
  // A second of frames without a new word: the names change 0.45 s after the last answer.
  for (let last = '', same = 0; same < 6;) {
    await e.frames(10);
    const words = await e.text('[aria-label="Futures"]');
    same = words === last ? same + 1 : 0;
    last = words;
  }
}

/** The flag is dragged, a third of the way back. */
async function dragged(e) {
  const car = await selected(e);
  await e.drag(flag(car, 0), flag(car, 0.33), { moves: 3 });
  await e.settled();
  await refined(e);
  return car;
}

async function released(e) {
  const car = await dragged(e);
  await e.release();
  await rest(e);
  return car;
}

/** The stopped clock of the page advances by a second: running animations are done. */
async function later(e) {
  await e.page.evaluate(() => {
    const now = performance.now();
    performance.now = () => now + 1000;
  });
  await e.frames(3);
}

/** A scene without road users on the map of the crossing. */
async function nobody(e) {
  const { json, bytes } = await emptyScene(e);
  await e.drop('nobody.json', bytes);
  await e.page.waitForSelector('.nobody');
  await e.settled();
  return json;
}

/** The flag is dragged across a median: it lags at the kerb, and the verdict is on the line. */
async function acrossMedian(e) {
  const { car, across } = await carBesideMedian(e);
  await e.choose(car.id);
  await e.key('z');
  await e.settled();
  const flagAt = async ({ x, y }) => {
    const [right, down] = await e.at(x, y);
    return [right + 9, down - 26];
  };
  // One move: the futures of a drag depend on those shown before.
  await e.drag(await flagAt(car.end), await flagAt(across), { moves: 1 });
  await e.page.waitForSelector('.helpbar');
  await e.settled();
  await refined(e);
}

/** The knob of the northern arm of a new crossing is dragged to turn it. */
async function turningAnArm(e) {
  await e.key('Shift+T');
  await e.page.click('[data-template="four-arms"]');
  await e.settled();
  await e.key(']');
  const now = await e.value('layout-arms.angle_deg');
  const knob = await knobOfArm(e, 1);
  await e.drag(await knob(now), await knob(71), { moves: 4 });
  await e.settled();
}

async function variants(e, count) {
  await e.key('b');
  await selected(e);
  await e.key('Shift+V');
  await e.page.waitForSelector('.strip');
  const field = e.page.getByLabel('Number of variants');
  await field.fill(String(count));
  await field.press('Enter');
  await leave(e);
  await e.key('Control+Enter');
  await e.page.waitForSelector('.vcard[data-variant]');
  await e.page.waitForSelector('.vcard.waiting', { state: 'detached', timeout: 60_000 });
  await e.settled();
}

/**
 * A recording that may be published: an example as a scenario record without its source, read again. One of its cars
 * has its recorded goal.
 */
async function recorded(e) {
  const reply = await e.page.request.get(new URL('/v1/scenes/demo-arterial/export?format=womd', e.page.url()).href);
  await e.drop('market-evening.tfrecord', await reply.body());
  await e.until(() => /imported/.test(document.querySelector('.toast')?.textContent ?? ''));
  await e.settled();
  await e.key('b');
  const car = await carOnTheMove(e);
  await e.choose(car.id);
  await e.key('Alt+g');
  await e.settled();
  await e.key('o');
  await leave(e);
  await rest(e);
  await gone(e, '.toast');
}

/** The flag of a car dragged by a finger, with the loupe beside it. */
async function fingered(e) {
  const f = new Fingers(e);
  const car = await carOnTheMove(e);
  await e.choose(car.id);
  await e.key('g');
  await e.settled();
  const goal = await e.pose('Goal');
  const [x, y] = await e.at(goal.x, goal.y);
  await f.drag([x + 12, y - 34], [x + 72, y - 40], 6);
  await e.settled();
  await refined(e);
}

const dark = { colorScheme: 'dark' };

/** `[name, how to reach it, page options]`. */
export const STATES = [
  ['01-first-view', rest],
  [
    '02-hover',
    async (e) => {
      const car = await carOnTheMove(e);
      await e.page.mouse.move(...car.from, { steps: 2 });
    },
  ],
  ['03-selected', selected],
  ['04-mid-drag', dragged],
  ['05-after-release', released],
  [
    '06-pedestrian-typed',
    async (e) => {
      const walker = await pedestrianOnTheMove(e);
      await e.choose(walker.id);
      await e.key('z');
      await e.key('g');
      await e.settled();
      await e.type('goal-speed', '1.2+0.4');
      await gone(e, '.toast');
      await rest(e);
      await e.page.locator('[data-field="goal-speed"]').click();
    },
  ],
  [
    '07-unreachable',
    async (e) => {
      await released(e);
      await e.type('goal-time', '2');
      await leave(e);
    },
  ],
  [
    '08-events',
    async (e) => {
      await released(e);
      await e.letGo();
      await e.key('e');
      // The remedy is tried on the server before it has its tick.
      await e.settled();
      await later(e);
    },
  ],
  [
    '09-log-ghost',
    async (e) => {
      await released(e);
      await e.key('o');
      for (let i = 0; i < 30; i++) await e.key('.');
      await later(e);
    },
  ],
  [
    '10-placing',
    async (e) => {
      const json = await nobody(e);
      const { a } = lanesBeside(json);
      await e.key('1');
      await e.page.mouse.move(...(await e.at(...along(a, 20))), { steps: 3 });
    },
  ],
  [
    '11-density-fill',
    async (e) => {
      await e.key('b');
      await e.key('d');
      await e.page.waitForSelector('.filling');
      await e.settled();
    },
  ],
  ['12-variants', (e) => variants(e, 6)],
  [
    '13-server-away',
    async (e, { program }) => {
      const car = await selected(e);
      await program.kill();
      await e.drag(flag(car, 0), flag(car, 0.33), { moves: 3 });
      await e.page.waitForSelector('.banner');
      await e.page.mouse.up();
      await e.until(() => /1 change is waiting/.test(document.querySelector('.banner').textContent));
    },
    // The banner counts down the seconds to the next try.
    { hide: ['.banner'], after: ({ program }) => program.run() },
  ],
  [
    '14-import-error',
    async (e) => {
      const bytes = (json) => Buffer.from(JSON.stringify(json, null, 1));
      const { json } = await emptyScene(e);
      const { agents } = await e.get('/v1/scenes/demo-crossing');
      await e.drop(
        ...['harbour_am.json', bytes({ ...json, name: 'Harbour, morning', agents })],
        ...['harbour_pm.json', bytes({ ...json, name: 'Harbour, evening', agents: agents.slice(0, 30) })],
        ...['junction_b.json', bytes(brokenScene)],
      );
      await e.page.waitForSelector('.dlg pre');
      await e.settled();
      await e.until(() => [...document.querySelectorAll('.scn canvas')].slice(0, 2).every((c) => c.dataset.done));
    },
    // The time when the server saved them.
    { hide: ['.scn small + small'] },
  ],
  [
    '15-empty',
    async (e) => {
      await e.page.waitForSelector('.empty .crd');
      await e.until(() => [...document.querySelectorAll('.crd canvas')].every((c) => c.dataset.done));
    },
    // The scene to show is unavailable at first.
    {
      scene: false,
      arrange: (context) => {
        let refused = false;
        const body = JSON.stringify({ title: 'The server is busy', detail: 'The server is busy.', status: 503 });
        return context.route(/\/v1\/scenes\/demo-crossing$/, (route) => {
          if (refused) return route.continue();
          refused = true;
          return route.fulfill({ status: 503, contentType: 'application/problem+json', body });
        });
      },
    },
  ],
  [
    '16-busy',
    async (e, { door }) => {
      await e.key('b');
      await selected(e);
      await e.key('Shift+V');
      await e.page.waitForSelector('.strip');
      await e.page.getByLabel('Number of variants').fill('10');
      await e.page.getByLabel('Number of variants').press('Enter');
      await leave(e);
      // The futures, and the others' reactions to four of them.
      door.lets = 5;
      await e.page.locator('.strip .none .pri').click();
      await e.until(() => document.querySelector('.strip .progress')?.getAttribute('aria-valuenow') === '4');
      await e.frames(6);
    },
    { holds: true },
  ],
  ['17-dark', released, dark],
  ['18-touch', fingered, devices['tablet on its side']],
  [
    '19-palette',
    async (e) => {
      await selected(e);
      await e.key('Control+k');
      await e.page.waitForSelector('.dlg');
      await e.page.keyboard.type('goal');
      await e.frames(2);
    },
  ],
  [
    '20-shortcuts',
    async (e) => {
      await e.key('?');
      await e.page.waitForSelector('.dlg.keys');
    },
  ],
  ['21-selected-1280x720', selected, { viewport: { width: 1280, height: 720 } }],
  ['22-recorded-scene', recorded],
  ['23-recorded-scene-dark', recorded, dark],
  [
    '24-live-drag',
    async (e, { door }) => {
      const car = await selected(e);
      // The first draft is on the page, and nothing after it.
      door.lets = 0;
      await e.drag(flag(car, 0), flag(car, 0.2), { moves: 1 });
      await e.until(() => /first draft|step \d/.test(document.querySelector('.insp').textContent));
      await e.frames(6);
    },
    { holds: true },
  ],
  ['25-verdict-on-the-line', acrossMedian],
  ['25-verdict-on-the-line-dark', acrossMedian, dark],
  [
    '26-others-react-mid-drag',
    async (e) => {
      await waiting(e);
      await e.key('g');
      await e.settled();
      const [start, end] = [await e.pose('Start'), await e.pose('Goal')];
      const [x, y] = await e.at(end.x, end.y);
      const flagAt = async (ahead) => {
        const to = await e.at(start.x + ahead * Math.cos(start.heading), start.y + ahead * Math.sin(start.heading));
        return [to[0] + 9, to[1] - 26];
      };
      await e.drag([x + 9, y - 26], await flagAt(45), { moves: 1 });
      // Reactions have been requested; if this car itself waits there are none.
      for (const ahead of [40, 35, 50, 30]) {
        await e.settled();
        if (await e.shows('.previewed')) break;
        await e.page.mouse.move(...(await flagAt(ahead)));
      }
      await e.page.waitForSelector('.previewed');
      await e.settled();
    },
  ],
  [
    '27-feedback-rounds',
    async (e) => {
      await selected(e);
      await e.key('Shift+K');
      await e.page.waitForSelector('.rcard');
      await e.settled();
      for (const key of ['1', 'k', '2', 'k', '3', 'j', '4', 'j', '5', 'j']) await e.key(key);
      await e.key('Enter');
      await e.settled();
    },
  ],
  [
    '27-rounds-of-the-scene',
    async (e) => {
      await e.key('Alt+K');
      await e.page.waitForSelector('.rcard', { timeout: 60_000 });
      await e.settled();
    },
  ],
  [
    '29-multi-select',
    async (e) => {
      await e.key('b');
      const walker = await pedestrianOnTheMove(e);
      await e.choose(walker.id);
      await leave(e);
      await e.key('Shift+A');
      await e.settled();
      await e.key('z');
      await e.settled();
      await gone(e, '.toast');
    },
  ],
  ['28-new-map', turningAnArm],
  [
    '30-speed-curve',
    async (e) => {
      await selected(e);
      await e.key('t');
      await e.frames(3);
      const plot = await e.page.locator('.plot').boundingBox();
      await e.page.mouse.dblclick(plot.x + plot.width * 0.6, plot.y + plot.height * 0.55);
      await e.settled();
      await e.type('point-speed', '0');
      await e.type('point-hold', '3');
      await leave(e);
    },
  ],
  [
    '31-variants-compared',
    async (e) => {
      await variants(e, 4);
      const cards = e.page.locator('.vcard .face');
      await cards.nth(1).focus();
      await e.key('c');
      await e.page.waitForSelector('.pane');
      await leave(e);
      await e.settled();
      for (let i = 0; i < 40; i++) await e.key('.');
    },
  ],
  [
    '32-export',
    async (e) => {
      await e.page.locator('.top [data-action="export"]').click();
      await e.page.locator('[data-kind="openscenario"]').click();
      await e.until(() => ![...document.querySelectorAll('.kind .tag')].some((t) => t.textContent === '…'));
      await e.settled();
    },
  ],
  [
    '33-history',
    async (e) => {
      await selected(e);
      for (const t of ['8.0', '7.0', '6.0']) await e.type('goal-time', t);
      await leave(e);
      await e.key('Control+h');
      await e.page.waitForSelector('.history');
      await e.page.locator('.past [data-step]').nth(2).click();
      await e.type('goal-time', '5.0');
      await leave(e);
    },
  ],
  [
    '33-share',
    async (e) => {
      await e.page.locator('[data-action="share"]').click();
      await e.until(() => document.querySelector('.share input')?.value.startsWith('http'));
    },
    // The port of the program differs each time.
    { hide: ['.share input'] },
  ],
  [
    'drive',
    async (e) => {
      const [car] = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 2.5);
      await e.choose(car.id);
      await e.key('Shift+E');
      await e.page.waitForSelector('.drivebar');
      await e.settled();
    },
  ],
  [
    '34-phone',
    async (e) => {
      const f = new Fingers(e);
      const [car] = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 2.5);
      await e.choose(car.id);
      await f.tap([195, 20]);
    },
    devices.phone,
  ],
  [
    '35-empty-scene',
    async (e) => {
      await nobody(e);
      // The list of scenes has the time of saving.
      await e.key('b');
    },
  ],
  [
    '36-search-case',
    async (e) => {
      await e.key('b');
      const [one, two] = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 2.5);
      await e.choose(one.id);
      await e.page
        .locator(`[data-agent="${two.id}"]`)
        .evaluate((el) => el.dispatchEvent(new MouseEvent('click', { bubbles: true, shiftKey: true })));
      await e.key('Alt+f');
      await e.page.locator('[data-action="case-search"]').click();
      await e.page.waitForSelector('[data-action="case-stop"]');
      await e.page.waitForSelector('[data-action="case-stop"]', { state: 'detached', timeout: 240_000 });
      await e.page.locator('.case .face').first().click();
      await e.settled();
    },
    // It has the time of day when it began.
    { hide: ['.seeking .note'] },
  ],
  [
    'layers',
    async (e) => {
      const car = await selected(e);
      for (const key of ['Shift+M', 'Shift+H', 'Shift+C']) await e.key(key);
      await e.page.locator('[data-menu="layers"]').click();
      await e.page.waitForSelector('.menu');
      return car;
    },
  ],
  [
    'remedy-tried',
    async (e) => {
      await released(e);
      await e.type('goal-time', '2');
      await leave(e);
      await e.page.locator('[data-remedy="Use nearest reachable"]').hover();
      await e.settled();
    },
  ],
];
