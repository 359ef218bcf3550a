// Measures, not verdicts: the delay from drag to answer. Printed and stored in out/figures.json.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { availableParallelism, loadavg } from 'node:os';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';
import { spread, traced } from '../../support/trace.js';
import { out } from '../../support/where.js';

const MOVES = 60;
const RELEASES = 5;
/** The first visible event of an answer. */
const seen = (answer) => answer.events().find((e) => ['initial', 'step', 'final'].includes(e.event));

journeys('figures', (stage) => {
  it('measures a drag and its release', { timeout: 90_000 }, async () => {
    const began = performance.now();
    const e = await stage.open();
    const opened = performance.now() - began;
    await e.begin();
    const car = await carOnTheMove(e);
    await e.page.mouse.click(...car.from);
    await e.page.waitForSelector('.fu');
    await e.settled();
    const flag = (k) => [car.to[0] + (car.from[0] - car.to[0]) * k + 9, car.to[1] + (car.from[1] - car.to[1]) * k - 26];

    const load = loadavg()[0];
    const mark = e.wire.asked.length;
    const drag = await traced(stage.browser, e.page, async () => {
      await e.drag(flag(0), flag(0.4), { moves: MOVES });
    });
    await e.settled();
    const asked = e.wire
      .since(mark)
      .filter((a) => a.body.react === false)
      .map((a) => ({ sent: a.sent * 1000, draft: seen(a)?.at * 1000 || null }));
    const moves = drag.moves.slice(-MOVES).map(({ at, known }) => {
      const draft = asked.find((a) => a.sent >= known && a.draft)?.draft ?? null;
      return { at, draft, shown: draft && drag.shownAfter(draft) };
    });
    const shown = moves.filter((m) => m.shown);
    const frames = drag.drawn.filter((t) => t >= moves[0].at && t <= moves.at(-1).at);

    const releases = [];
    for (let i = 0; i < RELEASES; i++) {
      if (i) await e.drag(flag(0.4 - 0.05 * (i - 1)), flag(0.4 - 0.05 * i), { moves: 4 });
      const trace = await traced(stage.browser, e.page, () => e.release());
      const [released] = trace.releases;
      // The preview of exactly this pose arrived before.
      const last = e.wire.asked.findLast((a) => a.body.react === true).event('final').at * 1000;
      const answer = Math.max(last, released);
      releases.push({ answered: answer - released, shown: trace.shownAfter(answer) - released });
    }

    const figures = {
      unit: 'ms',
      cores: availableParallelism(),
      load,
      opened: Math.round(opened),
      moveToDraft: spread(shown.map((m) => m.draft - m.at)),
      draftToFrame: spread(shown.map((m) => m.shown - m.draft)),
      moveToFutures: spread(shown.map((m) => m.shown - m.at)),
      frame: spread(frames.slice(1).map((t, i) => t - frames[i])),
      cpuPerFrame: Number((drag.cpuMs / Math.max(1, drag.drawn.length)).toFixed(1)),
      pageThreadPerFrame: Number((drag.pageMs / Math.max(1, drag.drawn.length)).toFixed(2)),
      pageThreadPerMove: Number((drag.pageMs / MOVES).toFixed(2)),
      requests: asked.length,
      answered: asked.filter((a) => a.draft).length,
      releaseToAnswer: spread(releases.map((r) => r.answered)),
      releaseToOthers: spread(releases.map((r) => r.shown)),
    };
    const since = (m, what) => m[what] && m[what] - m.at;
    const all = moves.map((m) => ({ draft: since(m, 'draft'), shown: since(m, 'shown') }));
    writeFileSync(`${out}/figures.json`, `${JSON.stringify({ ...figures, moves: all }, null, 2)}\n`);
    console.log(`Figures in ms, ${figures.cores} cores, load ${load.toFixed(1)}`);
    for (const [name, value] of Object.entries(figures))
      if (typeof value === 'object')
        console.log(`  ${name.padEnd(16)} p50 ${value.p50}  p95 ${value.p95}  n ${value.n}`);
    const { cpuPerFrame, pageThreadPerFrame, pageThreadPerMove, answered } = figures;
    console.log(`  CPU per frame ${cpuPerFrame}; opened in ${figures.opened}`);
    console.log(`  the page's thread: ${pageThreadPerFrame} a frame, ${pageThreadPerMove} a move`);
    console.log(`  ${asked.length} requests for ${moves.length} moves, ${answered} drawn`);
    assert.equal(moves.length, MOVES);
    assert.ok(shown.length > 0, 'futures were drawn during the drag');
  });
});
