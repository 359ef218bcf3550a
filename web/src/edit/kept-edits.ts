// Changes kept in this browser: of example scenes, and of own scenes until the server has them.
import { sceneKey, touched, withAgents, type Agent, type Scene } from '../model/scene';
import { forget, keep, recall } from '../net/storage';

type KeptAgent = Pick<Agent, 'id' | 'start' | 'goal' | 'chosen' | 'length' | 'width'>;

interface KeptEdits {
  readonly agents: readonly KeptAgent[];
  readonly seed: number;
  readonly diversity: number;
  readonly others: Scene['others'];
}

const place = (id: string): string => `edits:${id}`;

/** What differs between two versions of a scene that are to be saved apart. */
export const versionOf = (scene: Scene): string => sceneKey(scene) + scene.name;

/** Keeps the changes of a scene, or forgets them when there are none; says what became of it. */
export function keepEdits(scene: Scene): 'kept' | 'none' | 'full' {
  const agents = [...scene.agents.values()]
    .filter(touched)
    .map(({ id, start, goal, chosen, length, width }) => ({ id, start, goal, chosen, length, width }));
  if (!agents.length) {
    forgetEdits(scene.id);
    return 'none';
  }
  const edits: KeptEdits = { agents, seed: scene.seed, diversity: scene.diversity, others: scene.others };
  return keep(place(scene.id), edits) ? 'kept' : 'full';
}

export const forgetEdits = (id: string): void => forget(place(id));

/** The scene with the changes kept of it; null when there are none. */
export function withKeptEdits(scene: Scene): Scene | null {
  const kept = recall<KeptEdits>(place(scene.id));
  if (!kept) return null;
  const changed: Agent[] = [];
  for (const k of kept.agents) {
    const a = scene.agents.get(k.id);
    if (a) changed.push({ ...a, ...k, start: Object.freeze(k.start), goal: Object.freeze(k.goal) });
  }
  const { seed, diversity, others } = kept;
  return Object.freeze({ ...withAgents(scene, changed), seed, diversity, others });
}
