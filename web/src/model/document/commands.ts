// Every change of the document is a command with an exact inverse.
import { KIND_NAMES, kindOf, type Kind } from '../base/kinds';
import { inOrder, type Via } from './vias';
import {
  durationOf,
  freeGoal,
  kindChanged,
  logStartSpec,
  numberIn,
  startPose,
  withAgents,
  withItsRules,
  type Agent,
  type GoalSpec,
  type Length,
  type Others,
  type Replan,
  type Scene,
  type StartSpec,
  withCast,
} from './scene';
import type { Profile } from './profile';
import { TEXTS } from '../../texts/scene/steps';

export interface Command {
  readonly name: string;
  apply(scene: Scene): Scene;
  /** The command that undoes this one: from `apply(scene)` to `scene`. */
  invert(scene: Scene): Command;
  /** Key of the changed value: within a short time a later command with this key replaces this one. */
  readonly fold?: string;
  /** A consequence of the step before: joins it, under its name. */
  readonly joins?: boolean;
}

const PATCHABLE = [
  'start',
  'goal',
  'chosen',
  'profile',
  'dealt',
  'length',
  'width',
  'type',
  'kind',
  'subtype',
  'name',
  'called',
  'note',
  'locked',
  'does',
  'feedback',
  'pins',
] as const;
export type AgentPatch = Partial<Pick<Agent, (typeof PATCHABLE)[number]>>;

export function patchAgents(name: string, patches: ReadonlyMap<string, AgentPatch>, fold?: string): Command {
  return {
    name,
    fold,
    apply(scene) {
      const changed: Agent[] = [];
      for (const [id, patch] of patches) {
        const a = scene.agents.get(id);
        if (a) changed.push({ ...a, ...patch });
      }
      if (!changed.length) return scene;
      const next = withAgents(scene, changed);
      const recast = [...patches.values()].some((p) => 'type' in p || 'kind' in p || 'subtype' in p);
      return recast ? withCast(next, next.agents) : next;
    },
    invert(scene) {
      const back = new Map<string, AgentPatch>();
      for (const [id, patch] of patches) {
        const a = scene.agents.get(id);
        if (!a) continue;
        const old: Record<string, unknown> = {};
        for (const k of PATCHABLE) if (k in patch) old[k] = a[k];
        back.set(id, old as AgentPatch);
      }
      return patchAgents(name, back);
    },
  };
}

const one = (name: string, id: string, patch: AgentPatch, fold?: string): Command =>
  patchAgents(name, new Map([[id, patch]]), fold && `${fold}:${id}`);

/** New conditions make an earlier pick among six futures meaningless, so the choice returns to the generator. */
export const setStart = (a: Agent, start: StartSpec, what = TEXTS.start): Command =>
  one(TEXTS.ofChanged(what, a.name), a.id, { start: Object.freeze(start), chosen: null }, 'start');
/** A via point loses its time when that is not before the goal's. */
const kept = (goal: GoalSpec): GoalSpec => Object.freeze({ ...related(goal), via: inOrder(goal.via, goal.time) });
/** A relation ends with a place of its own, except for a passing, which ends without one. */
function related({ relation: r, ...goal }: GoalSpec): GoalSpec {
  if (!r || (r.after_s == null) === (goal.pos !== null)) return goal;
  if (r.after_s != null) return { ...goal, relation: r };
  return { ...goal, heading: null, relation: goal.speed === null ? r : { ...r, slower_mps: null } };
}

export const setGoal = (a: Agent, goal: GoalSpec, what = TEXTS.goal): Command =>
  one(TEXTS.ofMoved(what, a.name), a.id, { goal: kept(goal), chosen: null }, 'goal');
/** A goal from a remedy: a separate step, however soon after another change of the goal. */
export const goalStep = (a: Agent, goal: GoalSpec, name: string): Command => ({
  ...setGoal(a, goal),
  name,
  fold: undefined,
});
export const setBoth = (a: Agent, start: StartSpec, goal: GoalSpec): Command =>
  one(TEXTS.moved(a.name), a.id, { start: Object.freeze(start), goal: kept(goal), chosen: null }, 'both');
export const setSize = (a: Agent, length: number, width: number): Command =>
  one(TEXTS.sizeOfChanged(a.name), a.id, { length, width, chosen: null }, 'size');
