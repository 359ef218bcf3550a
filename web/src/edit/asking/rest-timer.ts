// Something that is done once nothing has happened for a while. Setting a timer anew costs much in a frame of a drag,
// so one runs on and counts how long it has been quiet.

/** Into so many parts a while is counted: it lasts as much longer as one of them, at most. */
const PARTS = 4;

export class RestTimer {
  readonly #part_ms: number;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #quiet = 0;
  #done: (() => void) | null = null;

  constructor(after_ms: number) {
    this.#part_ms = after_ms / PARTS;
  }

  /** Something happened: `done` runs when nothing follows. */
  begin(done: () => void): void {
    this.#done = done;
    // The part that runs already does not count.
    this.#quiet = this.#timer === undefined ? 0 : -1;
    this.#timer ??= this.#wait();
  }

  /** Nothing is waited for any more. */
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
