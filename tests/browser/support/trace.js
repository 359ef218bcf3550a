// The browser's own trace of events. Times are milliseconds of its monotonic clock.

const CATEGORIES = ['devtools.timeline', 'blink', 'viz'];
/** Duration of a screen frame. */
const FRAME_MS = 1000 / 60;
/** Events of frames only, which cost the page next to nothing. */
export const FRAMES_ALONE = ['viz'];

/** Runs `work` under a trace and returns its events: pointer events, frames begun and frames drawn. */
export async function traced(browser, page, work, categories = CATEGORIES) {
  const cdp = await browser.newBrowserCDPSession();
  const events = [];
  cdp.on('Tracing.dataCollected', (e) => {
    for (const v of e.value) events.push(v);
  });
  await cdp.send('Tracing.start', { transferMode: 'ReportEvents', traceConfig: { includedCategories: categories } });
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

/** CPU time, in ms, of the page's and the drawing processes. */
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
    // A page may get a raw move ahead of the frame that delivers it.
    const ahead = dispatched('pointerrawupdate');
    const told = dispatched('pointermove');
    this.moves = told.map((at, i) => ({ at, known: ahead.findLast((t) => t <= at && t > (told[i - 1] ?? 0)) ?? at }));
    // Other tabs are in the trace, too.
    const page = events.find((v) => v.name === 'EventDispatch' && /^pointer/.test(v.args.data?.type));
    const on = (thread) => (v) => v.tid === thread?.tid && v.pid === thread?.pid;
    this.releases = dispatched('pointerup');
    this.drawn = times('Display::DrawAndSwap');
    const spans = (name) =>
      events
        .filter((v) => v.name === name && v.ph === 'X')
        .map((v) => ({ at: v.ts / 1000, done: (v.ts + v.dur) / 1000, event: v }))
        .sort((a, b) => a.at - b.at);
    // At its next tick a screen shows what was drawn by then; of two pictures, the last.
    const phase = phaseOf(times('DelayBasedBeginFrameSource::OnTimerTick'));
    const shownAt = ({ done }) => Math.ceil((done - phase) / FRAME_MS);
    this.screen = [...new Set(spans('Display::DrawAndSwap').map(shownAt))].map((tick) => tick * FRAME_MS);
    const canvases = spans('OffscreenCanvasRenderingContext2D::FinalizeFrame').filter((c) => c.event.pid === page?.pid);
    this.finished = canvases.map((c) => c.done);
    // Messages of the page to the painting worker, and the end of their painting.
    const painter = canvases[0]?.event;
    const messages = spans('HandlePostMessage');
    const handled = new Map(
      messages.filter((h) => on(painter)(h.event)).map((h) => [h.event.args.data?.traceId, h.done]),
    );
    const frames = spans('FireAnimationFrame').filter((f) => on(page)(f.event));
    // Messages of other workers to the page, and the time of their handling.
    const heard = new Map(messages.filter((h) => on(page)(h.event)).map((h) => [h.event.args.data?.traceId, h.at]));
    this.heard = events
      .filter((v) => v.name === 'SchedulePostMessage' && heard.has(v.args.data?.traceId) && !on(painter)(v))
      .map((v) => ({ said: v.ts / 1000, heard: heard.get(v.args.data.traceId) }))
      .sort((a, b) => a.said - b.said);
    this.told = events
      .filter((v) => v.name === 'SchedulePostMessage' && handled.has(v.args.data?.traceId) && on(page)(v))
      .map((v) => ({ at: v.ts / 1000, painted: handled.get(v.args.data.traceId) }))
      .map((t) => ({ ...t, begun: frames.find((f) => f.at <= t.at && t.at <= f.done)?.at ?? t.at }))
      .sort((a, b) => a.at - b.at);
  }

  /**
   * The first picture begun after the page handled a worker's message sent at or after a time: when the page had
   * recorded it, when the painter had painted it and handed it over, and when it was on screen. Null for none.
   */
  pictureOnceTold(time) {
    const news = this.heard.find((h) => h.said >= time);
    return news ? this.#pictureAfter(news.heard) : null;
  }

  /** Time on screen of the first picture begun at or after a time; null when there was none. */
  shownAfter(time) {
    return this.#pictureAfter(time)?.shown ?? null;
  }

  #pictureAfter(time) {
    const told = this.told.find((t) => t.begun >= time);
    const painted = told && this.finished.find((t) => t >= told.painted);
    const shown = painted && this.drawn.find((t) => t >= painted);
    return shown ? { recorded: told.at, painted, shown } : null;
  }
}

/** Phase of the screen's clock, which is even: its timer is sometimes late. */
function phaseOf(ticks) {
  const [first = 0] = ticks;
  const late = ticks.map((t) => t - first - FRAME_MS * Math.round((t - first) / FRAME_MS)).sort((a, b) => a - b);
  return first + (late[late.length >> 1] ?? 0);
}

/** Median, 95th percentile and count. */
export function spread(values) {
  const sorted = values.filter((v) => v !== null).sort((a, b) => a - b);
  const at = (q) =>
    sorted.length ? Number(sorted[Math.min(sorted.length - 1, Math.ceil(q * sorted.length) - 1)].toFixed(1)) : null;
  return { p50: at(0.5), p95: at(0.95), n: sorted.length };
}
