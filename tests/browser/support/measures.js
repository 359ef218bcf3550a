// Response times: measurements of a page, and their methods. Times are milliseconds, sizes bytes.
import { readdirSync, readFileSync } from 'node:fs';
import { carOnTheMove } from './casting.js';
import { FRAMES_ALONE, spread, traced } from './trace.js';

/** A mouse reports 125 moves a second, the slowest of them: a screen has a new place for every frame. */
export const hand = { hz: 125 };
const SCREEN_HZ = 60;
/** Clock ticks of the kernel per second. */
const TICKS = 100;

const wait = (ms) => new Promise((done) => setTimeout(done, ms));

/** Moves the mouse along a line for this many frames, whatever the page does; returns the times of the moves. */
export async function sweep(e, from, to, frames) {
  const began = performance.now();
  const sent = [];
  const moved = [];
  const moves = Math.round((frames * hand.hz) / SCREEN_HZ);
  for (let i = 1; i <= moves; i++) {
    await wait(Math.max(0, began + (i * 1000) / hand.hz - performance.now()));
    const at = { x: from[0] + ((to[0] - from[0]) * i) / moves, y: from[1] + ((to[1] - from[1]) * i) / moves };
    // The browser's clock is the system's.
    moved.push(Number(process.hrtime.bigint()) / 1e6);
    sent.push(e.cdp.send('Input.dispatchMouseEvent', { type: 'mouseMoved', button: 'left', buttons: 1, ...at }));
  }
  await Promise.all(sent);
  return moved;
}

/** Grabs the flag of a car that goes straight on; returns its place after a share of the way back to the car. */
export async function takeFlag(e) {
  const car = await carOnTheMove(e);
  await e.choose(car.id);
  return (k) => [car.to[0] + (car.from[0] - car.to[0]) * k + 9, car.to[1] + (car.from[1] - car.to[1]) * k - 26];
}

/** Present place of the selected road user's flag. */
export async function flagNow(e) {
  const goal = await e.pose('Goal');
  const [x, y] = await e.at(goal.x, goal.y);
  return [x + 9, y - 26];
}

async function press(e, at) {
  await e.page.mouse.move(...at);
  await e.page.mouse.down();
  // The first moves turn a press into a drag.
  for (const d of [2, 4, 6]) await e.page.mouse.move(at[0] + d, at[1]);
  await e.until(() => document.querySelector('main.stage').dataset.cursor === 'grabbing');
}

/** Drags from one place to another and releases; `measured` runs the moves. */
export async function dragged(e, from, to, frames, measured) {
  await press(e, from);
  // Work that happens only at the first moves is not typical of a drag.
  await sweep(e, from, [from[0] + (to[0] - from[0]) * 0.1, from[1] + (to[1] - from[1]) * 0.1], 12);
  const measures = await measured(() =>
    sweep(e, [from[0] + (to[0] - from[0]) * 0.1, from[1] + (to[1] - from[1]) * 0.1], to, frames),
  );
  await e.release();
  return measures;
}

/**
 * From the pointer to the futures on screen, and the transferred bytes; the page was opened with `listening: 'times'`.
 */
export async function answered(browser, e, from, to, frames) {
  const mark = e.wire.asked.length;
  let moved = [];
  const trace = await dragged(e, from, to, frames, (run) =>
    traced(browser, e.page, async () => {
      moved = await run();
    }),
  );
  const asked = e.wire.since(mark).filter((a) => a.body.react === false);
  const drafts = asked
    .filter((a) => a.chunks.length)
    .map((a) => ({ sent: a.sent * 1000, came: a.chunks[0].at * 1000 }));
  const answersTo = (times) =>
    times.flatMap(({ at, known }) => {
      const draft = drafts.find((d) => d.sent >= known);
      const seen = draft && trace.pictureOnceTold(draft.came);
      return seen
        ? [
            {
              asked: draft.sent - known,
              came: draft.came - draft.sent,
              recorded: seen.recorded - draft.came,
              painted: seen.painted - seen.recorded,
              composed: seen.shown - seen.painted,
              drawn: seen.shown - draft.came,
              all: seen.shown - at,
            },
          ]
        : [];
    });
  const shown = answersTo(trace.moves);
  return {
    hand: spread(answersTo(moved.map((at) => ({ at, known: at }))).map((m) => m.all)),
    shown: spread(shown.map((m) => m.all)),
    asked: spread(shown.map((m) => m.asked)),
    came: spread(shown.map((m) => m.came)),
    drawn: spread(shown.map((m) => m.drawn)),
    recorded: spread(shown.map((m) => m.recorded)),
    painted: spread(shown.map((m) => m.painted)),
    composed: spread(shown.map((m) => m.composed)),
    request: spread(asked.map((a) => a.weight.request)),
    answer: spread(asked.map((a) => a.weight.answer)),
    questions: asked.length,
    answers: drafts.length,
  };
}

