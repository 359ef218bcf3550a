// Routes along the lanes of a map, and how tight their bends are.
import { makeLine, pointAt, sliceLine, wrapAngle, type Line, type Vec } from '../base/geometry';
import type { Lane, LaneHit, LaneMap } from '../document/lanemap';

export interface Route {
  readonly line: Line;
  readonly length: number;
  readonly lanes: readonly Lane[];
  /** Where each of them ends along the line, metres. */
  readonly ends: readonly number[];
}

/** Shortest route along the lanes from one hit to another, without lane changes. */
export function findRoute(map: LaneMap, from: LaneHit, to: LaneHit, limit = 400): Route | null {
  if (from.lane === to.lane && to.s >= from.s - 0.5)
    return routeOf(sliceLine(from.lane.line, from.s, to.s), [from.lane], [to.s - from.s]);
  interface Node {
    lane: Lane;
    cost: number;
    back: Node | null;
  }
  const open: Node[] = [{ lane: from.lane, cost: from.lane.line.length - from.s, back: null }];
  const seen = new Set<string>();
  for (let n = 0; open.length && n < limit; n++) {
    let best = 0;
    for (let i = 1; i < open.length; i++) if (open[i].cost < open[best].cost) best = i;
    const node = open.splice(best, 1)[0];
    if (seen.has(node.lane.id)) continue;
    if (node.back) seen.add(node.lane.id);
    for (const id of node.lane.next) {
      const lane = map.lanes.get(id);
      if (!lane || seen.has(id)) continue;
      if (lane === to.lane) return join(from, { lane, cost: 0, back: node }, to);
      open.push({ lane, cost: node.cost + lane.line.length, back: node });
    }
  }
  return null;

  function join(a: LaneHit, end: Node, b: LaneHit): Route {
    const chain: Lane[] = [];
    for (let n: Node | null = end; n; n = n.back) chain.unshift(n.lane);
    const pts: Vec[] = [];
    const ends: number[] = [];
    chain.forEach((lane, i) => {
      const [s0, s1] = [i === 0 ? a.s : 0, i === chain.length - 1 ? b.s : lane.line.length];
      const piece = sliceLine(lane.line, s0, s1);
      pts.push(...(i ? piece.slice(1) : piece));
      ends.push((ends.at(-1) ?? 0) + s1 - s0);
    });
    return routeOf(pts, chain, ends);
  }
}

function routeOf(pts: Vec[], lanes: readonly Lane[], ends: readonly number[]): Route {
  const line = makeLine(pts);
  return { line, length: line.length, lanes, ends };
}

/** Sharpest bend of a line as a radius, metres. */
export const tightestRadius = (line: Line): number => Math.min(...radii(line));

/** Radii of a line about every 2 m from its start on, measured over stretches of about 4 m; its ends are straight. */
export function radii(line: Line): number[] {
  const n = Math.max(2, Math.floor(line.length / 2));
  const out = new Array<number>(n + 1).fill(Infinity);
  const at = (i: number): Vec => {
    const p = pointAt(line, (line.length * i) / n);
    return [p.x, p.y];
  };
  for (let i = 2; i <= n; i++) {
    const a = at(i - 2),
      b = at(i - 1),
      c = at(i);
    const t = Math.abs(wrapAngle(Math.atan2(c[1] - b[1], c[0] - b[0]) - Math.atan2(b[1] - a[1], b[0] - a[0])));
    const d = line.length / n;
    if (t > 1e-3) out[i - 1] = d / t;
  }
  return out;
}
