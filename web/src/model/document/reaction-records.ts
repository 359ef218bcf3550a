// Road users that gave up a motion for another, and what they would do without conditions. A change of one road user
// starts the others from there, so that the order of a drag's steps does not affect the answer.
import type { Answering, GivenUp, MotionSet } from './futures';
import type { ReactionJson } from './scene-json';
import { takenPin } from './pins';
import { changedByHand, touched, type Agent, type Scene } from './scene';

/** Road users that return to their former motion when `asked` are computed again, or were removed. */
export function thoseWhoAnswer(scene: Scene, set: MotionSet, asked: Iterable<string>): ReadonlySet<string> {
  const whom = new Set(asked);
  const out = new Set<string>();
  // Without conditions it replays the recording again.
  for (const id of whom) if (isLeftAlone(scene, set, id)) out.add(id);
  const open = [...set.answering].filter(([id, x]) => !whom.has(id) && isFree(scene.agents.get(id), x));
  for (let before = -1; before !== out.size;) {
    before = out.size;
    for (const [id, { said }] of open)
      if (whom.has(said.cause) || out.has(said.cause) || !scene.agents.has(said.cause)) out.add(id);
  }
  return out;
}

/** It may return to another motion, which is known. */
const isFree = (a: Agent | undefined, x: Answering): boolean =>
  a !== undefined && x.gaveUp !== undefined && a.chosen === null && !takenPin(a);

function isLeftAlone(scene: Scene, set: MotionSet, id: string): boolean {
  const a = scene.agents.get(id);
  return a !== undefined && set.driving.has(id) && followsLog(scene, a);
}

/** Without conditions all replay the recording, and continue from its end where the scene is longer. */
const followsLog = (scene: Scene, a: Agent): boolean => !touched(a) && !scene.drawn;

/** The same, with the road users in `ids` following the motion they gave up. */
export function asIfNotAsked(set: MotionSet, ids: ReadonlySet<string> | undefined): MotionSet {
  if (!ids?.size) return set;
  const [futures, driving, answering] = [new Map(set.futures), new Set(set.driving), new Map(set.answering)];
  for (const id of ids) {
    const own = answering.get(id)?.gaveUp;
    answering.delete(id);
    if (own) {
      futures.set(id, own.futures);
      if (own.answering) answering.set(id, own.answering);
    } else {
      futures.delete(id);
      driving.delete(id);
    }
  }
  return { ...set, futures, driving, answering };
}

/** The motion that a road user is about to give up. */
export function toBeGivenUp(set: MotionSet, id: string): GivenUp | null {
  const futures = set.driving.has(id) ? set.futures.get(id) : undefined;
  const answering = set.answering.get(id);
  return futures ? { futures, ...(answering ? { answering } : {}) } : null;
}

/** Is the current motion the only known future? No alternatives are requested for a reacting road user. */
export const goesOneWay = (set: MotionSet, a: Agent): boolean =>
  !changedByHand(a) && set.driving.has(a.id) && set.futures.get(a.id)?.modes.length === 1;

/** Reactions stored in a file. Without conditions of its own only the recording can have been given up. */
export function readAnswering(scene: Scene, a: Agent, said: ReactionJson): Answering {
  return followsLog(scene, a) ? { said, gaveUp: null } : { said };
}
