// Response times as a table: measurements, not verdicts.
//
//   npm run figures                                    all rows, with the built program
//   npm run figures -- --bin OLD --bin NEW --turns 3   two programs in turn, on the same machine
//   npm run figures -- drag tabs                       some rows: opening, drag, phases, crowds, record, edits, tabs
//   npm run figures -- --hand 60                       pointer moves per second; 125 by default
import { availableParallelism, loadavg } from 'node:os';
import { readFileSync, writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { crowd } from './support/crowds.js';
import { Editor, launch } from './support/editor.js';
import { answered, atRest, costs, edit, flagNow, hand, held, phaseDrags, takeFlag } from './support/measures.js';
import { Program } from './support/program.js';
import { missing, out, program as built, recordedFile } from './support/where.js';

const FRAMES = 120;
const EDITS = 1000;
const PHASE_DRAGS = 9;
const TABS = 12;
const SIZES = { '1440x900': { width: 1440, height: 900 } };

/** Places of the flag: to and fro, so that every drag begins where the last one ended. */
const REACH = 0.35;

const address = (program, id) => (id ? new URL(`?scene=${id}`, program.url).href : program.url);

/** One drag with listening and one without, each on a page of its own. */
async function ofScene(row, { browser, program }, id, { scale = 1, after = false, frames = FRAMES } = {}) {
  for (const listening of ['times', 'nothing']) {
    const e = await Editor.open(browser, address(program, id), {
      viewport: SIZES['1440x900'],
      deviceScaleFactor: scale,
      listening,
    });
    try {
      await e.begin();
      const flag = await takeFlag(e);
      const way = [flag(0), flag(REACH)];
      if (after) {
        // After the first goal all road users in the way have reacted.
        await e.drag(flag(0), flag(REACH), { moves: 12 });
        await e.release();
        way.splice(0, 2, await flagNow(e), flag(0));
      }
      if (listening === 'times') {
        const a = await answered(browser, e, ...way, frames);
        row('hand to futures p50', a.hand.p50);
        row('hand to futures p95', a.hand.p95);
        row('pointer to futures p50', a.shown.p50);
        row('pointer to futures p95', a.shown.p95);
        for (const [stage, time] of [
          ['asking', a.asked],
          ['waiting', a.came],
          ['drawing', a.drawn],
          ['drawing, the page records', a.recorded],
          ['drawing, the worker paints', a.painted],
          ['drawing, the browser composes', a.composed],
        ]) {
          row(`of it ${stage} p50`, time.p50);
          row(`of it ${stage} p95`, time.p95);
        }
        row('request bytes p95', a.request.p95);
        row('answer bytes p50', a.answer.p50);
      } else {
        const c = await costs(browser, e, ...way, frames);
        row('frame p50', c.frame.p50);
        row('frame p95', c.frame.p95);
        row('draw to draw p95', c.drawn.p95);
        row('page thread a frame', c.page);
        row('CPU of page and drawing a frame', c.all);
        for (const [name, ms] of Object.entries(c.threads).slice(0, 5)) row(`  ${name}`, ms);
      }
    } finally {
      await e.close();
    }
  }
}

const ROWS = {
  async opening(row, { browser, program }) {
    const e = await Editor.open(browser, program.url, { listening: 'times' });
    try {
      // Since the request of the address, like the first paint.
      row('ready', await e.page.evaluate(() => performance.now()));
      const paint = await e.page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime);
      row('first paint', paint);
      await e.settled();
      row('KB before the first drag', e.wire.bytes / 1000);
    } finally {
      await e.close();
    }
  },
  async drag(row, stage) {
    await ofScene((name, v) => row(`example, before: ${name}`, v), stage, null);
    await ofScene((name, v) => row(`example, after: ${name}`, v), stage, null, { after: true });
  },
  /** From the release of a phase's edge to new futures of all road users. */
  async phases(row, { browser, program }) {
    const e = await Editor.open(browser, program.url, { listening: 'nothing' });
    try {
      await e.begin();
      row('phases: release to futures of all p50', (await phaseDrags(e, PHASE_DRAGS)).p50);
    } finally {
      await e.close();
    }
  },
  async crowds(row, stage) {
    for (const [count, scale] of [
      [130, 1],
      [256, 2],
    ]) {
      const id = await crowd(stage.program.url, count);
      await ofScene((name, v) => row(`${count} road users, ${scale}x: ${name}`, v), stage, id, { scale });
      await ofScene((name, v) => row(`${count} road users, ${scale}x, after: ${name}`, v), stage, id, {
        scale,
        after: true,
      });
    }
  },
  async record(row, stage) {
    const file = recordedFile({ dense: true });
    if (!file) return console.error('no recorded scenes here');
    const id = await imported(stage.program.url, file);
    for (const after of [false, true])
      await ofScene((name, v) => row(`record, ${after ? 'after' : 'before'}: ${name}`, v), stage, id, { after });
  },
  async edits(row, { browser, program }) {
    const e = await Editor.open(browser, program.url, { listening: 'nothing' });
    try {
      await e.begin();
      const flag = await takeFlag(e);
      await edit(e, 40);
      const before = await held(e);
      const first = await costs(browser, e, await flagNow(e), flag(REACH), FRAMES);
      await edit(e, EDITS);
      const after = await held(e);
      const then = await costs(browser, e, await flagNow(e), flag(0), FRAMES);
      row('page thread a frame, after 40 edits', first.page);
      row(`page thread a frame, after ${EDITS} edits`, then.page);
      row('frame p95, after 40 edits', first.frame.p95);
      row(`frame p95, after ${EDITS} edits`, then.frame.p95);
      row('heap MB, after 40 edits', before.heap / 1e6);
      row(`heap MB, after ${EDITS} edits`, after.heap / 1e6);
      row(`nodes more, after ${EDITS} edits`, after.nodes - before.nodes);
      row(`listeners more, after ${EDITS} edits`, after.listeners - before.listeners);
    } finally {
      await e.close();
    }
  },
  async tabs(row, { browser, program }) {
    const ids = await copies(program.url, TABS);
    const first = await Editor.open(browser, address(program, ids[0]), { listening: 'times' });
    const tabs = [first];
    try {
      for (const id of ids.slice(1)) tabs.push(await first.beside(address(program, id)));
      let alive = 0;
      const shown = [];
      for (const e of tabs) {
        await e.page.bringToFront();
        await e.begin();
        const flag = await takeFlag(e);
        const a = await answered(browser, e, flag(0), flag(REACH), 30);
        if (a.answers && a.shown.n && !e.errors.length) alive++;
        else console.error(`a tab is silent: ${a.questions} asked, ${a.answers} answered, ${e.errors.join(', ')}`);
        shown.push(a.shown.p50);
      }
      row('tabs that answer a drag', alive);
      row('pointer to futures p50, last tab', shown.at(-1));
      row(`CPU a second of ${TABS} tabs at rest`, await atRest(browser));
    } finally {
      await first.close();
    }
  },
};

