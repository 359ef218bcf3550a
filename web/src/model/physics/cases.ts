// A searched case: the event and its road users, whether a motion contains it, and how near it comes.
import { compareMarks } from '../document/future-facts';
import { motionOf } from './playback';
import { lightAt } from './signals';
import { closestTo, timeGapOf, type Closest, type Moving } from './proximity';
import { eventsIn, type SceneEvent } from './events';
import type { MotionSet } from '../document/futures';
import { pointAt, wrapAngle, type Vec } from '../base/geometry';
import { BRAKING_STEPS, poseAt, poseAtStep, STEP_S, type Motion } from '../base/motion';
import { JUDGING } from '../base/domain';
import { threshold } from '../document/thresholds';
import { AT_GOAL_M, canChange, type Agent, type Scene } from '../document/scene';

export type What = 'near' | 'collision' | 'first' | 'braking' | 'goal' | 'red';

/** The target of the search. */
export interface Sought {
  readonly what: What;
  /** The road user that is varied. */
  readonly who: string;
  /** The other party; null for any. */
  readonly other: string | null;
  /** The bound of the kind: metres of gap, seconds between the two, or m/s² of braking. */
  readonly limit: number;
}

/** Each kind with its initial bound, the unit of the bound, and whether it involves two. */
export const KINDS: Readonly<
  Record<
    What,
    { limit: number; step: number; unit: 'm' | 's' | 'm/s²'; range: readonly [number, number]; two: boolean }
  >
> = {
  near: { limit: 1, step: 0.1, unit: 'm', range: [0.1, 10], two: true },
  collision: { limit: 0, step: 0, unit: 'm', range: [0, 0], two: true },
  first: { limit: 2, step: 0.1, unit: 's', range: [0.1, 10], two: true },
  braking: { limit: 4, step: 0.5, unit: 'm/s²', range: [1, 9], two: false },
  goal: { limit: 2, step: 0.1, unit: 'm', range: [0.1, 20], two: false },
  red: { limit: 0, step: 0, unit: 'm', range: [0, 0], two: false },
};

/** Side of the other party, seen from the varied road user. */
export type PartySide = 'in-front' | 'behind' | 'on-the-left' | 'on-the-right';

/** The moment of a case in a motion. */
export interface Moment {
  /** In the unit of the kind. */
  readonly value: number;
  /** Seconds of the scene. */
  readonly time: number;
  readonly at: Vec;
  readonly other: string | null;
  readonly side: PartySide | null;
  readonly found: boolean;
  /** Distance from the target, smaller is nearer; below that of others where it is met. */
  readonly miss: number;
}

/** Paths with a greater distance do not cross, metres. */
const CROSSING_M = 1.5;
/** Further than any case. */
const FAR = 1e6;

/** The moment nearest to the target; null where it is impossible: a road user is absent, or has no goal. */
export function momentOf(scene: Scene, set: MotionSet, s: Sought): Moment | null {
  const who = scene.agents.get(s.who);
  if (!who) return null;
  const one: Moving = [who, motionOf(scene, set, who)];
  const others = [...scene.agents.values()]
    .filter((a) => a.id !== s.who && (s.other === null ? canChange(a) || a.type === 'other' : a.id === s.other))
    .map((a): Moving => [a, motionOf(scene, set, a)]);
  switch (s.what) {
    case 'near':
    case 'collision':
      return meeting(one, others, scene, set, s);
    case 'first':
      return others.length ? precedence(one, others[0], scene, set, s) : null;
    case 'braking':
      return braking(one, others, scene, set, s);
    case 'goal':
      return arrival(one, others, scene, set, s);
    case 'red':
      return redLight(one, scene, set, s);
  }
}

/**
 * A result is an event of the scene with its own numbers, so that a taken near miss is in the list. Gaps wider than the
 * near-miss threshold are no events; they are measured.
 */
