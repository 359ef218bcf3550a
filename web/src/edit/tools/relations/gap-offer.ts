// A goal that was just put near the future of a moving road user: its gap can be held. The goal is then relative to
// that road user, and stays so when it moves.
import { computed, signal } from '@preact/signals-core';
import type { Vec } from '../../../model/base/geometry';
import { canMove } from '../../../model/document/scene';
import type { Commit } from '../../document/document';
import type { Step } from '../../document/step';
import type { Editor } from '../../session/editor';
import type { SessionPart } from '../../session/part';
import type { offeredGap, OfferedGap } from './nearest-gap';

export class GapOffer implements SessionPart {
  /** The goal of the last change. */
  readonly #put = signal<{ readonly id: string; readonly pos: Vec } | null>(null);
  readonly #find = signal<typeof offeredGap | null>(null);

  constructor(private readonly editor: Editor) {}

  /** Null in a drag, and as soon as anything else changes or another road user is selected. */
  readonly now = computed<OfferedGap | null>(() => {
    const { editor: e } = this;
    const put = this.#put.value;
    const a = e.agent.value;
    if (!put || a?.id !== put.id || a.goal.pos !== put.pos || !canMove(a)) return null;
    return e.drag.active.value || e.reading.outdated.value ? null : (this.#find.value?.(e, a) ?? null);
  });

  opened(): void {
    this.#put.value = null;
  }

  followed({ before, after }: Commit, { agent: id, undo }: Step): void {
    const [was, is] = id === null || undo ? [] : [before.agents.get(id), after.agents.get(id)];
    // Who has just ended a relation wants none.
    const pos = is?.goal.relation || was?.goal.relation ? null : is?.goal.pos;
    this.#put.value = id !== null && pos && pos !== was?.goal.pos ? { id, pos } : null;
    if (this.#put.peek() && !this.#find.peek())
      // Without it nothing is offered; the next goal tries again.
      void import('./nearest-gap').then(({ offeredGap }) => (this.#find.value = offeredGap)).catch(() => null);
  }

  /** One step: the goal keeps its gap. */
  accept(): void {
    const offer = this.now.peek();
    if (offer) this.editor.commits.run(offer.command);
  }
}
