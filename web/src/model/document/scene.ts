// The document: what the user made. Frozen and structurally shared; motion that the generator worked out
// is not part of it, it is looked up by the document's key (see futures.ts).
import type { AgentType, Kind } from '../base/kinds';
import type { LaneMap } from './lanemap';
import { DEFAULTS } from '../base/domain';
import type { Feedback } from './feedback';
import type { AgentJson } from './scene-json';
import { wrapAngle, type Pose, type Vec } from '../base/geometry';
import { STEP_S, type Columns, type Motion } from '../base/motion';
import type { Profile } from './profile';
import { NO_VIAS, type Via } from './vias';

export type Others = 'react' | 'log' | 'still';

/** A field that is null is Free: the generator decides it. Position counts as one field. */
export interface StartSpec {
  readonly pos: Vec | null;
  readonly heading: number | null;
  readonly speed: number | null;
}
export interface GoalSpec extends StartSpec {
  readonly time: number;
  /** Ids of the road edges that it may go over on its way there. */
  readonly mayCross: readonly string[];
  /** Places on the way there, or on the way that the generator chooses. */
  readonly via: readonly Via[];
}

export interface Agent {
  readonly id: string;
  readonly type: AgentType;
  readonly kind: Kind;
  /** What the scene's author calls it; the kind is a guess from the size where nothing is said. */
  readonly subtype: string | null;
  readonly name: string;
  /** The name that was given by hand; null where the kind and the number are the name. */
  readonly called: string | null;
  readonly note: string;
  /** Refuses to be moved, changed and removed. */
  readonly locked: boolean;
  /** What it does while others change, where that is another thing than what the scene says of all. */
  readonly does: Others | null;
  readonly length: number;
  readonly width: number;
  readonly logSize: readonly [number, number];
  readonly logType: AgentType;
  readonly logSubtype: string | null;
  /** Put here by hand or by a program: nothing of it was recorded, so the generator decides all that it does. */
  readonly placed: boolean;
  /** As it came in the file; null for one that was put here since. */
  readonly source: AgentJson | null;
  readonly log: Motion;
  /** State at 0 s in the log; null when the road user appears later. */
  readonly logStart: Pose | null;
  readonly parked: boolean;
  readonly ego: boolean;
  readonly start: StartSpec;
  readonly goal: GoalSpec;
  /** Index of the future the user picked; null leaves the choice to the generator. */
  readonly chosen: number | null;
  /** How fast it goes along it, where that was drawn by hand; it goes with the pick. */
  readonly profile: Profile | null;
  /** Names the round of cards that its futures are from, where one of those was picked. */
  readonly dealt: string | null;
  /** Futures that stay while others are drawn anew, in the order in which they were pinned. */
  readonly pins: readonly Pin[];
  /** What was said of its futures in rounds; null where nothing was. */
  readonly feedback: Feedback | null;
}

/** A future that stays: its motion, and what it was made for. */
export interface Pin {
  /** Names the motion. */
  readonly key: string;
  /** What it was called. */
  readonly name: string;
  readonly track: Columns;
  readonly type: AgentType;
  readonly start: StartSpec;
  readonly goal: GoalSpec;
}

export interface Signal {
  readonly lane: string;
  readonly stop: Vec | null;
  readonly states: readonly (readonly [number, string])[];
}

/** How a variant is called and what is thought of it. */
export interface Variant {
  /** Counts up in a scene and is never used twice. */
  readonly id: number;
  /** The name that was given by hand; null where what differs is the name. */
  readonly called: string | null;
  /** Stays when others are made. */
  readonly kept: boolean;
  readonly starred: boolean;
}

/** What a variant consists of. */
export interface VariantState {
  readonly seed: number;
  readonly diversity: number;
  readonly others: Others;
  readonly length: Length;
  readonly replan: Replan;
  readonly drawn: number;
  /** Whose futures the variants made with it were; null where everybody was worked out anew. */
  readonly subject: string | null;
  /** Who was in the scene, as `Scene.castKey` has it. */
  readonly roster: string;
  /** What is asked of whom; of everybody else nothing is. */
  readonly asked: Readonly<Record<string, Asked>>;
}

