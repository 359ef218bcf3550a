// Tabs take turns at a scene.
import { describe, expect, it, vi } from 'vitest';
import { SceneTurns, type TurnEvents } from '../src/net/scene-lock';

/** Locks as browsers give them, for one name at a time. */
class Locks {
  #held: { release: (reason?: unknown) => void } | null = null;
  readonly #line: (() => void)[] = [];

  request(_: string, options: LockOptions, grant: (lock: Lock | null) => Promise<void> | undefined): Promise<void> {
    if (options.ifAvailable && this.#held) return Promise.resolve(grant(null));
    if (options.steal) this.#held?.release(new DOMException('stolen', 'AbortError'));
    return new Promise((resolve, reject) => {
      const take = () => {
        const mine = {
          release: (reason?: unknown) => {
            if (this.#held === mine) this.#held = null;
            if (reason) reject(reason);
            else resolve();
            if (!reason) this.#line.shift()?.();
          },
        };
        this.#held = mine;
        void grant({ mode: 'exclusive', name: _ } as Lock)?.then(() => mine.release());
      };
      options.signal?.addEventListener('abort', () => {
        const at = this.#line.indexOf(take);
        if (at >= 0) this.#line.splice(at, 1);
        reject(options.signal!.reason);
      });
      if (this.#held && !options.steal) this.#line.push(take);
      else take();
    });
  }
}

/** Channels of tabs of one browser: each hears the others. */
function channels(n: number): BroadcastChannel[] {
  const hearers: ((e: { data: unknown }) => void)[] = [];
  return Array.from({ length: n }, (_, i) => ({
    addEventListener: (_type: string, hear: (e: { data: unknown }) => void) => (hearers[i] = hear),
    postMessage: (data: unknown) => hearers.forEach((hear, j) => j !== i && hear({ data })),
  })) as unknown as BroadcastChannel[];
}

function tabs() {
  const locks = new Locks() as unknown as LockManager;
  return channels(2).map((channel) => {
    const said: string[] = [];
    let finished: Promise<void> = Promise.resolve();
    const on: TurnEvents = {
      got: () => said.push('got'),
      leaving: () => {
        said.push('leaving');
        return finished;
      },
      lost: () => said.push('lost'),
      changed: () => said.push('changed'),
    };
    const hang = () => (finished = new Promise<void>(() => undefined));
    return { turns: new SceneTurns(on, locks, channel), said, hang };
  });
}

describe('two tabs at one scene', () => {
  it('the second waits, asks, and gets it once the first has written everything', async () => {
    const [a, b] = tabs();
    expect(await a.turns.goTo('s')).toBe(true);
    expect(await b.turns.goTo('s')).toBe(false);
    b.turns.takeOver();
    await vi.waitFor(() => expect(b.said).toEqual(['got']));
    expect(a.said).toEqual(['leaving', 'lost']);
    a.turns.takeOver();
    await vi.waitFor(() => expect(a.said).toEqual(['leaving', 'lost', 'got']));
  });

  it('the second gets it when the first goes elsewhere', async () => {
    const [a, b] = tabs();
    await a.turns.goTo('s');
    await b.turns.goTo('s');
    await a.turns.goTo('other');
    await vi.waitFor(() => expect(b.said).toEqual(['got']));
    expect(a.said).toEqual([]);
  });

  it('only those who look at it hear of changes', async () => {
    const [a, b] = tabs();
    await a.turns.goTo('s');
    await b.turns.goTo('s');
    a.turns.tellChanged();
    b.turns.tellChanged();
    expect([a.said, b.said]).toEqual([[], ['changed']]);
  });

  it('a holder that hangs is passed over', async () => {
    vi.useFakeTimers();
    try {
      const [a, b] = tabs();
      a.hang();
      await a.turns.goTo('s');
      await b.turns.goTo('s');
      b.turns.takeOver();
      await vi.advanceTimersByTimeAsync(10_000);
      expect(b.said).toEqual(['got']);
      expect(a.said).toEqual(['leaving', 'lost']);
    } finally {
      vi.useRealTimers();
    }
  });

  it('without locks everybody has a turn', async () => {
    const turns = new SceneTurns({} as TurnEvents, null, null);
    expect(await turns.goTo('s')).toBe(true);
  });
});