/** Cost of a drag frame, undisturbed: the page was opened with `listening: 'nothing'`. */
export async function costs(browser, e, from, to, frames) {
  const { trace, threads } = await dragged(e, from, to, frames, async (run) => {
    const before = await threadTimes(browser);
    const trace = await traced(browser, e.page, run, FRAMES_ALONE);
    return { trace, threads: since(before, await threadTimes(browser)) };
  });
  const between = (times) => spread(times.slice(1).map((t, i) => t - times[i]));
  return {
    frame: between(trace.screen),
    drawn: between(trace.drawn),
    page: trace.pageMs / frames,
    all: trace.cpuMs / frames,
    threads: Object.fromEntries(Object.entries(threads).map(([name, ms]) => [name, ms / frames])),
  };
}

/** CPU time of the page's and the drawing processes by thread name, where the system reports it. */
async function threadTimes(browser) {
  const cdp = await browser.newBrowserCDPSession();
  const { processInfo } = await cdp.send('SystemInfo.getProcessInfo');
  await cdp.detach();
  const times = {};
  for (const { id, type } of processInfo.filter((p) => /renderer|gpu/i.test(p.type)))
    for (const [name, ms] of timesOf(id)) {
      const key = `${type.toLowerCase() === 'renderer' ? 'page' : 'drawing'}: ${name}`;
      times[key] = (times[key] ?? 0) + ms;
    }
  return times;
}

function timesOf(pid) {
  try {
    return readdirSync(`/proc/${pid}/task`).map((tid) => {
      const stat = readFileSync(`/proc/${pid}/task/${tid}/stat`, 'utf8');
      const name = stat.slice(stat.indexOf('(') + 1, stat.lastIndexOf(')'));
      const [user, system] = stat
        .slice(stat.lastIndexOf(')') + 2)
        .split(' ')
        .slice(11, 13)
        .map(Number);
      return [name, ((user + system) * 1000) / TICKS];
    });
  } catch {
    return [];
  }
}

const since = (before, after) =>
  Object.fromEntries(
    Object.entries(after)
      .map(([name, ms]) => [name, ms - (before[name] ?? 0)])
      .filter(([, ms]) => ms > 0)
      .sort((a, b) => b[1] - a[1]),
  );

/** CPU time of idle pages, in ms per second. */
export async function atRest(browser, seconds = 3) {
  const before = await threadTimes(browser);
  await wait(seconds * 1000);
  return Object.values(since(before, await threadTimes(browser))).reduce((sum, ms) => sum + ms, 0) / seconds;
}

/** Resources of the page: memory in use after a collection, nodes, listeners. */
export async function held(e) {
  await e.cdp.send('HeapProfiler.enable');
  for (let i = 0; i < 2; i++) await e.cdp.send('HeapProfiler.collectGarbage');
  await e.cdp.send('HeapProfiler.disable');
  await e.cdp.send('Performance.enable');
  const { metrics } = await e.cdp.send('Performance.getMetrics');
  await e.cdp.send('Performance.disable');
  const of = (name) => metrics.find((m) => m.name === name).value;
  return { heap: of('JSHeapUsedSize'), nodes: of('Nodes'), listeners: of('JSEventListeners') };
}

/** This many edits of the selected road user, by keys. */
export async function edit(e, times) {
  const keys = ['ArrowRight', 'ArrowUp', 'ArrowLeft', 'ArrowDown'];
  for (let i = 0; i < times; i++) await e.key(keys[i % keys.length]);
  await e.settled();
}

/** Drags an edge of a signal's phases to and fro; from each release until no road user is computed any more. */
export async function phaseDrags(e, count) {
  const { signals } = await e.get('/v1/scenes/demo-crossing');
  const { stop_m } = signals.find((s) => s.states.length === 2 && s.states[0][1] === 'go');
  await e.page.mouse.click(...(await e.at(...stop_m)));
  const edge = e.page.locator('.phases .edge').first();
  await edge.waitFor();
  const took = [];
  for (let i = 0; i < count; i++) {
    const box = await edge.boundingBox();
    const from = [box.x + box.width / 2, box.y + box.height / 2];
    await e.drag(from, [from[0] + (i % 2 ? 120 : -120), from[1]], { moves: 6 });
    const done = e.page.evaluate(
      () =>
        new Promise((tell) => {
          const stage = document.querySelector('main.stage');
          let began = 0;
          let isBusy = false;
          const watch = new MutationObserver(() => {
            if (stage.getAttribute('aria-busy') === 'true') isBusy = true;
            else if (isBusy) requestAnimationFrame(() => tell(performance.now() - began));
          });
          const release = () => {
            began = performance.now();
            watch.observe(stage, { attributeFilter: ['aria-busy'] });
          };
          addEventListener('pointerup', release, { once: true, capture: true });
        }),
    );
    await e.frames(2);
    await e.release();
    took.push(await done);
  }
  return spread(took);
}
