// What of a speed curve cannot be done: a speed that is not reached by its time, a goal that is not reached by its own.
// And what would be possible instead: the same curve with one thing changed, each tried before it is offered.
import type { Limits } from '../base/domain';
import { clamp, type Vec } from '../base/geometry';
import { STEP_S, type Motion } from '../base/motion';
import { alongOf, APART_S, motionOf, movedPoint } from './speed-profile';
import type { Profile, SpeedPoint } from '../document/profile';

/** A speed that is missed by less is as it was asked for, m/s. */
const SLACK_MPS = 0.3;
/** A goal that is missed by less is reached, metres; it lies on the path where it is no further beside it. */
const SLACK_M = 1;
const BESIDE_M = 3;
const TICK_S = 0.1;
const STEP_MPS = 0.25;

export interface Asked {
  readonly profile: Profile;
  readonly limits: Limits;
  /** Of the scene, seconds. */
  readonly duration: number;
  /** Most that may be asked, m/s. */
  readonly top: number;
  /** Where it should be, and when; null where no place is asked for. */
  readonly goal: { readonly at: Vec; readonly time: number } | null;
}

export type Way = { readonly points: readonly SpeedPoint[]; readonly goalTime?: number } &
  /** More time, seconds. */
  (
    | { readonly kind: 'later'; readonly by: number }
    /** Another speed at the point, m/s. */
    | { readonly kind: 'speed'; readonly v: number }
    /** A shorter stop, seconds. */
    | { readonly kind: 'shorter'; readonly hold: number }
  );

export type Misfit = { readonly ways: readonly Way[] } &
  /** A point whose speed is not there in time, since one brakes or gathers speed no faster. */
  (
    | { readonly what: 'braking' | 'gathering'; readonly point: SpeedPoint; readonly reached: number }
    /** So many metres before the goal at its time. */
    | { readonly what: 'short'; readonly time: number; readonly by: number }
  );

/** The first thing that cannot be done; null where all can. */
export function misfitOf(asked: Asked): Misfit | null {
  const { points } = asked.profile;
  const m = motionWith(asked, points);
  const i = missed(m, points);
  return i < 0 ? goalMisfit(asked, m) : pointMisfit(asked, m, i);
}

const motionWith = ({ profile, limits, duration }: Asked, points: readonly SpeedPoint[]): Motion =>
  motionOf({ path: profile.path, points }, limits, duration);

/** How much too fast it is at a point, m/s; below zero where it is too slow. */
function missedBy(m: Motion, points: readonly SpeedPoint[], i: number): number {
  const at = Math.min(m.speed.length - 1, Math.round(points[i].t / STEP_S));
  return m.speed[at] - points[i].v;
}

/** The first point that is missed, or -1. */
const missed = (m: Motion, points: readonly SpeedPoint[]): number =>
  points.findIndex((_, k) => Math.abs(missedBy(m, points, k)) > SLACK_MPS);

function pointMisfit(asked: Asked, m: Motion, i: number): Misfit {
  const { points } = asked.profile;
  const excess = missedBy(m, points, i);
  const reached = points[i].v + excess;
  const fits = (p: readonly SpeedPoint[]): boolean => Math.abs(missedBy(motionWith(asked, p), p, i)) <= SLACK_MPS;
  const ways = [later(asked, i, fits), shorter(points, i - 1, fits), otherSpeed(points, i, reached, fits)];
  const what = excess > 0 ? 'braking' : 'gathering';
  return { what, point: points[i], reached, ways: ways.filter((w) => w !== null) };
}

type Fits = (points: readonly SpeedPoint[]) => boolean;

/** The same point as much later as it has to be. */
function later({ profile: { points }, duration }: Asked, i: number, fits: Fits): Way | null {
  const next = i + 1 < points.length ? points[i + 1].t - points[i].hold - APART_S : duration;
  for (let n = 1; points[i].t + n * TICK_S <= next + 1e-6; n++) {
    const moved = movedPoint(points, i, { t: points[i].t + n * TICK_S }, duration);
    if (fits(moved)) return { kind: 'later', by: n * TICK_S, points: moved };
  }
  return null;
}

