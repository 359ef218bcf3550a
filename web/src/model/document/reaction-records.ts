// Those who gave up a motion for somebody else, and what they would do had nobody been asked anything. What is asked
// of one road user is answered by the others from there: the order in which a goal was dragged about must not show.
import type { Futures, MotionSet } from './futures';
import type { ReactionJson } from './scene-json';
import { takenPin } from './pins';
import { changedByHand, touched, type Agent, type Scene } from './scene';

/** Why somebody gave up the motion that it had, and which. */
export interface Answering {
  readonly said: ReactionJson;
  /** Null for the log; absent where nobody knows any more. */
  readonly gaveUp?: GivenUp | null;
}

/** A motion that was given up; it may have been an answer to another itself. */
export interface GivenUp {
  readonly futures: Futures;
  readonly answering?: Answering;
}

/** Who takes up its own motion again when `asked` are asked anew, or were taken away. */
export function thoseWhoAnswer(scene: Scene, set: MotionSet, asked: Iterable<string>): ReadonlySet<string> {
  const whom = new Set(asked);
  const out = new Set<string>();
  // Nobody is asked anything of it any more: it follows its log again.
  for (const id of whom) if (isLeftAlone(scene, set, id)) out.add(id);
  const open = [...set.answering].filter(([id, x]) => !whom.has(id) && isFree(scene.agents.get(id), x));
  for (let before = -1; before !== out.size;) {
    before = out.size;
    for (const [id, { said }] of open)
      if (whom.has(said.cause) || out.has(said.cause) || !scene.agents.has(said.cause)) out.add(id);
  }
  return out;
}

/** It may take up another motion, and it is known which. */
const isFree = (a: Agent | undefined, x: Answering): boolean =>
  a !== undefined && x.gaveUp !== undefined && a.chosen === null && !takenPin(a);

function isLeftAlone(scene: Scene, set: MotionSet, id: string): boolean {
  const a = scene.agents.get(id);
  return a !== undefined && set.driving.has(id) && followsLog(scene, a);
}

/** Without being asked anything everybody follows the log, and goes on from its end where that is asked. */
const followsLog = (scene: Scene, a: Agent): boolean => !touched(a) && !scene.drawn;

/** The same with those of `ids` doing what they gave up. */
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

/** What somebody does who is about to give it up. */
export function toBeGivenUp(set: MotionSet, id: string): GivenUp | null {
  const futures = set.driving.has(id) ? set.futures.get(id) : undefined;
  const answering = set.answering.get(id);
  return futures ? { futures, ...(answering ? { answering } : {}) } : null;
}

/** Is the one way that somebody goes all that is known of it? Whoever answers another is not asked for alternatives. */
export const goesOneWay = (set: MotionSet, a: Agent): boolean =>
  !changedByHand(a) && set.driving.has(a.id) && set.futures.get(a.id)?.modes.length === 1;

/** What a file says of those who answer. Without another motion in it they can only have given up their log. */
export function readAnswering(scene: Scene, a: Agent, said: ReactionJson): Answering {
  return followsLog(scene, a) ? { said, gaveUp: null } : { said };
}
