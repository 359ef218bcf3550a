// Motion over time: recorded tracks and generated futures have this form.
import { JUDGING } from './domain';
import { clamp, lerp, lerpAngle, type Pose } from './geometry';

export const STEP_S = 0.1;

/** Columns of states, one every 0.1 s. `valid` lists half-open ranges of scene steps. */
export interface Motion {
  readonly first: number;
  readonly x: Float64Array;
  readonly y: Float64Array;
  readonly heading: Float64Array;
  readonly speed: Float64Array;
  readonly valid: readonly (readonly [number, number])[];
}

export interface Columns {
  first_step?: number;
  valid?: [number, number][];
  x_m: ArrayLike<number>;
  y_m: ArrayLike<number>;
  heading_rad: ArrayLike<number>;
  vx_mps?: ArrayLike<number> | null;
  vy_mps?: ArrayLike<number> | null;
}

/** Builds a motion from API columns; `start`, when given, becomes the state before the first column. */
export function motionFrom(c: Columns, start?: Pose): Motion {
  const pad = start ? 1 : 0;
  const n = c.x_m.length + pad;
  const x = new Float64Array(n),
    y = new Float64Array(n),
    heading = new Float64Array(n),
    speed = new Float64Array(n);
  if (start) {
    x[0] = start.x;
    y[0] = start.y;
    heading[0] = start.heading;
    speed[0] = start.speed;
  }
  for (let i = 0; i < c.x_m.length; i++) {
    const k = i + pad;
    x[k] = c.x_m[i];
    y[k] = c.y_m[i];
    heading[k] = c.heading_rad[i] ?? 0;
    speed[k] = c.vx_mps && c.vy_mps ? signedSpeed(c.vx_mps[i], c.vy_mps[i], heading[k]) : 0;
  }
  const first = (c.first_step ?? 0) - pad;
  return { first, x, y, heading, speed, valid: c.valid ?? [[first, first + n]] };
}

const round = (v: number, k: number): number => Math.round(v * k) / k;
const column = (a: Float64Array, k: number): number[] => Array.from(a, (v) => round(v, k));

/** The columns of a motion in file form, from the state `skip` on: metres and m/s to 0.001, radians to 0.0001. */
export function trackJson(m: Motion, skip = 0) {
  const x = column(m.x.subarray(skip), 1000),
    y = column(m.y.subarray(skip), 1000),
    h = column(m.heading.subarray(skip), 10000);
  const v = m.speed.subarray(skip);
  return {
    first_step: m.first + skip,
    x_m: x,
    y_m: y,
    heading_rad: h,
    vx_mps: Array.from(v, (s, i) => round(s * Math.cos(h[i]), 1000)),
    vy_mps: Array.from(v, (s, i) => round(s * Math.sin(h[i]), 1000)),
  };
}

/** Velocity against the heading gives a negative speed, so that reversing is visible. */
function signedSpeed(vx: number, vy: number, heading: number): number {
  const v = Math.hypot(vx, vy);
  return vx * Math.cos(heading) + vy * Math.sin(heading) < -0.2 * v ? -v : v;
}

/** The motion of an absent road user. */
export const nowhere: Motion = {
  first: 0,
  x: new Float64Array(0),
  y: new Float64Array(0),
  heading: new Float64Array(0),
  speed: new Float64Array(0),
  valid: [],
};

/** Known stretches of a motion between two indices, both inclusive: first and last of each. */
export function stretches(m: Motion, from: number, to: number): (readonly [number, number])[] {
  const parts = m.valid.map(([a, b]) => [Math.max(from, a - m.first), Math.min(to, b - 1 - m.first)] as const);
  return parts.filter(([a, b]) => a <= b);
}

export const isValidAt = (m: Motion, step: number): boolean => m.valid.some(([a, b]) => step >= a && step < b);
export const lastStep = (m: Motion): number => (m.valid.length ? m.valid[m.valid.length - 1][1] - 1 : m.first - 1);

export function poseAtStep(m: Motion, step: number): Pose | null {
  const i = step - m.first;
  if (i < 0 || i >= m.x.length || !isValidAt(m, step)) return null;
  return { x: m.x[i], y: m.y[i], heading: m.heading[i], speed: m.speed[i] };
}

/** State at a time in seconds; null where the motion does not exist. */
export function poseAt(m: Motion, t: number): Pose | null {
  const f = t / STEP_S;
  const a = Math.floor(f + 1e-6);
  const k = clamp(f - a, 0, 1);
  if (!isValidAt(m, a)) return null;
  const i = a - m.first;
  if (i < 0 || i >= m.x.length) return null;
  if (k < 1e-6 || !isValidAt(m, a + 1) || i + 1 >= m.x.length) return poseAtStep(m, a);
  return {
    x: lerp(m.x[i], m.x[i + 1], k),
    y: lerp(m.y[i], m.y[i + 1], k),
    heading: lerpAngle(m.heading[i], m.heading[i + 1], k),
    speed: lerp(m.speed[i], m.speed[i + 1], k),
  };
}

