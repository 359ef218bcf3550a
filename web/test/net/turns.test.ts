// Locks of tabs at a scene.
import { describe, expect, it, vi } from 'vitest';
import { SceneTurns, type TurnEvents } from '../../src/net/scene-lock';
import { channels, Locks } from './locks';

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

  it('the second gets it when the first has switched to another scene', async () => {
    const [a, b] = tabs();
    await a.turns.goTo('s');
    await b.turns.goTo('s');
    expect(await a.turns.goTo('other')).toBe(true);
    expect(b.said).toEqual([]);
    a.turns.left();
    await vi.waitFor(() => expect(b.said).toEqual(['got']));
    expect(a.said).toEqual([]);
  });

  it('the first keeps it while it still shows it, on its way to another scene', async () => {
    const [a, b] = tabs();
    await a.turns.goTo('s');
    await b.turns.goTo('s');
    await a.turns.goTo('other');
    a.turns.left('s');
    expect(await a.turns.goTo('s')).toBe(true);
    await a.turns.goTo('other');
    a.turns.left('other');
    await vi.waitFor(() => expect(b.said).toEqual(['got']));
  });

  it('the first still has it when it returns before leaving', async () => {
    const [a, b] = tabs();
    await a.turns.goTo('s');
    await b.turns.goTo('s');
    await a.turns.goTo('other');
    expect(await a.turns.goTo('s')).toBe(true);
    a.turns.left();
    expect([a.said, b.said, a.turns.holds, b.turns.holds]).toEqual([[], [], true, false]);
  });

  it('the holder notifies the other tabs of its changes', async () => {
    const [a, b] = tabs();
    await a.turns.goTo('s');
    await b.turns.goTo('s');
    a.turns.tellChanged();
    b.turns.tellChanged();
    expect([a.said, b.said]).toEqual([[], ['changed']]);
  });

  it('a hung holder loses it', async () => {
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

  it('without locks every tab has a turn', async () => {
    const turns = new SceneTurns({} as TurnEvents, null, null);
    expect(await turns.goTo('s')).toBe(true);
  });
});
