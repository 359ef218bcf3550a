// Something that is done once nothing has happened for a while. Setting a timer anew costs much in a frame of a drag,
// so it is left to run, and looks again when it ends.

export class Rest {
  #timer: ReturnType<typeof setTimeout> | undefined;
  #due = 0;
  #done: (() => void) | null = null;

  constructor(private readonly after_ms: number) {}

  /** Something happened: `done` runs when nothing follows. */
  begin(done: () => void): void {
    this.#done = done;
    this.#due = performance.now() + this.after_ms;
    if (this.#timer === undefined) this.#wait(this.after_ms);
  }

  /** Nothing is waited for any more. */
  stop(): void {
    this.#done = null;
  }

  #wait(ms: number): void {
    this.#timer = setTimeout(() => {
      this.#timer = undefined;
      const done = this.#done;
      if (!done) return;
      const left = this.#due - performance.now();
      // Timers count whole milliseconds.
      if (left >= 1) return this.#wait(left);
      this.#done = null;
      done();
    }, ms);
  }
}
