// The document: the user's input. Frozen and structurally shared; generated motion is not part of it, but is looked up
// by the document's key (see futures.ts).
import type { AgentType, Kind } from '../base/kinds';
import { isEmptyRules, withRules, type LaneMap, type LaneRules } from './lanemap';
import { DEFAULTS } from '../base/domain';
import type { Feedback } from './feedback';
import type { AgentJson, GoalRelationJson } from './scene-json';
import { wrapAngle, type Pose, type Vec } from '../base/geometry';
import { STEP_S, type Columns, type Motion } from '../base/motion';
import type { Profile } from './profile';
import { NO_VIAS, type Via } from './vias';

export type Others = 'react' | 'log' | 'still';

/** A null field is Free: the generator decides it. Position counts as one field. */
export interface StartSpec {
  readonly pos: Vec | null;
  readonly heading: number | null;
  readonly speed: number | null;
}
export interface GoalSpec extends StartSpec {
  readonly time: number;
  /** Ids of road edges that it may cross on its way there. */
  readonly mayCross: readonly string[];
  /** Via points on the way there, or on the way that the generator chooses. */
  readonly via: readonly Via[];
  /** The other road user that the goal is relative to. It gives the place, or, after a passing, the time. */
  readonly relation?: Readonly<GoalRelationJson>;
}

export interface Agent {
  readonly id: string;
  readonly type: AgentType;
  readonly kind: Kind;
  /** The subtype of the file; without one the kind is inferred from the size. */
  readonly subtype: string | null;
  readonly name: string;
  /** Name given by the user; null where kind and number form the name. */
  readonly called: string | null;
  readonly note: string;
  /** Cannot be moved, changed or removed. */
  readonly locked: boolean;
  /** Its behaviour when others change, where it differs from the scene's. */
  readonly does: Others | null;
  readonly length: number;
  readonly width: number;
  readonly logSize: readonly [number, number];
  readonly logType: AgentType;
  readonly logSubtype: string | null;
  /** Placed by a user or a program: without a recording, so the generator decides its whole motion. */
  readonly placed: boolean;
  /** As read from the file; null for one placed since. */
  readonly source: AgentJson | null;
  readonly log: Motion;
  /** Recorded state at 0 s; null when the road user appears later. */
  readonly logStart: Pose | null;
  readonly parked: boolean;
  readonly ego: boolean;
  readonly start: StartSpec;
  readonly goal: GoalSpec;
  /** Index of the picked future; null leaves the choice to the generator. */
  readonly chosen: number | null;
  /** Drawn speed profile along the picked future; removed with the pick. */
  readonly profile: Profile | null;
  /** Round id of the cards that the picked future is from. */
  readonly dealt: string | null;
  /** Pinned futures, in the order of pinning. */
  readonly pins: readonly Pin[];
  /** Feedback on its futures; null where there is none. */
  readonly feedback: Feedback | null;
}

/** A pinned future: its motion, and what it was made for. */
export interface Pin {
  /** Identifies the motion. */
  readonly key: string;
  /** Its name when it was pinned. */
  readonly name: string;
  readonly track: Columns;
  readonly type: AgentType;
  readonly start: StartSpec;
  readonly goal: GoalSpec;
}

export interface Signal {
  readonly lane: string;
  readonly stop: Vec | null;
  /** From this step on, this state. */
  readonly states: readonly (readonly [number, string])[];
  /** The user has changed its states. */
  readonly edited?: true;
}

/** Name and rating of a variant. */
export interface Variant {
  /** Increases within a scene and is never reused. */
  readonly id: number;
  /** Name given by the user; null where the difference is the name. */
  readonly called: string | null;
  /** Stays when new variants are made. */
  readonly kept: boolean;
  readonly starred: boolean;
}

/** The content of a variant. */
export interface VariantState {
  readonly seed: number;
  readonly diversity: number;
  readonly others: Others;
  readonly length: Length;
  readonly replan: Replan;
  readonly drawn: number;
  /** Subject of its set of variants; null for all road users. */
  readonly subject: string | null;
  /** Road users of the scene, as in `Scene.castKey`. */
  readonly castKey: string;
  /** Conditions by id; road users not listed have none. */
  readonly asked: Readonly<Record<string, AgentConditions>>;
}

export type AgentConditions = Pick<
  Agent,
  'start' | 'goal' | 'chosen' | 'dealt' | 'profile' | 'length' | 'width' | 'type' | 'kind' | 'subtype' | 'does'
>;