/** A recorded scene, stored. */
async function imported(url, { path, name }) {
  const reply = await fetch(new URL(`/v1/import?name=${encodeURIComponent(name)}`, url), {
    method: 'POST',
    headers: { 'Content-Type': 'application/octet-stream' },
    body: readFileSync(path),
  });
  if (!reply.ok) throw new Error(`import: ${reply.status}`);
  return (await reply.json()).scenes[0].id;
}

/** Copies of the example, each with its own id. */
async function copies(url, count) {
  const ids = [];
  for (let i = 0; i < count; i++) {
    const reply = await fetch(new URL('/v1/scenes/demo-crossing/duplicate', url), {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify({ name: `Copy ${i + 1}` }),
    });
    ids.push((await reply.json()).id);
  }
  return ids;
}

const median = (all) => all.filter((v) => v !== null && v !== undefined).sort((a, b) => a - b)[all.length >> 1] ?? null;
const written = (v) => (v === null ? '-' : v >= 1000 ? Math.round(v).toLocaleString('en') : v.toFixed(1));

async function run(bins, names, turns) {
  /** Measurements: by row, then by program, one number for each turn. */
  const table = new Map();
  const loads = [];
  for (let turn = 0; turn < turns; turn++)
    for (const [i, bin] of bins.entries()) {
      const program = await Program.start(bin);
      const browser = await launch();
      const row = (name, value) => {
        if (!table.has(name))
          table.set(
            name,
            bins.map(() => []),
          );
        table.get(name)[i].push(value ?? null);
      };
      try {
        for (const name of names) {
          loads.push(loadavg()[0]);
          console.error(`turn ${turn + 1}, ${bin}: ${name}, load ${loads.at(-1).toFixed(1)}`);
          await ROWS[name](row, { browser, program }).catch((error) => console.error(`${name}: ${error.stack}`));
        }
      } finally {
        await browser.close();
        await program.stop();
      }
    }
  const heads = bins.map((b) => b.split('/').at(-1));
  const [least, most] = [Math.min(...loads), Math.max(...loads)].map((l) => l.toFixed(1));
  const lines = [
    `${availableParallelism()} cores, load ${least} to ${most}, median of ${turns} turns; ms unless said`,
    '',
    `| What | ${heads.join(' | ')} |`,
    `|---|${heads.map(() => '--:|').join('')}`,
    ...[...table].map(([name, values]) => `| ${name} | ${values.map((v) => written(median(v))).join(' | ')} |`),
  ];
  console.log(lines.join('\n'));
  writeFileSync(`${out}/figures-table.json`, `${JSON.stringify(Object.fromEntries(table), null, 2)}\n`);
}

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    bin: { type: 'string', multiple: true, default: [built] },
    turns: { type: 'string', default: '1' },
    hand: { type: 'string' },
  },
});
if (values.hand) hand.hz = Number(values.hand);
const names = positionals.length ? positionals : Object.keys(ROWS);
const unknown = names.filter((n) => !ROWS[n]);
if (unknown.length) {
  console.error(`unknown rows: ${unknown.join(', ')}; there are ${Object.keys(ROWS).join(', ')}`);
  process.exitCode = 2;
} else if (!missing()) await run(values.bin, names, Number(values.turns));
