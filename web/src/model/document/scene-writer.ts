// Document -> JSON: conditions for a request, and the whole scene for saving.
import type {
  AgentFuturesJson,
  AgentJson,
  ConditionJson,
  EditorJson,
  GeneratedJson,
  GoalJson,
  MapJson,
  MapRef,
  PinJson,
  ReactionJson,
  SampleJson,
  SceneJson,
  StartJson,
  TrackJson,
  VariantJson,
} from './scene-json';
import { ruleOf } from './lanemap';
import { DEFAULTS } from '../base/domain';
import { trackJson } from '../base/motion';
import {
  GOAL_TIME,
  hasGoal,
  sameSpec,
  doing,
  kindChanged,
  logStartSpec,
  sizeChanged,
  startPose,
  staysAway,
  touched,
  profileOf,
  type Agent,
  type Pin,
  type Scene,
} from './scene';
import type { Futures, MotionSet } from './futures';
import { viasJson } from './vias';

/** The conditions of a road user: a number fixes a field, null leaves it free, absent means "as recorded". */
const conditions = new WeakMap<Agent, ConditionJson>();

export function conditionOf(a: Agent): ConditionJson {
  let known = conditions.get(a);
  if (!known) conditions.set(a, (known = Object.freeze(writtenCondition(a))));
  return known;
}

function writtenCondition(a: Agent): ConditionJson {
  const c: ConditionJson = {};
  // A placed road user is written completely: its track in the file is only its start.
  if (a.type !== a.logType && !a.placed && a.type !== 'other') c.type = a.type;
  if (sizeChanged(a) || a.placed) {
    c.length_m = a.length;
    c.width_m = a.width;
  }
  if (a.placed || !sameSpec(a.start, logStartSpec(a.logStart))) {
    const s: StartJson = { heading_rad: a.start.heading, speed_mps: a.start.speed };
    s.x_m = a.start.pos?.[0] ?? null;
    s.y_m = a.start.pos?.[1] ?? null;
    c.start = s;
  }
  if (hasGoal(a.goal) || a.goal.time !== GOAL_TIME) {
    const { relation } = a.goal;
    const g: GoalJson = relation?.after_s == null ? { time_s: a.goal.time } : {};
    if (relation) g.relation = relation;
    if (a.goal.pos) {
      g.x_m = a.goal.pos[0];
      g.y_m = a.goal.pos[1];
      if (a.goal.mayCross.length) g.may_cross = [...a.goal.mayCross];
    }
    if (a.goal.heading !== null) g.heading_rad = a.goal.heading;
    if (a.goal.speed !== null) g.speed_mps = a.goal.speed;
    c.goal = g;
  }
  if (a.goal.via.length) c.via = viasJson(a.goal.via);
  return c;
}

export const isEmptyCondition = (c: ConditionJson): boolean => Object.keys(c).length === 0;

const round = (v: number, k: number): number => Math.round(v * k) / k;
function futuresJson(f: Futures, chosen: number): AgentFuturesJson {
  return {
    chosen,
    modes: f.modes.map((m) => ({
      probability: m.probability,
      ...(m.anchor == null ? {} : { anchor: m.anchor }),
      ...m.sent,
      ...trackJson(m.motion, 1),
    })),
  };
}

/** Futures in the server's stored form, so that the next request starts from the shown ones. */
export function generatedJson(
  scene: Scene,
  futures: Iterable<readonly [string, Futures]>,
  head?: Readonly<Record<string, unknown>>,
  answering?: MotionSet['answering'],
): GeneratedJson | null {
  const agents: Record<string, AgentFuturesJson> = {};
  for (const [id, f] of futures) {
    const a = scene.agents.get(id);
    if (!a || !f.modes.length) continue;
    const json = futuresJson(f, Math.min(f.modes.length - 1, a.chosen ?? f.chosen));
    agents[id] = { ...json, ...reactionOf(answering, id) };
  }
  if (!Object.keys(agents).length) return null;
  return {
    input_sha256: '',
    weights: {},
    seed: scene.seed,
    request: { steps: DEFAULTS.steps, diversity: scene.diversity },
    created_at: '1970-01-01T00:00:00Z',
    ...head,
    // The server cannot know that a picked future still meets the conditions; the writer does.
    stale: false,
    chosen_sample: 0,
    samples: [{ agents }],
  };
}

