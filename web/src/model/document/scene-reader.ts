// Scene JSON -> document. Tolerates missing members; counts unreadable ones.
import { readAnswering } from './reaction-records';
import { buildMap, formerRules, mapWith, nearestLanes, rulesIn, withRules, type LaneMap } from './lanemap';
import {
  isMapRef,
  type AgentFuturesJson,
  type AgentJson,
  type ConditionJson,
  type EditorJson,
  type MapJson,
  type PinJson,
  type SceneJson,
  type TrackJson,
  type VariantJson,
} from './scene-json';
import { DEFAULTS } from '../base/domain';
import { readFeedback } from './feedback';
import { isStill, motionFrom, poseAtStep, type Motion } from '../base/motion';
import { KIND_NAMES, kindOf, type AgentType, type Kind } from '../base/kinds';
import { type Answering, emptyMotion, unnamedFutures, type Futures, type MotionSet } from './futures';
import {
  durationOf,
  freeGoal,
  GOAL_TIME,
  logStartSpec,
  numberIn,
  readLength,
  readReplan,
  castKeyOf,
  sceneKey,
  startPose,
  type Agent,
  type GoalSpec,
  type Others,
  type Pin,
  type Scene,
  type StartSpec,
  type AgentConditions,
  type Variant,
  type VariantState,
} from './scene';
import type { Pose, Vec } from '../base/geometry';
import { keyOfPin, MOST_PINS } from './pins';
import { readThresholds } from './thresholds';
import { readVias } from './vias';
import { askedOf, MOST_VARIANTS } from './variants';
import { readProfile } from './profile';
import { TEXTS } from '../../texts/scene/reading';

export class SceneError extends Error {}

export function readScene(json: SceneJson, mapJson?: MapJson): Scene {
  if (!json || typeof json !== 'object' || !Array.isArray(json.agents)) throw new SceneError(TEXTS.thisIsNotAScene);
  if ((json.version ?? 1) > 1) throw new SceneError(TEXTS.thisSceneWas(json.version));
  const source = mapJson ?? (isMapRef(json.map) ? undefined : json.map);
  if (!source) throw new SceneError(TEXTS.theMapOfThis);
  const were = formerRules(json);
  const map = buildMap(mapWith(source, were));
  const steps =
    json.time?.steps ?? Math.max(1, ...json.agents.map((a) => (a.track?.first_step ?? 0) + (a.track?.x_m.length ?? 0)));
  const agents = new Map<string, Agent>();
  const names = namer(json.agents);
  for (const a of json.agents) agents.set(a.id, readAgent(a, map, names(a), json.x_editor ?? {}));
  const ed = json.x_editor ?? {};
  const length = readLength(ed.length_s);
  const laneRules = rulesIn(source, were);
  return Object.freeze({
    id: json.id ?? '',
    name: TEXTS.sceneName(json.id ?? '', json.name ?? TEXTS.untitled),
    source: json.meta?.source ?? 'drawn',
    licence: json.meta?.licence ?? '',
    steps,
    duration: durationOf(length, steps),
    length,
    replan: readReplan(ed.replan_s),
    map: withRules(map, laneRules),
    laneRules,
    signals: (json.signals ?? []).map((s) => ({
      lane: s.lane,
      stop: s.stop_m ? ([s.stop_m[0], s.stop_m[1]] as Vec) : null,
      states: s.states,
    })),
    agents,
    castKey: castKeyOf(agents.values()),
    issued: Math.max(0, ...Array.from(agents.keys(), (id) => Number(numberIn(id) ?? 0))),
    seed: ed.seed ?? DEFAULTS.seed,
    diversity: ed.diversity ?? DEFAULTS.diversity,
    others: readOthers(ed.others),
    drawn: ed.drawn ?? 0,
    drive: typeof ed.drive === 'string' ? ed.drive.slice(0, 32) : '',
    ...readVariants(ed.variants, agents),
    feedback: readFeedback(ed.scene_feedback),
    thresholds: readThresholds(ed.thresholds),
  });
}