export type Asked = Pick<
  Agent,
  'start' | 'goal' | 'chosen' | 'dealt' | 'profile' | 'length' | 'width' | 'type' | 'kind' | 'subtype' | 'does'
>;

export interface Scene {
  readonly id: string;
  readonly name: string;
  readonly source: string;
  readonly licence: string;
  readonly steps: number;
  /** Seconds that are worked out and played: the length, or less for a shorter recording. */
  readonly duration: number;
  /** Seconds asked for; past 9 s the generator plans anew from where everybody is by then. */
  readonly length: Length;
  /** Seconds after which everybody plans anew. */
  readonly replan: Replan;
  readonly map: LaneMap;
  readonly signals: readonly Signal[];
  readonly agents: ReadonlyMap<string, Agent>;
  /** Who is in the scene and of which kind, as text: equal for equal casts. */
  readonly castKey: string;
  /** The largest number that an id has ever had here: who comes new gets a larger one, also after somebody went. */
  readonly issued: number;
  readonly seed: number;
  readonly diversity: number;
  readonly others: Others;
  /** How often everybody was worked out anew: each time is a step that can be taken back. */
  readonly drawn: number;
  /** Ways that the scene could go, in the order in which they were made. */
  readonly variants: readonly Variant[];
  /** What they consist of, by their ids. Apart from them: a star is a small step. */
  readonly variantStates: Readonly<Record<number, VariantState>>;
  /** What was said in rounds of the whole scene; null where nothing was. */
  readonly feedback: Feedback | null;
  /** What counts as an event, where that is not as usual. */
  readonly thresholds: Thresholds;
}

/** Numbers by the names that the server has for them. */
export type Thresholds = Readonly<Record<string, number>>;
export const NO_THRESHOLDS: Thresholds = Object.freeze({});

/** Seconds that the generator works out in one go, and after which a goal is due unless another time is set. */
export const GOAL_TIME = DEFAULTS.horizon_s;
/** Nearer than this to its place a goal is reached, metres. */
export const AT_GOAL_M = 1;
export const LENGTHS = [9, 12, 15, 20] as const;
export const REPLANS = [3, 6, 9] as const;
export type Length = (typeof LENGTHS)[number];
export type Replan = (typeof REPLANS)[number];

export const readLength = (v: unknown): Length => LENGTHS.find((l) => l === v) ?? 9;
export const readReplan = (v: unknown): Replan => REPLANS.find((r) => r === v) ?? 9;

/** A recording may be shorter than 9 s; past that the generator goes on by itself. */
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

/** The start pose in force: fixed fields from the document, free ones from the log. */
export function startPose(a: Agent): Pose | null {
  const l = a.logStart;
  if (!l) return null;
  const [x, y] = a.start.pos ?? [l.x, l.y];
  return { x, y, heading: wrapAngle(a.start.heading ?? l.heading), speed: a.start.speed ?? Math.abs(l.speed) };
}

/** The speed curve in force: one belongs to a picked future, and is gone when that is. */
export const profileOf = (a: Agent): Profile | null => (a.chosen === null ? null : a.profile);

/** When somebody is to be at its goal, seconds; null where no place is asked for. */
export const goalTimeOf = (a: Agent): number | null => (a.goal.pos ? a.goal.time : null);

export const hasGoal = (g: GoalSpec): boolean => g.pos !== null || g.heading !== null || g.speed !== null;

const samePos = (a: Vec | null, b: Vec | null): boolean => a === b || (!!a && !!b && a[0] === b[0] && a[1] === b[1]);
export const sameSpec = (a: StartSpec, b: StartSpec): boolean =>
  samePos(a.pos, b.pos) && a.heading === b.heading && a.speed === b.speed;

const startChanged = (a: Agent): boolean => !sameSpec(a.start, logStartSpec(a.logStart));
export const sizeChanged = (a: Agent): boolean => a.length !== a.logSize[0] || a.width !== a.logSize[1];
export const kindChanged = (a: Agent): boolean => a.type !== a.logType || a.subtype !== a.logSubtype;

