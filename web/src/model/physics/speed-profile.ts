// A drawn speed profile: points of speed over time on a fixed path. The motion is computed here, within the road user's
// limits.
import type { Limits } from '../base/domain';
import {
  clamp,
  lerp,
  lerpAngle,
  makeLine,
  project,
  type Line,
  type OnLine,
  type Pose,
  type Vec,
} from '../base/geometry';
import { MOST_POINTS, type Path, type Profile, type SpeedPoint } from '../document/profile';
import { lastStep, poseAt, STEP_S, type Motion } from '../base/motion';

/** Least distance of points on a curve, seconds. */
export const APART_S = 0.3;
/** Least distance of places on a path, metres. */
const SPACING_M = 0.25;

const round = (v: number, k: number): number => Math.round(v * k) / k;

/** The path of a motion; null for one that reverses or does not move. */
export function pathOf(m: Motion): Path | null {
  const path = { x: [] as number[], y: [] as number[], heading: [] as number[] };
  const last = lastStep(m);
  for (let i = 0; i < m.x.length && m.first + i <= last; i++) {
    if (m.speed[i] < -0.1) return null;
    const n = path.x.length;
    if (n && Math.hypot(m.x[i] - path.x[n - 1], m.y[i] - path.y[n - 1]) < SPACING_M) continue;
    path.x.push(round(m.x[i], 1000));
    path.y.push(round(m.y[i], 1000));
    path.heading.push(round(m.heading[i], 10000));
  }
  return path.x.length ? path : null;
}

/** Start and end of an undrawn motion. */
export function endsOf(m: Motion, end: number): SpeedPoint[] {
  const at = (t: number): SpeedPoint => ({ t, v: Math.max(0, poseAt(m, t)?.speed ?? 0), hold: 0 });
  return [at(0), at(end)];
}

/** Duration of a change of acceleration, seconds, and its largest share of the time between two points. */
export const EASING_S = 0.5;
const EASING_SHARE = 1 / 3;

/**
 * The requested speed at a time: through the points, with constant acceleration between them except for a short easing
 * at both ends, so that even braking stays a straight line.
 */
export function wantedSpeed(points: readonly SpeedPoint[], t: number): number {
  const next = points.findIndex((p) => p.t > t);
  if (next === 0) return points[0].v;
  const at = next < 0 ? points.length - 1 : next - 1;
  const from = points[at];
  const left = from.t + from.hold;
  if (next < 0 || t <= left) return from.v;
  const to = points[next];
  const lasts = Math.max(1e-6, to.t - left);
  const easing = Math.min(EASING_S, lasts * EASING_SHARE);
  const [first, last] = [slopeAt(points, at), slopeAt(points, next)];
  const even = (to.v - from.v - ((first + last) / 2) * easing) / (lasts - easing);
  // The acceleration changes from the first point's to the constant one, and from that to the second point's.
  const eased = (slope: number, for_s: number): number => slope * for_s + ((even - slope) / easing / 2) * for_s * for_s;
  const [gone, left_s] = [t - left, to.t - t];
  if (gone < easing) return from.v + eased(first, gone);
  if (left_s < easing) return to.v - eased(last, left_s);
  return from.v + eased(first, easing) + even * (gone - easing);
}

/** Acceleration at a point, m/s²: zero where the speed is held or turns, else between both sides. */
function slopeAt(points: readonly SpeedPoint[], i: number): number {
  const [before, here, after] = [points[i - 1], points[i], points[i + 1]];
  if (!before || !after || here.hold) return 0;
  const meanTo = (p: SpeedPoint, q: SpeedPoint): number => (q.v - p.v) / Math.max(1e-6, q.t - p.t - p.hold);
  const [a, b] = [meanTo(before, here), meanTo(here, after)];
  return a * b > 0 ? (2 * a * b) / (a + b) : 0;
}

/** The motion along the path at these speeds; an infeasible speed is reached as soon as possible. */
export function motionOf({ path, points }: Profile, limits: Limits, duration: number): Motion {
  const n = Math.round(duration / STEP_S) + 1;
  const along = alongOf(path);
  const m = {
    x: new Float64Array(n),
    y: new Float64Array(n),
    heading: new Float64Array(n),
    speed: new Float64Array(n),
  };
  let s = 0;
  let v = points[0].v;
  for (let i = 0; i < n; i++) {
    if (i) {
      const wanted = wantedSpeed(points, i * STEP_S);
      const now = clamp(wanted, v - limits.brake_mps2 * STEP_S, v + limits.accel_mps2 * STEP_S);
      const next = clamp(now, 0, limits.speed_mps);
      s += ((v + next) / 2) * STEP_S;
      v = next;
    }
    const p = placeAt(path, along, s);
    m.x[i] = p.x;
    m.y[i] = p.y;
    m.heading[i] = p.heading;
    m.speed[i] = v;
  }
  return { first: 0, ...m, valid: [[0, n]] };
}

/** Distance of each place from the start of the path, metres. */
export function alongOf({ x, y }: Path): number[] {
  let s = 0;
  return x.map((_, i) => (i ? (s += Math.hypot(x[i] - x[i - 1], y[i] - y[i - 1])) : 0));
}

