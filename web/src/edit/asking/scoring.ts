// Scores motions that are already known.
import type { MotionSet, Score } from '../../model/document/futures';
import { canChange, doing, sceneKey, touchedIn, type Scene } from '../../model/document/scene';
import { thresholdsOf } from '../../model/document/scene-writer';
import { motionOf } from '../../model/physics/playback';
import { trackJson } from '../../model/base/motion';
import type { Generator } from '../../net/generator';
import { readScore } from './read-answer';
import type { SceneFile } from '../document/scene-file';

/** The motions of the document: conditioned road users follow their futures where there are any. */
export function followed(scene: Scene, set: MotionSet): MotionSet {
  const asked = touchedIn(scene).filter((id) => set.futures.has(id));
  return { ...set, key: sceneKey(scene), driving: new Set([...set.driving, ...asked]), stale: false };
}

/** Requests the events of the motions in `set`; null where the answer has none. */
export async function scoreOf(
  generator: Generator,
  file: SceneFile,
  scene: Scene,
  set: MotionSet,
  signal = new AbortController().signal,
): Promise<Score | null> {
  // Late arrivals that react are in `driving`.
  const own = [...scene.agents.values()].filter(
    (a) => set.driving.has(a.id) || (canChange(a) && (a.placed || doing(scene, a) === 'still')),
  );
  const tracks = Object.fromEntries(own.map((a) => [a.id, trackJson(motionOf(scene, set, a))]));
  return readScore(await generator.score(file.reference(scene), tracks, thresholdsOf(scene), signal));
}
