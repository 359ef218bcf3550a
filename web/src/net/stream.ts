// Reads a fetch body as events of a generation. EventSource cannot POST, so the stream is parsed here.
import type { GenerateEvent } from './types';
import { expanded } from './compact';
import { parseLines, readLines } from './lines';

/** Events that end in the same chunk of a body. */
export type Together = readonly GenerateEvent[];

export async function* readEvents(body: ReadableStream<Uint8Array>): AsyncGenerator<Together> {
  for await (const lines of readLines(body)) yield eventsOf(lines);
}

/** The events of complete lines. */
export function eventsOf(text: string): Together {
  return parseLines<Parameters<typeof expanded>[0]>(text).map(expanded);
}
