// Compares pictures of the editor's states with the accepted ones.
//
//   npm run pictures                 takes all and reports which differ
//   npm run pictures -- 03 27        only those with names that start with these
//   npm run pictures -- --accept     takes and accepts them (also with names)
//
// The same program, scene and seed give the same pictures: the viewport is fixed, motion is reduced, every step waits
// for a condition, and clocks stand still, so that no measured milliseconds and no dates are in a picture. Accepted
// pictures are scaled down in `pictures/`; the pictures of this run are in full size in `out/pictures/`.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { STATES } from './pictures/states.js';
import { Editor, launch } from './support/editor.js';
import { Holding } from './support/holding.js';
import { Pixels } from './support/pixels.js';
import { Program } from './support/program.js';
import { missing, out } from './support/where.js';

const ACCEPTED = fileURLToPath(new URL('pictures', import.meta.url));
const TAKEN = `${out}/pictures`;
const NOW = '2026-03-02T10:42:00';

/** Takes the picture of one state; returns its path. */
async function take(program, browser, [name, reach, { hide = [], holds, after, ...page } = {}]) {
  const door = holds ? await Holding.before(program.url) : null;
  const e = await Editor.open(browser, door?.url ?? program.url, {
    reducedMotion: 'reduce',
    colorScheme: 'light',
    stopwatch: false,
    now: NOW,
    ...page,
  });
  try {
    if (page.scene !== false) {
      await e.begin();
      await e.until(() => [...document.querySelectorAll('.scns canvas')].every((c) => c.dataset.done));
    }
    await reach(e, { program, door });
    // A worker paints the picture: it is there a frame later.
    await e.frames(4);
    await e.page.evaluate(() => document.fonts.ready);
    const path = `${TAKEN}/${name}.png`;
    const mask = hide.map((selector) => e.page.locator(selector));
    await e.page.screenshot({ path, mask, animations: 'disabled' });
    if (e.errors.length) throw new Error(e.errors.join('\n'));
    return path;
  } finally {
    await e.close();
    await door?.close();
    await after?.({ program });
  }
}

async function run(names, accept) {
  mkdirSync(TAKEN, { recursive: true });
  const states = STATES.filter(([name]) => !names.length || names.some((n) => name.startsWith(n)));
  const browser = await launch();
  const pixels = await Pixels.open(browser);
  let wrong = 0;
  const say = (name, words, bad = true) => {
    if (bad) wrong++;
    console.log(`${name}: ${words}`);
  };
  try {
    for (const state of states) {
      const [name] = state;
      // Stored scenes of one state are not in the next one's list.
      const program = await Program.start();
      try {
        const small = await pixels.small(readFileSync(await take(program, browser, state)));
        const known = `${ACCEPTED}/${name}.webp`;
        const before = existsSync(known) ? readFileSync(known) : null;
        const unlike = { alike: false, share: 1, square: 1, where: '' };
        const { alike, share, square, where } = before ? await pixels.differing(before, small) : unlike;
        const differ = `${percent(share)} of the pixels differ, ${percent(square)} in one place`;
        if (alike) say(name, 'as accepted', false);
        else if (accept) {
          writeFileSync(known, small);
          say(name, before ? `accepted; ${differ}` : 'accepted, new', false);
        } else say(name, before ? `${differ}${where}` : 'nothing accepted yet');
      } catch (error) {
        say(name, `not reached: ${error.message.split('\n')[0]}`);
      } finally {
        await program.stop();
      }
    }
  } finally {
    await browser.close();
  }
  const seen = `${states.length} states, ${wrong} to look at in ${TAKEN}`;
  console.log(wrong ? `${seen}; npm run pictures -- --accept takes them over` : `${states.length} states as accepted`);
  return wrong === 0;
}

const percent = (share) => `${(share * 100).toFixed(2)} %`;

const words = process.argv.slice(2);
const names = words.filter((w) => !w.startsWith('--'));
const unknown = words.filter((w) => w.startsWith('--') && w !== '--accept');
if (unknown.length) {
  console.error('npm run pictures -- [--accept] [NAME …]');
  process.exit(2);
}
if (!missing()) process.exitCode = (await run(names, words.includes('--accept'))) ? 0 : 1;
