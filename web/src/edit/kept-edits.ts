// Changes kept in this browser: of example scenes, and of own scenes until the server has them.
import type { AgentPatch } from '../model/commands';
import type { AgentJson, EditorJson, SceneJson } from '../model/json';
import { KIND_NAMES } from '../model/kinds';
import { kindOf, readAgent } from '../model/read';
import { changedByHand, numberIn, sceneKey, withRoster, type Agent, type Scene } from '../model/scene';
import { ofAgents, wholeAgentJson } from '../model/write';
import { forget, keep, recall } from '../net/storage';

type KeptAgent = Pick<Agent, 'id'> & AgentPatch;

interface KeptEdits {
  readonly agents: readonly KeptAgent[];
  /** Who has come, as a file has them, and who has gone. */
  readonly added?: readonly AgentJson[];
  readonly removed?: readonly string[];
  readonly editor?: Partial<EditorJson>;
  readonly seed: number;
  readonly diversity: number;
  readonly others: Scene['others'];
}

const place = (id: string): string => `edits:${id}`;

/** What the editor alone says of road users: nothing that the generator knows of. */
const saidOf = (a: Agent): boolean => a.called !== null || a.note !== '' || a.locked || a.does !== null;

/** What differs between two versions of a scene that are to be saved apart. */
export const versionOf = (scene: Scene): string =>
  sceneKey(scene) + scene.name + JSON.stringify(ofAgents([...scene.agents.values()].filter(saidOf)));

/** Keeps the changes of a scene as it was opened, or forgets them when there are none; says what became of it. */
export function keepEdits(scene: Scene, opened: SceneJson): 'kept' | 'none' | 'full' {
  const ids = new Set(opened.agents.map((a) => a.id));
  const all = [...scene.agents.values()];
  const agents = all
    .filter((a) => ids.has(a.id) && (changedByHand(a) || saidOf(a) || a.placed))
    .map((a) => {
      const { id, start, goal, chosen, length, width, type, kind, subtype, name, called, note, locked, does } = a;
      return { id, start, goal, chosen, length, width, type, kind, subtype, name, called, note, locked, does };
    });
  const come = all.filter((a) => !ids.has(a.id));
  const removed = [...ids].filter((id) => !scene.agents.has(id));
  if (!agents.length && !come.length && !removed.length) {
    forgetEdits(scene.id);
    return 'none';
  }
  const { seed, diversity, others } = scene;
  const edits: KeptEdits = {
    agents,
    added: come.map(wholeAgentJson),
    removed,
    editor: ofAgents(come),
    seed,
    diversity,
    others,
  };
  return keep(place(scene.id), edits) ? 'kept' : 'full';
}

export const forgetEdits = (id: string): void => forget(place(id));

/** The scene with the changes kept of it; null when there are none. */
export function withKeptEdits(scene: Scene): Scene | null {
  const kept = recall<KeptEdits>(place(scene.id));
  if (!kept) return null;
  const cast = new Map(scene.agents);
  for (const k of kept.agents) {
    const a = cast.get(k.id);
    if (a)
      cast.set(
        k.id,
        Object.freeze({ ...a, ...k, start: Object.freeze(k.start), goal: Object.freeze(k.goal) } as Agent),
      );
  }
  for (const id of kept.removed ?? []) cast.delete(id);
  let { issued } = scene;
  for (const json of kept.added ?? []) {
    if (scene.agents.has(json.id)) continue;
    cast.set(json.id, readAgent(json, scene.map, nameOfNew(json), kept.editor));
    issued = Math.max(issued, Number(numberIn(json.id) ?? 0));
  }
  const { seed, diversity, others } = kept;
  return Object.freeze({ ...withRoster(scene, cast, issued), seed, diversity, others });
}

/** What somebody is called who came with a new id. */
const nameOfNew = (json: AgentJson): string => `${KIND_NAMES[kindOf(json)]} ${numberIn(json.id) ?? json.id}`;
