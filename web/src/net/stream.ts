// Reads a fetch body as newline-delimited JSON. EventSource cannot POST, so the stream is read by hand.
import type { GenerateEvent } from './types';
import { expanded } from './compact';

export async function* readEvents(body: ReadableStream<Uint8Array>): AsyncGenerator<GenerateEvent> {
  const reader = body.getReader();
  const decoder = new TextDecoder();
  let rest = '';
  try {
    for (;;) {
      const { done, value } = await reader.read();
      rest += done ? decoder.decode() : decoder.decode(value, { stream: true });
      let end: number;
      while ((end = rest.indexOf('\n')) >= 0) {
        const line = rest.slice(0, end).trim();
        rest = rest.slice(end + 1);
        if (line) yield parse(line);
      }
      if (done) break;
    }
    if (rest.trim()) yield parse(rest.trim());
  } finally {
    // Leaving the loop early must also stop the server's work.
    void reader.cancel().catch(() => undefined);
  }
}

type Sent = Parameters<typeof expanded>[0];

const parse = (line: string): GenerateEvent => expanded(JSON.parse(line) as Sent);
