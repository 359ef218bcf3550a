// Runs schedules of the page: `npm run schedule -- [--runs N] [--seed S]`. With only a seed that one is repeated.
import { spawnSync } from 'node:child_process';
import { parseArgs } from 'node:util';

const { values } = parseArgs({ options: { runs: { type: 'string' }, seed: { type: 'string' } } });
const runs = values.runs ?? (values.seed === undefined ? '1000' : '1');
const env = { ...process.env, RUNS: runs, SEED: values.seed ?? '1' };
const { status } = spawnSync('npx', ['vitest', 'run', 'test/schedule'], { stdio: 'inherit', env });
process.exit(status ?? 1);
