// Every change of the document is a command with an exact inverse.
import {
  durationOf,
  freeGoal,
  logStartSpec,
  withAgents,
  type Agent,
  type GoalSpec,
  type Length,
  type Others,
  type Replan,
  type Scene,
  type StartSpec,
} from './scene';

export interface Command {
  readonly name: string;
  apply(scene: Scene): Scene;
  /** The command that takes `apply(scene)` back to `scene`. */
  invert(scene: Scene): Command;
  /** Same kind of change on the same thing: the later one may replace this one within a short time. */
  readonly fold?: string;
}

type AgentPatch = Partial<Pick<Agent, 'start' | 'goal' | 'chosen' | 'length' | 'width'>>;
const PATCHABLE = ['start', 'goal', 'chosen', 'length', 'width'] as const;

function patchAgents(name: string, patches: ReadonlyMap<string, AgentPatch>, fold?: string): Command {
  return {
    name,
    fold,
    apply(scene) {
      const changed: Agent[] = [];
      for (const [id, patch] of patches) {
        const a = scene.agents.get(id);
        if (a) changed.push({ ...a, ...patch });
      }
      return changed.length ? withAgents(scene, changed) : scene;
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

/** New demands make an earlier pick among six futures meaningless, so it goes back to the generator. */
export const setStart = (a: Agent, start: StartSpec, what = 'Start'): Command =>
  one(`${what} of ${a.name} changed`, a.id, { start: Object.freeze(start), chosen: null }, 'start');
export const setGoal = (a: Agent, goal: GoalSpec, what = 'Goal'): Command =>
  one(`${what} of ${a.name} moved`, a.id, { goal: Object.freeze(goal), chosen: null }, 'goal');
/** A goal that was decided on: a step of its own, however soon after another change of the goal. */
export const goalStep = (a: Agent, goal: GoalSpec, name: string): Command => ({
  ...setGoal(a, goal),
  name,
  fold: undefined,
});
export const setBoth = (a: Agent, start: StartSpec, goal: GoalSpec): Command =>
  one(`${a.name} moved`, a.id, { start: Object.freeze(start), goal: Object.freeze(goal), chosen: null }, 'both');
export const setSize = (a: Agent, length: number, width: number): Command =>
  one(`Size of ${a.name} changed`, a.id, { length, width, chosen: null }, 'size');
export const choose = (a: Agent, index: number | null, letter: string): Command =>
  one(
    index === null ? `${a.name} back to the most likely future` : `Future ${letter} chosen for ${a.name}`,
    a.id,
    { chosen: index },
    'choose',
  );
export const clearGoal = (a: Agent): Command =>
  one(`Goal of ${a.name} cleared`, a.id, { goal: freeGoal(), chosen: null });
export const resetAgent = (a: Agent): Command =>
  one(`${a.name} back to the log`, a.id, {
    start: logStartSpec(a.logStart),
    goal: freeGoal(),
    chosen: null,
    length: a.logSize[0],
    width: a.logSize[1],
  });

export function resetAll(scene: Scene): Command {
  const patches = new Map<string, AgentPatch>();
  for (const a of scene.agents.values())
    patches.set(a.id, {
      start: logStartSpec(a.logStart),
      goal: freeGoal(),
      chosen: null,
      length: a.logSize[0],
      width: a.logSize[1],
    });
  return patchAgents('Everybody back to the log', patches);
}

type ScenePatch = Partial<
  Pick<Scene, 'seed' | 'diversity' | 'others' | 'name' | 'length' | 'replan' | 'duration' | 'drawn'>
>;

function patchScene(name: string, patch: ScenePatch, fold?: string): Command {
  return {
    name,
    fold,
    apply: (scene) => Object.freeze({ ...scene, ...patch }),
    invert(scene) {
      const old: Record<string, unknown> = {};
      for (const k of Object.keys(patch) as (keyof ScenePatch)[]) old[k] = scene[k];
      return patchScene(name, old as ScenePatch);
    },
  };
}

export const setSeed = (seed: number): Command => patchScene(`Seed ${seed}`, { seed });
export const setDiversity = (diversity: number): Command =>
  patchScene(`Diversity ${Math.round(diversity * 100)}%`, { diversity }, 'diversity');
export const setOthers = (others: Others): Command =>
  patchScene({ react: 'Others react', log: 'Others replay the log', still: 'Others hold still' }[others], { others });
export const setReplan = (replan: Replan): Command => patchScene(`Planned anew each ${replan} s`, { replan });

/** Everybody worked out anew. */
export const drawAnew = (scene: Scene): Command => patchScene('Everybody worked out anew', { drawn: scene.drawn + 1 });

/** How much is worked out. Goals that would come after the end come at the end. */
export function setLength(scene: Scene, length: Length): Command {
  const late = new Map(
    [...scene.agents.values()]
      .filter((a) => a.goal.time > length)
      .map((a) => [a.id, { goal: Object.freeze({ ...a.goal, time: length }) }]),
  );
  return both(
    patchScene(`${length} s worked out`, { length, duration: durationOf(length, scene.steps) }),
    patchAgents('', late),
  );
}

/** Two commands as one step. */
function both(first: Command, second: Command): Command {
  return {
    name: first.name,
    apply: (scene) => second.apply(first.apply(scene)),
    invert: (scene) => ({ ...both(second.invert(first.apply(scene)), first.invert(scene)), name: first.name }),
  };
}

export const rename = (name: string): Command => patchScene(`Renamed to ${name}`, { name });