function reactionOf(answering: MotionSet['answering'] | undefined, id: string): { reaction?: ReactionJson } {
  const reaction = answering?.get(id)?.said;
  return reaction ? { reaction } : {};
}

/** The motions of all in a variant; for road users without conditions only the followed future. */
export function variantSample(scene: Scene, set: MotionSet): SampleJson {
  const agents: SampleJson['agents'] = {};
  for (const id of set.driving) {
    const [a, f] = [scene.agents.get(id), set.futures.get(id)];
    if (!a || !f?.modes.length) continue;
    const chosen = Math.min(f.modes.length - 1, a.chosen ?? f.chosen);
    const json = touched(a) ? futuresJson(f, chosen) : futuresJson({ ...f, modes: [f.modes[chosen]] }, 0);
    agents[id] = { ...json, ...reactionOf(set.answering, id) };
  }
  return { agents };
}

/** A single state, for a road user without other data. */
function startTrack(a: Agent): TrackJson {
  const p = startPose(a)!;
  const [x, y, h, v] = [round(p.x, 1000), round(p.y, 1000), round(p.heading, 10000), Math.abs(p.speed)];
  const velocity = { vx_mps: [round(v * Math.cos(h), 1000)], vy_mps: [round(v * Math.sin(h), 1000)] };
  return { first_step: 0, valid: [[0, 1]], x_m: [x], y_m: [y], heading_rad: [h], ...velocity };
}

/** A road user in file form, its conditions unchanged. */
function agentJson(a: Agent): AgentJson {
  if (!a.placed && a.source) return kindChanged(a) && a.subtype ? { ...a.source, subtype: a.subtype } : a.source;
  return {
    ...a.source,
    id: a.id,
    type: a.type,
    ...(a.subtype ? { subtype: a.subtype } : {}),
    length_m: a.length,
    width_m: a.width,
    track: startTrack(a),
  };
}

/** All road users, as a request sends them; conditions are separate. */
export const castJson = (scene: Scene): AgentJson[] => [...scene.agents.values()].map(agentJson);

/** A complete road user: for files and for copies. */
export const wholeAgentJson = (a: Agent): AgentJson => ({ ...agentJson(a), conditions: conditionOf(a) });

/** Signals as they were read, with the states of the scene: only these change. Of a drive also its time. */
export const timedJson = (raw: SceneJson, { drive, signals, steps }: Scene): Pick<SceneJson, 'signals' | 'time'> => ({
  ...(drive ? { time: { ...raw.time, steps } } : {}),
  ...(raw.signals
    ? {
        signals: raw.signals.map((s, i) => {
          const states = signals[i]?.states.map(([first, state]): [number, string] => [first, state]);
          return states ? { ...s, states } : s;
        }),
      }
    : {}),
});

/** The loaded scene with the user's changes written in; all else is unchanged. */
export function writeScene(
  raw: SceneJson,
  scene: Scene,
  generated: GeneratedJson | null,
  map?: MapJson | MapRef,
): SceneJson {
  return {
    ...raw,
    name: scene.name,
    map: map ?? raw.map,
    ...timedJson(raw, scene),
    agents: Array.from(scene.agents.values(), wholeAgentJson),
    generated,
    x_editor: {
      seed: scene.seed,
      diversity: scene.diversity,
      others: scene.others,
      length_s: scene.length,
      replan_s: scene.replan,
      ...(scene.drawn ? { drawn: scene.drawn } : {}),
      ...(scene.drive ? { drive: scene.drive } : {}),
      ...ofAgents(scene.agents.values()),
      ...(scene.variants.length ? { variants: variantsJson(scene) } : {}),
      ...(scene.feedback ? { scene_feedback: scene.feedback } : {}),
      ...thresholdsOf(scene),
      ...lanesWere(scene),
    },
  };
}

