// How often panels say something new. The picture follows every step of a drag; words, bars and curves beside it are
// not read sixty times a second, and for each of them the page would be laid out and painted.
import { effect, signal, untracked, type ReadonlySignal } from '@preact/signals-core';

/** While a hand drags, panels change once in so long. */
const READ_MS = 100;

export class Throttle {
  readonly #beat = signal(0);
  readonly #waiting = signal(false);
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** There is something new that panels do not say yet. */
  readonly waiting: ReadonlySignal<boolean> = this.#waiting;

  /** `news` reads what changes in a drag. */
  constructor(
    private readonly dragging: ReadonlySignal<boolean>,
    news: () => void,
  ) {
    effect(() => {
      news();
      if (!dragging.value) this.#over();
      else this.#timer ??= this.#wait();
    });
  }

  /** What `of` gives, and reads its signals; while a hand drags only now and then. */
  read<T>(of: () => T): T {
    if (!this.dragging.value) return of();
    void this.#beat.value;
    return untracked(of);
  }

  #wait(): ReturnType<typeof setTimeout> {
    this.#waiting.value = true;
    return setTimeout(() => {
      this.#over();
      this.#beat.value++;
    }, READ_MS);
  }

  #over(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#waiting.value = false;
  }
}
