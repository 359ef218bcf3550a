// The difference between two versions of a document, in both directions. Plain data that a browser can store, whatever
// the command.
import { withCast, withItsRules, type Agent, type Scene } from './scene';

/** Changed members of a road user; all of them when it is added or removed; null where it is absent. */
type AgentChange = Partial<Agent> | null;
export type HistoryDirection = 'back' | 'forth';

interface AgentDiff {
  readonly id: string;
  readonly back: AgentChange;
  readonly forth: AgentChange;
}

type Fields = Partial<Omit<Scene, 'agents' | 'castKey' | 'map' | 'id'>>;

export interface SceneDiff {
  readonly agents: readonly AgentDiff[];
  readonly back: Fields;
  readonly forth: Fields;
  /** All ids in order, where road users are added or removed. */
  readonly order?: Readonly<Record<HistoryDirection, readonly string[]>>;
}

/** Never part of a step: another map is another scene, and `castKey` follows from the agents. */
const FIXED: readonly string[] = ['agents', 'castKey', 'map', 'id'];

/** Values are frozen; equal ones may be different objects after storage. */
const same = (a: unknown, b: unknown): boolean =>
  a === b || (typeof a === 'object' && typeof b === 'object' && JSON.stringify(a) === JSON.stringify(b));

function differences<T extends object>(a: T, b: T, skip: readonly string[]): { back: Partial<T>; forth: Partial<T> } {
  const back: Partial<T> = {},
    forth: Partial<T> = {};
  for (const k of new Set([...Object.keys(a), ...Object.keys(b)]) as Set<keyof T & string>) {
    if (skip.includes(k) || same(a[k], b[k])) continue;
    back[k] = a[k];
    forth[k] = b[k];
  }
  return { back, forth };
}

/** Data from the file that no change of the document affects, except a drive. */
const RECORDED: readonly string[] = ['log', 'logStart', 'source'];

export function diffOf(before: Scene, after: Scene): SceneDiff {
  const agents: AgentDiff[] = [];
  for (const [id, b] of before.agents) {
    const a = after.agents.get(id);
    if (a === b) continue;
    if (!a) agents.push({ id, back: b, forth: null });
    else if (a.log !== b.log) agents.push({ id, back: b, forth: a });
    else {
      const d = differences(b, a, RECORDED);
      if (Object.keys(d.forth).length) agents.push({ id, ...d });
    }
  }
  for (const [id, a] of after.agents) if (!before.agents.has(id)) agents.push({ id, back: null, forth: a });
  const moved = agents.some((d) => !d.back || !d.forth);
  const order = moved ? { order: { back: [...before.agents.keys()], forth: [...after.agents.keys()] } } : {};
  return { agents, ...differences<Fields>(before, after, FIXED), ...order };
}

export const isEmptyDiff = (d: SceneDiff): boolean => !d.agents.length && !Object.keys(d.forth).length && !d.order;

export function applyDiff(scene: Scene, diff: SceneDiff, way: HistoryDirection): Scene {
  const agents = new Map(scene.agents);
  for (const d of diff.agents) {
    const side = d[way];
    const a = agents.get(d.id);
    if (!side) agents.delete(d.id);
    else if (a || isWhole(side)) agents.set(d.id, Object.freeze({ ...a, ...side } as Agent));
  }
  const order = diff.order?.[way];
  return withCast(withItsRules({ ...scene, ...diff[way] }), order ? inOrder(agents, order) : agents);
}

const isWhole = (side: Partial<Agent>): boolean => side.log !== undefined;

function inOrder(agents: ReadonlyMap<string, Agent>, order: readonly string[]): Map<string, Agent> {
  const out = new Map<string, Agent>();
  for (const id of [...order, ...agents.keys()]) {
    const a = agents.get(id);
    if (a) out.set(id, a);
  }
  return out;
}

/** A document without the data of its file: the map, and the recordings unless they are of a drive. */
export interface SceneState {
  readonly agents: readonly (Partial<Agent> & { readonly id: string })[];
  readonly fields: Fields;
}

export function stateOf(scene: Scene): SceneState {
  const ofFile = scene.drive ? [] : RECORDED;
  const without = <T extends object>(v: T, skip: readonly string[]) =>
    Object.fromEntries(Object.entries(v).filter(([k]) => !skip.includes(k)));
  return {
    agents: [...scene.agents.values()].map((a) => without(a, ofFile) as SceneState['agents'][number]),
    fields: without(scene, FIXED) as Fields,
  };
}

/** The document in that state. A road user missing in the file has no recording until the step that adds it. */
export function withState(file: Scene, state: SceneState): Scene {
  const agents = new Map(
    state.agents.map((s) => [s.id, Object.freeze({ ...file.agents.get(s.id), ...s } as Agent)] as const),
  );
  return withCast(withItsRules({ ...file, ...state.fields }), agents);
}

/** Have all road users a recording, as a document requires? */
export const isComplete = (scene: Scene): boolean => [...scene.agents.values()].every((a) => a.log !== undefined);
