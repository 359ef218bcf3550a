// The conversation with the generator: the latest wins, late answers are dropped, losses are tolerated.
import { afterEach, describe, expect, it } from 'vitest';
import type { SceneJson } from '../../src/model/document/scene-json';
import { Client } from '../../src/net/client';
import type { Handlers, Question } from '../../src/net/generator';
import { HttpGenerator, type Patience } from '../../src/net/http-generator';
import { httpTransport, type Transport } from '../../src/net/http-transport';
import type { GenerateEvent } from '../../src/net/types';
import { crossingJson } from '../helpers';
import { readEvents } from '../../src/net/stream';
import { startStandIn, type StandIn } from '../standin/server.mjs';

let server: StandIn | null = null;
afterEach(async () => {
  await server?.close();
  server = null;
});

const generator = (url: string, patience?: Partial<Patience>) =>
  new HttpGenerator(new Client(url), httpTransport(new Client(url)), patience);

interface Seen {
  drafts: number[];
  final: number;
  away: number;
  refused: string[];
  dropped: number;
}

function ask(preview: boolean, goal: number): { ask: Question; seen: Seen; done: Promise<void> } {
  const seen: Seen = { drafts: [], final: 0, away: 0, refused: [], dropped: 0 };
  let end!: () => void;
  const done = new Promise<void>((r) => {
    end = r;
  });
  const on: Handlers = {
    draft: (_, step) => seen.drafts.push(step),
    final: () => {
      seen.final++;
      end();
    },
    refused: (p) => {
      seen.refused.push(p.code);
      end();
    },
    away: () => {
      seen.away++;
      end();
    },
    dropped: () => {
      seen.dropped++;
      end();
    },
  };
  return {
    seen,
    done,
    ask: {
      preview,
      on,
      scene: () => ({ id: 'demo-crossing' }),
      whole: () => crossingJson(),
      options: {
        agents: ['1'],
        react: !preview,
        conditions: { 1: { goal: { x_m: goal, y_m: 0 } } },
        seed: 0,
        diversity: 1,
        steps: 5,
        stream_modes: 'all',
        score: !preview,
      },
    },
  };
}

