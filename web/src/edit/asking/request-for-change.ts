// The request after a change of the document: the road users to compute again, and those that may react.
import { thoseWhoAnswer } from '../../model/document/reaction-records';
import type { MotionSet } from '../../model/document/futures';
import { takenPin } from '../../model/document/pins';
import { STEP_S } from '../../model/base/motion';
import { canChange, doing, GOAL_TIME, touchedIn, type Agent, type Scene } from '../../model/document/scene';
import type { Step } from '../document/step';
import type { Editor } from '../session/editor';
import type { Wanted } from './request-builder';

/** `nothing`: no conditions remain. `known`: the motions are known and need only a score. */
export type ChangeRequest = Wanted | 'nothing' | 'known';

export function requestForChange(
  editor: Pick<Editor, 'answers'>,
  scene: Scene,
  step: Step,
  set: MotionSet = editor.answers.motion.peek(),
): ChangeRequest {
  const asked = whatIsAsked(scene, step, set);
  if (typeof asked === 'string' || asked.agents === 'all') return asked;
  return { ...asked, anew: thoseWhoAnswer(scene, set, [...asked.agents, ...changedBy(step)]) };
}

/** Road users that a step changes. */
export const changedBy = (step: Step): Iterable<string> => (step.agent ? [step.agent] : (step.several ?? []));

function whatIsAsked(scene: Scene, step: Step, set: MotionSet): ChangeRequest {
  const known = set.futures;
  if (step.everybody) return everybodyAnew(scene, step, known);
  const mine = touchedIn(scene);
  if (!mine.length) return 'nothing';
  const others = othersThatAnswer(scene);
  if (others === 'nobody') return askedAlone(scene, mine, step, known);
  const rest = others === 'all' ? free(scene) : others;
  const picked = [...scene.agents.values()].filter((a) => a.chosen !== null).map((a) => a.id);
  const subject = step.agent ? scene.agents.get(step.agent) : undefined;
  if (subject && subject.chosen !== null && known.has(subject.id)) {
    const open = [...new Set([...mine.filter((id) => !known.has(id)), ...relatedTo(scene, [subject.id])])];
    // Past its 9 s the generator computes the continuation.
    if (!rest.length && !open.length && scene.length <= GOAL_TIME) return 'known';
    // Its future is kept; road users that meet it react, and all others keep theirs.
    const agents = [subject.id, ...open];
    const react = rest.length > 0 && whoReacts(scene, agents);
    return { agents, pinned: [subject.id], react, step, kept: new Set(picked) };
  }
  const held = heldIn(scene, known);
  const asked = whoIsAsked(scene, mine, known, step).filter((id) => !held.has(id));
  if (!asked.length && held.size) {
    // A pinned future stays unchanged when all else is drawn again: others react to it as to a picked one.
    const ids = [...held];
    return { agents: ids, pinned: ids, react: rest, step, kept: new Set(picked) };
  }
  const kept = new Set(picked.filter((id) => !asked.includes(id)));
  return { agents: asked, react: whoReacts(scene, asked), step, kept };
}

/** Road users that may react to the requested ones, in the form of the API. */
export function whoReacts(scene: Scene, asked: readonly string[]): boolean | string[] {
  const others = othersThatAnswer(scene);
  if (others === 'nobody') return false;
  const picked = [...scene.agents.values()].some((a) => a.chosen !== null && !asked.includes(a.id));
  if (others === 'all' && !picked) return true;
  return (others === 'all' ? free(scene) : others).filter((id) => !asked.includes(id));
}

/** Road users without a picked future, which may replan. Late arrivals brake for others too. */
const free = (scene: Scene): string[] =>
  [...scene.agents.values()].filter((a) => isEverThere(scene, a) && a.chosen === null).map((a) => a.id);

/** Is a movable road user present within the computed time? */
const isEverThere = (scene: Scene, a: Agent): boolean =>
  canChange(a) || (a.type !== 'other' && a.log.valid.some(([from]) => from * STEP_S < scene.length - 1e-6));

/** Road users that react to a change: all, none, or the ids set to react. */
function othersThatAnswer(scene: Scene): 'all' | 'nobody' | string[] {
  const own = [...scene.agents.values()].some((a) => a.does !== null && a.does !== scene.others);
  if (!own) return scene.others === 'react' ? 'all' : 'nobody';
  const ids = free(scene).filter((id) => doing(scene, scene.agents.get(id)!) === 'react');
  return ids.length ? ids : 'nobody';
}

/**
 * The changed road users, and those without known futures. May be empty: then all continue, longer or with reacting
 * others. After a new seed all without a picked future are drawn again.
 */
function whoIsAsked(scene: Scene, mine: readonly string[], known: ReadonlyMap<string, unknown>, step: Step): string[] {
  const open = mine.filter((id) => !known.has(id));
  const changed = [...changedBy(step)];
  const about = [...changed, ...relatedTo(scene, changed)].filter((id) => mine.includes(id));
  const all = [...new Set([...about, ...open])].filter((id) => scene.agents.get(id)!.chosen === null || !known.has(id));
  if (all.length || !step.chance) return all;
  const unpicked = mine.filter((id) => scene.agents.get(id)!.chosen === null);
  return unpicked.length ? unpicked : [...mine];
}

/** Road users without a pick whose goal is relative to these, or to one that is: they keep the relation. */
function relatedTo(scene: Scene, ids: readonly string[]): string[] {
  const found = new Set(ids);
  const next = (): Agent | undefined =>
    [...scene.agents.values()].find(
      (a) => !found.has(a.id) && found.has(a.goal.relation?.to ?? '') && a.chosen === null && canChange(a),
    );
  for (let a = next(); a; a = next()) found.add(a.id);
  return [...found].filter((id) => !ids.includes(id));
}

/** The others replay or hold still: only conditioned road users are computed. */
function askedAlone(scene: Scene, mine: string[], step: Step, known: MotionSet['futures']): ChangeRequest {
  const open = mine.filter((id) => scene.agents.get(id)!.chosen === null || !known.has(id));
  const kept = new Set(mine.filter((id) => !open.includes(id)));
  if (open.length) return { agents: open, react: false, step, kept };
  return scene.length > GOAL_TIME ? { agents: mine, pinned: mine, react: false, step, kept } : 'known';
}

/** Draws all again except road users with a taken pinned future: these keep it, and the others react to it. */
function everybodyAnew(scene: Scene, step: Step, known: MotionSet['futures']): ChangeRequest {
  const held = heldIn(scene, known);
  if (!held.size) return { agents: 'all', react: false, step };
  const agents = [...scene.agents.values()].filter((a) => canChange(a) && !held.has(a.id)).map((a) => a.id);
  return agents.length ? { agents, react: false, step, kept: held } : 'known';
}

/** Road users with a taken pinned future that is known. */
const heldIn = (scene: Scene, known: MotionSet['futures']): ReadonlySet<string> =>
  new Set([...scene.agents.values()].filter((a) => takenPin(a) && known.has(a.id)).map((a) => a.id));
