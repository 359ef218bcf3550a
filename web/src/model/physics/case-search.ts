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
  /** Start place, along its lane. */
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
  const now = startPose(a)?.speed ?? 0;
  const wide = Math.max(SPEED_SHARE * now, Math.min(SPEED_MORE_MPS, top / 4));
  const start = {
    ...(may.speed ? { speed_mps: range(Math.max(0, now - wide), Math.min(top, now + wide)) } : {}),
    ...(may.place ? { ahead_m: range(-PLACE_MORE_M, PLACE_MORE_M) } : {}),
  };
  // The ranges replace the whole goal, and have no edges that may be crossed.
  const timed = may.time && a.goal.pos !== null && !a.goal.mayCross.length;
  const [from, to] = [a.goal.time - TIME_MORE_S, a.goal.time + TIME_MORE_S];
  const time = { time_s: range(Math.max(TIME_LEAST_S, from), Math.min(scene.duration, to)) };
  if (!may.speed && !may.place && !timed) return null;
  return {
    agents: [a.id],
    ...(may.speed || may.place ? { start } : {}),
    ...(timed ? { goal: { ...conditionOf(a).goal, ...time } as Situation['goal'] } : {}),
  };
}

/** A figure, compared with a number. */
type FigureBound = readonly [figure: string, is: '<=' | '>=' | '>' | '==', number: number];

const NO_COLLISION: FigureBound = ['actor.collisions', '==', 0];
const gapOf = ({ other }: Sought): string => (other === null ? 'actor.min_distance_m' : 'pair.gap_m');

/** What the figures of a try must be, of the chosen future of the varied road user. */
function boundsOf(s: Sought): FigureBound[] {
  const { what, limit } = s;
  switch (what) {
    case 'near':
      return [[gapOf(s), '<=', limit], [gapOf(s), '>', 0], NO_COLLISION];
    case 'collision':
      return [[gapOf(s), '<=', limit]];
    case 'first':
      return [['pair.pet_s', '<=', limit], ['pair.other_first', '==', 0], NO_COLLISION];
    case 'braking':
      return [['actor.kinematic.brake_mps2', '>=', limit], NO_COLLISION];
    case 'goal':
      return [['actor.goal_error.position_m', '<=', AT_GOAL_M], [gapOf(s), '<=', limit], NO_COLLISION];
    case 'red':
      return [['actor.red_lights', '>=', 1]];
  }
}

/** The condition on the figures of a try. */
export const conditionOn = (s: Sought): string =>
  boundsOf(s)
    .map((bound) => bound.join(' '))
    .join(' && ');

/** Where the chosen future of a try comes as near as this, metres or seconds, another one may be a case. */
const OTHER_FUTURES = 2;

/** May one of the futures of a try be a case? */
export function mayBeCase({ miss, figures }: Pick<Try, 'miss' | 'figures'>, s: Sought): boolean {
  const near = boundsOf(s).find(([figure]) => figure === gapOf(s) || figure === 'pair.pet_s');
  return miss === 0 || (near !== undefined && (figures[near[0]] ?? Infinity) <= near[2] + OTHER_FUTURES);
}

/** The document of a try, without a picked future for the varied road user; null where its start is occupied. */
export function withTry(scene: Scene, id: string, { conditions, seed }: NonNullable<Try['request']>): Scene | null {
  const a = scene.agents.get(id)!;
  const { start, goal } = conditions[id] ?? {};
  const [x, y] = [start?.x_m ?? null, start?.y_m ?? null];
  const pos = x === null || y === null ? a.start.pos : Object.freeze([x, y] as const);
  const [heading, speed] = [start?.heading_rad ?? a.start.heading, start?.speed_mps ?? a.start.speed];
  const begun = { ...a.start, pos, heading, speed };
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
