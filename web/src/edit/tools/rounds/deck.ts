// The preference cards: six futures of one road user, or six alternatives of the whole scene, to be judged. No road
// user follows them yet.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import { answerTo, type CardVerdict, type RoundInputs, type Verdict } from '../../../model/document/feedback';
import { everybody, oneSubject, type Subject } from '../../../model/document/feedback-commands';
import type { Scene } from '../../../model/document/scene';
import type { Cards } from '../../session/reading';
import type { Futures, MotionSet } from '../../../model/document/futures';
import type { RoundJson } from '../../../model/document/scene-json';

interface DealtHand {
  /** Identifies the inputs of the draw, and the document. */
  readonly print: string;
  /** The inputs of the draw. */
  readonly asked: RoundInputs;
  /** Traits of each card, in the order of the cards, and what was learned before them. */
  readonly round: RoundJson;
  /** Name of each. */
  readonly names: readonly string[];
}

/** Futures of one road user, without reactions. */
export interface OneHand extends DealtHand {
  readonly id: string;
  readonly futures: Futures;
}

/** Motions of all road users, by card. */
export interface SceneHand extends DealtHand {
  readonly id: null;
  readonly sets: readonly MotionSet[];
}

export type Hand = OneHand | SceneHand;

/** Subject of the open rounds: a road user's id, or null for the whole scene. */
export interface RoundsOf {
  readonly id: string | null;
}

const NONE: readonly null[] = Object.freeze([]);

export class Deck implements Cards {
  readonly #of = signal<RoundsOf | null>(null);
  readonly #hand = signal<Hand | null>(null);
  readonly #current = signal(0);
  readonly #asking = signal(false);
  readonly #problem = signal<string | null>(null);

  /** Null while rounds are closed. */
  readonly of: ReadonlySignal<RoundsOf | null> = this.#of;
  readonly hand: ReadonlySignal<Hand | null> = this.#hand;
  /** Index of the card that keys act on. */
  readonly current: ReadonlySignal<number> = this.#current;
  readonly asking: ReadonlySignal<boolean> = this.#asking;
  /** Why there are no cards. */
  readonly problem: ReadonlySignal<string | null> = this.#problem;

  /** Subject of the open rounds; null while they are closed, or when it was removed. */
  readonly subject = computed<Subject | null>(() => {
    const [of, now] = [this.of.value, this.scene.value];
    if (!of || !now) return null;
    if (of.id === null) return everybody(now);
    const a = now.agents.get(of.id);
    return a ? oneSubject(a) : null;
  });
  /** Verdict on each card; null where it is open. */
  readonly said = computed<readonly (CardVerdict | null)[]>(() => {
    const hand = this.hand.value;
    const of = hand && this.subject.value;
    return of ? hand.round.cards.map((card) => answerTo(of.feedback, hand.asked, card)) : NONE;
  });

  constructor(private readonly scene: ReadonlySignal<Scene | null>) {}

  verdicts(): readonly (Verdict | null)[] {
    return this.said.value.map((answer) => answer?.verdict ?? null);
  }

  open(id: string | null): void {
    batch(() => {
      this.close();
      this.#of.value = { id };
    });
  }

  close(): void {
    batch(() => {
      this.#of.value = null;
      this.#hand.value = this.#problem.value = null;
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
    const of = this.#of.peek();
    if (!of || hand.id !== of.id) return;
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
    const n = this.#hand.peek()?.names.length ?? 0;
    this.#current.value = Math.max(0, Math.min(n - 1, index));
  }

  /** The cards, if they belong to this road user. */
  ofAgent(id: string): OneHand | null {
    const hand = this.#hand.value;
    return hand && hand.id === id ? hand : null;
  }

  /** Motions of all on the viewed card, for whole-scene cards. */
  shownSet(): MotionSet | null {
    const hand = this.#hand.value;
    return hand?.id === null ? (hand.sets[this.#current.value] ?? null) : null;
  }
}
