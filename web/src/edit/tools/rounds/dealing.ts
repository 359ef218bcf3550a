// From an answer to cards, and from a card to the document after it is taken.
import { patchScene, type Command } from '../../../model/document/commands';
import { DEFAULTS } from '../../../model/base/domain';
import { readEvents } from '../../../model/words/event-words';
import { LETTERS, type MotionSet } from '../../../model/document/futures';
import type { Subject } from '../../../model/document/feedback-commands';
import { naming, readFutures, withNames } from '../../../model/words/named-futures';
import { firstPose } from '../../../model/document/scene-reader';
import { sceneKey, type Scene } from '../../../model/document/scene';
import { nameVariants } from '../../../model/words/variant-names';
import { stateOfVariant } from '../../../model/document/variants';
import type { FinalEvent } from '../../../net/types';
import { motionAfter } from '../../asking/merge-answer';
import type { Take } from '../../asking/take-maker';
import type { OneHand, SceneHand } from './deck';
import { TEXTS } from '../../../texts/editing/rounds';

type HandContent<T> = Omit<T, 'print' | 'asked' | 'round'>;

/** The cards of an answer; null where it has none. */
export function handOf(
  scene: Scene,
  now: MotionSet,
  of: Subject,
  e: FinalEvent,
): HandContent<OneHand> | HandContent<SceneHand> | null {
  return of.id === null ? scenes(scene, now, e) : futures(scene, of.id, e);
}

function futures(scene: Scene, id: string, e: FinalEvent): HandContent<OneHand> | null {
  const a = scene.agents.get(id);
  const json = e.samples[0]?.agents[id];
  const start = a && json && firstPose(a, json);
  if (!start) return null;
  const { steps } = DEFAULTS;
  const all = withNames(readFutures(json, start, steps, steps, a.type === 'pedestrian'), naming(scene, a));
  return { id, futures: { ...all, chosen: 0 }, names: all.modes.map((m) => m.name) };
}

/** Each sample is a separate scene. */
function scenes(scene: Scene, now: MotionSet, e: FinalEvent): HandContent<SceneHand> {
  const asked = { agents: 'all', react: false, step: null } as const;
  const sets = e.samples.map((sample, i) => {
    const one = { ...e, samples: [sample], scores: e.scores ? [e.scores[i]] : undefined } as FinalEvent;
    return motionAfter(now, scene, one, asked, () => 'rank');
  });
  const state = stateOfVariant(scene, null);
  const nameless = sets.map((set, i) => ({ id: i + 1, state, scene, set, events: readEvents(scene, set) }));
  return { id: null, sets, names: nameVariants(nameless, undefined, TEXTS.sceneNumber) };
}

/** The document of a whole-scene card: all road users are drawn again, once more for each card. */
export function sceneTaken(scene: Scene, hand: SceneHand, index: number): { command: Command; take: Take } {
  const name = TEXTS.cardOfARound(LETTERS[index]);
  const command = patchScene(name, { drawn: scene.drawn + 1 + index });
  const after = command.apply(scene);
  return { command, take: { scene: after, set: { ...hand.sets[index], key: sceneKey(after) } } };
}
