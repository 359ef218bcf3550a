// The connection in a worker: the worker's own code behind a worker made of timers, with the stand-in server.
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Client } from '../../src/net/client';
import { WorkerTransport } from '../../src/net/worker-transport';
import type { FromWorker, ToWorker } from '../../src/net/transport.worker';
import { startStandIn, type StandIn } from '../standin/server.mjs';

const BODY = JSON.stringify({
  scene_id: 'demo-crossing',
  agents: ['1'],
  react: false,
  conditions: { 1: { goal: { x_m: 10, y_m: 0 } } },
  steps: 5,
  stream_modes: 'all',
});

/** The global object of the worker. */
const inside: {
  onmessage?: (e: { data: ToWorker }) => void;
  postMessage?: (m: FromWorker) => void;
  location?: unknown;
} = {};
let made: FakeWorker[] = [];

/** Messages are copied and arrive later, as between threads. */
class FakeWorker {
  #gone = false;
  onmessage: ((e: { data: FromWorker }) => void) | null = null;
  onerror: ((e: { preventDefault(): void }) => void) | null = null;
  constructor() {
    made.push(this);
    inside.postMessage = (m) =>
      void setTimeout((data: FromWorker) => this.onmessage?.({ data }), 0, structuredClone(m));
  }
  postMessage(m: ToWorker): void {
    setTimeout((data: ToWorker) => !this.#gone && inside.onmessage?.({ data }), 0, structuredClone(m));
  }
  terminate(): void {
    this.#gone = true;
  }
}

let server: StandIn;
const asked = vi.fn<(signal: AbortSignal | null | undefined) => void>();
const real = globalThis.fetch;

beforeEach(async () => {
  made = [];
  asked.mockReset();
  server = await startStandIn({ port: 0, delay: 5 });
  vi.stubGlobal('Worker', FakeWorker);
  inside.location = { href: server.url };
  vi.stubGlobal('self', inside);
  // The stand-in answers only requests.
  vi.stubGlobal('WebSocket', undefined);
  // The worker uses the server that its script came from.
  vi.stubGlobal('fetch', (path: string, init?: RequestInit) => {
    asked(init?.signal);
    return real(new URL(path, server.url), init);
  });
  vi.resetModules();
  await import('../../src/net/transport.worker');
});

afterEach(async () => {
  vi.unstubAllGlobals();
  await server.close();
});

it('gives the events in the order of arrival, and starts one worker', async () => {
  const line = new WorkerTransport(new Client());
  const answer = await line.ask(BODY, new AbortController().signal);
  expect(answer).toMatchObject({ status: 200, problem: null });
  const events = [];
  for await (const e of answer.events) events.push(e);
  const told = events.map((e) => e.event).filter((name) => name !== 'heartbeat');
  expect(told).toEqual(['accepted', 'initial', 'step', 'step', 'step', 'step', 'step', 'final']);
  expect(made.length).toBe(1);
});

it('two questions at once do not mix', async () => {
  const line = new WorkerTransport(new Client());
  const one = async (): Promise<number> => {
    let count = 0;
    for await (const e of (await line.ask(BODY, new AbortController().signal)).events)
      if (e.event !== 'heartbeat') count++;
    return count;
  };
  const [a, b] = await Promise.all([one(), one()]);
  expect(a).toBe(b);
  expect(a).toBeGreaterThanOrEqual(7);
});

it('a cancelled question ends in the worker, too', async () => {
  const line = new WorkerTransport(new Client());
  const abort = new AbortController();
  const answer = await line.ask(BODY, abort.signal);
  const reading = (async () => {
    for await (const e of answer.events) if (e.event === 'initial') abort.abort();
  })();
  await expect(reading).rejects.toMatchObject({ name: 'AbortError' });
  await vi.waitFor(() => expect(asked.mock.lastCall![0]!.aborted).toBe(true));
});

it('leaving the loop early ends the work, too', async () => {
  const line = new WorkerTransport(new Client());
  const answer = await line.ask(BODY, new AbortController().signal);
  for await (const e of answer.events) if (e.event === 'initial') break;
  await vi.waitFor(() => expect(asked.mock.lastCall![0]!.aborted).toBe(true));
});

it('a refusal has its words, and a missing server is a failure', async () => {
  const line = new WorkerTransport(new Client());
  const refused = await line.ask('{"scene_id":"nowhere"}', new AbortController().signal);
  expect(refused.status).toBeGreaterThanOrEqual(400);
  expect(refused.problem?.title).toBeTruthy();
  await server.close();
  await expect(line.ask(BODY, new AbortController().signal)).rejects.toThrow();
  server = await startStandIn({ port: 0, delay: 1 });
});

it('without its worker the page sends requests itself', async () => {
  const line = new WorkerTransport(new Client());
  const answering = line.ask(BODY, new AbortController().signal);
  made[0].onerror!({ preventDefault: () => undefined });
  const answer = await answering;
  let last = '';
  for await (const e of answer.events) last = e.event;
  expect(last).toBe('final');
});
