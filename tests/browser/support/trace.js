// The browser's own record of what happened when. Times are milliseconds of its monotonic clock.

const CATEGORIES = [
  'devtools.timeline',
  'disabled-by-default-devtools.timeline',
  'disabled-by-default-devtools.timeline.frame',
];

/** Runs `work` under a trace and gives what happened: pointer events, frames begun and frames drawn. */
export async function traced(browser, page, work) {
  const cdp = await browser.newBrowserCDPSession();
  const events = [];
  cdp.on('Tracing.dataCollected', (e) => {
    for (const v of e.value) events.push(v);
  });
  await cdp.send('Tracing.start', { transferMode: 'ReportEvents', traceConfig: { includedCategories: CATEGORIES } });
  const thread = await page.context().newCDPSession(page);
  await thread.send('Performance.enable', { timeDomain: 'threadTicks' });
  const before = { cpu: await cpu(cdp), page: await busy(thread) };
  await work();
  const after = { cpu: await cpu(cdp), page: await busy(thread) };
  await thread.detach();
  const complete = new Promise((resolve) => cdp.once('Tracing.tracingComplete', resolve));
  await cdp.send('Tracing.end');
  await complete;
  await cdp.detach();
  return new Trace(events, after.cpu - before.cpu, after.page - before.page);
}

/** Time, in ms, that the page's main thread has worked: script, style, layout and painting commands. */
async function busy(thread) {
  const { metrics } = await thread.send('Performance.getMetrics');
  return metrics.find((m) => m.name === 'TaskDuration').value * 1000;
}

/** CPU time, in ms, that the page's and the drawing processes have used. */
async function cpu(cdp) {
  const { processInfo } = await cdp.send('SystemInfo.getProcessInfo');
  return processInfo.filter((p) => /renderer|gpu/i.test(p.type)).reduce((sum, p) => sum + p.cpuTime, 0) * 1000;
}

class Trace {
  constructor(events, cpuMs, pageMs) {
    this.cpuMs = cpuMs;
    this.pageMs = pageMs;
    const times = (name, keep = () => true) =>
      events
        .filter((v) => v.name === name && keep(v))
        .map((v) => v.ts / 1000)
        .sort((a, b) => a - b);
    const dispatched = (type) => times('EventDispatch', (v) => v.args.data?.type === type);
    this.moves = dispatched('pointermove');
    this.releases = dispatched('pointerup');
    this.begun = times('FireAnimationFrame');
    this.committed = events
      .filter((v) => v.name === 'Commit' && v.ph === 'X')
      .map((v) => ({ at: v.ts / 1000, done: (v.ts + v.dur) / 1000 }))
      .sort((a, b) => a.at - b.at);
    this.drawn = times('DrawFrame');
  }

  /** When the first frame was on screen that was begun at or after a time; null when there was none. */
  shownAfter(time) {
    const begun = this.begun.find((t) => t >= time);
    const commit = begun === undefined ? undefined : this.committed.find((c) => c.at >= begun);
    return (commit && (this.drawn.find((t) => t >= commit.done) ?? null)) || null;
  }
}

/** Median, 95th percentile and count. */
export function spread(values) {
  const sorted = values.filter((v) => v !== null).sort((a, b) => a - b);
  const at = (q) =>
    sorted.length ? Number(sorted[Math.min(sorted.length - 1, Math.ceil(q * sorted.length) - 1)].toFixed(1)) : null;
  return { p50: at(0.5), p95: at(0.95), n: sorted.length };
}
