// A followed run comes in pieces of any length, and ends with the server, or when it is left.
import { expect, it } from 'vitest';
import { Client, Refused } from '../../src/net/client';
import { followRun, type RunEvent } from '../../src/net/run-follower';

const STEP = { number: 1, time_s: 0.1, states: {}, changes: [], faults: [], entered: [], left: [] };
const EVENTS = [{ event: 'step', step: STEP }, { event: 'heartbeat' }, { event: 'end' }];
const TEXT = new TextEncoder().encode(EVENTS.map((e) => `${JSON.stringify(e)}\n`).join(''));

/** A server whose reply comes in pieces of so many bytes. */
function answering(bytes: number, left: () => void = () => undefined): Client {
  const body = new ReadableStream<Uint8Array>({
    start(to) {
      for (let at = 0; at < TEXT.length; at += bytes) to.enqueue(TEXT.slice(at, at + bytes));
      if (bytes !== 40) to.close();
    },
    cancel: left,
  });
  return new Client('', (path, init) => {
    expect([path, new Headers(init?.headers).get('accept')]).toEqual(['/v1/runs/a%2Fb', 'application/x-ndjson']);
    return Promise.resolve(new Response(body));
  });
}

const { signal } = new AbortController();

it('gives the events, however the bytes are cut', async () => {
  for (const bytes of [1, 7, 1000]) {
    const seen: RunEvent[] = [];
    for await (const event of followRun(answering(bytes), 'a/b', signal)) seen.push(event);
    expect(seen).toEqual(EVENTS);
  }
});

it('leaves the reply when its reader leaves', async () => {
  let left = false;
  const events = followRun(
    answering(40, () => (left = true)),
    'a/b',
    signal,
  );
  for await (const { event } of events) if (event === 'step') break;
  expect(left).toBe(true);
});

it('says why a run is not there', async () => {
  const problem = { type: 'about:blank', title: 'Not found', status: 404, code: 'not-found', detail: 'No run.' };
  const head = { status: 404, headers: { 'Content-Type': 'application/problem+json' } };
  const client = new Client('', () => Promise.resolve(new Response(JSON.stringify(problem), head)));
  await expect(followRun(client, 'gone', signal).next()).rejects.toBeInstanceOf(Refused);
});
