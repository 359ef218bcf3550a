// The persistent connection to the generator, over a socket whose ends are both in the test.
import { expect, it, vi } from 'vitest';
import { Client } from '../../src/net/client';
import { SocketTransport } from '../../src/net/socket-transport';

class FakeSocket {
  readonly OPEN = 1;
  readyState = 0;
  readonly sent: { ask?: number; body?: unknown; end?: number }[] = [];
  onopen: (() => void) | null = null;
  onmessage: ((e: { data: string }) => void) | null = null;
  onclose: (() => void) | null = null;

  send(text: string): void {
    this.sent.push(JSON.parse(text) as object);
  }
  open(): void {
    this.readyState = 1;
    this.onopen?.();
  }
  /** Sends a message of the server: a head, then lines. */
  tell(head: object, ...lines: object[]): void {
    this.onmessage?.({ data: [head, ...lines].map((line) => `${JSON.stringify(line)}\n`).join('') });
  }
  close(): void {
    this.readyState = 3;
    this.onclose?.();
  }
}

/** The smallest possible events. */
const ACCEPTED = { event: 'accepted' };
const DRAFT = { event: 'initial', agents: {} };
const FINAL = { event: 'final', samples: [] };
const BODY = '{"scene_id":"demo"}';
const never = new AbortController().signal;

function stage() {
  const sockets: FakeSocket[] = [];
  let now = 0;
  const requests = vi.fn<(body: string) => Response>(() => new Response(JSON.stringify(FINAL)));
  const client = new Client('', (_, init) => Promise.resolve(requests(init!.body as string)));
  const connect = () => {
    sockets.push(new FakeSocket());
    return sockets.at(-1) as unknown as WebSocket;
  };
  const line = new SocketTransport(client, connect, () => now);
  return { line, sockets, requests, later: (ms: number) => (now += ms) };
}

async function read(pieces: AsyncIterable<readonly { event: string }[]>): Promise<string[][]> {
  const all = [];
  for await (const piece of pieces) all.push(piece.map((e) => e.event));
  return all;
}

it('sends over the connection once it is open, and before that by requests', async () => {
  const { line, sockets, requests } = stage();
  expect(await read((await line.ask(BODY, never)).pieces)).toEqual([['final']]);
  expect(requests).toHaveBeenCalledTimes(1);
  sockets[0].open();
  const asking = line.ask(BODY, never);
  expect(sockets[0].sent).toEqual([{ ask: 1, body: { scene_id: 'demo' } }]);
  sockets[0].tell({ ask: 1, status: 200, scene: 'held:1' }, ACCEPTED, DRAFT);
  const { pieces, ...head } = await asking;
  expect(head).toEqual({ status: 200, held: 'held:1', problem: null });
  sockets[0].tell({ ask: 1 }, DRAFT);
  sockets[0].tell({ ask: 1, last: true }, FINAL);
  expect(await read(pieces)).toEqual([['accepted', 'initial'], ['initial'], ['final']]);
  expect(requests).toHaveBeenCalledTimes(1);
  expect(sockets.length).toBe(1);
});

it('keeps questions apart, and cancels an abandoned one', async () => {
  const { line, sockets } = stage();
  const [socket] = sockets;
  socket.open();
  const abort = new AbortController();
  const first = line.ask(BODY, abort.signal);
  const second = line.ask(BODY, never);
  abort.abort();
  await expect(first).rejects.toMatchObject({ name: 'AbortError' });
  expect(socket.sent.at(-1)).toEqual({ end: 1 });
  // Pieces already under way are dropped.
  socket.tell({ ask: 1, status: 200, last: true }, FINAL);
  socket.tell({ ask: 2, status: 200 }, ACCEPTED);
  const answer = await second;
  for await (const piece of answer.pieces) {
    expect(piece).toEqual([ACCEPTED]);
    break;
  }
  expect(socket.sent.at(-1)).toEqual({ end: 2 });
});

it('a refusal has its words and the time of a retry', async () => {
  const { line, sockets } = stage();
  sockets[0].open();
  const asking = line.ask(BODY, never);
  sockets[0].tell(
    { ask: 1, status: 503, retry_after_s: 2, last: true },
    { code: 'busy', retry_after_ms: 1500, title: 'Busy' },
  );
  const { pieces, ...head } = await asking;
  expect(head).toMatchObject({
    status: 503,
    problem: { code: 'busy', retry_after_ms: 1500, title: 'Busy', status: 503 },
  });
  expect(await read(pieces)).toEqual([]);
});

it('an answer that stops early fails with the words of its problem', async () => {
  const { line, sockets } = stage();
  sockets[0].open();
  const asking = line.ask(BODY, never);
  sockets[0].tell({ ask: 1, status: 200 }, ACCEPTED);
  const { pieces } = await asking;
  sockets[0].tell({ ask: 1, status: 500, last: true }, { code: 'internal', detail: 'The server failed.' });
  await expect(read(pieces)).rejects.toThrow('The server failed.');
});

it('questions of a lost connection are sent as requests; half an answer is a failure', async () => {
  const { line, sockets, requests } = stage();
  sockets[0].open();
  const unheard = line.ask(BODY, never);
  const half = line.ask(BODY, never);
  sockets[0].tell({ ask: 2, status: 200 }, ACCEPTED);
  const { pieces } = await half;
  sockets[0].close();
  expect(await read((await unheard).pieces)).toEqual([['final']]);
  expect(requests).toHaveBeenCalledTimes(1);
  await expect(read(pieces)).rejects.toThrow('lost');
});

it('a connection with unreadable messages is closed', async () => {
  const { line, sockets, requests } = stage();
  sockets[0].open();
  const asking = line.ask(BODY, never);
  sockets[0].onmessage!({ data: '<html>' });
  expect(await read((await asking).pieces)).toEqual([['final']]);
  expect(requests).toHaveBeenCalledTimes(1);
});

it('reconnects after a delay, which doubles each time', async () => {
  const { line, sockets, requests, later } = stage();
  const ask = async (): Promise<void> => void (await read((await line.ask(BODY, never)).pieces));
  sockets[0].close();
  await ask();
  expect(sockets.length).toBe(1);
  later(500);
  await ask();
  expect(sockets.length).toBe(2);
  sockets[1].close();
  later(500);
  await ask();
  expect(sockets.length).toBe(2);
  later(500);
  await ask();
  expect(sockets.length).toBe(3);
  sockets[2].open();
  expect(requests).toHaveBeenCalledTimes(4);
  // After a successful one the delay is short again.
  sockets[2].close();
  later(2000);
  await ask();
  sockets[3].close();
  later(500);
  await ask();
  expect(sockets.length).toBe(5);
});

it('long questions, and more than a few at once, are sent as requests', async () => {
  const { line, sockets, requests } = stage();
  sockets[0].open();
  await line.ask(JSON.stringify({ scene: 'x'.repeat(200_000) }), never);
  expect(requests).toHaveBeenCalledTimes(1);
  for (let i = 0; i < 6; i++) void line.ask(BODY, never);
  expect(sockets[0].sent.length).toBe(6);
  await line.ask(BODY, never);
  expect(requests).toHaveBeenCalledTimes(2);
});
