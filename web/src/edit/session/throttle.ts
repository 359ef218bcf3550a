// Limits how often panels update. The picture follows every frame of a drag; updating words, bars and curves sixty
// times a second would only cost layout and paint.
import { effect, signal, untracked, type ReadonlySignal } from '@preact/signals-core';

/** During a drag, panels update at this interval. */
const READ_MS = 100;

export class Throttle {
  readonly #beat = signal(0);
  readonly #waiting = signal(false);
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** The panels have not shown the newest values yet. */
  readonly waiting: ReadonlySignal<boolean> = this.#waiting;

  /** `news` reads the signals that change in a drag. */
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

  /** The result of `of`, tracking its signals; during a drag only at intervals. */
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
