// Locks and channels shared by the tabs of one browser, as browsers provide them.

interface Held {
  release(reason?: unknown): void;
}

export class Locks {
  readonly #held = new Map<string, Held>();
  readonly #lines = new Map<string, (() => void)[]>();

  request(name: string, options: LockOptions, grant: (lock: Lock | null) => Promise<void> | undefined): Promise<void> {
    if (options.ifAvailable && this.#held.has(name)) return Promise.resolve(grant(null));
    if (options.steal) this.#held.get(name)?.release(new DOMException('stolen', 'AbortError'));
    return new Promise((resolve, reject) => {
      const line = this.#lines.get(name) ?? [];
      this.#lines.set(name, line);
      const take = () => {
        const mine: Held = {
          release: (reason) => {
            if (this.#held.get(name) === mine) this.#held.delete(name);
            if (reason) reject(reason);
            else resolve();
            if (!reason && !this.#held.has(name)) line.shift()?.();
          },
        };
        this.#held.set(name, mine);
        const held = grant({ mode: 'exclusive', name } as Lock);
        if (held) void held.then(() => mine.release());
        else mine.release();
      };
      options.signal?.addEventListener('abort', () => {
        const at = line.indexOf(take);
        if (at >= 0) line.splice(at, 1);
        reject(options.signal!.reason);
      });
      if (this.#held.has(name) && !options.steal) line.push(take);
      else take();
    });
  }
}

/** Channels of the tabs of one browser: each receives from the others. */
export function channels(n: number): BroadcastChannel[] {
  const hearers: ((e: { data: unknown }) => void)[] = [];
  return Array.from({ length: n }, (_, i) => ({
    addEventListener: (_type: string, hear: (e: { data: unknown }) => void) => (hearers[i] = hear),
    postMessage: (data: unknown) => hearers.forEach((hear, j) => j !== i && hear({ data })),
  })) as unknown as BroadcastChannel[];
}
