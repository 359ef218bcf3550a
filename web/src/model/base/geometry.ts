// Plane geometry in scene metres. Angles are radians, counter-clockwise from +x.

export type Vec = readonly [number, number];

/** A point, in metres or in pixels. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

export interface Pose {
  readonly x: number;
  readonly y: number;
  readonly heading: number;
  readonly speed: number;
}

export interface Box {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

/** The four corners of a rectangle that may be turned, counter-clockwise. */
export type Quad = readonly [Vec, Vec, Vec, Vec];

const TAU = Math.PI * 2;
export const rad = (degrees: number): number => (degrees * Math.PI) / 180;
export const deg = (radians: number): number => (radians * 180) / Math.PI;
export const clamp = (v: number, lo: number, hi: number): number => Math.min(hi, Math.max(lo, v));
export const lerp = (a: number, b: number, t: number): number => a + (b - a) * t;
const dist = (a: Vec, b: Vec): number => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** The only function that wraps angles: to [-pi, pi). */
export function wrapAngle(a: number): number {
  const w = (a + Math.PI) % TAU;
  return (w < 0 ? w + TAU : w) - Math.PI;
}

export const lerpAngle = (a: number, b: number, t: number): number => wrapAngle(a + wrapAngle(b - a) * t);

export function mixPose(a: Pose, b: Pose, t: number): Pose {
  return {
    x: lerp(a.x, b.x, t),
    y: lerp(a.y, b.y, t),
    heading: lerpAngle(a.heading, b.heading, t),
    speed: lerp(a.speed, b.speed, t),
  };
}

/** A polyline with its running length, for points by distance. */
export interface Line {
  readonly pts: readonly Vec[];
  readonly s: Float64Array;
  readonly length: number;
}

export function makeLine(pts: readonly Vec[]): Line {
  const s = new Float64Array(pts.length);
  for (let i = 1; i < pts.length; i++) s[i] = s[i - 1] + dist(pts[i - 1], pts[i]);
  return { pts, s, length: pts.length ? s[pts.length - 1] : 0 };
}

export interface OnLine {
  x: number;
  y: number;
  heading: number;
}

export function pointAt(line: Line, along: number): OnLine {
  const { pts, s } = line;
  const last = pts.length - 1;
  if (last < 1) return { x: pts[0]?.[0] ?? 0, y: pts[0]?.[1] ?? 0, heading: 0 };
  const d = clamp(along, 0, line.length);
  let lo = 0,
    hi = last;
  while (hi - lo > 1) {
    const mid = (lo + hi) >> 1;
    if (s[mid] <= d) lo = mid;
    else hi = mid;
  }
  const a = pts[lo],
    b = pts[lo + 1];
  const t = (d - s[lo]) / Math.max(1e-9, s[lo + 1] - s[lo]);
  return { x: lerp(a[0], b[0], t), y: lerp(a[1], b[1], t), heading: Math.atan2(b[1] - a[1], b[0] - a[0]) };
}

export interface Projection extends OnLine {
  s: number;
  d: number;
}

/** Nearest point of a polyline. */
export function project(line: Line, x: number, y: number): Projection {
  // A drag calls this for hundreds of lines in each frame, so it allocates no memory.
  let least = Infinity,
    at = 0,
    share = 0;
  for (let i = 1; i < line.pts.length; i++) {
    const a = line.pts[i - 1],
      b = line.pts[i];
    const dx = b[0] - a[0],
      dy = b[1] - a[1];
    const len2 = dx * dx + dy * dy;
    const t = len2 > 0 ? clamp(((x - a[0]) * dx + (y - a[1]) * dy) / len2, 0, 1) : 0;
    const ex = x - a[0] - dx * t,
      ey = y - a[1] - dy * t;
    const d2 = ex * ex + ey * ey;
    if (d2 >= least) continue;
    least = d2;
    at = i;
    share = t;
  }
  if (!at) return { x: 0, y: 0, heading: 0, s: 0, d: Infinity };
  const a = line.pts[at - 1],
    b = line.pts[at];
  const dx = b[0] - a[0],
    dy = b[1] - a[1];
  const s = line.s[at - 1] + Math.sqrt(dx * dx + dy * dy) * share;
  return { x: a[0] + dx * share, y: a[1] + dy * share, heading: Math.atan2(dy, dx), s, d: Math.sqrt(least) };
}

