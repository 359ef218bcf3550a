// Runs in a worker: asks the generator, reads and unpacks what it streams, and hands it over event by event.
import { Client } from './client';
import { lineHere, type Head } from './line';
import type { GenerateEvent } from './types';

/** A question by a number of its own; or the end of one. */
export type ToLine = { readonly id: number; readonly body: string } | { readonly end: number };
/** The head comes first; the last is either the end or a failure, unless the page has ended the question. */
export type FromLine = { readonly id: number } & (
  { readonly head: Head } | { readonly event: GenerateEvent } | { readonly ended: true } | { readonly failed: string }
);

const ask = lineHere(new Client());
const open = new Map<number, AbortController>();
const tell = (said: FromLine): void => self.postMessage(said);

self.onmessage = ({ data }: MessageEvent<ToLine>) => {
  if ('end' in data) open.get(data.end)?.abort();
  else void answer(data.id, data.body);
};

async function answer(id: number, body: string): Promise<void> {
  const abort = new AbortController();
  open.set(id, abort);
  try {
    const { events, ...head } = await ask(body, abort.signal);
    tell({ id, head });
    for await (const event of events) tell({ id, event });
    tell({ id, ended: true });
  } catch (e) {
    if (!abort.signal.aborted) tell({ id, failed: String(e) });
  } finally {
    open.delete(id);
  }
}
