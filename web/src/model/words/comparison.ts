// Differences between two variants: changed road users, since when, and the outcome.
import { JUDGING } from '../base/domain';
import { compareMarks } from '../document/future-facts';
import { motionOf } from '../physics/playback';
import { counted } from '../physics/events';
import type { TrafficEvent } from './event-words';
import type { MotionSet } from '../document/futures';
import { toLocal, type Vec } from '../base/geometry';
import { poseAt, STEP_S, type Motion } from '../base/motion';
import type { Agent, Scene } from '../document/scene';
import { TEXTS } from '../../texts/scene/comparison';

export interface ComparedVariant {
  /** Its number, as the name in a sentence. */
  readonly label: string;
  readonly scene: Scene;
  readonly set: MotionSet;
  readonly events: readonly TrafficEvent[];
}

/** A moment when they diverge, in a sentence. */
export interface DivergingMoment {
  readonly time: number;
  readonly words: string;
  readonly at: Vec;
}

/** A road user with different motions. */
export interface Diverging {
  readonly agent: Agent;
  readonly left: Motion;
  readonly right: Motion;
  /** Largest distance between both, metres. */
  readonly far: number;
  /** Time of the first difference. */
  readonly since: number;
}

export interface Comparison {
  /** The largest distance first. */
  readonly diverging: readonly Diverging[];
  readonly moments: readonly DivergingMoment[];
  /** Number of road users with equal motions. */
  readonly same: number;
  readonly all: number;
}

/** Motions further apart than this differ, metres. */
const APART_M = 1;
const MOST_MOMENTS = 6;
/** A stop or slowdown within this many seconds of the divergence counts. */
const SOON_S = 4;
const SLOWS_MPS = 1;

export function comparisonOf(left: ComparedVariant, right: ComparedVariant): Comparison {
  const all = [...left.scene.agents.values()].filter((a) => a.type !== 'other');
  const diverging = all.flatMap((a) => partedOf(left, right, a) ?? []).sort((p, q) => q.far - p.far);
  return {
    diverging,
    moments: momentsOf(left, right, diverging),
    same: all.length - diverging.length,
    all: all.length,
  };
}

function partedOf(left: ComparedVariant, right: ComparedVariant, agent: Agent): Diverging | null {
  const other = right.scene.agents.get(agent.id);
  if (!other) return null;
  const m = motionOf(left.scene, left.set, agent),
    n = motionOf(right.scene, right.set, other);
  if (m === n) return null;
  let far = 0,
    since = -1;
  for (let t = 0; t <= left.scene.duration + STEP_S / 2; t += STEP_S) {
    const p = poseAt(m, t),
      q = poseAt(n, t);
    if (!p || !q) continue;
    const d = Math.hypot(p.x - q.x, p.y - q.y);
    if (d > APART_M && since < 0) since = t;
    far = Math.max(far, d);
  }
  return since < 0 ? null : { agent, left: m, right: n, far, since };
}

// -------------------------------------------------------------- the moments

function momentsOf(left: ComparedVariant, right: ComparedVariant, diverging: readonly Diverging[]): DivergingMoment[] {
  const said = (e: TrafficEvent): string =>
    e.what === 'collision' && e.b ? TEXTS.hits(e.a.name, e.b.name) : `${e.b ? e.a.name : e.title}, ${e.short}`;
  // If there are too many the worst are listed, and of these the earliest, on either side.
  const events = [left, right]
    .flatMap((s) => counted(s.events).map((e) => ({ e, words: `${s.label}: ${said(e)}` })))
    .sort((p, q) => compareMarks(p.e.kind, q.e.kind) || p.e.time - q.e.time);
  // An event in both, with a slightly different gap, is no difference.
  const alone = events.filter((m) => !events.some((o) => o !== m && sameMeeting(o.e, m.e)));
  const own = alone.map(({ e, words }): DivergingMoment => ({ time: e.time, words, at: e.at }));
  const ways = diverging.map((p) => wayOf(left, right, p));
  return [...own.slice(0, MOST_MOMENTS - 2), ...ways].slice(0, MOST_MOMENTS).sort((a, b) => a.time - b.time);
}

/** The same event of the same road users at about the same time. */
const sameMeeting = (p: TrafficEvent, q: TrafficEvent): boolean =>
  p.what === q.what && p.a.id === q.a.id && p.b?.id === q.b?.id && Math.abs(p.time - q.time) < 0.5;

function wayOf(
  left: ComparedVariant,
  right: ComparedVariant,
  { agent, left: m, right: n, since: t }: Diverging,
): DivergingMoment {
  const p = poseAt(m, t)!,
    q = poseAt(n, t)!;
  const at: Vec = [(p.x + q.x) / 2, (p.y + q.y) / 2];
  const [along, aside] = toLocal(p, q.x, q.y);
  const say = (words: string): DivergingMoment => ({ time: t, words: `${agent.name} ${words}`, at });
  if (Math.abs(aside) > Math.abs(along))
    return say(aside > 0 ? TEXTS.keepsFurther(right.label) : TEXTS.keepsFurtherRight(right.label));
  // The one behind has slowed, or the other one continues.
  const [slow, motion, other] = along < 0 ? [right, n, m] : [left, m, n];
  const least = (of: Motion): number => {
    let v = Infinity;
    for (let s = t; s <= Math.min(left.scene.duration, t + SOON_S); s += STEP_S) v = Math.min(v, speedAt(of, s));
    return v;
  };
  if (least(motion) < JUDGING.standing_mps && least(other) >= JUDGING.standing_mps)
    return say(TEXTS.stopsOnlyIn(slow.label));
  if (speedAt(motion, 0) - speedAt(motion, t) > SLOWS_MPS) return say(TEXTS.slowsOnlyIn(slow.label));
  return say(TEXTS.goesFasterIn((slow === left ? right : left).label));
}

const speedAt = (m: Motion, t: number): number => Math.abs(poseAt(m, t)?.speed ?? Infinity);