function meeting(one: Moving, others: readonly Moving[], scene: Scene, set: MotionSet, s: Sought): Moment | null {
  const c = closestTo(one, others, scene.duration);
  if (!c) return null;
  const between = eventsBetween(scene, set, s);
  const hit = between.find((x) => x.kind === 'collision');
  const near = between.find((x) => x.gap !== null && x.gap <= s.limit);
  const counts = threshold(scene, 'gap_m');
  const e = hit ?? near;
  const gap = hit ? 0 : (near?.gap ?? c.gap);
  const isNear = gap > 0 && gap <= s.limit && (near !== undefined || s.limit > counts);
  const found = s.what === 'collision' ? gap === 0 : isNear;
  // A collision is not a near miss: it counts as twice the limit away.
  const miss = s.what === 'collision' ? gap : gap === 0 ? s.limit * 2 : gap;
  const b = e ? others.find(([a]) => a === (e.a.id === s.who ? e.b : e.a))?.[0] : undefined;
  return momentAt(one, b ?? c.b, others, { value: gap, time: b ? e!.time : c.time, found, miss });
}

/** They overlap, at a step or between two. */
const collides = (c: Closest | null, scene: Scene, set: MotionSet, s: Sought): boolean =>
  c?.gap === 0 || eventsBetween(scene, set, s)[0]?.kind === 'collision';

/** Events between the two, or between one and any other, the worst first. */
function eventsBetween(scene: Scene, set: MotionSet, { who, other }: Sought): SceneEvent[] {
  const is = (a: Agent | null, id: string | null): boolean => a !== null && (id === null || a.id === id);
  return eventsIn(scene, set)
    .filter(({ a, b }) => (a.id === who && is(b, other)) || (b?.id === who && is(a, other)))
    .sort((p, q) => compareMarks(p.kind, q.kind) || p.time - q.time);
}

interface MeasuredValue {
  readonly value: number;
  readonly time: number;
  readonly found: boolean;
  readonly miss: number;
}

/** With place and side at that time. */
function momentAt(one: Moving, b: Agent | null, others: readonly Moving[], m: MeasuredValue): Moment | null {
  const p = poseAt(one[1], m.time);
  const other = others.find(([a]) => a === b);
  const q = other ? poseAt(other[1], m.time) : null;
  if (!p) return null;
  return {
    ...m,
    at: q ? [(p.x + q.x) / 2, (p.y + q.y) / 2] : [p.x, p.y],
    other: q && b ? b.id : null,
    side: q ? sideOf(wrapAngle(Math.atan2(q.y - p.y, q.x - p.x) - p.heading)) : null,
  };
}

const sideOf = (bearing: number): PartySide =>
  Math.abs(bearing) < Math.PI / 4
    ? 'in-front'
    : Math.abs(bearing) > (3 * Math.PI) / 4
      ? 'behind'
      : bearing > 0
        ? 'on-the-left'
        : 'on-the-right';

/** Does it reach the crossing point before the other one, and by how little? */
function precedence(one: Moving, two: Moving, scene: Scene, set: MotionSet, s: Sought): Moment | null {
  const crossing = crossingOf(one[1], two[1], scene.duration);
  if (!crossing) return null;
  const { mine, theirs } = crossing;
  // As in the score: from one leaving the ground to the other reaching it.
  const between = timeGapOf(one, two, scene.duration);
  const ahead = between ? (between.first === one[0] ? between.gap : -between.gap) : theirs - mine;
  const hit = collides(closestTo(one, [two], scene.duration), scene, set, s);
  const found = ahead > 0 && ahead <= s.limit && !hit;
  const miss = found ? ahead : s.limit + Math.abs(ahead - s.limit / 2) + (hit ? s.limit : 0);
  return momentAt(one, two[0], [two], { value: ahead, time: mine, found, miss });
}

/** Arrival times of two at their closest point; null where their paths do not cross. */
function crossingOf(m: Motion, n: Motion, duration: number): { mine: number; theirs: number } | null {
  const steps = Math.round(duration / STEP_S);
  let best = CROSSING_M ** 2;
  let at: { mine: number; theirs: number } | null = null;
  for (let i = 0; i <= steps; i++) {
    const p = poseAtStep(m, i);
    for (let j = 0; p && j <= steps; j++) {
      const q = poseAtStep(n, j);
      if (!q) continue;
      const d = (p.x - q.x) ** 2 + (p.y - q.y) ** 2;
      const along = Math.abs(wrapAngle(p.heading - q.heading)) < JUDGING.pet_angle_rad;
      if (d >= best || along) continue;
      best = d;
      at = { mine: i * STEP_S, theirs: j * STEP_S };
    }
  }
  return at;
}