export interface Scene {
  readonly id: string;
  readonly name: string;
  readonly source: string;
  readonly licence: string;
  readonly steps: number;
  /** Computed and played seconds: the length, or less for a shorter recording. */
  readonly duration: number;
  /** Requested seconds; past 9 s the generator replans from the reached state. */
  readonly length: Length;
  /** Interval of replanning, seconds. */
  readonly replan: Replan;
  readonly map: LaneMap;
  readonly signals: readonly Signal[];
  readonly agents: ReadonlyMap<string, Agent>;
  /** Ids and kinds of the road users, as text: equal for equal casts. */
  readonly castKey: string;
  /** The largest number ever used in an id here: new ones get a larger one, also after a removal. */
  readonly issued: number;
  readonly seed: number;
  readonly diversity: number;
  readonly others: Others;
  /** Number of times that all were drawn again: each is a step that can be undone. */
  readonly drawn: number;
  /** Digest of the tracks that a drive has recorded; empty where all are as they were read. */
  readonly drive: string;
  /** Variants of the scene, in the order they were made. */
  readonly variants: readonly Variant[];
  /** Their content, by id. Stored separately, so that a star is a small step. */
  readonly variantStates: Readonly<Record<number, VariantState>>;
  /** Feedback on the whole scene; null where there is none. */
  readonly feedback: Feedback | null;
  /** Thresholds of events that differ from the usual ones. */
  readonly thresholds: Thresholds;
  /** Rules of lanes that differ from the file's; `map` has them. */
  readonly laneRules: LaneRules;
}

/** Numbers by the server's names. */
export type Thresholds = Readonly<Record<string, number>>;
export const NO_THRESHOLDS: Thresholds = Object.freeze({});

/** Planning horizon of the generator, seconds, and the default goal time. */
export const GOAL_TIME = DEFAULTS.horizon_s;
/** A goal within this distance is reached, metres. */
export const AT_GOAL_M = 1;
export const LENGTHS = [9, 12, 15, 20] as const;
export const REPLANS = [3, 6, 9] as const;
export type Length = (typeof LENGTHS)[number];
export type Replan = (typeof REPLANS)[number];

export const readLength = (v: unknown): Length => LENGTHS.find((l) => l === v) ?? 9;
export const readReplan = (v: unknown): Replan => REPLANS.find((r) => r === v) ?? 9;

/** A recording may be shorter than 9 s; beyond that the generator continues. */
export const durationOf = (length: Length, steps: number): number =>
  length > GOAL_TIME ? length : Math.min(GOAL_TIME, Math.max(1, steps - 1) * STEP_S);
const NO_EDGES: readonly string[] = Object.freeze([]);

export const freeGoal = (time = GOAL_TIME): GoalSpec =>
  Object.freeze({ pos: null, heading: null, speed: null, time, mayCross: NO_EDGES, via: NO_VIAS });

export function logStartSpec(p: Pose | null): StartSpec {
  return Object.freeze(
    p
      ? { pos: Object.freeze([p.x, p.y]) as Vec, heading: p.heading, speed: Math.abs(p.speed) }
      : { pos: null, heading: null, speed: null },
  );
}

/** The effective start pose: fixed fields from the document, free ones from the recording. */
export function startPose(a: Agent): Pose | null {
  const l = a.logStart;
  if (!l) return null;
  const [x, y] = a.start.pos ?? [l.x, l.y];
  return { x, y, heading: wrapAngle(a.start.heading ?? l.heading), speed: a.start.speed ?? Math.abs(l.speed) };
}

/** The effective speed profile: it belongs to a picked future, and disappears with the pick. */
export const profileOf = (a: Agent): Profile | null => (a.chosen === null ? null : a.profile);

/** Has the goal a place, of its own or by its relation? */
export const isPlaced = (g: GoalSpec): boolean => g.pos !== null || g.relation !== undefined;

/** Goal time, seconds; null without a goal position. */
export const goalTimeOf = (a: Agent): number | null => (isPlaced(a.goal) ? a.goal.time : null);

export const hasGoal = (g: GoalSpec): boolean => isPlaced(g) || g.heading !== null || g.speed !== null;

const samePos = (a: Vec | null, b: Vec | null): boolean => a === b || (!!a && !!b && a[0] === b[0] && a[1] === b[1]);
export const sameSpec = (a: StartSpec, b: StartSpec): boolean =>
  samePos(a.pos, b.pos) && a.heading === b.heading && a.speed === b.speed;

const startChanged = (a: Agent): boolean => !sameSpec(a.start, logStartSpec(a.logStart));
export const sizeChanged = (a: Agent): boolean => a.length !== a.logSize[0] || a.width !== a.logSize[1];
export const kindChanged = (a: Agent): boolean => a.type !== a.logType || a.subtype !== a.logSubtype;

/** Has the user set a condition that "as recorded" would remove? */
export const changedByHand = (a: Agent): boolean =>
  hasGoal(a.goal) || a.goal.via.length > 0 || a.chosen !== null || startChanged(a) || sizeChanged(a) || kindChanged(a);