/** A stop that ends as much sooner as it has to, if any of it is left. */
function shorter(points: readonly SpeedPoint[], i: number, fits: Fits): Way | null {
  const hold = points[i]?.hold ?? 0;
  for (let n = 1; hold - n * TICK_S > TICK_S; n++) {
    const left = Math.round((hold - n * TICK_S) * 10) / 10;
    const cut = points.map((p, k) => (k === i ? { ...p, hold: left } : p));
    if (fits(cut)) return { kind: 'shorter', hold: left, points: cut };
  }
  return null;
}

/** The speed nearest to the one asked for that is there in time: a curve to it is steeper halfway than on the whole. */
function otherSpeed(points: readonly SpeedPoint[], i: number, reached: number, fits: Fits): Way | null {
  const away = Math.sign(reached - points[i].v) * STEP_MPS;
  for (let v = reached; v >= 0 && Math.abs(v - reached) < Math.abs(points[i - 1].v - reached); v += away) {
    const taken = points.map((p, k) => (k === i ? { ...p, v } : p));
    if (fits(taken)) return { kind: 'speed', v, points: taken };
  }
  return null;
}

// -------------------------------------------------------------- the goal

function goalMisfit(asked: Asked, m: Motion): Misfit | null {
  const { goal, profile, duration } = asked;
  const way = goal && wayTo(asked, goal.at);
  if (!goal || way === null) return null;
  const { points } = profile;
  const by = way - gone(m, goal.time);
  if (by <= SLACK_M) return null;
  const there =
    (time: number): Fits =>
    (p) => {
      const tried = motionWith(asked, p);
      return missed(tried, p) < 0 && way - gone(tried, time) <= SLACK_M;
    };
  const stop = points.reduce((most, p, i) => (p.hold > (points[most]?.hold ?? 0) ? i : most), -1);
  const ways = [arriving(asked, m, way, duration), shorter(points, stop, there(goal.time)), faster(asked, there)];
  return { what: 'short', time: goal.time, by, ways: ways.filter((w) => w !== null) };
}

/** Metres from the start to a goal by the path; null where it does not lie on it. */
function wayTo({ profile: { path } }: Asked, [gx, gy]: Vec): number | null {
  const along = alongOf(path);
  const off = path.x.map((x, i) => Math.hypot(x - gx, path.y[i] - gy));
  const i = off.indexOf(Math.min(...off));
  return off[i] <= BESIDE_M ? along[i] : null;
}

/** Metres driven by a time. */
function gone(m: Motion, time: number): number {
  let s = 0;
  const last = Math.min(m.speed.length - 1, Math.round(time / STEP_S));
  for (let i = 1; i <= last; i++) s += ((m.speed[i - 1] + m.speed[i]) / 2) * STEP_S;
  return s;
}

/** The time at which it is there as the curve is. */
function arriving({ goal, profile }: Asked, m: Motion, way: number, duration: number): Way | null {
  for (let time = goal!.time + TICK_S; time <= duration + 1e-6; time += TICK_S)
    if (way - gone(m, time) <= SLACK_M)
      return { kind: 'later', by: time - goal!.time, goalTime: Math.round(time * 10) / 10, points: profile.points };
  return null;
}

/** Faster at the end, by as little as does. */
function faster({ profile: { points }, top, goal }: Asked, there: (time: number) => Fits): Way | null {
  const last = points.length - 1;
  for (let v = Math.ceil(points[last].v); v < top; v++) {
    const taken = points.map((p, i) => (i === last ? { ...p, v: clamp(v + 1, 0, top) } : p));
    if (there(goal!.time)(taken)) return { kind: 'speed', v: taken[last].v, points: taken };
  }
  return null;
}
