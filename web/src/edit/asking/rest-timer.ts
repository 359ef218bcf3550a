// Runs work once nothing has happened for a while. Restarting a timer is slow in a drag frame, so one timer keeps
// running and counts the quiet parts.

/** Number of parts of the delay: it may last longer by at most one part. */
const PARTS = 4;

export class RestTimer {
  readonly #part_ms: number;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #quiet = 0;
  #done: (() => void) | null = null;

  constructor(after_ms: number) {
    this.#part_ms = after_ms / PARTS;
  }

  /** Restarts the delay; `done` runs at its end. */
  begin(done: () => void): void {
    this.#done = done;
    // The part already running does not count.
    this.#quiet = this.#timer === undefined ? 0 : -1;
    this.#timer ??= this.#wait();
  }

  /** Cancels the delay. */
  stop(): void {
    this.#done = null;
  }

  #wait(): ReturnType<typeof setTimeout> {
    return setTimeout(() => {
      this.#timer = undefined;
      const done = this.#done;
      if (!done) return;
      this.#quiet++;
      if (this.#quiet < PARTS) {
        this.#timer = this.#wait();
        return;
      }
      this.#done = null;
      done();
    }, this.#part_ms);
  }
}
