// Playback position and state. `playback.ts` advances it with the frames.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';

/** Playback speeds, in scene seconds per second. */
export const RATES = [0.1, 0.25, 0.5, 1, 2, 4, 8] as const;

export class Playhead {
  readonly #time = signal(0);
  readonly #playing = signal(false);
  readonly #rate = signal<number>(1);
  readonly #loop = signal(true);
  readonly #follow = signal(false);

  /** Seconds from the start of the scene. */
  readonly time: ReadonlySignal<number> = this.#time;
  readonly playing: ReadonlySignal<boolean> = this.#playing;
  readonly rate: ReadonlySignal<number> = this.#rate;
  readonly loop: ReadonlySignal<boolean> = this.#loop;
  /** Does the picture follow the selected road user in playback? */
  readonly follow: ReadonlySignal<boolean> = this.#follow;

  /** `duration`: of the scene, seconds; null while none is open. */
  constructor(private readonly duration: () => number | null) {}

  play(): void {
    this.#playing.value = true;
  }

  pause(): void {
    this.#playing.value = false;
  }

  /** Limited to the scene's duration. */
  moveTo(seconds: number): void {
    const duration = this.duration();
    if (duration !== null) this.#time.value = Math.min(duration, Math.max(0, seconds));
  }

  /** To the start, paused. */
  rewind(): void {
    batch(() => {
      this.#playing.value = false;
      this.#time.value = 0;
    });
  }

  /** The next rate up or down; stops at the ends, or wraps with `round`. */
  changeRate(step: 1 | -1, round = false): void {
    const at = RATES.indexOf(this.#rate.peek() as (typeof RATES)[number]) + step;
    const next = RATES[round ? (at + RATES.length) % RATES.length : Math.min(RATES.length - 1, Math.max(0, at))];
    this.#rate.value = next;
  }

  toggleLoop(): void {
    this.#loop.value = !this.#loop.peek();
  }

  toggleFollow(): void {
    this.#follow.value = !this.#follow.peek();
  }
}
