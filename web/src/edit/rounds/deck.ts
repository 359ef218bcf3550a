// The cards on the table: six futures of one road user that are judged. Nobody follows them and nobody answers them.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Asked } from '../../model/feedback';
import type { Futures } from '../../model/futures';
import type { RoundJson } from '../../model/json';

export interface Hand {
  readonly id: string;
  /** Names what they were drawn by, and the document. */
  readonly print: string;
  /** What they were drawn by. */
  readonly asked: Asked;
  readonly futures: Futures;
  /** What each is like, in the order of the futures, and what was learned before them. */
  readonly round: RoundJson;
}

export class Deck {
  readonly #of = signal<string | null>(null);
  readonly #hand = signal<Hand | null>(null);
  readonly #current = signal(0);
  readonly #asking = signal(false);
  readonly #problem = signal<string | null>(null);

  /** Id of the road user whose rounds are open. */
  readonly of: ReadonlySignal<string | null> = this.#of;
  readonly hand: ReadonlySignal<Hand | null> = this.#hand;
  /** Index of the card that keys are about. */
  readonly current: ReadonlySignal<number> = this.#current;
  readonly asking: ReadonlySignal<boolean> = this.#asking;
  /** Why there are no cards. */
  readonly problem: ReadonlySignal<string | null> = this.#problem;

  open(id: string): void {
    batch(() => {
      this.close();
      this.#of.value = id;
    });
  }

  close(): void {
    batch(() => {
      this.#of.value = this.#hand.value = this.#problem.value = null;
      this.#current.value = 0;
      this.#asking.value = false;
    });
  }

  ask(): void {
    batch(() => {
      this.#asking.value = true;
      this.#problem.value = null;
    });
  }

  deal(hand: Hand): void {
    if (hand.id !== this.#of.peek()) return;
    batch(() => {
      if (hand.asked.round !== this.#hand.peek()?.asked.round) this.#current.value = 0;
      this.#hand.value = hand;
      this.#asking.value = false;
      this.#problem.value = null;
      this.point(this.#current.peek());
    });
  }

  fail(words: string | null): void {
    batch(() => {
      this.#asking.value = false;
      this.#problem.value = words;
    });
  }

  point(index: number): void {
    const n = this.#hand.peek()?.futures.modes.length ?? 0;
    this.#current.value = Math.max(0, Math.min(n - 1, index));
  }
}
