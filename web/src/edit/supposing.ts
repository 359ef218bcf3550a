// What everybody would do after a change that is not made, asked on a line of its own. The document stays as it is.
import type { Command } from '../model/commands';
import type { MotionSet } from '../model/futures';
import type { Scene } from '../model/scene';
import type { Generator } from '../net/generator';
import { askedAfter } from './after-change';
import type { Editor } from './editor';
import { motionAfter } from './motion-after';
import type { Questions } from './question';

/** A document with one change more, and whom it is about. */
export interface Supposition {
  readonly name: string;
  readonly scene: Scene;
  readonly changed: readonly string[];
}

/** Null where the command changes nobody. */
export function supposition(scene: Scene, command: Command): Supposition | null {
  const after = command.apply(scene);
  const changed = [...after.agents.values()].filter((a) => scene.agents.get(a.id) !== a).map((a) => a.id);
  return changed.length ? { name: command.name, scene: after, changed } : null;
}

export class Supposing {
  constructor(
    private readonly editor: Editor,
    private readonly questions: Questions,
    private readonly generator: Generator,
  ) {}

  /** Null when nothing came of it. False: there is nobody to ask, or nothing that is asked. */
  ask({ name, scene, changed }: Supposition, answered: (set: MotionSet | null) => void): boolean {
    const { editor } = this;
    const set = editor.motion.peek();
    if (editor.away.peek() || set.stale) return false;
    const agent = changed.length === 1 ? changed[0] : null;
    const asked = askedAfter(editor, scene, { name, agent, several: changed, undo: false });
    if (typeof asked === 'string') return false;
    const nothing = () => answered(null);
    const question = this.questions.makeApart(scene, set, asked, {
      draft: () => undefined,
      final: (e) => answered(motionAfter(set, scene, e, asked, () => 'rank')),
      refused: nothing,
      away: nothing,
      dropped: nothing,
    });
    this.generator.ask(question);
    return true;
  }

  cancel(): void {
    this.generator.cancel();
  }
}
