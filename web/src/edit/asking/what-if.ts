// The motion of all road users after a change that is not committed, requested on a connection of its own. The document
// stays unchanged.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Command } from '../../model/document/commands';
import type { MotionSet } from '../../model/document/futures';
import type { Scene } from '../../model/document/scene';
import type { Generator } from '../../net/generator';
import type { FinalEvent } from '../../net/types';
import { requestForChange } from './request-for-change';
import type { Editor } from '../session/editor';
import { motionAfter, rejudged } from './merge-answer';
import type { RequestBuilder } from './request-builder';
import type { SceneFile } from '../document/scene-file';
import { followed, scoreOf } from './scoring';

/** A document with one more change, and the changed road users. */
export interface TriedChange {
  readonly name: string;
  readonly scene: Scene;
  readonly changed: readonly string[];
}

/** Null where the command changes no road user. */
export function triedChange(scene: Scene, command: Command): TriedChange | null {
  const after = command.apply(scene);
  const changed = [...after.agents.values()].filter((a) => scene.agents.get(a.id) !== a).map((a) => a.id);
  return changed.length ? { name: command.name, scene: after, changed } : null;
}

export class WhatIf {
  readonly #asking = signal(false);
  /** The open request; answers to earlier ones are ignored. */
  #open = {};

  readonly asking: ReadonlySignal<boolean> = this.#asking;

  constructor(
    private readonly editor: Pick<Editor, 'answers'>,
    private readonly questions: RequestBuilder,
    private readonly generator: Generator,
    private readonly file: SceneFile,
  ) {}

  /**
   * `answered` gets null when the request failed. False where the generator is unreachable or nothing is to be
   * requested.
   */
  ask({ name, scene, changed }: TriedChange, answered: (set: MotionSet | null) => void): boolean {
    const { editor } = this;
    const set = editor.answers.motion.peek();
    if (editor.answers.away.peek() || set.stale) return false;
    const agent = changed.length === 1 ? changed[0] : null;
    const asked = requestForChange(editor, scene, { name, agent, several: changed, undo: false });
    if (asked === 'nothing') return false;
    const open = (this.#open = {});
    const end = (after: MotionSet | null): void => {
      if (this.#open !== open) return;
      batch(() => {
        this.#asking.value = false;
        answered(after);
      });
    };
    const nothing = () => end(null);
    this.#asking.value = true;
    if (asked === 'known') {
      void this.#scored(scene, set, changed).then(end, nothing);
      return true;
    }
    const final = (e: FinalEvent) => end(motionAfter(set, scene, e, asked, () => 'rank'));
    const on = { draft: () => undefined, final, refused: nothing, away: nothing, dropped: nothing };
    this.generator.ask(this.questions.makeApart(scene, set, asked, on));
    return true;
  }

  /** No road user reacts: only the followed future of a road user changes. */
  async #scored(scene: Scene, set: MotionSet, changed: readonly string[]): Promise<MotionSet> {
    const after = followed(scene, set);
    const score = await scoreOf(this.generator, this.file, scene, after);
    return score ? { ...after, futures: rejudged(scene, after, score, changed), score } : after;
  }

  /** Ignores the answer to the open request. */
  cancel(): void {
    if (!this.#asking.peek()) return;
    this.#open = {};
    this.#asking.value = false;
    this.generator.cancel();
  }
}