function braking(one: Moving, others: readonly Moving[], scene: Scene, set: MotionSet, s: Sought): Moment | null {
  const steps = Math.round(scene.duration / STEP_S);
  let value = 0;
  let time = 0;
  for (let i = 0; i + BRAKING_STEPS <= steps; i++) {
    const p = poseAtStep(one[1], i),
      q = poseAtStep(one[1], i + BRAKING_STEPS);
    if (!p || !q) continue;
    const rate = (Math.abs(p.speed) - Math.abs(q.speed)) / (BRAKING_STEPS * STEP_S);
    if (rate > value) [value, time] = [rate, (i + BRAKING_STEPS / 2) * STEP_S];
  }
  const c = closestTo(one, others, scene.duration);
  const hit = collides(c, scene, set, s);
  const found = value >= s.limit && !hit;
  const miss = found ? -value : Math.max(0, s.limit - value) + (hit ? s.limit : 0);
  return momentAt(one, null, [], { value, time, found, miss });
}

function arrival(one: Moving, others: readonly Moving[], scene: Scene, set: MotionSet, s: Sought): Moment | null {
  const { pos, time } = one[0].goal;
  const end = pos && poseAt(one[1], time);
  if (!pos || !end) return null;
  const off = Math.hypot(end.x - pos[0], end.y - pos[1]);
  const c = closestTo(one, others, scene.duration);
  if (!c) return null;
  const hit = collides(c, scene, set, s);
  const found = off <= AT_GOAL_M && !hit && c.gap <= s.limit;
  const miss = Math.min(FAR, c.gap + Math.max(0, off - AT_GOAL_M) + (hit ? s.limit * 2 : 0));
  return momentAt(one, c.b, others, { value: c.gap, time: c.time, found, miss });
}

/** View only: a signal for a road user is within this distance of its path, metres. */
const BESIDE_M = 6;

/** A red-light violation in the generator's verdict, otherwise the distance to a red signal. */
function redLight(one: Moving, scene: Scene, set: MotionSet, s: Sought): Moment | null {
  const f = set.futures.get(s.who);
  const m = f?.modes[Math.min(f.modes.length - 1, one[0].chosen ?? f.chosen)];
  const run = m?.about?.faults.find((x) => x.kind === 'red_light');
  if (run) {
    const value = run.extent ?? 0;
    return { value, time: run.time, at: run.at, other: null, side: null, found: true, miss: -value };
  }
  let best: { d: number; time: number } | null = null;
  for (const signal of scene.signals) {
    const { lane, stop } = signal;
    const line = scene.map.lanes.get(lane)?.line;
    const into = line ? pointAt(line, 0).heading : null;
    for (let step = 0; stop && step * STEP_S <= scene.duration; step++) {
      const p = lightAt(signal, step * STEP_S) === 'stop' ? poseAtStep(one[1], step) : null;
      // Signals for other approaches do not apply.
      const own = p && (into === null || Math.abs(wrapAngle(p.heading - into)) < JUDGING.along_lane_rad);
      const d = own ? Math.hypot(stop[0] - p.x, stop[1] - p.y) : Infinity;
      if (d < (best?.d ?? Infinity)) best = { d, time: step * STEP_S };
    }
  }
  return best && momentAt(one, null, [], { value: best.d, time: best.time, found: false, miss: best.d + BESIDE_M });
}

/** Cases closer than this in time and value, on the same side, are the same. */
const SAME_S = 0.3;
const SAME_VALUE = 0.5;

export const alike = (a: Moment, b: Moment): boolean =>
  Math.abs(a.time - b.time) < SAME_S &&
  Math.abs(a.value - b.value) < SAME_VALUE &&
  a.other === b.other &&
  a.side === b.side;