export const choose = (a: Agent, index: number | null, letter: string): Command =>
  one(
    index === null ? TEXTS.mostLikelyRestored(a.name) : TEXTS.futureChosen(letter, a.name),
    a.id,
    // Another pick among the same six keeps the round; a pick after a cleared one does not belong to it.
    { chosen: index, dealt: a.chosen === null ? null : a.dealt, profile: null },
    'choose',
  );
/** A card of a round; `dealt` is the round's id. */
export const takeDealt = (a: Agent, index: number, dealt: string, letter: string): Command =>
  one(TEXTS.futureOfARound(letter, a.name), a.id, { chosen: index, dealt, profile: null });
/** A speed curve for a future, and with it the start speed; null removes the curve and the pick. */
export function setCurve(a: Agent, index: number | null, profile: Profile | null, goalTime?: number): Command {
  if (!profile) return one(TEXTS.speedCurveOf(a.name), a.id, { chosen: null, profile: null });
  const v = profile.points[0].v;
  const start =
    Math.abs(v - (startPose(a)?.speed ?? v)) > 0.01 ? { start: Object.freeze({ ...a.start, speed: v }) } : {};
  const goal = goalTime === undefined ? {} : { goal: Object.freeze({ ...a.goal, time: goalTime }) };
  const patch = { ...start, ...goal, chosen: index, profile: Object.freeze(profile) };
  return one(TEXTS.speedCurveOfChanged(a.name), a.id, patch);
}
export const clearGoal = (a: Agent): Command =>
  one(TEXTS.goalOfCleared(a.name), a.id, { goal: withoutGoal(a), chosen: null });
/** A goal without conditions; via points stay. */
export const withoutGoal = (a: Agent): GoalSpec =>
  Object.freeze({ ...freeGoal(), via: inOrder(a.goal.via, freeGoal().time) });
/** Via points, in their order. */
export const setVias = (a: Agent, all: readonly Via[], name: string, fold?: string): Command =>
  one(name, a.id, { goal: Object.freeze({ ...a.goal, via: Object.freeze(all) }), chosen: null }, fold);

/** The recorded state. A placed road user has no recording and loses only its goal, pick and curve. */
export function recorded(a: Agent): AgentPatch {
  if (a.placed) return { goal: freeGoal(), chosen: null, profile: null };
  const kind: AgentPatch = kindChanged(a) ? { type: a.logType, subtype: a.logSubtype, ...kindOfLog(a) } : {};
  const [length, width] = a.logSize;
  return { start: logStartSpec(a.logStart), goal: freeGoal(), chosen: null, profile: null, length, width, ...kind };
}

function kindOfLog(a: Agent): Pick<Agent, 'kind' | 'name'> {
  const [length_m, width_m] = a.logSize;
  const kind = kindOf({ type: a.logType, subtype: a.logSubtype ?? undefined, length_m, width_m });
  return { kind, name: nameAs(a, kind) };
}

/** Its name if it were of another kind: the number stays. */
export const nameAs = (a: Pick<Agent, 'name' | 'called'>, kind: Kind): string =>
  a.called ?? `${KIND_NAMES[kind]} ${/\d+$/.exec(a.name)?.[0] ?? ''}`.trim();

export const resetAgent = (a: Agent): Command => one(TEXTS.resetToLog(a.name), a.id, recorded(a));

export function resetAll(scene: Scene): Command {
  const patches = new Map(
    [...scene.agents.values()].filter((a) => !a.placed && !a.locked).map((a) => [a.id, recorded(a)]),
  );
  return patchAgents(TEXTS.allReset, patches);
}

// -------------------------------------------------------------- adding and removing road users

interface Recast {
  readonly put: readonly Agent[];
  readonly drop: readonly string[];
  /** The order to keep, where it matters; otherwise new ones come last. */
  readonly order?: readonly string[];
  readonly issued: number;
}

