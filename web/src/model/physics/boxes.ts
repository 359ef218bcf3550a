// Road users as boxes on the ground: overlap and distance.
import { clamp, type OnLine, type Vec } from '../base/geometry';

/** A box on the ground. */
export interface Footprint {
  readonly pose: OnLine;
  readonly length: number;
  readonly width: number;
}

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

/** Do two boxes overlap? They do if no line along one of their sides separates them. */
export function touching(a: Footprint, b: Footprint): boolean {
  const far = (a.length + a.width + b.length + b.width) / 2;
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
    if (a1 <= b0 || b1 <= a0) return false;
  }
  return true;
}

/** Distance from a point to a segment. */
function toStretch([x, y]: Vec, [ax, ay]: Vec, [bx, by]: Vec): number {
  const dx = bx - ax,
    dy = by - ay;
  const len2 = dx * dx + dy * dy;
  const t = len2 > 0 ? clamp(((x - ax) * dx + (y - ay) * dy) / len2, 0, 1) : 0;
  return Math.hypot(x - ax - dx * t, y - ay - dy * t);
}

/** Distance between two boxes, metres; 0 where they overlap. */
export function gapBetween(a: Footprint, b: Footprint): number {
  if (touching(a, b)) return 0;
  const p = corners(a),
    q = corners(b);
  let best = Infinity;
  for (let i = 0; i < 4; i++)
    for (let j = 0; j < 4; j++)
      best = Math.min(best, toStretch(p[i], q[j], q[(j + 1) % 4]), toStretch(q[i], p[j], p[(j + 1) % 4]));
  return best;
}

/** Lower bound of the distance between boxes, from their centres only. */
export const gapAtLeast = (a: Footprint, b: Footprint): number =>
  Math.hypot(a.pose.x - b.pose.x, a.pose.y - b.pose.y) -
  (Math.hypot(a.length, a.width) + Math.hypot(b.length, b.width)) / 2;
