// How fast a road user goes, drawn by hand: points of speed over time on a path that is kept as it was. The motion
// that follows from both is worked out here, within what the road user can do.
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
import { lastStep, poseAt, STEP_S, type Motion } from '../base/motion';

/** A speed at a time, m/s and s; from then on it is held for so many seconds. */
export interface SpeedPoint {
  readonly t: number;
  readonly v: number;
  readonly hold: number;
}

/** Places with a heading, some way apart. */
export interface Path {
  readonly x: readonly number[];
  readonly y: readonly number[];
  readonly heading: readonly number[];
}

/** The first point is the start; points lie in the order of their times. */
export interface Profile {
  readonly path: Path;
  readonly points: readonly SpeedPoint[];
}

/** Points of one curve are at least so far apart, seconds, and at most so many. */
export const APART_S = 0.3;
export const MOST_POINTS = 12;
/** Places of a path are at least so far apart, metres. */
const SPACING_M = 0.25;

const round = (v: number, k: number): number => Math.round(v * k) / k;

/** The path of a motion; null for one that goes backwards or nowhere at all. */
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

/** The points of a motion that nobody has drawn: its start and its end. */
export function endsOf(m: Motion, end: number): SpeedPoint[] {
  const at = (t: number): SpeedPoint => ({ t, v: Math.max(0, poseAt(m, t)?.speed ?? 0), hold: 0 });
  return [at(0), at(end)];
}

/** A change of acceleration takes so long, seconds, and at most this share of the time between two points. */
export const EASING_S = 0.5;
const EASING_SHARE = 1 / 3;

/**
 * The speed that is asked for at a time: through the points, at one acceleration from each to the next but for a short
 * easing at both, so that a line of even braking is one.
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
  // The acceleration goes from the one at the first point to the even one, and from that to the one at the second.
  const eased = (slope: number, for_s: number): number => slope * for_s + ((even - slope) / easing / 2) * for_s * for_s;
  const [gone, left_s] = [t - left, to.t - t];
  if (gone < easing) return from.v + eased(first, gone);
  if (left_s < easing) return to.v - eased(last, left_s);
  return from.v + eased(first, easing) + even * (gone - easing);
}

/** Acceleration at a point, m/s²: none where the speed is held or turns, else between those on both sides. */
function slopeAt(points: readonly SpeedPoint[], i: number): number {
  const [before, here, after] = [points[i - 1], points[i], points[i + 1]];
  if (!before || !after || here.hold) return 0;
  const meanTo = (p: SpeedPoint, q: SpeedPoint): number => (q.v - p.v) / Math.max(1e-6, q.t - p.t - p.hold);
  const [a, b] = [meanTo(before, here), meanTo(here, after)];
  return a * b > 0 ? (2 * a * b) / (a + b) : 0;
}

/** The motion along the path at these speeds; what cannot be done in time is done as soon as it can be. */
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

/** Metres from the beginning of a path to each of its places. */
export function alongOf({ x, y }: Path): number[] {
  let s = 0;
  return x.map((_, i) => (i ? (s += Math.hypot(x[i] - x[i - 1], y[i] - y[i - 1])) : 0));
}

export const lineOf = (path: Path): Line => makeLine(path.x.map((x, i): Vec => [x, path.y[i]]));

/** Past its end the path goes straight on. */
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

/** A place at which it stands. */
export interface Stop {
  readonly pose: Pose;
  readonly from: number;
  /** Seconds that it stands there; to the end where nothing follows. */
  readonly lasts: number;
}

/** A stop that begins and lasts like a drawn one within this is that one, seconds: who hardly moves stands already. */
const SAME_STOP_S = 0.5;

/**
 * Where a motion stands for at least half a second. A stop that was drawn lasts as long as it was drawn: states, one
 * each 0.1 s, say it only to a step.
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

type Range = readonly [number, number];

/** When a point of a curve may come, and for how long it may hold if it comes at `t`, seconds: it passes no other. */
export function roomOf(
  points: readonly SpeedPoint[],
  i: number,
  end: number,
  t = points[i].t,
): { t: Range; hold: Range } {
  const before = i ? points[i - 1].t + points[i - 1].hold + APART_S : 0;
  const after = i + 1 < points.length ? points[i + 1].t - APART_S : end;
  return { t: i ? [before, Math.max(before, after)] : [0, 0], hold: [0, Math.max(0, after - t)] };
}

/** A point moved; it passes no other, and the start stays at 0 s. */
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

/** When a stop has to be asked for, so that it is next to a place with so many metres of the road user ahead of it. */
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
  // The later it stops the further it has come.
  let [from, to] = [0, duration];
  for (let n = 0; n < 12; n++) {
    const t = (from + to) / 2;
    const moved = movedPoint(points, i, { t }, duration);
    const { speed } = motionOf({ path, points: moved }, limits, duration);
    const stands = speed.findIndex((v, k) => v === 0 && k * STEP_S >= moved[i].t - 1e-6);
    // As the motion itself adds them up.
    const upTo = stands < 0 ? speed.length - 1 : stands;
    let gone = 0;
    for (let k = 1; k <= upTo; k++) gone += ((speed[k - 1] + speed[k]) / 2) * STEP_S;
    if (gone < wanted) from = t;
    else to = t;
  }
  return Math.round(from * 100) / 100;
}

/** One more point; null where there is no room for it. */
export function addedPoint(points: readonly SpeedPoint[], p: SpeedPoint): { points: SpeedPoint[]; at: number } | null {
  const near = points.some((q) => p.t > q.t - APART_S && p.t < q.t + q.hold + APART_S);
  if (near || points.length >= MOST_POINTS) return null;
  const at = points.filter((q) => q.t < p.t).length;
  return { points: [...points.slice(0, at), p, ...points.slice(at)], at };
}

// -------------------------------------------------------------- in a file

/** Reads what a file says; null for what is no profile. */
export function readProfile(v: unknown): Profile | null {
  const p = v as Partial<Profile> | null | undefined;
  const numbers = (a: unknown): a is number[] => Array.isArray(a) && a.length > 0 && a.every((n) => Number.isFinite(n));
  const { x, y, heading } = p?.path ?? {};
  if (!numbers(x) || !numbers(y) || !numbers(heading) || x.length !== y.length || x.length !== heading.length)
    return null;
  const points = Array.isArray(p?.points) ? p.points : [];
  const fine = points.every((q, i) => {
    const ok = q !== null && [q.t, q.v, q.hold].every((n) => Number.isFinite(n) && n >= 0);
    return ok && (i ? q.t > points[i - 1].t : q.t === 0);
  });
  return fine && points.length > 0 && points.length <= MOST_POINTS ? freeze(p as Profile) : null;
}

const freeze = (p: Profile): Profile => Object.freeze({ path: p.path, points: p.points });