/** Piece of a line between two distances, both ends included. */
export function sliceLine(line: Line, from: number, to: number): Vec[] {
  const a = pointAt(line, from),
    b = pointAt(line, to);
  const out: Vec[] = [[a.x, a.y]];
  for (let i = 0; i < line.pts.length; i++) if (line.s[i] > from + 0.05 && line.s[i] < to - 0.05) out.push(line.pts[i]);
  out.push([b.x, b.y]);
  return out;
}

/** Cubic curve that leaves `a` along its heading and arrives at `b` along its heading. */
export function curveBetween(a: OnLine, b: OnLine, n = 30, pull = 0.42): Vec[] {
  const d = Math.hypot(b.x - a.x, b.y - a.y) * pull;
  const p1: Vec = [a.x + Math.cos(a.heading) * d, a.y + Math.sin(a.heading) * d];
  const p2: Vec = [b.x - Math.cos(b.heading) * d, b.y - Math.sin(b.heading) * d];
  const out: Vec[] = [];
  for (let i = 0; i <= n; i++) {
    const t = i / n,
      u = 1 - t;
    const c0 = u * u * u,
      c1 = 3 * u * u * t,
      c2 = 3 * u * t * t,
      c3 = t * t * t;
    out.push([c0 * a.x + c1 * p1[0] + c2 * p2[0] + c3 * b.x, c0 * a.y + c1 * p1[1] + c2 * p2[1] + c3 * b.y]);
  }
  return out;
}

/** Offset of a point in a pose's own frame: metres ahead and to the left. */
export function toLocal(p: OnLine, x: number, y: number): Vec {
  const c = Math.cos(p.heading),
    s = Math.sin(p.heading),
    dx = x - p.x,
    dy = y - p.y;
  return [dx * c + dy * s, -dx * s + dy * c];
}

export function insideBox(p: OnLine, length: number, width: number, x: number, y: number, grow = 0): boolean {
  const [u, v] = toLocal(p, x, y);
  return Math.abs(u) <= length / 2 + grow && Math.abs(v) <= width / 2 + grow;
}

export function insidePolygon(x: number, y: number, poly: readonly Vec[]): boolean {
  let inside = false;
  for (let i = 0, j = poly.length - 1; i < poly.length; j = i++) {
    const a = poly[i],
      b = poly[j];
    if (a[1] > y !== b[1] > y && x < ((b[0] - a[0]) * (y - a[1])) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside;
}

export const emptyBox = (): Box => ({ x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity });

export function growBox(b: Box, x: number, y: number): void {
  if (x < b.x0) b.x0 = x;
  if (y < b.y0) b.y0 = y;
  if (x > b.x1) b.x1 = x;
  if (y > b.y1) b.y1 = y;
}

export function boxOf(pts: Iterable<Vec>): Box {
  const b = emptyBox();
  for (const p of pts) growBox(b, p[0], p[1]);
  return b;
}

export const boxesMeet = (a: Box, b: Box): boolean => a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1;

/**
 * Thins points, keeping those without which the line would be off one of them by more than `tolerance`: far fewer where
 * it is straight. The first and the last are kept.
 */
export function thinned(
  from: number,
  to: number,
  at: (i: number) => Vec,
  tolerance: number,
  keep: (p: Vec) => void,
): void {
  let anchor = at(from);
  keep(anchor);
  let last = anchor;
  // The directions in which a line from the anchor passes all points since: right of one, left of the other.
  let lowX = 0,
    lowY = 0,
    highX = 0,
    highY = 0;
  let open = true;
  let farthest = 0;
  for (let i = from + 1; i <= to; i++) {
    const p = at(i);
    const dx = p[0] - anchor[0],
      dy = p[1] - anchor[1];
    const d = Math.sqrt(dx * dx + dy * dy);
    const ahead = open || (lowX * dy - lowY * dx >= 0 && highX * dy - highY * dx <= 0);
    if (!ahead || d < farthest - tolerance) {
      keep(last);
      anchor = last;
      open = true;
      farthest = 0;
      i--;
      continue;
    }
    last = p;
    farthest = Math.max(farthest, d);
    if (d <= tolerance) continue;
    // The tangents from the anchor to the tolerance circle around the point.
    const sin = tolerance / d;
    const cos = Math.sqrt(1 - sin * sin);
    const rx = dx * cos + dy * sin,
      ry = dy * cos - dx * sin;
    const lx = dx * cos - dy * sin,
      ly = dy * cos + dx * sin;
    if (open || lowX * ry - lowY * rx > 0) {
      lowX = rx;
      lowY = ry;
    }
    if (open || highX * ly - highY * lx < 0) {
      highX = lx;
      highY = ly;
    }
    open = false;
  }
  if (last !== anchor) keep(last);
}