/** Puts road users in place of those with their ids, or adds them, and removes others. */
export function recast(name: string, { put, drop, order, issued }: Recast): Command {
  return {
    name,
    apply(scene) {
      const agents = new Map(scene.agents);
      for (const id of drop) agents.delete(id);
      for (const a of put) agents.set(a.id, Object.freeze(a));
      const rest = new Set(agents.keys());
      const first = (order ?? []).filter((id) => rest.delete(id));
      const sorted = order ? new Map([...first, ...rest].map((id) => [id, agents.get(id)!])) : agents;
      return withCast(scene, sorted, issued);
    },
    invert(scene) {
      const back = [...drop, ...put.map((a) => a.id)].flatMap((id) => scene.agents.get(id) ?? []);
      const gone = put.filter((a) => !scene.agents.has(a.id)).map((a) => a.id);
      return recast(name, { put: back, drop: gone, order: [...scene.agents.keys()], issued: scene.issued });
    },
  };
}

/** New road users; their ids come from `newIds`. */
export function addAgents(scene: Scene, agents: readonly Agent[], name: string): Command {
  const issued = Math.max(scene.issued, ...agents.map((a) => Number(numberIn(a.id) ?? 0)));
  return recast(name, { put: agents, drop: [], issued });
}

/** Removes them with all their data, and goals relative to them; undo restores it. */
export function removeAgents(scene: Scene, ids: readonly string[], name: string): Command {
  const put = [...scene.agents.values()]
    .filter((a) => ids.includes(a.goal.relation?.to ?? '') && !ids.includes(a.id))
    .map((a) => ({ ...a, goal: withoutGoal(a), chosen: null }));
  return recast(name, { put, drop: ids.filter((id) => scene.agents.has(id)), issued: scene.issued });
}

type ScenePatch = Partial<
  Pick<
    Scene,
    | 'seed'
    | 'diversity'
    | 'others'
    | 'name'
    | 'length'
    | 'replan'
    | 'duration'
    | 'drawn'
    | 'drive'
    | 'steps'
    | 'signals'
    | 'variants'
    | 'variantStates'
    | 'feedback'
    | 'thresholds'
    | 'laneRules'
  >
>;

export function patchScene(name: string, patch: ScenePatch, fold?: string): Command {
  return {
    name,
    fold,
    apply: (scene) => Object.freeze(withItsRules({ ...scene, ...patch })),
    invert(scene) {
      const old: Record<string, unknown> = {};
      for (const k of Object.keys(patch) as (keyof ScenePatch)[]) old[k] = scene[k];
      return patchScene(name, old as ScenePatch);
    },
  };
}

export const setSeed = (seed: number): Command => patchScene(TEXTS.seed(seed), { seed });
export const setDiversity = (diversity: number): Command =>
  patchScene(TEXTS.diversity(Math.round(diversity * 100)), { diversity }, 'diversity');
export const setOthers = (others: Others): Command =>
  patchScene({ react: TEXTS.othersReact, log: TEXTS.othersReplay, still: TEXTS.othersHoldStill }[others], { others });
export const setReplan = (replan: Replan): Command => patchScene(TEXTS.replanEvery(replan), { replan });

/** Draws the motion of all road users again. */
export const drawAnew = (scene: Scene): Command => patchScene(TEXTS.allGeneratedAgain, { drawn: scene.drawn + 1 });

/** Other phases of signals: all road users are computed again. */
export const setSignals = (scene: Scene, signals: Scene['signals'], fold?: string): Command =>
  patchScene(TEXTS.signalPhasesChanged, { signals, drawn: scene.drawn + 1 }, fold);

/** Sets the planned time. Goals after its end move to the end. */
export function setLength(scene: Scene, length: Length): Command {
  const late = new Map(
    [...scene.agents.values()]
      .filter((a) => a.goal.time > length)
      .map((a) => [a.id, { goal: Object.freeze({ ...a.goal, time: length }) }]),
  );
  return inOneStep(
    patchScene(TEXTS.length(length), { length, duration: durationOf(length, scene.steps) }),
    patchAgents('', late),
  );
}

/** Two commands as one step. */
export function inOneStep(first: Command, second: Command, name = first.name): Command {
  return {
    name,
    apply: (scene) => second.apply(first.apply(scene)),
    invert: (scene) => inOneStep(second.invert(first.apply(scene)), first.invert(scene), name),
  };
}

export const rename = (name: string): Command => patchScene(TEXTS.renamedTo(name), { name });
