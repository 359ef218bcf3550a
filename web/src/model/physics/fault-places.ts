// Where on the picture something is wrong with the futures of one: a word for each place, not one for each future.
import { compareMarks, faultMark, type Fault, type Mark } from '../document/future-facts';
import type { Futures } from '../document/futures';
import type { Vec } from '../base/geometry';
import { STEP_S, type Motion } from '../base/motion';

/** Futures that break the same rule nearer to each other than this share a word, metres. */
const TOGETHER_M = 8;

export interface FaultPlace {
  readonly mark: Mark;
  /** The one whose words are shown: that of the shown future where it is one of them, else the worst. */
  readonly fault: Fault;
  /** Indices of the futures. */
  readonly futures: readonly number[];
}

interface Found {
  readonly index: number;
  readonly fault: Fault;
  /** Places along the stretch, in metres. */
  readonly along: readonly Vec[];
}

/** Steps between two of them. */
const EVERY = 4;

function placesAlong(m: Motion, fault: Fault): Vec[] {
  const out: Vec[] = [fault.at];
  const last = Math.min(m.x.length - 1, Math.round(fault.until / STEP_S) - m.first);
  const first = Math.max(0, Math.round(fault.time / STEP_S) - m.first);
  for (let i = first; i <= last; i += EVERY) out.push([m.x[i], m.y[i]]);
  // The end belongs to it: what breaks the same rule next to it is the same place.
  if (last > first) out.push([m.x[last], m.y[last]]);
  return out;
}

/**
 * The places of what is wrong with the futures in `visible`; those of the shown one first, then the worst. Of a goal
 * that is missed the shown one alone tells: that others end elsewhere is plain to see.
 */
export function faultPlaces(f: Futures, visible: readonly number[], chosen: number): FaultPlace[] {
  const clusters: Found[][] = [];
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

const together = (a: Found, b: Found): boolean =>
  a.fault.kind === b.fault.kind &&
  a.fault.with === b.fault.with &&
  a.along.some(([x, y]) => b.along.some((p) => Math.hypot(p[0] - x, p[1] - y) <= TOGETHER_M));

function placeOf(found: readonly Found[], chosen: number): FaultPlace {
  const ofShown = found.filter((o) => o.index === chosen);
  const told = (ofShown.length ? ofShown : found).map((o) => o.fault);
  const fault = told.reduce((a, b) => (worse(b, a) ? b : a));
  return {
    mark: faultMark(fault),
    fault,
    futures: [...new Set(found.map((o) => o.index))].sort((a, b) => a - b),
  };
}

/** Of a near miss the smaller gap is worse, of all else the larger figure. */
const worse = (a: Fault, b: Fault): boolean => {
  if (a.extent === null || b.extent === null) return a.extent !== null;
  return a.kind === 'near_miss' ? a.extent < b.extent : a.extent > b.extent;
};
