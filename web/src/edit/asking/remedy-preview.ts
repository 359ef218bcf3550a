// Preview of a change that is not committed: the resulting motion of all is dashed beside the current one.
import { effect, type ReadonlySignal } from '@preact/signals-core';
import type { Command } from '../../model/document/commands';
import { findChanges } from '../../model/words/change-words';
import type { MotionSet } from '../../model/document/futures';
import type { Editor } from '../session/editor';
import type { SceneBeside } from '../session/view-settings';
import { triedChange, type WhatIf, type TriedChange } from './what-if';

export class RemedyPreview {
  /** The preview shown from here; another owner's preview is not removed. */
  #shown: SceneBeside | null = null;

  get asking(): ReadonlySignal<boolean> {
    return this.whatIf.asking;
  }

  constructor(
    private readonly editor: Editor,
    private readonly whatIf: WhatIf,
  ) {
    // A preview belongs to one document and one selection: it ends when either changes.
    effect(() => {
      void [editor.scene.value, editor.selected.value];
      this.stop();
    });
  }

  /** Shows the goal and start of the command at once, and its outcome when that is known. */
  begin(command: Command): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene || editor.drag.active.peek()) return;
    this.stop();
    const tried = triedChange(scene, command);
    if (!tried) return;
    const before = editor.answers.motion.peek();
    this.#show({ scene: tried.scene, set: before, diverging: tried.changed, tried: true });
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
    this.#show({ scene, set, diverging: [...changed, ...others], tried: true });
  }

  #show(beside: SceneBeside): void {
    this.#shown = beside;
    this.editor.view.showBeside(beside);
  }
}
