// Reference pictures of the editor's main states, and their comparison.
//
//   npm run pictures -- DIR                    takes the pictures
//   npm run pictures -- --compare BEFORE AFTER prints the share of pixels that differ
//
// The same program, scene and seed give the same pictures: the viewport is fixed, motion is reduced, every step waits
// for a condition, and the page's stopwatch stands still, so that no measured milliseconds are in the picture.
import { mkdirSync } from 'node:fs';
import { carOnTheMove } from './support/casting.js';
import { Editor, launch } from './support/editor.js';
import { compare } from './support/pixels.js';
import { Program } from './support/program.js';
import { missing } from './support/where.js';

/** A corner of the picture where the pointer is over nobody and no panel. */
const REST = [700, 120];

/** The states in order, each going on from the one before it. */
const STATES = [
  ['1-opened', async (e) => e.page.mouse.move(...REST)],
  [
    '2-selected',
    async (e, car) => {
      await e.choose(car.id);
      await e.until(() => document.querySelectorAll('.fu').length === 6);
    },
  ],
  [
    '3-dragging',
    async (e, car) => {
      await e.drag(flag(car, 0), flag(car, 0.15), { moves: 1 });
      await e.settled();
      await e.page.mouse.move(...flag(car, 0.3));
    },
  ],
  [
    '4-released',
    async (e) => {
      await e.release();
      await e.page.mouse.move(...REST);
      await e.until(() => /changed|other/.test(document.querySelector('.toast')?.textContent ?? ''));
    },
  ],
  ['5-unreachable', (e) => e.type('goal-time', '2')],
  ['6-palette', (e) => e.key('Control+k')],
  [
    '7-shortcuts',
    async (e) => {
      await e.key('Escape');
      await e.page.evaluate(() => document.activeElement?.blur());
      await e.key('?');
      await e.page.waitForSelector('.dlg.keys');
    },
  ],
  [
    '8-dark-events',
    async (e) => {
      await e.key('Escape');
      await e.key('Control+z');
      await e.settled();
      await e.letGo();
      await e.key('Shift+d');
      await e.key('n');
      await e.key('e');
      await e.settled();
      await e.until(() => !document.querySelector('.toast'));
    },
  ],
];

/** The flag of a car's goal, moved by a share of the way back to the car. */
const flag = (car, share) => [
  car.to[0] + (car.from[0] - car.to[0]) * share + 9,
  car.to[1] + (car.from[1] - car.to[1]) * share - 26,
];

async function take(folder) {
  mkdirSync(folder, { recursive: true });
  const program = await Program.start();
  const browser = await launch();
  try {
    const e = await Editor.open(browser, program.url, {
      reducedMotion: 'reduce',
      colorScheme: 'light',
      stopwatch: false,
    });
    await e.begin();
    await e.until(() => [...document.querySelectorAll('.scns canvas')].every((c) => c.dataset.done));
    const car = await carOnTheMove(e);
    for (const [name, reach] of STATES) {
      await reach(e, car);
      await e.settled();
      await e.page.evaluate(() => document.fonts.ready);
      await e.page.screenshot({ path: `${folder}/${name}.png`, animations: 'disabled' });
      console.log(`${folder}/${name}.png`);
    }
    if (e.errors.length) throw new Error(e.errors.join('\n'));
  } finally {
    await browser.close();
    await program.stop();
  }
}

const [first, ...rest] = process.argv.slice(2);
if (!first || (first === '--compare' && rest.length !== 2)) {
  console.error('npm run pictures -- DIR | --compare BEFORE AFTER');
  process.exit(2);
}
if (first === '--compare') process.exitCode = (await compare(...rest)) ? 0 : 1;
else if (!missing()) await take(first);
