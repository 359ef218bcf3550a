// A change that is tried and not made: what everybody would do is asked on a line of its own and shown dashed beside
// what they do. The document stays as it is.
import { effect, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Command } from '../model/commands';
import { findChanges } from '../model/changes';
import type { MotionSet } from '../model/futures';
import type { Scene } from '../model/scene';
import type { Generator } from '../net/generator';
import type { FinalEvent } from '../net/types';
import { askedAfter } from './after-change';
import type { Beside, Editor } from './editor';
import { motionAfter } from './motion-after';
import type { Questions, Wanted } from './question';

export class Trial {
  readonly #asking = signal(false);
  /** What is shown for it; somebody else's is not taken away. */
  #shown: Beside | null = null;
  #from: Scene | null = null;

  readonly asking: ReadonlySignal<boolean> = this.#asking;

  constructor(
    private readonly editor: Editor,
    private readonly questions: Questions,
    private readonly generator: Generator,
  ) {
    // It is about the document as it was, and somebody's way out: made or not, it is over when that changes.
    effect(() => {
      void [editor.scene.value, editor.selected.value];
      this.stop();
    });
  }

  /** Shows where the command puts goal and start at once, and what comes of it as soon as that is known. */
  begin(command: Command): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene || editor.dragging.peek()) return;
    this.stop();
    const after = command.apply(scene);
    const changed = [...after.agents.values()].filter((a) => scene.agents.get(a.id) !== a).map((a) => a.id);
    if (!changed.length) return;
    this.#from = scene;
    const set = editor.motion.peek();
    this.#show({ scene: after, set, parted: changed, tried: true });
    if (editor.away.peek() || set.stale) return;
    const agent = changed.length === 1 ? changed[0] : null;
    const asked = askedAfter(editor, after, { name: command.name, agent, several: changed, undo: false });
    if (typeof asked === 'string') return;
    this.#asking.value = true;
    const question = this.questions.makeApart(after, set, asked, {
      draft: () => undefined,
      final: (e) => this.#answered(scene, after, set, changed, asked, e),
      refused: () => this.#end(),
      away: () => this.#end(),
      dropped: () => this.#end(),
    });
    this.generator.ask(question);
  }

  stop(): void {
    const { editor } = this;
    if (!this.#shown) return;
    if (editor.beside.peek() === this.#shown) editor.showBeside(null);
    this.#shown = this.#from = null;
    if (this.#asking.peek()) this.generator.cancel();
    this.#end();
  }

  #answered(from: Scene, after: Scene, before: MotionSet, changed: readonly string[], asked: Wanted, e: FinalEvent) {
    this.#end();
    if (this.#from !== from || this.#shown?.scene !== after) return;
    const set = motionAfter(before, after, e, asked, () => 'rank');
    const others = findChanges(after, before, set, new Set(changed)).map((c) => c.id);
    this.#show({ scene: after, set, parted: [...changed, ...others], tried: true });
  }

  #show(beside: Beside): void {
    this.#shown = beside;
    this.editor.showBeside(beside);
  }

  #end(): void {
    this.#asking.value = false;
  }
}