export const lineOf = (path: Path): Line => makeLine(path.x.map((x, i): Vec => [x, path.y[i]]));

/** Past its end the path continues straight. */
function placeAt(path: Path, along: readonly number[], s: number): OnLine {
  const at = (i: number): OnLine => ({ x: path.x[i], y: path.y[i], heading: path.heading[i] });
  const last = along.length - 1;
  if (s >= along[last]) {
    const end = at(last);
    const on = s - along[last];
    return { ...end, x: end.x + on * Math.cos(end.heading), y: end.y + on * Math.sin(end.heading) };
  }
  const i = along.findIndex((a) => a > s);
  const [p, q] = [at(i - 1), at(i)];
  const k = (s - along[i - 1]) / (along[i] - along[i - 1]);
  return { x: lerp(p.x, q.x, k), y: lerp(p.y, q.y, k), heading: lerpAngle(p.heading, q.heading, k) };
}

/** A stop on the path. */
export interface Stop {
  readonly pose: Pose;
  readonly from: number;
  /** Duration in seconds; to the end where nothing follows. */
  readonly lasts: number;
}

/** A stop that matches a drawn one within this is that one, seconds: a crawl counts as standing. */
const SAME_STOP_S = 0.5;

/**
 * Stops of a motion of at least 0.5 s. A drawn stop has its drawn duration: states every 0.1 s give it only to a step.
 */
export function stopsOf(m: Motion, points: readonly SpeedPoint[] = []): Stop[] {
  const out: Stop[] = [];
  for (let i = 0; i < m.speed.length; i++) {
    if (m.speed[i] > 0) continue;
    let end = i;
    while (end + 1 < m.speed.length && m.speed[end + 1] === 0) end++;
    const lasts = (end - i) * STEP_S;
    if (lasts >= 0.45) {
      const from = (m.first + i) * STEP_S;
      const near = (a: number, b: number): boolean => Math.abs(a - b) < SAME_STOP_S;
      const drawn = points.find((p) => p.v === 0 && near(p.t, from) && near(p.hold, lasts));
      const pose = { x: m.x[i], y: m.y[i], heading: m.heading[i], speed: 0 };
      out.push({ pose, from, lasts: drawn?.hold ?? lasts });
    }
    i = end;
  }
  return out;
}

// -------------------------------------------------------------- changes

type SpeedBounds = readonly [number, number];

/** Possible time of a curve's point, and possible hold at `t`, seconds: it passes no other point. */
export function roomOf(
  points: readonly SpeedPoint[],
  i: number,
  end: number,
  t = points[i].t,
): { t: SpeedBounds; hold: SpeedBounds } {
  const before = i ? points[i - 1].t + points[i - 1].hold + APART_S : 0;
  const after = i + 1 < points.length ? points[i + 1].t - APART_S : end;
  return { t: i ? [before, Math.max(before, after)] : [0, 0], hold: [0, Math.max(0, after - t)] };
}

/** A moved point; it passes no other, and the start stays at 0 s. */
export function movedPoint(
  points: readonly SpeedPoint[],
  i: number,
  to: Partial<SpeedPoint>,
  end: number,
): SpeedPoint[] {
  const was = points[i];
  const t = clamp(to.t ?? was.t, ...roomOf(points, i, end).t);
  const hold = clamp(to.hold ?? was.hold, ...roomOf(points, i, end, t).hold);
  const p = { t: round(t, 100), v: Math.max(0, to.v ?? was.v), hold: round(hold, 100) };
  return points.map((q, k) => (k === i ? p : q));
}

/** The time for a stop at which the front of the road user is beside a place, given the length ahead of its centre. */
export function timeOfStop(
  profile: Profile,
  i: number,
  [x, y]: Vec,
  ahead: number,
  limits: Limits,
  duration: number,
): number {
  const { path, points } = profile;
  const wanted = project(lineOf(path), x, y).s - ahead;
  // A later stop is further along the path.
  let [from, to] = [0, duration];
  for (let n = 0; n < 12; n++) {
    const t = (from + to) / 2;
    const moved = movedPoint(points, i, { t }, duration);
    const { speed } = motionOf({ path, points: moved }, limits, duration);
    const stands = speed.findIndex((v, k) => v === 0 && k * STEP_S >= moved[i].t - 1e-6);
    // Summed as in the motion itself.
    const upTo = stands < 0 ? speed.length - 1 : stands;
    let gone = 0;
    for (let k = 1; k <= upTo; k++) gone += ((speed[k - 1] + speed[k]) / 2) * STEP_S;
    if (gone < wanted) from = t;
    else to = t;
  }
  return Math.round(from * 100) / 100;
}

/** Adds a point; null where there is no room for it. */
export function addedPoint(points: readonly SpeedPoint[], p: SpeedPoint): { points: SpeedPoint[]; at: number } | null {
  const near = points.some((q) => p.t > q.t - APART_S && p.t < q.t + q.hold + APART_S);
  if (near || points.length >= MOST_POINTS) return null;
  const at = points.filter((q) => q.t < p.t).length;
  return { points: [...points.slice(0, at), p, ...points.slice(at)], at };
}