/** Has this road user a condition? One without a recording has nothing else to follow. */
export const touched = (a: Agent): boolean => a.placed || changedByHand(a);

/** Ids of all road users with conditions. */
export const touchedIn = (scene: Scene): string[] =>
  [...scene.agents.values()].filter((a) => touched(a) && canChange(a)).map((a) => a.id);

export function withAgents(scene: Scene, changes: Iterable<Agent>): Scene {
  const agents = new Map(scene.agents);
  for (const a of changes) agents.set(a.id, Object.freeze(a));
  return Object.freeze({ ...scene, agents });
}

/** A scene whose map has its rules. */
export const withItsRules = (scene: Scene): Scene => ({ ...scene, map: withRules(scene.map, scene.laneRules) });

const subtypeOf = (a: Pick<Agent, 'subtype' | 'kind'>): string => a.subtype ?? a.kind;
export const castKeyOf = (agents: Iterable<Agent>): string =>
  Array.from(agents, (a) => `${a.id}:${a.type}:${subtypeOf(a)}`).join(' ');

/** Another cast; road users in the given order. */
export function withCast(scene: Scene, agents: ReadonlyMap<string, Agent>, issued = scene.issued): Scene {
  return Object.freeze({ ...scene, agents, castKey: castKeyOf(agents.values()), issued });
}

/** The number at the end of an id, where it is short enough to read. */
export const numberIn = (id: string): string | undefined => /(\d{1,5})$/.exec(id)?.[1];

/** Unique ids for `n` new road users. */
export function newIds(scene: Scene, n: number): string[] {
  const ids: string[] = [];
  for (let k = scene.issued + 1; ids.length < n; k++) if (!scene.agents.has(String(k))) ids.push(String(k));
  return ids;
}

/** Behaviour of a road user when others change. */
export const doing = (s: Scene, a: Agent): Others => a.does ?? s.others;

/** Text of all inputs of the generator's answer; equal keys, equal answers. */
const keys = new WeakMap<Scene, string>();

export function sceneKey(scene: Scene): string {
  let key = keys.get(scene);
  if (key === undefined) keys.set(scene, (key = keyOf(scene)));
  return key;
}

function keyOf(scene: Scene): string {
  const parts: unknown[] = [
    scene.id,
    scene.seed,
    scene.diversity,
    scene.others,
    scene.length,
    scene.replan,
    scene.drawn,
  ];
  parts.push(scene.castKey);
  if (scene.drive) parts.push(scene.drive);
  if (Object.keys(scene.thresholds).length) parts.push(scene.thresholds);
  if (!isEmptyRules(scene.laneRules)) parts.push(scene.laneRules);
  for (const s of scene.signals) if (s.edited) parts.push([s.lane, s.states]);
  for (const a of scene.agents.values()) {
    if (touched(a)) parts.push([a.id, a.start, a.goal, a.chosen, a.length, a.width]);
    if (profileOf(a)) parts.push([a.id, a.profile]);
    if (a.chosen !== null && a.dealt) parts.push([a.id, a.dealt]);
    if (a.does) parts.push([a.id, a.does]);
  }
  return JSON.stringify(parts);
}

/** Key of all inputs of the cards in a document, independent of its id. */
export const printOf = (scene: Scene): string => shortFor(sceneKey({ ...scene, id: '' }));

/** A short digest of a long text. */
export function shortFor(text: string): string {
  // FNV-1a, twice with different offsets: 64 bits.
  let [a, b] = [0x811c9dc5, 0x9dc5811c];
  for (const ch of text) {
    const c = ch.codePointAt(0)!;
    a = Math.imul(a ^ c, 0x01000193);
    b = Math.imul(b ^ (c + 7), 0x01000193);
  }
  return [a, b].map((v) => (v >>> 0).toString(16).padStart(8, '0')).join('');
}

const MADE = ['drawn', 'placed', 'synthetic', 'sumo', 'demo', 'generated'];

/** Recorded maps lack the surroundings of the road; made ones are drawn with grass and pavement. */
export const isRecorded = (source: string): boolean => !MADE.includes(source);

/** With "hold still" late arrivals stay out: they would drive into standing ones. */
export const staysAway = (s: Scene, a: Agent): boolean =>
  doing(s, a) === 'still' && a.type !== 'other' && a.logStart === null;

/** The name of a road user by its id; null for an unknown one. */
export type NameOf = (id: string) => string | null;

/** Names of road users by id; null for an absent one. */
export const nameIn =
  (s: Scene): NameOf =>
  (id) =>
    s.agents.get(id)?.name ?? null;

export const canChange = (a: Agent): boolean => a.type !== 'other' && a.logStart !== null;

/** Can it be moved and given conditions? */
export const canMove = (a: Agent): boolean => canChange(a) && !a.locked;
