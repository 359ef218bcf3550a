// Reads a fetch body as newline-delimited JSON. EventSource cannot POST, so the stream is parsed here.
import type { GenerateEvent } from './types';
import { expanded } from './compact';

/** Events that end in the same chunk of a body. */
export type Together = readonly GenerateEvent[];

export async function* readEvents(body: ReadableStream<Uint8Array>): AsyncGenerator<Together> {
  const reader = body.getReader();
  const decoder = new TextDecoder();
  let rest = '';
  try {
    for (;;) {
      const { done, value } = await reader.read();
      rest += done ? decoder.decode() : decoder.decode(value, { stream: true });
      const end = done ? rest.length : rest.lastIndexOf('\n') + 1;
      const events = eventsOf(rest.slice(0, end));
      rest = rest.slice(end);
      if (events.length) yield events;
      if (done) break;
    }
  } finally {
    // Leaving the loop early must also stop the server's work.
    void reader.cancel().catch(() => undefined);
  }
}

/** The events of complete lines. */
export function eventsOf(text: string): Together {
  const lines = text.split('\n').map((line) => line.trim());
  return lines.filter(Boolean).map(parse);
}

type SentEvent = Parameters<typeof expanded>[0];

const parse = (line: string): GenerateEvent => expanded(JSON.parse(line) as SentEvent);