/** Does it end before a time? A future that no road user follows ends with the first 9 s. */
export const endsBefore = (m: Motion, t: number): boolean => lastStep(m) * STEP_S < t - 0.05;

export function endPose(m: Motion): Pose {
  const last = lastStep(m);
  return poseAtStep(m, last) ?? { x: m.x[m.x.length - 1] ?? 0, y: m.y[m.y.length - 1] ?? 0, heading: 0, speed: 0 };
}

/** Distance travelled up to each state. Columns of unseen steps hold no place: a gap counts as a straight line. */
export function distances(m: Motion): Float64Array {
  const s = new Float64Array(m.x.length);
  let last = -1;
  for (let i = 0; i < s.length; i++) {
    if (i) s[i] = s[i - 1];
    if (!isValidAt(m, m.first + i)) continue;
    if (last >= 0) s[i] += Math.sqrt((m.x[i] - m.x[last]) ** 2 + (m.y[i] - m.y[last]) ** 2);
    last = i;
  }
  return s;
}

export const pathLength = (m: Motion): number => distances(m)[m.x.length - 1] ?? 0;

/** Recorded speeds jitter; the curve on the timeline shows their mean over 0.8 s. */
export function smoothSpeed(m: Motion, halfWindow = 4): Float64Array {
  const out = new Float64Array(m.speed.length);
  for (let i = 0; i < out.length; i++) {
    let sum = 0,
      n = 0;
    for (let j = Math.max(0, i - halfWindow); j <= Math.min(out.length - 1, i + halfWindow); j++) {
      if (!isValidAt(m, m.first + j)) continue;
      sum += m.speed[j];
      n++;
    }
    out[i] = n ? sum / n : 0;
  }
  return out;
}

/** True when the whole recording stays within a hand's breadth. */
export function isStill(m: Motion): boolean {
  let x0 = Infinity,
    x1 = -Infinity,
    y0 = Infinity,
    y1 = -Infinity;
  for (let i = 0; i < m.x.length; i++) {
    if (!isValidAt(m, m.first + i)) continue;
    x0 = Math.min(x0, m.x[i]);
    x1 = Math.max(x1, m.x[i]);
    y0 = Math.min(y0, m.y[i]);
    y1 = Math.max(y1, m.y[i]);
  }
  return x1 - x0 < 0.6 && y1 - y0 < 0.6;
}

/** The same pose throughout: the motion for "Hold still". */
export function heldStill(p: Pose, steps: number): Motion {
  const fill = (v: number) => new Float64Array(steps).fill(v);
  return { first: 0, x: fill(p.x), y: fill(p.y), heading: fill(p.heading), speed: fill(0), valid: [[0, steps]] };
}

const continued = new WeakMap<Motion, Motion>();

/** The motion up to scene step `last`: extended straight at its last speed where it ends before. */
export function straightOn(m: Motion, last: number): Motion {
  const end = lastStep(m);
  if (end >= last || !m.valid.length) return m;
  const known = continued.get(m);
  if (known && lastStep(known) === last) return known;
  const n = last - m.first + 1,
    from = end - m.first;
  const grow = (a: Float64Array): Float64Array => {
    const out = new Float64Array(n);
    out.set(a.subarray(0, from + 1));
    return out;
  };
  const x = grow(m.x),
    y = grow(m.y),
    heading = grow(m.heading),
    speed = grow(m.speed);
  // A recorded velocity may differ from the heading; the heading is precise enough for display.
  const v = Math.abs(speed[from]) < JUDGING.standing_mps ? 0 : speed[from];
  for (let i = from + 1; i < n; i++) {
    const s = v * STEP_S * (i - from);
    x[i] = x[from] + s * Math.cos(heading[from]);
    y[i] = y[from] + s * Math.sin(heading[from]);
    heading[i] = heading[from];
    speed[i] = v;
  }
  const valid = m.valid.map(([a, b], i): readonly [number, number] =>
    i === m.valid.length - 1 ? [a, last + 1] : [a, b],
  );
  const out: Motion = { first: m.first, x, y, heading, speed, valid };
  continued.set(m, out);
  return out;
}

/** Steps over which braking is measured: as many before a moment as after it. */
export const BRAKING_STEPS = 2 * JUDGING.harsh_steps;

/** The hardest braking, m/s², measured as on the server. */
export function hardestBraking({ speed }: Motion): number {
  let most = 0;
  for (let i = BRAKING_STEPS; i < speed.length; i++)
    most = Math.max(most, (Math.abs(speed[i - BRAKING_STEPS]) - Math.abs(speed[i])) / (BRAKING_STEPS * STEP_S));
  return most;
}

/** Largest distance between two motions at the same time, metres. */
export function furthestApart(a: Motion, b: Motion): number {
  let most = 0;
  for (let i = 0; i < Math.min(a.x.length, b.x.length); i++)
    most = Math.max(most, Math.hypot(a.x[i] - b.x[i], a.y[i] - b.y[i]));
  return most;
}
