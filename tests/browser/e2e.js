// All journeys, or those of the given files: `node e2e.js [FILE…]`. Two files run at a time, since a journey leaves a
// core idle while it waits. A file that fails runs once more, alone, and is then named as unsteady: a browser on a busy
// machine may lose a frame or a connection, but a fault of the program fails twice.
import { readdirSync, writeFileSync } from 'node:fs';
import { join, relative, resolve } from 'node:path';
import { run } from 'node:test';
import { spec } from 'node:test/reporters';
import { fileURLToPath } from 'node:url';
import { out } from './support/where.js';

const AT_A_TIME = 2;

const here = fileURLToPath(new URL('.', import.meta.url));

/** All files of journeys, by name. */
const all = () =>
  readdirSync(join(here, 'journeys'), { recursive: true })
    .filter((name) => name.endsWith('.test.js'))
    .map((name) => join(here, 'journeys', name))
    .sort();

/** Runs files and prints their results; the files in which something failed. */
function failing(files, concurrency) {
  return new Promise((done, reject) => {
    const failed = new Set();
    let elsewhere = false;
    const tests = run({ files, concurrency });
    // A group of journeys fails in the file that declares it, and again in its own.
    tests.on('test:fail', ({ file, name }) => {
      const own = files.find((f) => f === file || f === resolve(name));
      if (own) failed.add(own);
      else elsewhere = true;
    });
    tests.on('error', reject);
    const report = tests.compose(spec);
    report.on('end', () => done(elsewhere && !failed.size ? files : [...failed]));
    report.pipe(process.stdout, { end: false });
  });
}

const given = process.argv.slice(2).map((name) => resolve(name));
const files = given.length ? given : all();
const first = await failing(files, AT_A_TIME);
const second = first.length ? await failing(first, 1) : [];
const unsteady = first.filter((file) => !second.includes(file));
const names = (of) => of.map((file) => relative(here, file)).join(', ');
writeFileSync(`${out}/unsteady.txt`, names(unsteady));
if (unsteady.length) console.log(`Failed at first, passed alone: ${names(unsteady)}`);
if (second.length) console.log(`Failed twice: ${names(second)}`);
process.exitCode = second.length ? 1 : 0;
