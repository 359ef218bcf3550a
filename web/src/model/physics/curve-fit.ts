// Infeasible parts of a speed profile: a speed or goal that is not reached in time. And feasible alternatives: the same
// profile with one change, each tested before it is offered.
import { AT_GOAL_M } from '../document/scene';
import type { Limits } from '../base/domain';
import { clamp, type Vec } from '../base/geometry';
import { STEP_S, type Motion } from '../base/motion';
import { alongOf, APART_S, motionOf, movedPoint } from './speed-profile';
import type { Profile, SpeedPoint } from '../document/profile';

/** A speed deviation below this is accepted, m/s. */
const SLACK_MPS = 0.3;
/** A goal within this distance is on the path, metres. */
const BESIDE_M = 3;
const TICK_S = 0.1;
const STEP_MPS = 0.25;

export interface CurveRequest {
  readonly profile: Profile;
  readonly limits: Limits;
  /** Of the scene, seconds. */
  readonly duration: number;
  /** Highest allowed speed, m/s. */
  readonly top: number;
  /** Goal position and time; null without a goal position. */
  readonly goal: { readonly at: Vec; readonly time: number } | null;
}

export type CurveRemedy = { readonly points: readonly SpeedPoint[]; readonly goalTime?: number } &
  /** Later by this many seconds. */
  (
    | { readonly kind: 'later'; readonly by: number }
    /** Another speed at the point, m/s. */
    | { readonly kind: 'speed'; readonly v: number }
    /** A shorter stop, seconds. */
    | { readonly kind: 'shorter'; readonly hold: number }
  );

export type Misfit = { readonly ways: readonly CurveRemedy[] } &
  /** A point whose speed is not reached in time by possible braking or acceleration. */
  (
    | { readonly what: 'braking' | 'gathering'; readonly point: SpeedPoint; readonly reached: number }
    /** This many metres before the goal at its time. */
    | { readonly what: 'short'; readonly time: number; readonly by: number }
  );

/** The first infeasible part; null where all is feasible. */
export function misfitOf(asked: CurveRequest): Misfit | null {
  const { points } = asked.profile;
  const m = motionWith(asked, points);
  const i = missed(m, points);
  return i < 0 ? goalMisfit(asked, m) : pointMisfit(asked, m, i);
}

const motionWith = ({ profile, limits, duration }: CurveRequest, points: readonly SpeedPoint[]): Motion =>
  motionOf({ path: profile.path, points }, limits, duration);

/** Excess speed at a point, m/s; negative where it is too slow. */
function missedBy(m: Motion, points: readonly SpeedPoint[], i: number): number {
  const at = Math.min(m.speed.length - 1, Math.round(points[i].t / STEP_S));
  return m.speed[at] - points[i].v;
}

/** The first point that is missed, or -1. */
const missed = (m: Motion, points: readonly SpeedPoint[]): number =>
  points.findIndex((_, k) => Math.abs(missedBy(m, points, k)) > SLACK_MPS);

function pointMisfit(asked: CurveRequest, m: Motion, i: number): Misfit {
  const { points } = asked.profile;
  const excess = missedBy(m, points, i);
  const reached = points[i].v + excess;
  const fits = (p: readonly SpeedPoint[]): boolean => Math.abs(missedBy(motionWith(asked, p), p, i)) <= SLACK_MPS;
  const ways = [later(asked, i, fits), shorter(points, i - 1, fits), otherSpeed(points, i, reached, fits)];
  const what = excess > 0 ? 'braking' : 'gathering';
  return { what, point: points[i], reached, ways: ways.filter((w) => w !== null) };
}

type Fits = (points: readonly SpeedPoint[]) => boolean;

/** The same point delayed as far as needed. */
function later({ profile: { points }, duration }: CurveRequest, i: number, fits: Fits): CurveRemedy | null {
  const next = i + 1 < points.length ? points[i + 1].t - points[i].hold - APART_S : duration;
  for (let n = 1; points[i].t + n * TICK_S <= next + 1e-6; n++) {
    const moved = movedPoint(points, i, { t: points[i].t + n * TICK_S }, duration);
    if (fits(moved)) return { kind: 'later', by: n * TICK_S, points: moved };
  }
  return null;
}

