// Places of faults on the picture for the futures of one road user: one word for each place, not for each future.
import { compareMarks, faultMark, type Fault, type Mark } from '../document/future-facts';
import type { Futures } from '../document/futures';
import type { Vec } from '../base/geometry';
import { STEP_S, type Motion } from '../base/motion';

/** Futures that break the same rule within this distance share a word, metres. */
const TOGETHER_M = 8;

export interface FaultPlace {
  readonly mark: Mark;
  /** The displayed fault: the shown future's, where it is one of them, else the worst. */
  readonly fault: Fault;
  /** Indices of the futures. */
  readonly futures: readonly number[];
}

interface FaultOfFuture {
  readonly index: number;
  readonly fault: Fault;
  /** Points along the stretch, in metres. */
  readonly along: readonly Vec[];
}

/** Steps between two of them. */
const EVERY = 4;

function placesAlong(m: Motion, fault: Fault): Vec[] {
  const out: Vec[] = [fault.at];
  const last = Math.min(m.x.length - 1, Math.round(fault.until / STEP_S) - m.first);
  const first = Math.max(0, Math.round(fault.time / STEP_S) - m.first);
  for (let i = first; i <= last; i += EVERY) out.push([m.x[i], m.y[i]]);
  // The end point is included: a violation of the same rule beside it is the same place.
  if (last > first) out.push([m.x[last], m.y[last]]);
  return out;
}

/**
 * Fault places of the futures in `visible`; the shown one's first, then the worst. Missed goals are listed only for the
 * shown one: where the others end is visible.
 */
export function faultPlaces(f: Futures, visible: readonly number[], chosen: number): FaultPlace[] {
  const clusters: FaultOfFuture[][] = [];
  for (const index of visible)
    for (const fault of f.modes[index]?.about?.faults ?? []) {
      if ((fault.kind === 'goal_missed' || fault.kind === 'via_missed') && index !== chosen) continue;
      const found = { index, fault, along: placesAlong(f.modes[index].motion, fault) };
      const near = clusters.filter((c) => c.some((o) => together(o, found)));
      const merged = [...near.flat(), found];
      for (const c of near) clusters.splice(clusters.indexOf(c), 1);
      clusters.push(merged);
    }
  const shows = (p: FaultPlace): number => Number(p.futures.includes(chosen));
  return clusters
    .map((c) => placeOf(c, chosen))
    .sort((a, b) => shows(b) - shows(a) || compareMarks(a.mark, b.mark) || b.futures.length - a.futures.length);
}

const together = (a: FaultOfFuture, b: FaultOfFuture): boolean =>
  a.fault.kind === b.fault.kind &&
  a.fault.with === b.fault.with &&
  a.along.some(([x, y]) => b.along.some((p) => Math.hypot(p[0] - x, p[1] - y) <= TOGETHER_M));

function placeOf(found: readonly FaultOfFuture[], chosen: number): FaultPlace {
  const ofShown = found.filter((o) => o.index === chosen);
  const told = (ofShown.length ? ofShown : found).map((o) => o.fault);
  const fault = told.reduce((a, b) => (worse(b, a) ? b : a));
  return {
    mark: faultMark(fault),
    fault,
    futures: [...new Set(found.map((o) => o.index))].sort((a, b) => a - b),
  };
}

/** For a near miss the smaller gap is worse, for all else the larger figure. */
const worse = (a: Fault, b: Fault): boolean => {
  if (a.extent === null || b.extent === null) return a.extent !== null;
  return a.kind === 'near_miss' ? a.extent < b.extent : a.extent > b.extent;
};