describe('generator', () => {
  it('shows six steps and a final answer', async () => {
    server = await startStandIn({ port: 0, delay: 1 });
    const g = generator(server.url),
      a = ask(true, 10);
    g.ask(a.ask);
    await a.done;
    expect(a.seen).toEqual({ drafts: [0, 1, 2, 3, 4, 5], final: 1, away: 0, refused: [], dropped: 0 });
  });

  it('shows each planning window from its first draft on', async () => {
    server = await startStandIn({ port: 0, delay: 1 });
    const g = generator(server.url),
      a = ask(false, 10),
      windows: number[] = [];
    const on: Handlers = {
      ...a.ask.on,
      draft: (e, step, steps, ms) => {
        windows.push(e.window ?? 0);
        a.ask.on.draft(e, step, steps, ms);
      },
    };
    g.ask({ ...a.ask, on, options: { ...a.ask.options, horizon_s: 20, replan_interval_s: 9 } });
    await a.done;
    expect(a.seen.drafts).toEqual([0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5]);
    expect(windows.filter((w, i) => w !== windows[i - 1])).toEqual([0, 1, 2]);
    expect(a.seen.final).toBe(1);
  });

  it('sends the surroundings of a drag once, and again when the server has dropped them', async () => {
    server = await startStandIn({ port: 0, delay: 1 });
    const g = generator(server.url);
    const surroundings = crossingJson();
    const drag = async (): Promise<unknown[]> => {
      const mark = server!.log.length;
      for (const goal of [10, 11, 12]) {
        const a = ask(true, goal);
        g.ask({ ...a.ask, scene: () => ({ scene: surroundings }) });
        await a.done;
        expect(a.seen.final).toBe(1);
      }
      return server!.log.slice(mark).map((l) => l.scene ?? l.scene_id);
    };
    expect(await drag()).toEqual(['inline', 'held:1', 'held:1']);
    server.forget();
    // Dropped surroundings are sent once.
    expect(await drag()).toEqual(['held:1', 'inline', 'held:1', 'held:1']);
  });

  it('keeps one under way and one waiting during a drag', async () => {
    server = await startStandIn({ port: 0, delay: 15 });
    const g = generator(server.url);
    const all = [];
    for (let i = 0; i < 30; i++) {
      const a = ask(true, i);
      all.push(a);
      g.ask(a.ask);
      await new Promise((r) => setTimeout(r, 8));
    }
    await all[all.length - 1].done;
    const last = all[all.length - 1].seen;
    expect(last.final).toBe(1);
    expect(all.slice(0, -1).every((a) => a.seen.final === 0)).toBe(true);
    // Drafts were drawn, with far fewer requests than pointer moves.
    expect(all.filter((a) => a.seen.drafts.length).length).toBeGreaterThan(2);
    expect(server.log.length).toBeLessThan(25);
    expect(server.log.map((l) => l.revision)).toEqual([...server.log.map((l) => l.revision)].sort((x, y) => x - y));
  });

  it('lets a release overtake the previews at once', async () => {
    server = await startStandIn({ port: 0, delay: 20 });
    const g = generator(server.url),
      p = ask(true, 1),
      c = ask(false, 2);
    g.ask(p.ask);
    g.ask(c.ask);
    await c.done;
    expect(p.seen.dropped).toBe(1);
    expect(p.seen.drafts).toEqual([]);
    expect(c.seen.final).toBe(1);
    expect(server.log.at(-1)!.react).toBe(true);
  });

  it('never goes back a step when events arrive out of order or are lost', async () => {
    server = await startStandIn({ port: 0, delay: 1, shuffle: true, loss: 0.3 });
    const g = generator(server.url);
    for (let i = 0; i < 8; i++) {
      const a = ask(true, i);
      g.ask(a.ask);
      await a.done;
      expect(a.seen.drafts).toEqual([...a.seen.drafts].sort((x, y) => x - y));
      expect(a.seen.final).toBe(1);
    }
  });

  it('reports an unreachable generator, and a refusal', async () => {
    server = await startStandIn({ port: 0, away: true });
    const g = generator(server.url),
      a = ask(false, 1);
    g.ask(a.ask);
    await a.done;
    expect(a.seen.away).toBe(1);
    server.options.away = false;
    const b = ask(false, 1);
    const unknown = { ...crossingJson(), map: { ref: 'sha256:unknown' } };
    g.ask({ ...b.ask, scene: () => ({ id: 'nowhere' }), whole: () => unknown });
    await b.done;
    expect(b.seen.refused).toEqual(['unknown-map']);
  });

  it('waits while the queue is full, without reporting the generator as unreachable', async () => {
    server = await startStandIn({ port: 0, delay: 1, busy: 3 });
    const g = generator(server.url),
      p = ask(true, 1),
      c = ask(false, 1);
    g.ask(p.ask);
    await p.done;
    expect(p.seen).toMatchObject({ dropped: 1, away: 0, final: 0 });
    g.ask(c.ask);
    await c.done;
    expect(c.seen).toMatchObject({ final: 1, away: 0 });
  });

  it('notices a generator that hangs: slow at first, then unreachable', async () => {
    server = await startStandIn({ port: 0, delay: 1, hang: true });
    let asked = 0;
    const g = generator(server.url, {
      slow: 60,
      look: 200,
      lost: 2000,
      tick: 20,
      alive: async () => {
        asked++;
        return false;
      },
    });
    const a = ask(true, 1),
      waiting = ask(true, 2),
      slow: number[] = [];
    g.ask({ ...a.ask, on: { ...a.ask.on, slow: (ms) => slow.push(ms) } });
    g.ask(waiting.ask);
    await a.done;
    expect(slow[0]).toBeGreaterThanOrEqual(60);
    expect(slow.length).toBeLessThan(4);
    expect(a.seen).toMatchObject({ away: 1, drafts: [], final: 0 });
    expect(waiting.seen).toMatchObject({ dropped: 1, away: 0 });
    expect(asked).toBe(1);
    expect(g.busy).toBe(false);
    server.options.hang = false;
    const b = ask(false, 1);
    g.ask(b.ask);
    await b.done;
    expect(b.seen).toMatchObject({ final: 1, away: 0 });
  });

  it('keeps waiting for a server that is only busy, up to a limit', async () => {
    server = await startStandIn({ port: 0, delay: 1, hang: true });
    const g = generator(server.url, {
        slow: 40,
        look: 80,
        lost: 300,
        tick: 20,
        alive: async () => true,
      }),
      a = ask(true, 1);
    const began = performance.now();
    g.ask(a.ask);
    await a.done;
    expect(performance.now() - began).toBeGreaterThan(250);
    expect(a.seen.away).toBe(1);
  });

  it('sends the map again when the server does not know it', async () => {
    server = await startStandIn({ port: 0, delay: 1 });
    const scene = [...server.scenes.values()][0].scene as unknown as SceneJson;
    const g = generator(server.url),
      a = ask(false, 1);
    g.ask({
      ...a.ask,
      scene: () => ({ scene: { ...scene, map: { ref: 'sha256:unknown' } } }),
      whole: () => scene,
    });
    await a.done;
    expect(a.seen.final).toBe(1);
  });
});

describe('stream', () => {
  it('joins lines however they are cut', async () => {
    const text = '{"event":"heartbeat"}\n\n{"event":"step","step":1,"agents":{}}\n{"event":"superseded"}';
    const bytes = new TextEncoder().encode(text);
    for (const size of [1, 3, 7, 1000]) {
      const body = new ReadableStream<Uint8Array>({
        start(c) {
          for (let i = 0; i < bytes.length; i += size) c.enqueue(bytes.slice(i, i + size));
          c.close();
        },
      });
      const out = [];
      for await (const events of readEvents(body)) out.push(...events.map((e) => e.event));
      expect(out).toEqual(['heartbeat', 'step', 'superseded']);
    }
  });
});