/** A stop shortened as far as needed, if any of it is left. */
function shorter(points: readonly SpeedPoint[], i: number, fits: Fits): CurveRemedy | null {
  const hold = points[i]?.hold ?? 0;
  for (let n = 1; hold - n * TICK_S > TICK_S; n++) {
    const left = Math.round((hold - n * TICK_S) * 10) / 10;
    const cut = points.map((p, k) => (k === i ? { ...p, hold: left } : p));
    if (fits(cut)) return { kind: 'shorter', hold: left, points: cut };
  }
  return null;
}

/** The speed nearest to the requested one that is reached in time: a curve is steeper halfway than on average. */
function otherSpeed(points: readonly SpeedPoint[], i: number, reached: number, fits: Fits): CurveRemedy | null {
  const away = Math.sign(reached - points[i].v) * STEP_MPS;
  for (let v = reached; v >= 0 && Math.abs(v - reached) < Math.abs(points[i - 1].v - reached); v += away) {
    const taken = points.map((p, k) => (k === i ? { ...p, v } : p));
    if (fits(taken)) return { kind: 'speed', v, points: taken };
  }
  return null;
}

// -------------------------------------------------------------- the goal

function goalMisfit(asked: CurveRequest, m: Motion): Misfit | null {
  const { goal, profile, duration } = asked;
  const way = goal && wayTo(asked, goal.at);
  if (!goal || way === null) return null;
  const { points } = profile;
  const by = way - gone(m, goal.time);
  if (by <= AT_GOAL_M) return null;
  const there =
    (time: number): Fits =>
    (p) => {
      const tried = motionWith(asked, p);
      return missed(tried, p) < 0 && way - gone(tried, time) <= AT_GOAL_M;
    };
  const stop = points.reduce((most, p, i) => (p.hold > (points[most]?.hold ?? 0) ? i : most), -1);
  const ways = [arriving(asked, m, way, duration), shorter(points, stop, there(goal.time)), faster(asked, there)];
  return { what: 'short', time: goal.time, by, ways: ways.filter((w) => w !== null) };
}

/** Metres from the start to a goal along the path; null where it is not on the path. */
function wayTo({ profile: { path } }: CurveRequest, [gx, gy]: Vec): number | null {
  const along = alongOf(path);
  const off = path.x.map((x, i) => Math.hypot(x - gx, path.y[i] - gy));
  const i = off.indexOf(Math.min(...off));
  return off[i] <= BESIDE_M ? along[i] : null;
}

/** Distance driven by a time, metres. */
function gone(m: Motion, time: number): number {
  let s = 0;
  const last = Math.min(m.speed.length - 1, Math.round(time / STEP_S));
  for (let i = 1; i <= last; i++) s += ((m.speed[i - 1] + m.speed[i]) / 2) * STEP_S;
  return s;
}

/** The arrival time of the unchanged curve. */
function arriving({ goal, profile }: CurveRequest, m: Motion, way: number, duration: number): CurveRemedy | null {
  for (let time = goal!.time + TICK_S; time <= duration + 1e-6; time += TICK_S)
    if (way - gone(m, time) <= AT_GOAL_M)
      return { kind: 'later', by: time - goal!.time, goalTime: Math.round(time * 10) / 10, points: profile.points };
  return null;
}

/** Faster at the end, by the least sufficient amount. */
function faster({ profile: { points }, top, goal }: CurveRequest, there: (time: number) => Fits): CurveRemedy | null {
  const last = points.length - 1;
  for (let v = Math.ceil(points[last].v); v < top; v++) {
    const taken = points.map((p, i) => (i === last ? { ...p, v: clamp(v + 1, 0, top) } : p));
    if (there(goal!.time)(taken)) return { kind: 'speed', v: taken[last].v, points: taken };
  }
  return null;
}
