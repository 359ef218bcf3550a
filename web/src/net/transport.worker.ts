// Runs in a worker: sends questions to the generator, reads and unpacks the stream, and passes it on. Events that
// arrive together go in one message: each message costs the page a task, sixty times a second.
import type { Head } from './http-transport';
import { ROOT } from './root';
import { connection, SocketTransport } from './socket-transport';
import type { Together } from './stream';
import type { GenerateEvent } from './types';

/** A question with a number; or its cancellation. */
export type ToWorker = { readonly id: number; readonly body: string } | { readonly end: number };
/** The head comes with the first events; the last message is marked, or is a failure, unless the page has ended it. */
export type FromWorker = { readonly id: number } & (
  { readonly head: Head | null; readonly events: Together; readonly last: boolean } | Failed
);
type Failed = { readonly failed: string };

/** The last event of an answer. */
const LAST = new Set<GenerateEvent['event']>(['final', 'error', 'superseded']);

const line = new SocketTransport({ send: (path, init) => fetch(ROOT + path, init) }, () =>
  connection('/v1/generate', self.location.href),
);
const open = new Map<number, AbortController>();
const tell = (said: FromWorker): void => self.postMessage(said);

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if ('end' in data) open.get(data.end)?.abort();
  else void answer(data.id, data.body);
};

async function answer(id: number, body: string): Promise<void> {
  const abort = new AbortController();
  open.set(id, abort);
  try {
    const { pieces, ...begun } = await line.ask(body, abort.signal);
    let head: Head | null = begun;
    let last = false;
    for await (const events of pieces) {
      last ||= events.some((e) => LAST.has(e.event));
      tell({ id, head, events, last });
      head = null;
    }
    if (!last) tell({ id, head, events: [], last: true });
  } catch (e) {
    if (!abort.signal.aborted) tell({ id, failed: String(e) });
  } finally {
    open.delete(id);
  }
}
