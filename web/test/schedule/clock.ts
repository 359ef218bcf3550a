// The clock of a schedule: timers fire in order and at once, so that a minute of the page takes no time here.

interface Timer {
  readonly id: number;
  at: number;
  readonly every: number | null;
  readonly work: () => void;
}

/** Lets all pending promises continue. */
const settled = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));

export class Clock {
  now = 1_700_000_000_000;
  #next = 1;
  readonly #timers = new Map<number, Timer>();
  readonly #real = {
    setTimeout: globalThis.setTimeout,
    clearTimeout: globalThis.clearTimeout,
    setInterval: globalThis.setInterval,
    clearInterval: globalThis.clearInterval,
    dateNow: Date.now,
  };

  /** Replaces the machine's clock, until `restore`. */
  install(): void {
    const start = (every: boolean) => (work: () => void, ms?: number) => {
      const wait = Math.max(1, ms ?? 0);
      const timer = { id: this.#next++, at: this.now + wait, every: every ? wait : null, work };
      this.#timers.set(timer.id, timer);
      return timer.id;
    };
    const stop = (id: unknown) => void this.#timers.delete(id as number);
    const all = { setTimeout: start(false), clearTimeout: stop, setInterval: start(true), clearInterval: stop };
    Object.assign(globalThis, all);
    Date.now = () => this.now;
  }

  restore(): void {
    const { dateNow, ...timers } = this.#real;
    Object.assign(globalThis, timers);
    Date.now = dateNow;
  }

  /** Advances the clock by this many milliseconds. */
  async pass(ms: number): Promise<void> {
    const end = this.now + ms;
    await settled();
    for (let t = this.#first(end); t; t = this.#first(end)) {
      this.now = Math.max(this.now, t.at);
      if (t.every === null) this.#timers.delete(t.id);
      else t.at += t.every;
      t.work();
      await settled();
    }
    this.now = end;
  }

  #first(until: number): Timer | null {
    let first: Timer | null = null;
    for (const t of this.#timers.values()) if (t.at <= until && (!first || t.at < first.at)) first = t;
    return first;
  }
}