/** The `castKey` of a document in JSON. */
export const castKeyOfJson = (json: SceneJson): string =>
  json.agents
    .map((a) => {
      const type = typeOf(a.conditions?.type ?? a.type);
      return `${a.id}:${type}:${a.subtype ?? kindOf({ ...a, type })}`;
    })
    .join(' ');

const readOthers = (v: string | undefined): Others => (v === 'log' || v === 'still' ? v : 'react');
const readDoes = (v: unknown): Others | null => (v === 'log' || v === 'still' || v === 'react' ? v : null);

const typeOf = (t: string | null | undefined): AgentType =>
  (['vehicle', 'pedestrian', 'cyclist'].includes(t ?? '') ? t : 'other') as AgentType;

const NO_TRACK: TrackJson = { x_m: [], y_m: [], heading_rad: [] };

/** A road user with only a fixed start. */
function startTrack({ start: s }: ConditionJson): TrackJson | null {
  if (s?.x_m == null || s.y_m == null) return null;
  const h = s.heading_rad ?? 0,
    v = s.speed_mps ?? 0;
  return { x_m: [s.x_m], y_m: [s.y_m], heading_rad: [h], vx_mps: [v * Math.cos(h)], vy_mps: [v * Math.sin(h)] };
}

/** One state and a fixed start identify placed road users. */
function isPlaced(json: AgentJson, log: Motion, ed: EditorJson): boolean {
  const single = log.valid.length === 1 && log.valid[0][0] === 0 && log.valid[0][1] === 1;
  return single && json.type !== 'other' && (json.conditions?.start?.x_m != null || !!ed.placed?.includes(json.id));
}

/** `name`: the default name. */
export function readAgent(json: AgentJson, map: LaneMap, name: string, ed: EditorJson = {}): Agent {
  const c = json.conditions ?? {};
  const log = motionFrom(json.track?.x_m?.length ? json.track : (startTrack(c) ?? json.track ?? NO_TRACK));
  const logStart = poseAtStep(log, 0);
  const placed = isPlaced(json, log, ed);
  const asked = readConditions(json, c, logStart, ed);
  const { type } = asked;
  const called = ed.names?.[json.id] || null;
  const subtype = json.subtype ?? null;
  return Object.freeze({
    id: json.id,
    ...asked,
    subtype,
    name: called ?? name,
    called,
    feedback: readFeedback(ed.feedback?.[json.id]),
    pins: readPins(ed.pins?.[json.id], logStart),
    note: ed.notes?.[json.id] ?? '',
    locked: !!ed.locked?.includes(json.id),
    logSize: [json.length_m, json.width_m] as const,
    logType: typeOf(json.type),
    logSubtype: ed.was?.[json.id] ?? subtype,
    placed,
    source: json,
    log,
    logStart,
    parked: type === 'vehicle' && !placed && isStill(log) && offLanes(map, firstSeen(log)),
    ego: json.role === 'ego',
  });
}

/** The conditions of a road user. */
function readConditions(
  json: AgentJson,
  c: ConditionJson,
  logStart: Pose | null,
  ed: Pick<EditorJson, 'picked' | 'dealt' | 'curves' | 'does'>,
): Pick<Agent, 'type' | 'kind' | 'does' | 'length' | 'width' | 'start' | 'goal' | 'chosen' | 'dealt' | 'profile'> {
  const type = c.type ? typeOf(c.type) : typeOf(json.type);
  const picked = ed.picked?.[json.id];
  const dealt = ed.dealt?.[json.id];
  return {
    type,
    kind: kindOf({ ...json, type }),
    does: readDoes(ed.does?.[json.id]),
    length: c.length_m ?? json.length_m,
    width: c.width_m ?? json.width_m,
    start: readStart(c, logStart),
    goal: readGoal(c),
    chosen: typeof picked === 'number' && picked >= 0 && picked < 6 ? Math.floor(picked) : null,
    profile: readProfile(ed.curves?.[json.id]),
    dealt: typeof dealt === 'string' && dealt ? dealt.slice(0, 32) : null,
  };
}

/** The length of the longest future, in states. */
const MOST_STATES = 202;
const isColumn = (v: unknown, n: number): boolean =>
  Array.isArray(v) && v.length === n && v.every((x) => Number.isFinite(x));

