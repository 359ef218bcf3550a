// Futures from the server and from files, with names.
import { unnamedFutures, type Futures, type KeepOrder, type MotionSet } from '../document/futures';
import { nameIn, type Scene } from '../document/scene';
import type { AgentFuturesJson, SceneJson } from '../document/scene-json';
import { savedFutures, savedVariantFutures } from '../document/scene-reader';
import type { Pose } from '../base/geometry';
import { nameAll, type Naming } from './future-names';

/** The same futures, named by their relations to others. */
export function withNames(f: Futures, who: Naming): Futures {
  const names = nameAll(f.modes, who);
  return { ...f, modes: f.modes.map((m, i) => ({ ...m, ...names[i] })) };
}

/** Futures as received, `step` of `steps`; a received name stays. */
export function readFutures(
  json: AgentFuturesJson,
  start: Pose | null,
  step: number,
  steps: number,
  onFoot: boolean,
  keep?: KeepOrder,
): Futures {
  const sent = unnamedFutures(json, start, step, steps, keep);
  const { modes } = withNames(sent, { onFoot, nameOf: () => null });
  return { ...sent, modes: modes.map((m, i) => ({ ...m, name: sent.modes[i].name || m.name })) };
}

/** The futures saved in a scene, if they still belong to it. */
export const readGenerated = (json: SceneJson, scene: Scene): MotionSet | null =>
  named(scene, savedFutures(json, scene));

/** The stored motion of a variant; null where there is none. */
export const readVariantSample = (json: SceneJson, id: number, scene: Scene): MotionSet | null =>
  named(scene, savedVariantFutures(json, id, scene));

function named(scene: Scene, set: MotionSet | null): MotionSet | null {
  if (!set) return null;
  const nameOf = nameIn(scene);
  const futures = [...set.futures].map(([id, f]): [string, Futures] => {
    const onFoot = scene.agents.get(id)?.type === 'pedestrian';
    return [id, withNames(f, { onFoot, nameOf })];
  });
  return { ...set, futures: new Map(futures) };
}
