// Closest approach of several road users.
import { gapAtLeast, gapBetween, type Footprint } from './boxes';
import { JUDGING } from '../base/domain';
import type { Pose, Vec } from '../base/geometry';
import { poseAtStep, STEP_S, type Motion } from '../base/motion';
import type { Agent } from '../document/scene';

/** Two road users at their closest approach. */
export interface Closest {
  readonly a: Agent;
  readonly b: Agent;
  /** Distance between their boxes, metres. */
  readonly gap: number;
  /** Seconds of the scene. */
  readonly time: number;
}

/** Larger groups are skipped. */
const MOST = 80;

export type Moving = readonly [Agent, Motion];

function boxAt([agent, motion]: Moving, step: number): Footprint | null {
  const pose = poseAtStep(motion, step);
  return pose && { pose, length: agent.length, width: agent.width };
}

/**
 * Closest approach among all, with the moment. With several types only unlike types are compared, since pedestrians in
 * a crowd are always close. Null for fewer than two, or too many.
 */
export function closestOf(all: readonly Moving[], duration: number): Closest | null {
  if (all.length < 2 || all.length > MOST) return null;
  const mixed = new Set(all.map(([a]) => a.type)).size > 1;
  const steps = Math.round(duration / STEP_S);
  let best: Closest | null = null;
  for (let step = 0; step <= steps; step++) {
    const boxes = all.map((m) => boxAt(m, step));
    for (let i = 0; i < all.length; i++)
      for (let j = i + 1; j < all.length; j++) {
        const p = boxes[i],
          q = boxes[j];
        if (!p || !q || (mixed && all[i][0].type === all[j][0].type)) continue;
        const known = best?.gap ?? Infinity;
        if (gapAtLeast(p, q) >= known) continue;
        const gap = gapBetween(p, q);
        if (gap < known) best = { a: all[i][0], b: all[j][0], gap, time: step * STEP_S };
      }
  }
  return best;
}

/** The closest approach of the others to one road user; at equal gaps the earliest. Null where none is near. */
export function closestTo(one: Moving, others: readonly Moving[], duration: number): Closest | null {
  const steps = Math.round(duration / STEP_S);
  let best: Closest | null = null;
  for (let step = 0; step <= steps; step++) {
    const p = boxAt(one, step);
    for (const other of p ? others : []) {
      const q = boxAt(other, step);
      const known = best?.gap ?? Infinity;
      if (!q || gapAtLeast(p!, q) >= known) continue;
      const gap = gapBetween(p!, q);
      if (gap < known) best = { a: one[0], b: other[0], gap, time: step * STEP_S };
    }
  }
  return best;
}

/** One road user reaches the place that the other has just left. */
export interface TimeGap {
  readonly first: Agent;
  readonly second: Agent;
  /** From the first leaving the shared ground to the second reaching it, seconds. */
  readonly gap: number;
  /** Arrival of the second, seconds of the scene. */
  readonly time: number;
}

/**
 * Post-encroachment time of two: the least time shift at which their boxes would overlap, equal to the engine's score
 * for crossing paths; for one behind the other it is the time between them. Null without shared ground, where one
 * hardly moves, and where they overlap.
 */
export function timeGapOf(one: Moving, other: Moving, duration: number): TimeGap | null {
  const steps = Math.round(duration / STEP_S);
  const [p, q] = [one, other].map((m) => Array.from({ length: steps + 1 }, (_, step) => boxAt(m, step)));
  if (wayOf(p) < JUDGING.pet_travel_m || wayOf(q) < JUDGING.pet_travel_m) return null;
  for (let shift = 0; shift <= steps; shift++)
    for (let step = shift; step <= steps; step++) {
      const oneFirst = share(p[step - shift], q[step]);
      if (!oneFirst && !share(q[step - shift], p[step])) continue;
      const [first, second] = oneFirst ? [one[0], other[0]] : [other[0], one[0]];
      return shift ? { first, second, gap: shift * STEP_S, time: step * STEP_S } : null;
    }
  return null;
}

/** A moving box. */
export interface Driven extends Footprint {
  readonly pose: Pose;
}

/**
 * Seconds until two boxes overlap at constant velocities; null where they already do, or would not soon. Exact: on each
 * of the four side directions the projections overlap for one interval, and the boxes overlap while all four do.
 */
export function timeToCollision(p: Driven, q: Driven): number | null {
  const [dx, dy] = [q.pose.x - p.pose.x, q.pose.y - p.pose.y];
  const velocity = ({ pose }: Driven): Vec => [
    pose.speed * Math.cos(pose.heading),
    pose.speed * Math.sin(pose.heading),
  ];
  const [[px, py], [qx, qy]] = [velocity(p), velocity(q)];
  let [enter, leave] = [0, JUDGING.look_ahead_s as number];
  for (const angle of [p, q].flatMap(({ pose }) => [pose.heading, pose.heading + Math.PI / 2])) {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const half = ({ pose, length, width }: Driven): number =>
      (length * Math.abs(Math.cos(pose.heading - angle)) + width * Math.abs(Math.sin(pose.heading - angle))) / 2;
    const [offset, closing, reach] = [dx * c + dy * s, (px - qx) * c + (py - qy) * s, half(p) + half(q)];
    if (Math.abs(closing) < 1e-12) {
      if (Math.abs(offset) >= reach) return null;
      continue;
    }
    const [t0, t1] = [(offset - reach) / closing, (offset + reach) / closing];
    [enter, leave] = [Math.max(enter, Math.min(t0, t1)), Math.min(leave, Math.max(t0, t1))];
  }
  return enter > 0 && enter < leave ? enter : null;
}

const share = (p: Footprint | null, q: Footprint | null): boolean =>
  p !== null && q !== null && gapAtLeast(p, q) <= 0 && gapBetween(p, q) <= 0;

function wayOf(boxes: readonly (Footprint | null)[]): number {
  let way = 0;
  boxes.reduce((before, box) => {
    if (before && box) way += Math.hypot(box.pose.x - before.pose.x, box.pose.y - before.pose.y);
    return box ?? before;
  }, null);
  return way;
}

/** The same at one moment: distance of the two closest, metres. */
export function gapNow(boxes: readonly Footprint[]): number | null {
  if (boxes.length < 2 || boxes.length > MOST) return null;
  let best = Infinity;
  boxes.forEach((p, i) => {
    for (const q of boxes.slice(i + 1)) if (gapAtLeast(p, q) < best) best = Math.min(best, gapBetween(p, q));
  });
  return best;
}
