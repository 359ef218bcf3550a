// A change that is tried and not made: what everybody would do is shown dashed beside what they do.
import { effect, type ReadonlySignal } from '@preact/signals-core';
import type { Command } from '../../model/document/commands';
import { findChanges } from '../../model/words/change-words';
import type { MotionSet } from '../../model/document/futures';
import type { Editor } from '../session/editor';
import type { Beside } from '../session/view-settings';
import { triedChange, type WhatIf, type TriedChange } from './what-if';

export class RemedyPreview {
  /** What is shown for it; somebody else's is not taken away. */
  #shown: Beside | null = null;

  get asking(): ReadonlySignal<boolean> {
    return this.whatIf.asking;
  }

  constructor(
    private readonly editor: Editor,
    private readonly whatIf: WhatIf,
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
    if (!scene || editor.drag.active.peek()) return;
    this.stop();
    const tried = triedChange(scene, command);
    if (!tried) return;
    const before = editor.answers.motion.peek();
    this.#show({ scene: tried.scene, set: before, parted: tried.changed, tried: true });
    this.whatIf.ask(tried, (set) => set && this.#answered(tried, before, set));
  }

  stop(): void {
    if (!this.#shown) return;
    if (this.editor.view.beside.peek() === this.#shown) this.editor.view.showBeside(null);
    this.#shown = null;
    this.whatIf.cancel();
  }

  #answered({ scene, changed }: TriedChange, before: MotionSet, set: MotionSet): void {
    const others = findChanges(scene, before, set, new Set(changed)).map((c) => c.id);
    this.#show({ scene, set, parted: [...changed, ...others], tried: true });
  }

  #show(beside: Beside): void {
    this.#shown = beside;
    this.editor.view.showBeside(beside);
  }
}
