// The search for a case in the words of the API: the ranges of what may vary, the condition on the figures, and the
// document of a try.
import { patchScene, setGoal, setStart } from '../document/commands';
import { conditionOf } from '../document/scene-writer';
import { AT_GOAL_M, startPose, type Agent, type Scene } from '../document/scene';
import type { Schemas } from '../base/schemas';
import { touching } from './boxes';
import type { Sought } from './cases';

export type SearchBody = Schemas['SearchBody'];
export type Try = Schemas['SearchTry'];
type Situation = Schemas['BatchSituation'];

/** Numbers of a road user that may vary. */
export interface MayChange {
  readonly speed: boolean;
  readonly time: boolean;
  readonly seed: boolean;
  /** Start place, along its heading. */
  readonly place: boolean;
}

/** Speeds vary within this share of the present one, or by this many m/s, whichever is wider. */
const SPEED_SHARE = 0.5;
const SPEED_MORE_MPS = 4;
/** Goal times vary by this many seconds. */
const TIME_MORE_S = 3;
const TIME_LEAST_S = 1;
/** Starts vary by this many metres forwards and backwards. */
export const PLACE_MORE_M = 5;

const range = (low: number, high: number): Schemas['Distribution'] => ({ uniform: [low, high] });

/** What a road user is asked for, with ranges of what may vary; null where nothing but the seed does. */
export function situationOf(a: Agent, scene: Scene, may: MayChange, top: number): Situation | null {
  const { start, goal } = conditionOf(a);
  const now = startPose(a)?.speed ?? 0;
  const wide = Math.max(SPEED_SHARE * now, Math.min(SPEED_MORE_MPS, top / 4));
  const speed = may.speed ? { speed_mps: range(Math.max(0, now - wide), Math.min(top, now + wide)) } : {};
  // The ranges replace the whole goal, and have no edges that may be crossed.
  const timed = may.time && a.goal.pos !== null && !a.goal.mayCross.length;
  const [from, to] = [a.goal.time - TIME_MORE_S, a.goal.time + TIME_MORE_S];
  const time = { time_s: range(Math.max(TIME_LEAST_S, from), Math.min(scene.duration, to)) };
  // A shift is from the recorded start, which is that of the document in the scene of a search.
  const { x_m: x, y_m: y, ...rest } = start ?? {};
  const place = may.place ? { ahead_m: range(-PLACE_MORE_M, PLACE_MORE_M) } : x == null ? {} : { x_m: x, y_m: y };
  if (!may.speed && !may.place && !timed) return null;
  return {
    agents: [a.id],
    ...(may.speed || may.place ? { start: { ...rest, ...place, ...speed } as Situation['start'] } : {}),
    ...(timed ? { goal: { ...goal, ...time } as Situation['goal'] } : {}),
  };
}

/** The chosen future of a try may miss a case of another one by so much, where two road users are meant. */
const OTHER_FUTURES_M = 2;
const OTHER_FUTURES_S = 2;

/** A figure, compared with a number. */
type FigureBound = readonly [figure: string, is: '<=' | '>=' | '==', number: number];

const NO_COLLISION: FigureBound = ['actor.collisions', '==', 0];
const gapAtMost = (metres: number): FigureBound => ['actor.min_distance_m', '<=', metres];
const all = (...of: FigureBound[]): string => of.map((c) => c.join(' ')).join(' && ');

/**
 * The condition on the figures of a try. They are those of the chosen future of the varied road user with anybody, and
 * of all red lights: what satisfies it is made again, and judged.
 */
export function conditionOn({ what, limit }: Sought): string {
  switch (what) {
    case 'near':
    case 'collision':
      return all(gapAtMost(limit + OTHER_FUTURES_M));
    case 'first':
      return all(['actor.pet_s', '<=', limit + OTHER_FUTURES_S]);
    case 'braking':
      return all(['actor.kinematic.brake_mps2', '>=', limit], NO_COLLISION);
    case 'goal':
      return all(['actor.goal_error.position_m', '<=', AT_GOAL_M], gapAtMost(limit), NO_COLLISION);
    case 'red':
      return all(['red_lights', '>=', 1]);
  }
}

/** The miss of a condition about one road user leads to a case; that of a pair would lead to any other pair. */
export const methodFor = ({ other }: Sought): Schemas['SamplingMethod'] => (other === null ? 'search' : 'sobol');

/** The document of a try, without a picked future for the varied road user; null where its start is occupied. */
export function withTry(scene: Scene, id: string, { conditions, seed }: NonNullable<Try['request']>): Scene | null {
  const a = scene.agents.get(id)!;
  const { start, goal } = conditions[id] ?? {};
  const [x, y] = [start?.x_m ?? null, start?.y_m ?? null];
  const pos = x === null || y === null ? a.start.pos : Object.freeze([x, y] as const);
  const begun = { ...a.start, pos, speed: start?.speed_mps ?? a.start.speed };
  const s = setStart(a, begun).apply(patchScene('', { seed }).apply(scene));
  const at = s.agents.get(id)!;
  if (pos !== a.start.pos && !isFree(scene, at)) return null;
  // Goal times are multiples of 0.1 s; the generator rounds them.
  const time = goal?.time_s == null || !at.goal.pos ? at.goal.time : Math.round(goal.time_s * 10) / 10;
  return setGoal(at, { ...at.goal, time }).apply(s);
}

function isFree(scene: Scene, a: Agent): boolean {
  const pose = startPose(a);
  return [...scene.agents.values()].every((b) => {
    const p = b.id === a.id ? null : startPose(b);
    return !p || !pose || !touching({ ...a, pose }, { ...b, pose: p });
  });
}
