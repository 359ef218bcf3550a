// A change that is tried and not made: what everybody would do is shown dashed beside what they do.
import { effect, type ReadonlySignal } from '@preact/signals-core';
import type { Command } from '../model/document/commands';
import { findChanges } from '../model/words/change-words';
import type { MotionSet } from '../model/document/futures';
import type { Beside, Editor } from './editor';
import { supposition, type Supposing, type Supposition } from './supposing';

export class Trial {
  /** What is shown for it; somebody else's is not taken away. */
  #shown: Beside | null = null;

  get asking(): ReadonlySignal<boolean> {
    return this.supposing.asking;
  }

  constructor(
    private readonly editor: Editor,
    private readonly supposing: Supposing,
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
    const tried = supposition(scene, command);
    if (!tried) return;
    const before = editor.motion.peek();
    this.#show({ scene: tried.scene, set: before, parted: tried.changed, tried: true });
    this.supposing.ask(tried, (set) => set && this.#answered(tried, before, set));
  }

  stop(): void {
    if (!this.#shown) return;
    if (this.editor.beside.peek() === this.#shown) this.editor.showBeside(null);
    this.#shown = null;
    this.supposing.cancel();
  }

  #answered({ scene, changed }: Supposition, before: MotionSet, set: MotionSet): void {
    const others = findChanges(scene, before, set, new Set(changed)).map((c) => c.id);
    this.#show({ scene, set, parted: [...changed, ...others], tried: true });
  }

  #show(beside: Beside): void {
    this.#shown = beside;
    this.editor.showBeside(beside);
  }
}
