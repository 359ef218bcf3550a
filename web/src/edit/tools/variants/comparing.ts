// Two variants side by side: which ones, their differences, and the road user whose speeds are compared.
import { batch, computed, effect, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Diverging } from '../../../model/words/comparison';
import type { Editor } from '../../session/editor';
import { comparedOf, type Card, type Compared, type WholeCard } from './cards';
import { TEXTS } from '../../../texts/editing/variants';

/** The variants that are compared. */
interface ComparedCards {
  readonly cards: ReadonlySignal<readonly Card[]>;
  /** Id of the shown variant. */
  readonly shown: ReadonlySignal<number | null>;
  card(id: number): Card | null;
  /** Shows a variant. */
  take(id: number): void;
  /** Kept ones that have all their data. */
  within(scope: 'kept'): readonly WholeCard[];
}

export class Comparing {
  readonly #pair = signal<readonly [number, number] | null>(null);
  readonly #picked = signal<number | null>(null);
  readonly #followed = signal<string | null>(null);

  /** The two compared variants, the left one first. */
  readonly pair: ReadonlySignal<readonly [number, number] | null> = this.#pair;
  /** The first of two variants to compare. */
  readonly picked: ReadonlySignal<number | null> = this.#picked;
  /** The two compared variants, and their differences. */
  readonly compared: ReadonlySignal<Compared | null>;
  /** The road user whose speeds are compared: the picked one, else the one with the largest distance. */
  readonly followed = computed<Diverging | null>(() => {
    const diverging = this.compared.value?.comparison.diverging ?? [];
    return diverging.find((p) => p.agent.id === this.#followed.value) ?? diverging.at(0) ?? null;
  });

  constructor(
    private readonly editor: Editor,
    private readonly of: ComparedCards,
  ) {
    this.compared = computed(() => comparedOf(of.cards.value, this.#pair.value));
    effect(() => {
      const now = this.compared.value;
      const diverging = now?.comparison.diverging.map((p) => p.agent.id) ?? [];
      editor.view.showBeside(now && { scene: now.right.scene, set: now.right.set, diverging });
    });
    // A change of the scene ends the comparison: the scene is none of the two any more.
    effect(() => {
      const left = this.#pair.value?.[0];
      if (left !== undefined && !editor.drag.active.value && of.shown.value !== left) this.end();
    });
  }

  follow(agent: string): void {
    this.#followed.value = agent;
  }

  /**
   * Compares with the picked variant, otherwise with the shown one; without either, this one is picked. If exactly two
   * are kept, each is compared with the other at once.
   */
  with(id: number): void {
    const first = this.#picked.peek() ?? this.of.shown.peek();
    const kept = this.of.within('kept').map((c) => c.id);
    if (this.#picked.peek() === null && kept.length === 2 && kept.includes(id)) {
      this.between(kept[0], kept[1]);
      return;
    }
    if (first === null || first === id) {
      const taken = this.#picked.peek() !== id;
      this.#picked.value = taken ? id : null;
      if (taken) this.editor.notices.show({ text: TEXTS.selectASecond(id) });
      return;
    }
    this.between(first, id);
  }

  between(left: number, right: number): void {
    const { of } = this;
    if (left === right || !of.card(left)?.set || !of.card(right)?.set) return;
    of.take(left);
    if (of.shown.peek() !== left) return;
    batch(() => {
      this.#picked.value = null;
      this.#pair.value = [left, right];
    });
    const moment = this.compared.peek()?.comparison.moments[0];
    this.editor.notices.say(
      moment ? TEXTS.variantsDiffer(left, right, moment.words) : TEXTS.variantsAreIdentical(left, right),
    );
  }

  swapSides(): void {
    const pair = this.#pair.peek();
    if (pair) this.between(pair[1], pair[0]);
  }

  /** No variant is picked any more. */
  unpick(): void {
    this.#picked.value = null;
  }

  end(): void {
    batch(() => {
      this.#pair.value = null;
      this.#picked.value = null;
    });
  }
}