/** The readable pinned futures. */
function readPins(json: unknown, logStart: Pose | null): readonly Pin[] {
  const all = (Array.isArray(json) ? json.slice(0, MOST_PINS) : []) as Partial<PinJson>[];
  const pins = all.flatMap((p): Pin[] => {
    const t = p?.track;
    const n = t?.x_m?.length ?? 0;
    if (!t || n < 2 || n > MOST_STATES || !whole(t.first_step ?? 0, 0, MOST_STATES)) return [];
    if (![t.x_m, t.y_m, t.heading_rad, t.vx_mps, t.vy_mps].every((c) => isColumn(c, n))) return [];
    const { first_step = 0, x_m, y_m, heading_rad, vx_mps, vy_mps } = t;
    const track = Object.freeze({ first_step, x_m, y_m, heading_rad, vx_mps, vy_mps });
    const type = typeOf(p.type);
    const c = typeof p.conditions === 'object' && p.conditions ? p.conditions : {};
    const name = typeof p.name === 'string' ? p.name.slice(0, 80) : '';
    const key = keyOfPin(type, track);
    return [Object.freeze({ key, name, track, type, start: readStart(c, logStart), goal: readGoal(c) })];
  });
  return Object.freeze(pins);
}

/**
 * The pose before the first of the futures: the start, or for a late arrival its first recorded pose; null for one that
 * comes in slower than recorded, or not at all.
 */
export const firstPose = (a: Agent, f: AgentFuturesJson): Pose | null =>
  startPose(a) ?? poseAtStep(a.log, (f.modes?.[0]?.first_step ?? 0) - 1);

/** The futures saved in a scene, if they still belong to it. */
export function savedFutures(json: SceneJson, scene: Scene): MotionSet | null {
  const g = json.generated;
  return g && !g.stale ? readSample(json, scene, g.chosen_sample ?? 0) : null;
}

/** One of the answers saved in a scene; `scene` is its document. */
function readSample(json: SceneJson, scene: Scene, index: number): MotionSet | null {
  const g = json.generated;
  const agents = g?.samples?.[index]?.agents;
  if (!g || !agents) return null;
  const futures = new Map<string, Futures>();
  const answering = new Map<string, Answering>();
  for (const [id, f] of Object.entries(agents)) {
    const a = scene.agents.get(id);
    if (a && f.modes?.length) {
      futures.set(id, unnamedFutures(f, firstPose(a, f), 1, 1));
      if (f.reaction) answering.set(id, readAnswering(scene, a, f.reaction));
    }
  }
  if (!futures.size) return null;
  const head = Object.fromEntries(Object.entries(g).filter(([k]) => k !== 'samples'));
  return { ...emptyMotion(sceneKey(scene)), futures, driving: new Set(futures.keys()), answering, head };
}

/** The stored motions of a variant; null where there are none. */
export function savedVariantFutures(json: SceneJson, id: number, scene: Scene): MotionSet | null {
  const all = json.x_editor?.variants;
  const sample = Array.isArray(all) ? all.find((v) => v?.id === id)?.sample : undefined;
  return whole(sample, 1, MOST_VARIANTS) ? readSample(json, scene, sample) : null;
}

function readStart(c: ConditionJson, log: Pose | null): StartSpec {
  const base = logStartSpec(log);
  const s = c.start;
  if (!s) return base;
  const pos: Vec | null =
    s.x_m === undefined ? base.pos : s.x_m === null || s.y_m == null ? null : Object.freeze([s.x_m, s.y_m] as const);
  return Object.freeze({
    pos,
    heading: s.heading_rad === undefined ? base.heading : s.heading_rad,
    speed: s.speed_mps === undefined ? base.speed : s.speed_mps,
  });
}

