// Schedules of the page: at rest the server has the committed document, or the title reports otherwise. `npm run
// schedule` runs more of them, and repeats one by its seed.
import { expect, it } from 'vitest';
import { runSchedule } from './schedule';

const RUNS = Number(process.env.RUNS ?? 300);
const FIRST = Number(process.env.SEED ?? 1);

it(
  `nothing that was committed is lost, and nothing else is saved, in ${RUNS} schedules`,
  async () => {
    const began = performance.now();
    for (let seed = FIRST; seed < FIRST + RUNS; seed++) {
      const { steps, broken } = await runSchedule(seed);
      const told = [`seed ${seed}:`, ...steps.map((s) => `  ${s}`), ...broken.map((b) => `! ${b}`)].join('\n');
      expect(broken, `${told}\nnpm run schedule -- --seed ${seed}`).toEqual([]);
    }
    if (RUNS > 300) console.log(`${RUNS} schedules, ${((performance.now() - began) / 1000).toFixed(0)} s`);
  },
  RUNS * 1000,
);
