// The reaction of one road user to another: what it does, its cause and its place.
import { wrapAngle, type Pose } from '../base/geometry';
import { JUDGING } from '../base/domain';
import type { ReactionKind } from '../document/scene-json';
import { poseAt, STEP_S, type Motion } from '../base/motion';
import type { Agent } from '../document/scene';

export interface Reaction {
  readonly kind: ReactionKind;
  /** The direct cause. */
  readonly cause: { readonly id: string; readonly name: string };
  /** Delay in seconds; null where unknown. */
  readonly delay: number | null;
  /** Scene time when it waits or is slowest. */
  readonly time: number;
  /** Its pose then, with the speed. */
  readonly place: Pose;
  /** Is the cause ahead on the same path? It may also cross. */
  readonly ahead: boolean;
}

/** A possible cause of another's change, with its current motion. */
export interface Answered {
  readonly id: string;
  readonly name: string;
  readonly motion: Motion;
  /** Is it conditioned, or reacting itself? */
  readonly asked: boolean;
}

// View only, down to ASKED_SHARE: which words describe a change that the server gave no reason for, as after a speed
// curve. A reaction of the server comes with its kind and cause.

/** Ahead within this many metres, with at most this lateral offset and going the same way. */
const AHEAD_M = 40;
const ASIDE_M = 2.5;

/** Is the other one ahead on the same path at that time? */
export function answersAhead(mine: Motion, other: Motion, t: number): boolean {
  const p = poseAt(mine, t),
    q = poseAt(other, t);
  if (!p || !q || Math.abs(wrapAngle(q.heading - p.heading)) > JUDGING.same_way_rad) return false;
  const dx = q.x - p.x,
    dy = q.y - p.y;
  const ahead = dx * Math.cos(p.heading) + dy * Math.sin(p.heading);
  const aside = Math.abs(-dx * Math.sin(p.heading) + dy * Math.cos(p.heading));
  return ahead > 0 && ahead < AHEAD_M && aside < ASIDE_M;
}

/** An arrival that differs by less is neither later nor earlier, seconds. */
const SAME_ARRIVAL_S = 0.3;
/** Motions nearer than this are the same, metres. */
const SAME_PLACE_M = 0.1;
/** Causes are looked for from this long before a change until this long after it, seconds. */
const BEFORE_S = 2;
const AFTER_S = 5;
/** A road user further away than this is no cause, in metres. */
const NEAR_M = 25;
/** A conditioned road user is the cause unless another one comes nearer than this share. */
const ASKED_SHARE = 0.5;

/** Infers the reaction from a change without a given reason; null when there is no possible cause. */
export function guessReaction(
  a: Agent,
  before: Motion,
  after: Motion,
  duration: number,
  causes: readonly Answered[],
  lost: number,
): Reaction | null {
  const { kind, time } = kindOf(before, after, duration, lost);
  const place = poseAt(after, time);
  const cause = place && nearestCause(a.id, before, after, time, causes);
  if (!cause) return null;
  const ahead = answersAhead(after, cause.motion, time);
  const { id, name } = cause;
  return { kind, cause: { id, name }, delay: lost > 0 ? lost : null, time, place, ahead };
}

function kindOf(before: Motion, after: Motion, duration: number, lost: number): { kind: ReactionKind; time: number } {
  const part = partWhereApart(before, after, duration);
  const stop = longestStop(after, part.from);
  if (lost > 0 && stop.seconds > longestStop(before, part.from).seconds + JUDGING.waits_s)
    return { kind: 'waits', time: stop.from };
  if (lost > SAME_ARRIVAL_S) return { kind: 'slows', time: slowest(after, part.from, part.widest) };
  if (lost < -SAME_ARRIVAL_S) return { kind: 'speeds_up', time: part.widest };
  return { kind: 'keeps_clear', time: part.widest };
}

/** Time from which two motions differ, and time of the largest difference. */
function partWhereApart(a: Motion, b: Motion, duration: number): { from: number; widest: number } {
  let from = -1,
    widest = 0,
    most = 0;
  for (let t = 0; t <= duration + 1e-6; t += STEP_S) {
    const p = poseAt(a, t),
      q = poseAt(b, t);
    if (!p || !q) continue;
    const d = Math.hypot(p.x - q.x, p.y - q.y);
    if (from < 0 && d > SAME_PLACE_M) from = t;
    if (d > most) {
      most = d;
      widest = t;
    }
  }
  return { from: Math.max(0, from), widest };
}

function slowest(m: Motion, from: number, to: number): number {
  let at = to,
    low = Infinity;
  for (let t = from; t <= to + 1e-6; t += STEP_S) {
    const p = poseAt(m, t);
    if (!p || Math.abs(p.speed) >= low - 1e-6) continue;
    low = Math.abs(p.speed);
    at = t;
  }
  return at;
}

function longestStop(m: Motion, from: number): { seconds: number; from: number } {
  let best = { seconds: 0, from },
    since = -1;
  const first = Math.max(0, Math.round(from / STEP_S) - m.first);
  for (let i = first; i <= m.speed.length; i++) {
    const still = i < m.speed.length && Math.abs(m.speed[i]) < JUDGING.standing_mps;
    if (still && since < 0) since = i;
    if (still || since < 0) continue;
    const seconds = (i - since) * STEP_S;
    if (seconds > best.seconds) best = { seconds, from: (m.first + since) * STEP_S };
    since = -1;
  }
  return best;
}

/** The road user nearest to the motion that was given up, or to the new one. */
function nearestCause(
  id: string,
  before: Motion,
  after: Motion,
  time: number,
  causes: readonly Answered[],
): Answered | null {
  let best: Answered | null = null,
    least = NEAR_M;
  for (const c of causes) {
    if (c.id === id) continue;
    const gap = Math.min(closest(before, c.motion, time), closest(after, c.motion, time));
    const weighed = c.asked ? gap * ASKED_SHARE : gap;
    if (weighed >= least) continue;
    least = weighed;
    best = c;
  }
  return best ?? causes.find((c) => c.asked && c.id !== id) ?? null;
}

/** Least distance of two motions around a time. */
function closest(a: Motion, b: Motion, time: number): number {
  let least = Infinity;
  for (let t = Math.max(0, time - BEFORE_S); t <= time + AFTER_S; t += 2 * STEP_S) {
    const p = poseAt(a, t),
      q = poseAt(b, t);
    if (p && q) least = Math.min(least, Math.hypot(p.x - q.x, p.y - q.y));
  }
  return least;
}
