// What is asked of the generator once the document is changed: who is worked out anew, and who answers them.
import { thoseWhoAnswer } from '../../model/document/reaction-records';
import type { MotionSet } from '../../model/document/futures';
import { takenPin } from '../../model/document/pins';
import { STEP_S } from '../../model/base/motion';
import { canChange, doing, GOAL_TIME, touchedIn, type Agent, type Scene } from '../../model/document/scene';
import type { Step } from '../document/step';
import type { Editor } from '../session/editor';
import type { Wanted } from './request-builder';

/** `nothing`: nobody is asked anything any more. `known`: the motions are there and only to be scored. */
export type Asked = Wanted | 'nothing' | 'known';

export function requestForChange(
  editor: Pick<Editor, 'answers'>,
  scene: Scene,
  step: Step,
  set: MotionSet = editor.answers.motion.peek(),
): Asked {
  const asked = whatIsAsked(scene, step, set);
  if (typeof asked === 'string' || asked.agents === 'all') return asked;
  return { ...asked, anew: thoseWhoAnswer(scene, set, [...asked.agents, ...changedBy(step)]) };
}

/** Whom a step is about. */
export const changedBy = (step: Step): Iterable<string> => (step.agent ? [step.agent] : (step.several ?? []));

function whatIsAsked(scene: Scene, step: Step, set: MotionSet): Asked {
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
    // Past its 9 s the generator says how it goes on.
    if (!rest.length && scene.length <= GOAL_TIME) return 'known';
    // It is kept as it is; whoever meets it answers it, and all others go on as they do.
    const { id } = subject;
    const react = rest.length > 0 && whoReacts(scene, [id]);
    return { agents: [id], pinned: [id], react, step, kept: new Set(picked) };
  }
  const held = heldIn(scene, known);
  const asked = whoIsAsked(scene, mine, known, step).filter((id) => !held.has(id));
  if (!asked.length && held.size) {
    // A pinned future stays as it is, whatever else is drawn anew: others answer it as any that is picked.
    const ids = [...held];
    return { agents: ids, pinned: ids, react: rest, step, kept: new Set(picked) };
  }
  const kept = new Set(picked.filter((id) => !asked.includes(id)));
  return { agents: asked, react: whoReacts(scene, asked), step, kept };
}

/** Who may answer those that are asked, as the API takes it. */
export function whoReacts(scene: Scene, asked: readonly string[]): boolean | string[] {
  const others = othersThatAnswer(scene);
  if (others === 'nobody') return false;
  const picked = [...scene.agents.values()].some((a) => a.chosen !== null && !asked.includes(a.id));
  if (others === 'all' && !picked) return true;
  return (others === 'all' ? free(scene) : others).filter((id) => !asked.includes(id));
}

/** Those that may take another way: nobody has picked a future for them. Who comes in later brakes for others too. */
const free = (scene: Scene): string[] =>
  [...scene.agents.values()].filter((a) => isEverThere(scene, a) && a.chosen === null).map((a) => a.id);

/** Does somebody who can move come within what is worked out? */
const isEverThere = (scene: Scene, a: Agent): boolean =>
  canChange(a) || (a.type !== 'other' && a.log.valid.some(([from]) => from * STEP_S < scene.length - 1e-6));

/** Who answers to a change: all, nobody, or those of whom that was said. */
function othersThatAnswer(scene: Scene): 'all' | 'nobody' | string[] {
  const own = [...scene.agents.values()].some((a) => a.does !== null && a.does !== scene.others);
  if (!own) return scene.others === 'react' ? 'all' : 'nobody';
  const ids = free(scene).filter((id) => doing(scene, scene.agents.get(id)!) === 'react');
  return ids.length ? ids : 'nobody';
}

/**
 * Whom the change is about, and those of whom nothing is known yet. It may be nobody: everybody goes on then, longer or
 * with others that answer. Where chance is another all are drawn anew of whom no future is picked.
 */
function whoIsAsked(scene: Scene, mine: readonly string[], known: ReadonlyMap<string, unknown>, step: Step): string[] {
  const open = mine.filter((id) => !known.has(id));
  const about = [...changedBy(step)].filter((id) => mine.includes(id));
  const all = [...new Set([...about, ...open])].filter((id) => scene.agents.get(id)!.chosen === null || !known.has(id));
  if (all.length || !step.chance) return all;
  const unpicked = mine.filter((id) => scene.agents.get(id)!.chosen === null);
  return unpicked.length ? unpicked : [...mine];
}

/** The others keep to the log or stand: only those that were asked something are worked out. */
function askedAlone(scene: Scene, mine: string[], step: Step, known: MotionSet['futures']): Asked {
  const open = mine.filter((id) => scene.agents.get(id)!.chosen === null || !known.has(id));
  const kept = new Set(mine.filter((id) => !open.includes(id)));
  if (open.length) return { agents: open, react: false, step, kept };
  return scene.length > GOAL_TIME ? { agents: mine, pinned: mine, react: false, step, kept } : 'known';
}

/** Everybody is drawn anew but those that take a pinned future: these go on as they do, and the others see it. */
function everybodyAnew(scene: Scene, step: Step, known: MotionSet['futures']): Asked {
  const held = heldIn(scene, known);
  if (!held.size) return { agents: 'all', react: false, step };
  const agents = [...scene.agents.values()].filter((a) => canChange(a) && !held.has(a.id)).map((a) => a.id);
  return agents.length ? { agents, react: false, step, kept: held } : 'known';
}

/** Those that take a pinned future that is known. */
const heldIn = (scene: Scene, known: MotionSet['futures']): ReadonlySet<string> =>
  new Set([...scene.agents.values()].filter((a) => takenPin(a) && known.has(a.id)).map((a) => a.id));
