// What is asked of the generator once the document is changed: who is worked out anew, and who answers them.
import { canChange, GOAL_TIME, touched, type Scene } from '../model/scene';
import type { Editor, Step } from './editor';
import type { Wanted } from './question';

/** `nothing`: nobody is asked anything any more. `known`: the motions are there and only to be scored. */
export type Asked = Wanted | 'nothing' | 'known';

export function askedAfter(editor: Editor, scene: Scene, step: Step): Asked {
  if (step.everybody) return { agents: 'all', react: false, step };
  const mine = editor.touchedIds(scene);
  if (!mine.length) return 'nothing';
  if (scene.others !== 'react') return askedAlone(editor, scene, mine, step);
  const picked = [...scene.agents.values()].filter((a) => a.chosen !== null).map((a) => a.id);
  const rest = [...scene.agents.values()].filter((a) => canChange(a) && a.chosen === null).map((a) => a.id);
  const subject = step.agent ? scene.agents.get(step.agent) : undefined;
  if (subject && subject.chosen !== null && editor.motion.peek().futures.has(subject.id)) {
    if (!rest.length) return 'known';
    // Past its 9 s a picked future goes on only where it is kept beside everybody else's.
    if (scene.length > GOAL_TIME) return { agents: rest, react: false, step, kept: new Set(picked) };
    // It is kept as it is; whoever meets it answers it, and all others go on as they do.
    const { id } = subject;
    const react = picked.length > 1 ? rest : true;
    return { agents: [id], pinned: [id], react, step, kept: new Set(picked) };
  }
  const first = subject && touched(subject) ? subject.id : mine[0];
  const react = picked.length ? rest.filter((id) => id !== first) : true;
  return { agents: [first], react, step, kept: new Set(picked.filter((id) => id !== first)) };
}

/** The others keep to the log or stand: only those that were asked something are worked out. */
function askedAlone(editor: Editor, scene: Scene, mine: string[], step: Step): Asked {
  const known = editor.motion.peek().futures;
  const open = mine.filter((id) => scene.agents.get(id)!.chosen === null || !known.has(id));
  const kept = new Set(mine.filter((id) => !open.includes(id)));
  return open.length ? { agents: open, react: false, step, kept } : 'known';
}
