// A busy server does not end a drive: the step is sent again until there is room, and no longer than the drive lasts.
import { afterEach, expect, it, vi } from 'vitest';
import { Client, Refused } from '../../src/net/client';
import { RunLine } from '../../src/net/run-line';

const PRESENT = { number: 0, time_s: 0, states: {}, changes: [], faults: [], entered: [], left: [] };
const STEP = { ...PRESENT, number: 1, time_s: 0.1 };
const EGO = { id: 'a', x_m: 0, y_m: 0, heading_rad: 0, vx_mps: 0, vy_mps: 0 };

const refusal = (status: number, code: string): Response =>
  new Response(JSON.stringify({ title: code, status, code, retry_after_ms: 40 }), { status });

/** A run on a server without WebSockets that gives these replies to its steps; each gets the bodies sent so far. */
async function running(
  ...replies: ((sent: readonly string[]) => Response)[]
): Promise<{ line: RunLine; sent: string[] }> {
  vi.stubGlobal('location', { href: 'http://server/' });
  vi.stubGlobal('WebSocket', undefined);
  const sent: string[] = [];
  const client = new Client('', (path, init) => {
    if (path === '/v1/runs') return Promise.resolve(new Response(JSON.stringify({ run: 'r', present: PRESENT })));
    if (init?.method === 'DELETE') return Promise.resolve(new Response(null, { status: 204 }));
    sent.push(init?.body as string);
    return Promise.resolve(replies[Math.min(sent.length, replies.length) - 1](sent));
  });
  return { line: await RunLine.begin(client, { scene: {} as never, ego: 'a', seed: 1 }), sent };
}

afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

it('sends a step again after the time that a busy server asks for', async () => {
  const busy = () => refusal(503, 'busy');
  const limited = () => refusal(429, 'too-many-requests');
  const { line, sent } = await running(busy, limited, () => new Response(JSON.stringify(STEP)));
  vi.useFakeTimers();
  const step = line.step(1, EGO);
  const counts = [];
  for (let i = 0; i < 4; i++) {
    await vi.advanceTimersByTimeAsync(39);
    counts.push(sent.length);
    await vi.advanceTimersByTimeAsync(1);
  }
  expect(counts).toEqual([1, 2, 3, 3]);
  expect(await step).toEqual(STEP);
  expect(new Set(sent).size).toBe(1);
});

it('sends a step once the one before is answered, and none after one that failed', async () => {
  const bodies: Record<number, Response> = {
    1: new Response(JSON.stringify(STEP)),
    2: refusal(409, 'step-order'),
  };
  const { line, sent } = await running((all) => bodies[all.length]);
  const first = line.step(1, EGO);
  const later = [line.step(2, EGO), line.step(3, EGO)];
  const refused = later.map((step) => expect(step).rejects.toBeInstanceOf(Refused));
  expect(sent.length).toBeLessThan(2);
  expect(await first).toEqual(STEP);
  await Promise.all(refused);
  expect(sent.map((body) => (JSON.parse(body) as { number: number }).number)).toEqual([1, 2]);
});

it('gives other refusals to the caller', async () => {
  const { line, sent } = await running(() => refusal(404, 'not-found'));
  await expect(line.step(1, EGO)).rejects.toBeInstanceOf(Refused);
  expect(sent.length).toBe(1);
});

it('asks no more once the run is over', async () => {
  const { line, sent } = await running(() => refusal(503, 'busy'));
  vi.useFakeTimers();
  const step = line.step(1, EGO);
  const over = expect(step).rejects.toThrow();
  await vi.advanceTimersByTimeAsync(10);
  line.end();
  await vi.advanceTimersByTimeAsync(100);
  await over;
  expect(sent.length).toBe(1);
});
