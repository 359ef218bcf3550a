// One question to the generator and its answer: a refusal, or a sequence of events.
import { problemOf } from './problem';
import type { Client } from './client';
import { readEvents, type Together } from './stream';
import type { GenerateEvent, Problem } from './types';

export interface Head {
  readonly status: number;
  /** The server's name for the scene that came with the question. */
  readonly held?: string | undefined;
  /** Why there are no events; null where there are. */
  readonly problem: Problem | null;
}

export interface EventReply extends Head {
  /** To be read once. Leaving the loop early ends the server's work too. */
  readonly events: AsyncIterable<GenerateEvent>;
}

/** Sends a request. */
export type Sender = Pick<Client, 'send'>;

/** Sends a question, given as a request body. The abort signal makes it fail. */
export type Transport = (body: string, signal: AbortSignal) => Promise<EventReply>;

async function* none(): AsyncGenerator<Together> {}

/** The transport on the current thread. */
export function httpTransport(sender: Sender): Transport {
  const ask = askHere(sender);
  return async (body, signal) => {
    const { pieces, ...head } = await ask(body, signal);
    return { ...head, events: oneByOne(pieces) };
  };
}

async function* oneByOne(pieces: AsyncIterable<Together>): AsyncGenerator<GenerateEvent> {
  for await (const events of pieces) yield* events;
}

/** The same, with events that arrived together in one group. */
export function askHere(sender: Sender) {
  return async (body: string, signal: AbortSignal): Promise<Head & { pieces: AsyncIterable<Together> }> => {
    const reply = await sender.send('/v1/generate', {
      method: 'POST',
      body,
      signal,
      headers: { 'Content-Type': 'application/json', Accept: 'application/x-ndjson' },
    });
    const head = {
      status: reply.status,
      held: reply.headers.get('dragtraffic-scene') ?? undefined,
    };
    if (!reply.ok) return { ...head, problem: await problemOf(reply), pieces: none() };
    return { ...head, problem: null, pieces: readEvents(reply.body!) };
  };
}
