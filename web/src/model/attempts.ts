// Numbers that are tried on a road user, one set after the other: its speed at the start, its goal time, the seed.
import { patchScene, setGoal, setStart } from './commands';
import { startPose, type Agent, type Scene } from './scene';

/** What of a road user may be changed. */
export interface MayChange {
  readonly speed: boolean;
  readonly time: boolean;
  readonly seed: boolean;
}

/** One thing to try: numbers of its own for a road user. */
export interface Attempt {
  readonly seed: number;
  /** Speed at the start, m/s; null for as it is. */
  readonly speed: number | null;
  /** Goal time, seconds; null for as it is. */
  readonly time: number | null;
}

/** Speeds are tried within this share of what it is and so many m/s more or less, whichever is wider. */
const SPEED_SHARE = 0.5;
const SPEED_MORE_MPS = 4;
/** Goal times are tried so many seconds around what it is. */
const TIME_MORE_S = 3;
const TIME_LEAST_S = 1;
/** Fractions of these fill a range evenly, however many are taken. */
const GOLDEN = 0.6180339887498949;
const PLASTIC = 0.7548776662466927;

/** The n-th attempt; the first is the scene as it is. Nothing of it is drawn by chance, so it can be done again. */
export function attempt(a: Agent, scene: Scene, may: MayChange, n: number, top: number): Attempt {
  const seed = may.seed ? scene.seed + n : scene.seed;
  if (n === 0) return { seed, speed: null, time: null };
  const spread = (k: number): number => 2 * ((n * k) % 1) - 1;
  const now = startPose(a)?.speed ?? 0;
  const wide = Math.max(SPEED_SHARE * now, Math.min(SPEED_MORE_MPS, top / 4));
  const speed = Math.min(top, Math.max(0, now + spread(GOLDEN) * wide));
  const time = Math.min(scene.duration, Math.max(TIME_LEAST_S, a.goal.time + spread(PLASTIC) * TIME_MORE_S));
  return {
    seed,
    speed: may.speed ? Math.round(speed * 100) / 100 : null,
    time: may.time && a.goal.pos ? Math.round(time * 10) / 10 : null,
  };
}

/** The document with an attempt in it, and no future picked for the one who is tried. */
export function withAttempt(scene: Scene, id: string, { seed, speed, time }: Attempt): Scene {
  const a = scene.agents.get(id)!;
  let s = patchScene('', { seed }).apply(scene);
  s = setStart(a, speed === null ? a.start : { ...a.start, speed }).apply(s);
  const goal = s.agents.get(id)!;
  return setGoal(goal, time === null ? goal.goal : { ...goal.goal, time }).apply(s);
}
