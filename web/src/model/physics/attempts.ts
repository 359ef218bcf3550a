// Attempts that vary numbers of a road user in turn: start speed, goal time, start place, seed.
import { patchScene, setGoal, setStart } from '../document/commands';
import { touching } from './boxes';
import { JUDGING } from '../base/domain';
import { wrapAngle, type Pose } from '../base/geometry';
import { nearestLanes, type Lane } from '../document/lanemap';
import { startPose, type Agent, type Scene, type StartSpec } from '../document/scene';

/** Numbers of a road user that may vary. */
export interface MayChange {
  readonly speed: boolean;
  readonly time: boolean;
  readonly seed: boolean;
  /** Start place, along its lane. */
  readonly place: boolean;
}

/** One attempt: its numbers for a road user. */
export interface Attempt {
  readonly seed: number;
  /** Start speed, m/s; null for unchanged. */
  readonly speed: number | null;
  /** Goal time, seconds; null for unchanged. */
  readonly time: number | null;
  /** Shift of the start, metres; null for unchanged. */
  readonly ahead: number | null;
}

/** Speeds vary within this share of the present one, or by this many m/s, whichever is wider. */
const SPEED_SHARE = 0.5;
const SPEED_MORE_MPS = 4;
/** Goal times vary by this many seconds. */
const TIME_MORE_S = 3;
const TIME_LEAST_S = 1;
/** Starts vary by this many metres forwards and backwards. */
export const PLACE_MORE_M = 5;
/** Multiples of this, modulo 1, fill a range evenly, however many are taken. */
const GOLDEN = 0.6180339887498949;
const PLASTIC = 0.7548776662466927;
const SILVER = 0.41421356237309515;

/** The n-th attempt; the first is the unchanged scene. Deterministic, so it can be repeated. */
export function attempt(a: Agent, scene: Scene, may: MayChange, n: number, top: number): Attempt {
  const seed = may.seed ? scene.seed + n : scene.seed;
  if (n === 0) return { seed, speed: null, time: null, ahead: null };
  const spread = (k: number): number => 2 * ((n * k) % 1) - 1;
  const now = startPose(a)?.speed ?? 0;
  const wide = Math.max(SPEED_SHARE * now, Math.min(SPEED_MORE_MPS, top / 4));
  const speed = Math.min(top, Math.max(0, now + spread(GOLDEN) * wide));
  const time = Math.min(scene.duration, Math.max(TIME_LEAST_S, a.goal.time + spread(PLASTIC) * TIME_MORE_S));
  return {
    seed,
    speed: may.speed ? Math.round(speed * 100) / 100 : null,
    time: may.time && a.goal.pos ? Math.round(time * 10) / 10 : null,
    ahead: may.place ? Math.round(spread(SILVER) * PLACE_MORE_M * 10) / 10 : null,
  };
}

/** The document with an attempt, and without a picked future for the varied road user. */
export function withAttempt(scene: Scene, id: string, { seed, speed, time, ahead }: Attempt): Scene {
  const a = scene.agents.get(id)!;
  let s = patchScene('', { seed }).apply(scene);
  const start = { ...a.start, ...(ahead === null ? {} : movedAlong(scene, a, ahead)) };
  s = setStart(a, speed === null ? start : { ...start, speed }).apply(s);
  const goal = s.agents.get(id)!;
  return setGoal(goal, time === null ? goal.goal : { ...goal.goal, time }).apply(s);
}

/**
 * The place this many metres ahead, with its lateral offset in the lane; off the lanes straight on. Half as far, or not
 * at all, where that is occupied.
 */
function movedAlong(scene: Scene, a: Agent, ahead: number): Partial<StartSpec> {
  for (const metres of [ahead, ahead / 2]) {
    const p = placeAlong(scene, a, metres);
    if (p && isFree(scene, a, p)) return { pos: Object.freeze([p.x, p.y] as const), heading: p.heading };
  }
  return {};
}

function placeAlong({ map }: Scene, a: Agent, metres: number): Pose | null {
  const now = startPose(a);
  if (!now) return null;
  const { x, y, heading, speed } = now;
  const straight = { x: x + Math.cos(heading) * metres, y: y + Math.sin(heading) * metres, heading, speed };
  const fits = (l: Lane): boolean => l.kind === 'road' || (a.type === 'cyclist' && l.kind === 'bike');
  const under = a.type === 'pedestrian' ? undefined : nearestLanes(map, x, y, heading, JUDGING.on_lane_m, fits)[0];
  if (!under) return straight;
  const { lane } = under;
  const same = (l: Lane): boolean => l === lane || lane.next.includes(l.id) || lane.prev.includes(l.id);
  const on = nearestLanes(map, straight.x, straight.y, heading, JUDGING.on_lane_m, same)[0];
  if (!on) return straight;
  const left = -(x - under.x) * Math.sin(under.heading) + (y - under.y) * Math.cos(under.heading);
  return {
    x: on.x - Math.sin(on.heading) * left,
    y: on.y + Math.cos(on.heading) * left,
    heading: wrapAngle(on.heading + heading - under.heading),
    speed,
  };
}

const isFree = (scene: Scene, a: Agent, pose: Pose): boolean =>
  [...scene.agents.values()].every((b) => {
    const p = b.id === a.id ? null : startPose(b);
    return !p || !touching({ pose, length: a.length, width: a.width }, { pose: p, length: b.length, width: b.width });
  });