function readGoal(c: ConditionJson): GoalSpec {
  const g = c.goal;
  const via = readVias(c.via);
  if (!g) return via.length ? Object.freeze({ ...freeGoal(), via }) : freeGoal();
  const pos: Vec | null = g.x_m == null || g.y_m == null ? null : Object.freeze([g.x_m, g.y_m] as const);
  return Object.freeze({
    pos,
    heading: g.heading_rad ?? null,
    speed: g.speed_mps ?? null,
    time: g.time_s ?? GOAL_TIME,
    mayCross: Object.freeze([...(g.may_cross ?? [])]),
    via,
    ...(g.relation ? { relation: Object.freeze({ ...g.relation }) } : {}),
  });
}

// -------------------------------------------------------------- variants

const whole = (v: unknown, least: number, most: number): v is number =>
  Number.isSafeInteger(v) && (v as number) >= least && (v as number) <= most;
/** Upper bound of the diversity. */
const MOST_DIVERSITY = 2;

/** The readable variants; each id once. */
function readVariants(json: unknown, agents: ReadonlyMap<string, Agent>): Pick<Scene, 'variants' | 'variantStates'> {
  const variants = new Map<number, Variant>();
  const states: Record<number, VariantState> = {};
  for (const v of (Array.isArray(json) ? json : []) as Partial<VariantJson>[]) {
    const { id, seed, diversity } = v ?? {};
    if (variants.size >= MOST_VARIANTS || !whole(id, 1, 1e9) || variants.has(id)) continue;
    if (!whole(seed, 0, Number.MAX_SAFE_INTEGER) || typeof v.roster !== 'string') continue;
    const called = typeof v.name === 'string' && v.name ? v.name.slice(0, 80) : null;
    variants.set(id, Object.freeze({ id, called, kept: v.kept === true, starred: v.starred === true }));
    states[id] = Object.freeze({
      seed,
      diversity: typeof diversity === 'number' ? Math.min(MOST_DIVERSITY, Math.max(0, diversity)) : DEFAULTS.diversity,
      others: readOthers(v.others),
      length: readLength(v.length_s),
      replan: readReplan(v.replan_s),
      drawn: whole(v.drawn, 0, 1e6) ? v.drawn : 0,
      subject: typeof v.subject === 'string' && agents.has(v.subject) ? v.subject : null,
      castKey: v.roster,
      asked: readAsked(v, agents),
    });
  }
  return { variants: Object.freeze([...variants.values()]), variantStates: Object.freeze(states) };
}

function readAsked(v: Partial<VariantJson>, agents: ReadonlyMap<string, Agent>): VariantState['asked'] {
  const asked: Record<string, AgentConditions> = {};
  for (const [id, c] of Object.entries(v.conditions ?? {})) {
    const a = agents.get(id);
    if (!a?.source || !c || typeof c !== 'object') continue;
    const ed = { picked: v.picked, dealt: v.dealt, curves: v.curves, does: v.does };
    // Read like the file's road user; the lanes matter only for parked ones.
    asked[id] = askedOf({ ...a, ...readConditions(a.source, c, a.logStart, ed) });
  }
  return Object.freeze(asked);
}

const firstSeen = (log: Motion): Pose | null => (log.valid.length ? poseAtStep(log, log.valid[0][0]) : null);

/**
 * Parked means still while seen, and off every lane centre, also for a late arrival: a queue at a red light keeps its
 * colour.
 */
function offLanes(map: LaneMap, p: Pose | null): boolean {
  return !p || nearestLanes(map, p.x, p.y, null, 1.6, (l) => l.kind === 'road').length === 0;
}

/** Names contain the number of the id where it is short and unique, else a running number. */
function namer(all: readonly AgentJson[]): (a: AgentJson) => string {
  const digits = new Map<string, number>();
  const key = (a: AgentJson) => numberIn(a.id);
  for (const a of all) {
    const k = key(a);
    if (k) digits.set(k, (digits.get(k) ?? 0) + 1);
  }
  const count = new Map<Kind, number>();
  return (a) => {
    const kind = kindOf({ ...a, type: a.conditions?.type ?? a.type });
    const k = key(a);
    if (k && digits.get(k) === 1) return `${KIND_NAMES[kind]} ${k}`;
    const n = (count.get(kind) ?? 0) + 1;
    count.set(kind, n);
    return `${KIND_NAMES[kind]} ${n}`;
  };
}
