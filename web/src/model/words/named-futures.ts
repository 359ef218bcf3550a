// Futures from the server and from files, with names.
import { unnamedFutures, type Futures, type KeepOrder, type MotionSet } from '../document/futures';
import { nearestLanes, type LaneMap } from '../document/lanemap';
import { isRecorded, nameIn, type Agent, type Scene } from '../document/scene';
import type { AgentFuturesJson, SceneJson } from '../document/scene-json';
import { savedFutures, savedVariantFutures } from '../document/scene-reader';
import type { Pose } from '../base/geometry';
import { nameAll, type Naming } from './future-names';

/** What the names of a road user's futures depend on. */
export const naming = (scene: Scene, a: Agent): Naming => ({
  onFoot: a.type === 'pedestrian',
  nameOf: nameIn(scene),
  // Examples and placed road users have no recorded motion.
  log: isRecorded(scene.source) && !a.placed ? a.log : null,
  inLane: (p) => isInLane(scene.map, p),
});

/** Nearer to a line than this is no longer clearly in the lane, metres. */
const BESIDE_LINE_M = 0.5;
/** Lanes are looked for within this distance: half of the widest, metres. */
const LANES_WITHIN_M = 4;

function isInLane(map: LaneMap, { x, y, heading }: Pose): boolean {
  const [hit] = nearestLanes(map, x, y, heading, LANES_WITHIN_M, (l) => l.kind !== 'walk');
  return hit !== undefined && hit.d < hit.lane.width / 2 - BESIDE_LINE_M;
}

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
  const futures = [...set.futures].map(([id, f]): [string, Futures] => {
    const a = scene.agents.get(id);
    return [id, a ? withNames(f, naming(scene, a)) : f];
  });
  return { ...set, futures: new Map(futures) };
}
