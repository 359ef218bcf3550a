// Takes docs/drag.webp, the moving picture of the README: a car is dragged into another arm, then the scene plays.
//
//   npm run drag
import { writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { Animation } from './support/animation.js';
import { Editor, launch } from './support/editor.js';
import { Program } from './support/program.js';
import { missing } from './support/where.js';

const PICTURE = fileURLToPath(new URL('../../docs/drag.webp', import.meta.url));
/** The page, px, and the picture's share of it. */
const PAGE = { width: 1200, height: 750 };
const SCALE = 0.8;
/** The road user of the README's first example, and a goal in the north arm, m. */
const CAR = '4';
const GOAL = [1.5, 27.5];
/** The point of a flag that is dragged, from its goal. */
const FLAG = [9, -26];

async function take(e, animation) {
  let pointer = [420, 570];
  const shoot = async (ms) => {
    await e.frames(3);
    await animation.add(
      await e.page.screenshot(),
      pointer.map((v) => v * SCALE),
      ms,
    );
  };
  /** Moves in even steps, a frame each. */
  const move = async (to, steps) => {
    const from = pointer;
    for (let i = 1; i <= steps; i++) {
      pointer = from.map((v, k) => v + ((to[k] - v) * i) / steps);
      await e.page.mouse.move(...pointer);
      await shoot(66);
    }
  };
  const flagAt = async ([x, y]) => (await e.at(x, y)).map((v, k) => v + FLAG[k]);

  await e.page.mouse.move(...pointer);
  await shoot(400);
  const { track } = (await e.get('/v1/scenes/demo-crossing')).agents.find((agent) => agent.id === CAR);
  await move(await e.at(track.x_m[0], track.y_m[0]), 10);
  await e.page.mouse.down();
  await e.page.mouse.up();
  await e.page.waitForSelector('.fu');
  await e.settled();
  await shoot(700);
  const end = await e.pose('Goal');
  await move(await flagAt([end.x, end.y]), 9);
  await e.page.mouse.down();
  await shoot(266);
  await move(await flagAt(GOAL), 36);
  await e.settled();
  await shoot(900);
  await e.release();
  await shoot(1500);
  for (let i = 0; i < 28; i++) {
    for (let step = 0; step < 3; step++) await e.key('.');
    await shoot(100);
  }
  await shoot(900);
}

if (!missing()) {
  const [program, browser] = [await Program.start(), await launch()];
  try {
    const animation = await Animation.open(browser, [PAGE.width * SCALE, PAGE.height * SCALE]);
    const e = await Editor.open(browser, program.url, { viewport: PAGE, deviceScaleFactor: SCALE });
    await e.begin();
    await take(e, animation);
    writeFileSync(PICTURE, animation.bytes());
  } finally {
    await browser.close();
    await program.stop();
  }
}
