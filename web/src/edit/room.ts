// Room for road users: who stands where somebody is to be put, and where there is place instead.
import { insidePolygon, makeLine, project, type OnLine, type Vec } from '../model/geometry';
import type { Newcomer } from '../model/newcomer';
import { startPose, type Agent, type Scene } from '../model/scene';

/** A box on the ground. */
export interface Footprint {
  readonly pose: OnLine;
  readonly length: number;
  readonly width: number;
}

/** Closer than this counts as touching, metres. */
const CLEAR_M = 0.1;

function corners({ pose, length, width }: Footprint): Vec[] {
  const c = Math.cos(pose.heading),
    s = Math.sin(pose.heading);
  return [
    [1, 1],
    [1, -1],
    [-1, -1],
    [-1, 1],
  ].map(([i, j]): Vec => {
    const u = (i * length) / 2,
      v = (j * width) / 2;
    return [pose.x + u * c - v * s, pose.y + u * s + v * c];
  });
}

/** Do two boxes touch? They do not where a line along one of their sides lies between them. */
export function touching(a: Footprint, b: Footprint): boolean {
  const far = (a.length + a.width + b.length + b.width) / 2 + CLEAR_M;
  if (Math.abs(a.pose.x - b.pose.x) > far || Math.abs(a.pose.y - b.pose.y) > far) return false;
  const p = corners(a),
    q = corners(b);
  for (const angle of [a.pose.heading, a.pose.heading + Math.PI / 2, b.pose.heading, b.pose.heading + Math.PI / 2]) {
    const c = Math.cos(angle),
      s = Math.sin(angle);
    const span = (pts: Vec[]): [number, number] => {
      const d = pts.map(([x, y]) => x * c + y * s);
      return [Math.min(...d), Math.max(...d)];
    };
    const [a0, a1] = span(p),
      [b0, b1] = span(q);
    if (a1 + CLEAR_M <= b0 || b1 + CLEAR_M <= a0) return false;
  }
  return true;
}

/** Everybody who is there at the start of a scene, as boxes. */
export function standing(scene: Scene): (Footprint & { readonly agent: Agent })[] {
  return [...scene.agents.values()].flatMap((agent) => {
    const pose = startPose(agent);
    return pose ? [{ agent, pose, length: agent.length, width: agent.width }] : [];
  });
}

/** Who stands in the way of a box. */
export const inTheWay = (f: Footprint, taken: readonly Footprint[]): Footprint | undefined =>
  taken.find((o) => touching(f, o));

/** How far one looks for a free place, metres. */
const LOOK_M = 60;

/**
 * How far all of them are to be moved so that they touch nobody: the nearest such place behind the first of them,
 * before it, or beside it. Null where all is full.
 */
export function freeShift(all: readonly Newcomer[], taken: readonly Footprint[], step = 2): Vec | null {
  const first = all[0];
  if (!first) return null;
  const h = first.pose.heading;
  const fits = (dx: number, dy: number): boolean =>
    all.every((n) => !inTheWay({ ...n, pose: { ...n.pose, x: n.pose.x + dx, y: n.pose.y + dy } }, taken));
  if (fits(0, 0)) return [0, 0];
  for (let d = step; d <= LOOK_M; d += step)
    for (const turn of [Math.PI, 0, -Math.PI / 2, Math.PI / 2, (-3 * Math.PI) / 4, (3 * Math.PI) / 4]) {
      const dx = Math.cos(h + turn) * d,
        dy = Math.sin(h + turn) * d;
      if (fits(dx, dy)) return [dx, dy];
    }
  return null;
}

/** Beyond so many the smallest gap is not looked for. */
const MOST_COMPARED = 120;

/** The shortest way between the boxes of any two of them, metres; null for fewer than two. */
export function smallestGap(all: readonly Agent[]): number | null {
  if (all.length < 2 || all.length > MOST_COMPARED) return null;
  const boxes = all.flatMap((agent): Vec[][] => {
    const pose = startPose(agent);
    return pose ? [corners({ pose, length: agent.length, width: agent.width })] : [];
  });
  let best = Infinity;
  boxes.forEach((p, i) => {
    for (const q of boxes.slice(i + 1)) best = Math.min(best, between(p, q));
  });
  return Number.isFinite(best) ? best : null;
}

/** The shortest way between two outlines that do not cross; where they do, 0. */
function between(p: readonly Vec[], q: readonly Vec[]): number {
  if (p.some(([x, y]) => insidePolygon(x, y, q)) || q.some(([x, y]) => insidePolygon(x, y, p))) return 0;
  const one = (points: readonly Vec[], outline: readonly Vec[]): number => {
    const line = makeLine([...outline, outline[0]]);
    return Math.min(...points.map(([x, y]) => project(line, x, y).d));
  };
  return Math.min(one(p, q), one(q, p));
}
