// Requirements of these journeys on this machine, and messages for missing ones.
import { execFileSync } from 'node:child_process';
import { accessSync, constants, existsSync, mkdirSync, readdirSync, statSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

const chromium = process.env.CHROMIUM || '/usr/bin/chromium';
const firefox = process.env.FIREFOX || ['/usr/bin/firefox', '/usr/bin/firefox-esr'].find(runs) || '/usr/bin/firefox';
const program = process.env.DRAGTRAFFIC_BIN || here('../../../target/debug/dragtraffic');

function runs(path) {
  try {
    accessSync(path, constants.X_OK);
    return true;
  } catch {
    return false;
  }
}

const NAMED = { CHROMIUM: chromium, FIREFOX: firefox, DRAGTRAFFIC_BIN: program };

/**
 * Why no journey can run here in this browser, or false. A program that its variable names has to be there, or a check
 * that installed it would pass over all journeys.
 */
export function missing(browser = 'chromium') {
  for (const [variable, path] of Object.entries(NAMED))
    if (process.env[variable] && !runs(path)) throw new Error(`${variable} is ${path}, and no such program runs.`);
  const without = {
    chromium: !runs(chromium) && 'no Chromium; set CHROMIUM to its path',
    firefox: !runs(firefox) && 'no Firefox; set FIREFOX to its path',
  };
  const why = without[browser]
    ? without[browser]
    : !runs(program)
      ? 'no dragtraffic program; run `cargo build -p dragtraffic` or set DRAGTRAFFIC_BIN'
      : false;
  if (why) console.log(`Skipped: ${why}.`);
  return why;
}

/**
 * A recorded scenario file, or null; `dense` for the largest one. DRAGTRAFFIC_SAMPLES means that its
 * folder has some; without it they may be beside the checkout.
 */
export function recordedFile({ dense = false } = {}) {
  const said = process.env.DRAGTRAFFIC_SAMPLES;
  const folder = said ? `${said}/womd/val` : here('../../../../shared/data/womd/val');
  if (!said && !existsSync(folder)) return null;
  const names = readdirSync(folder)
    .filter((n) => n.endsWith('.tfrecord.gz'))
    .sort();
  const size = (n) => statSync(`${folder}/${n}`).size;
  const name = dense ? names.toSorted((a, b) => size(b) - size(a))[0] : names[0];
  if (said && !name) throw new Error(`DRAGTRAFFIC_SAMPLES is set, but ${folder} has no .tfrecord.gz`);
  return name ? { path: `${folder}/${name}`, name } : null;
}

/** A recorded scenario file; where there is none beside the checkout, an example in the format of the recordings. */
export function recording() {
  const found = recordedFile();
  if (found) return found;
  const name = 'example.tfrecord.gz';
  const path = `${out}/${name}`;
  const example = here('../../../assets/scenes/demo-roundabout.json');
  execFileSync(program, ['convert', example, '--to', 'womd', '-o', path, '--force'], { stdio: 'pipe' });
  return { path, name };
}

export const out = here('../out');
mkdirSync(out, { recursive: true });

/** Address of a page that is already served, for instance by `vite preview`; then no program is started. */
const running = process.env.DRAGTRAFFIC_PAGE || null;

export { chromium, firefox, program, running };