describe('a drag that is answered in time, with late delivery', () => {
  /** The test decides when answers arrive, and advances the clock. */
  function scripted() {
    let now = 0;
    const asked: { body: { revision: number }; signal: AbortSignal; tell: (e: GenerateEvent) => void }[] = [];
    const line: Transport = (body, signal) => {
      const come: GenerateEvent[] = [];
      let wake: (() => void) | null = null;
      signal.addEventListener('abort', () => wake?.());
      const events = async function* () {
        while (!signal.aborted) {
          while (come.length) yield come.shift()!;
          await new Promise<void>((w) => (wake = w));
        }
      };
      const tell = (e: GenerateEvent) => (come.push(e), wake?.());
      asked.push({ body: JSON.parse(body) as { revision: number }, signal, tell });
      return Promise.resolve({ status: 200, problem: null, events: events() });
    };
    const g = new HttpGenerator(new Client(''), line, { tick: 1e6 }, () => now);
    const quiet = () => new Promise((done) => setTimeout(done));
    return {
      g,
      asked,
      quiet,
      pass: (ms: number) => void (now += ms),
      async draft(i: number) {
        asked[i].tell({ event: 'initial', revision: asked[i].body.revision, window: 0, steps: 5, agents: {} } as never);
        await quiet();
      },
      async final(i: number) {
        const nothing = { samples: [], resolved: {} };
        asked[i].tell({ event: 'final', revision: asked[i].body.revision, ...nothing } as never);
        await quiet();
      },
    };
  }

  /** Eight questions, each with its first result after this many ms, as a draft or as its answer. */
  async function warm(s: ReturnType<typeof scripted>, ms = 8, heard: 'draft' | 'final' = 'draft') {
    for (let i = 0; i < 8; i++) {
      s.g.ask(ask(true, i).ask);
      await s.quiet();
      s.pass(ms);
      await s[heard](i);
    }
  }

  it('sends the next question once the answer must be under way, and still shows that', async () => {
    const s = scripted();
    await warm(s);
    const [a, b] = [ask(true, 20), ask(true, 21)];
    s.g.ask(a.ask);
    await s.quiet();
    s.pass(16);
    s.g.ask(b.ask);
    await s.quiet();
    expect(s.asked).toHaveLength(10);
    expect(s.asked[8].signal.aborted).toBe(false);
    await s.draft(8);
    expect(a.seen).toMatchObject({ drafts: [0], dropped: 1 });
    await s.draft(9);
    expect(b.seen).toMatchObject({ drafts: [0], dropped: 0 });
    s.g.cancel();
  });

  it('overtakes answers without drafts in the same way', async () => {
    const s = scripted();
    await warm(s, 8, 'final');
    const [a, b] = [ask(true, 20), ask(true, 21)];
    s.g.ask(a.ask);
    await s.quiet();
    s.pass(16);
    s.g.ask(b.ask);
    await s.quiet();
    expect(s.asked).toHaveLength(10);
    await s.final(8);
    expect(a.seen).toMatchObject({ drafts: [], final: 1, dropped: 0 });
    // A result was drawn: the next may be overtaken again.
    s.pass(16);
    s.g.ask(ask(true, 22).ask);
    await s.quiet();
    expect(s.asked).toHaveLength(11);
    // A newer answer replaces the older question.
    await s.final(10);
    expect(s.asked[9].signal.aborted).toBe(true);
    expect(b.seen).toMatchObject({ final: 0, dropped: 1 });
  });

  it('overtakes no second one before a result was drawn', async () => {
    const s = scripted();
    await warm(s);
    for (let i = 0; i < 6; i++) {
      s.g.ask(ask(true, 20 + i).ask);
      await s.quiet();
      s.pass(16);
    }
    expect(s.asked).toHaveLength(10);
    await s.draft(9);
    // The older of the two is cancelled, and the newest one is sent.
    expect(s.asked[8].signal.aborted).toBe(true);
    expect(s.asked).toHaveLength(11);
    s.g.cancel();
  });

  it('waits for a question that contains its scene', async () => {
    const s = scripted();
    await warm(s);
    const carrying = (goal: number) => ({ ...ask(true, goal).ask, scene: () => ({ scene: crossingJson() }) });
    s.g.ask(carrying(20));
    await s.quiet();
    s.pass(16);
    s.g.ask(carrying(21));
    await s.quiet();
    expect(s.asked).toHaveLength(9);
    s.g.cancel();
  });

  it('waits where the server is slower than the drag', async () => {
    const s = scripted();
    await warm(s, 40);
    s.g.ask(ask(true, 20).ask);
    await s.quiet();
    s.pass(16);
    s.g.ask(ask(true, 21).ask);
    await s.quiet();
    expect(s.asked).toHaveLength(9);
    s.g.cancel();
  });
});
