// How one road user answers another: what it does, for whom, where, and how to say it in one sentence.
import { wrapAngle, type Pose } from '../base/geometry';
import type { ReactionKind } from '../document/scene-json';
import { poseAt, STEP_S, type Motion } from '../base/motion';
import type { Agent } from '../document/scene';
import { num, speedText, walkingUnit, type SpeedUnit } from '../base/units';
import { TEXTS } from '../../texts/reactions';

export interface Reaction {
  readonly kind: ReactionKind;
  /** Whom it answers, directly. */
  readonly cause: { readonly id: string; readonly name: string };
  /** Seconds that it loses; null where nobody says. */
  readonly delay: number | null;
  /** Scene time at which it waits or is slowest. */
  readonly time: number;
  /** Where that is, with the speed there. */
  readonly place: Pose;
  /** Is the cause ahead on the same way? It may also cross. */
  readonly ahead: boolean;
}

/** One that may be the cause of another's change, with the motion it has now. */
export interface Answered {
  readonly id: string;
  readonly name: string;
  readonly motion: Motion;
  /** Was it asked something, or did it answer somebody itself? */
  readonly asked: boolean;
}

/** Shorter waits than this are not told in seconds. */
const TOLD_S = 0.5;

/** `waits 2 s for Car 7`, `slows to 8 km/h behind Car 12`: the verb first, the other's name last. */
export function reactionWords(a: Agent, r: Reaction, shown: SpeedUnit = 'km/h'): string {
  const { name } = r.cause;
  switch (r.kind) {
    case 'waits': {
      const long = r.delay !== null && r.delay >= TOLD_S ? ` ${roundSeconds(r.delay)} s` : '';
      return TEXTS.waits(long, name, r.ahead);
    }
    case 'slows': {
      const unit = a.type === 'pedestrian' ? walkingUnit(shown) : shown;
      const speed = speedText(Math.abs(r.place.speed), unit);
      return /[1-9]/.test(speed) ? TEXTS.slowsTo(`${speed} ${unit}`, name, r.ahead) : TEXTS.stopsBriefly(name, r.ahead);
    }
    case 'speeds_up':
      return TEXTS.makesWayFor(name);
    case 'keeps_clear':
      return TEXTS.takesAnother(name);
  }
}

/** Half seconds below two, whole ones above: nobody counts a wait in tenths. */
function roundSeconds(v: number): string {
  const step = v < 1.75 ? 2 : 1;
  const r = Math.round(v * step) / step;
  return num(r, r % 1 ? 1 : 0);
}

/** Ahead within this many metres, at most so far aside, and going nearly the same way. */
const AHEAD_M = 40;
const ASIDE_M = 2.5;
const SAME_WAY_RAD = Math.PI / 4;

/** Is the other one ahead on the same way at that time? */
export function answersAhead(mine: Motion, other: Motion, t: number): boolean {
  const p = poseAt(mine, t),
    q = poseAt(other, t);
  if (!p || !q || Math.abs(wrapAngle(q.heading - p.heading)) > SAME_WAY_RAD) return false;
  const dx = q.x - p.x,
    dy = q.y - p.y;
  const ahead = dx * Math.cos(p.heading) + dy * Math.sin(p.heading);
  const aside = Math.abs(-dx * Math.sin(p.heading) + dy * Math.cos(p.heading));
  return ahead > 0 && ahead < AHEAD_M && aside < ASIDE_M;
}

/** Slower than this is standing, in m/s; shorter stops than this, in seconds, are no waits. */
const STANDS = { walking: 0.2, driving: 0.6 };
const WAITS_S = 0.8;
/** An apparent cause further away than this is none, in metres. */
const NEAR_M = 25;
/** One that was itself asked something is the cause unless another one comes nearer than this share. */
const ASKED_SHARE = 0.5;

/** What a change looks like, for a generator that says no reason; null when nobody may be the cause. */
export function guessReaction(
  a: Agent,
  before: Motion,
  after: Motion,
  duration: number,
  causes: readonly Answered[],
  lost: number,
): Reaction | null {
  const { kind, time } = kindOf(a, before, after, duration, lost);
  const place = poseAt(after, time);
  const cause = place && nearestCause(a.id, before, after, time, causes);
  if (!cause) return null;
  const ahead = answersAhead(after, cause.motion, time);
  const { id, name } = cause;
  return { kind, cause: { id, name }, delay: lost > 0 ? lost : null, time, place, ahead };
}

function kindOf(
  a: Agent,
  before: Motion,
  after: Motion,
  duration: number,
  lost: number,
): { kind: ReactionKind; time: number } {
  const still = a.type === 'pedestrian' ? STANDS.walking : STANDS.driving;
  const part = partWhereApart(before, after, duration);
  const stop = longestStop(after, still, part.from);
  if (lost > 0 && stop.seconds > longestStop(before, still, part.from).seconds + WAITS_S)
    return { kind: 'waits', time: stop.from };
  if (lost > 0.3) return { kind: 'slows', time: slowest(after, part.from, part.widest) };
  if (lost < -0.3) return { kind: 'speeds_up', time: part.widest };
  return { kind: 'keeps_clear', time: part.widest };
}

/** From when on two motions are apart, and when most. */
function partWhereApart(a: Motion, b: Motion, duration: number): { from: number; widest: number } {
  let from = -1,
    widest = 0,
    most = 0;
  for (let t = 0; t <= duration + 1e-6; t += STEP_S) {
    const p = poseAt(a, t),
      q = poseAt(b, t);
    if (!p || !q) continue;
    const d = Math.hypot(p.x - q.x, p.y - q.y);
    if (from < 0 && d > 0.1) from = t;
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

function longestStop(m: Motion, below: number, from: number): { seconds: number; from: number } {
  let best = { seconds: 0, from },
    since = -1;
  const first = Math.max(0, Math.round(from / STEP_S) - m.first);
  for (let i = first; i <= m.speed.length; i++) {
    const still = i < m.speed.length && Math.abs(m.speed[i]) < below;
    if (still && since < 0) since = i;
    if (still || since < 0) continue;
    const seconds = (i - since) * STEP_S;
    if (seconds > best.seconds) best = { seconds, from: (m.first + since) * STEP_S };
    since = -1;
  }
  return best;
}

/** Who comes nearest to the motion that was given up, or to the one taken instead. */
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

/** How near two motions come in the seconds around a time. */
function closest(a: Motion, b: Motion, time: number): number {
  let least = Infinity;
  for (let t = Math.max(0, time - 2); t <= time + 5; t += 2 * STEP_S) {
    const p = poseAt(a, t),
      q = poseAt(b, t);
    if (p && q) least = Math.min(least, Math.hypot(p.x - q.x, p.y - q.y));
  }
  return least;
}
