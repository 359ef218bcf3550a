// Ground where the paths of two road users cross within a short time: the conflict heat map of a junction.
import { JUDGING, THRESHOLDS } from '../base/domain';
import { motionOf } from './playback';
import type { MotionSet } from '../document/futures';
import { wrapAngle } from '../base/geometry';
import { poseAtStep, STEP_S } from '../base/motion';
import type { Agent, Scene } from '../document/scene';

/** Edge of a ground cell, metres. */
export const CELL_M = 2;
/** Arrivals further apart in time than this are no conflict, seconds. */
export const WITHIN_S = 3;
/** Steps between samples: 4 m at 20 m/s, less than a car's length. */
const STRIDE = 2;

/** A ground cell that two road users reach. */
export interface Zone {
  /** Its centre, metres. */
  readonly x: number;
  readonly y: number;
  /**
   * Least time between one leaving it and the other arriving, seconds, over all pairs; 0 where both are there at once.
   */
  readonly gap: number;
}

interface Visit {
  readonly id: string;
  readonly heading: number;
  readonly from: number;
  until: number;
}

type Ground = Map<string, Visit[]>;

/** All conflict cells of the shown motions. */
export function conflictZones(scene: Scene, set: MotionSet): Zone[] {
  const ground: Ground = new Map();
  for (const a of scene.agents.values()) if (a.type !== 'other' && !a.parked) visit(ground, scene, set, a);
  const out: Zone[] = [];
  for (const [key, visits] of ground) {
    const gap = leastGap(visits);
    if (gap > WITHIN_S) continue;
    const [i, j] = key.split(' ').map(Number);
    out.push({ x: (i + 0.5) * CELL_M, y: (j + 0.5) * CELL_M, gap });
  }
  return out;
}

function visit(ground: Ground, scene: Scene, set: MotionSet, a: Agent): void {
  const m = motionOf(scene, set, a);
  const last = Math.round(scene.duration / STEP_S);
  for (let step = 0; step <= last; step += STRIDE) {
    const p = poseAtStep(m, step);
    if (!p || Math.abs(p.speed) < THRESHOLDS.moving_mps.usual) continue;
    for (const key of under(p.x, p.y, p.heading, a.length)) enter(ground, key, a.id, p.heading, step * STEP_S);
  }
}

/** The cells along the centre line of a box. */
function under(x: number, y: number, heading: number, length: number): Set<string> {
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  const n = Math.max(1, Math.ceil(length / CELL_M));
  const keys = new Set<string>();
  for (let i = 0; i <= n; i++) {
    const d = (i / n - 0.5) * length;
    keys.add(`${Math.floor((x + c * d) / CELL_M)} ${Math.floor((y + s * d) / CELL_M)}`);
  }
  return keys;
}

function enter(ground: Ground, key: string, id: string, heading: number, time: number): void {
  const all = ground.get(key);
  const own = all?.findLast((v) => v.id === id);
  // It is still there, or has returned.
  if (own && time - own.until < 2 * STRIDE * STEP_S) own.until = time;
  else if (all) all.push({ id, heading, from: time, until: time });
  else ground.set(key, [{ id, heading, from: time, until: time }]);
}

function leastGap(visits: readonly Visit[]): number {
  let least = Infinity;
  visits.forEach((a, i) => {
    for (const b of visits.slice(i + 1)) {
      if (a.id === b.id || Math.abs(wrapAngle(a.heading - b.heading)) < JUDGING.pet_angle_rad) continue;
      least = Math.min(least, Math.max(0, a.from - b.until, b.from - a.until));
    }
  });
  return least;
}
