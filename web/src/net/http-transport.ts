// One question to the generator and what comes back: a refusal, or events one after the other.
import { problemOf } from './problem';
import type { Client } from './client';
import { readEvents, type Together } from './stream';
import type { GenerateEvent, Problem } from './types';

export interface Head {
  readonly status: number;
  /** When a server that is busy wants to be asked again, seconds; null where it says nothing. */
  readonly retryAfter_s: number | null;
  /** Under what name the server holds the scene that came with the question. */
  readonly held?: string | undefined;
  /** Why there are no events; null where there are. */
  readonly problem: Problem | null;
}

export interface Answer extends Head {
  /** To be read once. Who leaves early ends the work of the server, too. */
  readonly events: AsyncIterable<GenerateEvent>;
}

/** Sends a request. */
export type Sender = Pick<Client, 'send'>;

/** Puts a question, given as the body of its request. A signal that aborts fails what is on its way. */
export type Transport = (body: string, signal: AbortSignal) => Promise<Answer>;

async function* none(): AsyncGenerator<Together> {}

/** The line of the thread that it is made in. */
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

/** The same, with what came together in one. */
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
      retryAfter_s: Number(reply.headers.get('retry-after')) || null,
      held: reply.headers.get('dragtraffic-scene') ?? undefined,
    };
    if (!reply.ok) return { ...head, problem: await problemOf(reply), pieces: none() };
    return { ...head, problem: null, pieces: readEvents(reply.body!) };
  };
}
