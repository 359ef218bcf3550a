// Is the drag at a bad place? Then the picture keeps the words at the faults, and the panel has all others.
import { markOf } from '../../model/document/future-facts';
import type { Agent } from '../../model/document/scene';
import { outOfReach, verdictsHold } from '../moves/goal-verdict';
import type { Editor } from '../session/editor';

export class QuietDrag {
  #bad = false;

  constructor(private readonly editor: Pick<Editor, 'answers' | 'drag' | 'reading' | 'scene'>) {}

  /** Between two answers the last verdict stays, so that no label flickers. */
  is(a: Agent | null): boolean {
    const { editor: e } = this;
    if (!a || !e.drag.info.value) this.#bad = false;
    else if (verdictsHold(e)) {
      const about = e.reading.futures.value?.modes[e.reading.chosen.value]?.about;
      this.#bad = outOfReach(e, a) !== null || (!!about && markOf(about) !== 'ok');
    }
    return this.#bad;
  }
}