/** Has the user asked anything of this road user that the log could take back? */
export const changedByHand = (a: Agent): boolean =>
  hasGoal(a.goal) || a.goal.via.length > 0 || a.chosen !== null || startChanged(a) || sizeChanged(a) || kindChanged(a);

/** Is anything asked of this road user? One without a log has nothing else to follow. */
export const touched = (a: Agent): boolean => a.placed || changedByHand(a);

/** Ids of everybody whom somebody asked something of. */
export const touchedIn = (scene: Scene): string[] =>
  [...scene.agents.values()].filter((a) => touched(a) && canChange(a)).map((a) => a.id);

export function withAgents(scene: Scene, changes: Iterable<Agent>): Scene {
  const agents = new Map(scene.agents);
  for (const a of changes) agents.set(a.id, Object.freeze(a));
  return Object.freeze({ ...scene, agents });
}

const subtypeOf = (a: Pick<Agent, 'subtype' | 'kind'>): string => a.subtype ?? a.kind;
export const castKeyOf = (agents: Iterable<Agent>): string =>
  Array.from(agents, (a) => `${a.id}:${a.type}:${subtypeOf(a)}`).join(' ');

/** Another cast; the road users in the order they are given. */
export function withCast(scene: Scene, agents: ReadonlyMap<string, Agent>, issued = scene.issued): Scene {
  return Object.freeze({ ...scene, agents, castKey: castKeyOf(agents.values()), issued });
}

/** The number at the end of an id, where it is short enough to be read. */
export const numberIn = (id: string): string | undefined => /(\d{1,5})$/.exec(id)?.[1];

/** Ids of their own for `n` who come new. */
export function newIds(scene: Scene, n: number): string[] {
  const ids: string[] = [];
  for (let k = scene.issued + 1; ids.length < n; k++) if (!scene.agents.has(String(k))) ids.push(String(k));
  return ids;
}

/** What a road user does while others change. */
export const doing = (s: Scene, a: Agent): Others => a.does ?? s.others;

/** Text that names everything the generator's answer depends on; equal keys, equal answers. */
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
  if (Object.keys(scene.thresholds).length) parts.push(scene.thresholds);
  for (const a of scene.agents.values()) {
    if (touched(a)) parts.push([a.id, a.start, a.goal, a.chosen, a.length, a.width]);
    if (profileOf(a)) parts.push([a.id, a.profile]);
    if (a.chosen !== null && a.dealt) parts.push([a.id, a.dealt]);
    if (a.does) parts.push([a.id, a.does]);
  }
  return JSON.stringify(parts);
}

/** Names all that the cards depend on in a document, wherever it is kept. */
export const printOf = (scene: Scene): string => shortFor(sceneKey({ ...scene, id: '' }));

/** A short text in place of a long one. */
export function shortFor(text: string): string {
  // FNV-1a, twice with different beginnings: 64 bits.
  let [a, b] = [0x811c9dc5, 0x9dc5811c];
  for (const ch of text) {
    const c = ch.codePointAt(0)!;
    a = Math.imul(a ^ c, 0x01000193);
    b = Math.imul(b ^ (c + 7), 0x01000193);
  }
  return [a, b].map((v) => (v >>> 0).toString(16).padStart(8, '0')).join('');
}

const MADE = ['drawn', 'placed', 'synthetic', 'sumo', 'demo', 'generated'];

/** Recorded maps know nothing of what lies beside the road; made ones are drawn with grass and pavement. */
export const isRecorded = (source: string): boolean => !MADE.includes(source);

/** Held still nobody comes in from outside: it would run into those that stand. */
export const staysAway = (s: Scene, a: Agent): boolean =>
  doing(s, a) === 'still' && a.type !== 'other' && a.logStart === null;

/** What road users are called, by id; null for one that is not there. */
export const nameIn =
  (s: Scene) =>
  (id: string): string | null =>
    s.agents.get(id)?.name ?? null;

export const canChange = (a: Agent): boolean => a.type !== 'other' && a.logStart !== null;

/** May it be moved and asked things? */
export const canMove = (a: Agent): boolean => canChange(a) && !a.locked;