/** Thresholds that differ from the usual ones: for files and for requests. */
export const thresholdsOf = (s: Scene): { thresholds?: Record<string, number> } =>
  Object.keys(s.thresholds).length ? { thresholds: { ...s.thresholds } } : {};

/** What the lanes with changed rules were. */
function lanesWere({ map: { lanes }, laneRules }: Scene): Pick<EditorJson, 'lanes_were'> {
  const were = Object.keys(laneRules).flatMap((id) => (lanes.has(id) ? [[id, ruleOf(lanes.get(id)!)]] : []));
  return were.length ? { lanes_were: Object.fromEntries(were) } : {};
}

/** Variants in file form. */
export const variantsJson = (scene: Scene): VariantJson[] =>
  scene.variants.map((v) => {
    const { seed, diversity, others, length, replan, drawn, subject, castKey, asked } = scene.variantStates[v.id];
    const all = Object.entries(asked).flatMap(([id, patch]) => {
      const a = scene.agents.get(id);
      return a ? [{ ...a, ...patch }] : [];
    });
    const { picked, dealt, curves, does } = ofAgents(all);
    return {
      id: v.id,
      ...(v.called ? { name: v.called } : {}),
      ...(v.kept ? { kept: true } : {}),
      ...(v.starred ? { starred: true } : {}),
      seed,
      diversity,
      others,
      length_s: length,
      replan_s: replan,
      ...(drawn ? { drawn } : {}),
      ...(subject === null ? {} : { subject }),
      roster: castKey,
      conditions: Object.fromEntries(all.map((a) => [a.id, conditionOf(a)])),
      ...(picked ? { picked } : {}),
      ...(dealt ? { dealt } : {}),
      ...(does ? { does } : {}),
      ...(curves ? { curves } : {}),
    };
  });

const pinJson = (a: Agent, { name, type, track, start, goal }: Pin): PinJson => ({
  name,
  type,
  track: track as TrackJson,
  conditions: writtenCondition({ ...a, start, goal }),
});

/** Editor-only data of single road users. */
export function ofAgents(agents: Iterable<Agent>): Partial<EditorJson> {
  const all = [...agents];
  const entries = <T>(of: (a: Agent) => T | null | undefined): Record<string, T> | undefined => {
    const list = all.flatMap((a): [string, T][] => {
      const v = of(a);
      return v === null || v === undefined || v === '' ? [] : [[a.id, v]];
    });
    return list.length ? Object.fromEntries(list) : undefined;
  };
  const ids = (which: (a: Agent) => boolean): string[] | undefined => {
    const list = all.filter(which).map((a) => a.id);
    return list.length ? list : undefined;
  };
  const ed: Partial<EditorJson> = {
    picked: entries((a) => a.chosen),
    curves: entries(profileOf),
    dealt: entries((a) => (a.chosen === null ? null : a.dealt)),
    names: entries((a) => a.called),
    notes: entries((a) => a.note),
    locked: ids((a) => a.locked),
    does: entries((a) => a.does),
    feedback: entries((a) => a.feedback),
    pins: entries((a) => (a.pins.length ? a.pins.map((p) => pinJson(a, p)) : null)),
    placed: ids((a) => a.placed),
    was: entries((a) => (a.placed || a.subtype === a.logSubtype ? null : a.logSubtype)),
  };
  return Object.fromEntries(Object.entries(ed).filter(([, v]) => v !== undefined));
}

/** The same with held road users standing at their start. Late arrivals that hold still are left out. */
export function withStill(scene: Scene, cast: readonly AgentJson[], keep: ReadonlySet<string>): AgentJson[] {
  return cast.flatMap((json) => {
    const a = scene.agents.get(json.id);
    if (!a || doing(scene, a) !== 'still' || keep.has(json.id)) return [json];
    if (staysAway(scene, a)) return [];
    const p = startPose(a);
    if (!p) return [json];
    const same = (v: number) => json.track.x_m.map(() => v);
    return [
      {
        ...json,
        track: {
          ...json.track,
          x_m: same(p.x),
          y_m: same(p.y),
          heading_rad: same(p.heading),
          vx_mps: same(0),
          vy_mps: same(0),
        },
      },
    ];
  });
}
