// Reads a fetch body as newline-delimited JSON. EventSource cannot POST, so the stream is read by hand.
import type { GenerateEvent } from './types';
import { expanded } from './compact';
import { parseLater } from './decoder';

/** Lines longer than this are parsed off the main thread: they cost more than 2 ms here. */
const LONG_LINE = 120_000;

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
        if (line) yield await parse(line);
      }
      if (done) break;
    }
    if (rest.trim()) yield await parse(rest.trim());
  } finally {
    // Leaving the loop early must also stop the server's work.
    void reader.cancel().catch(() => undefined);
  }
}

type Sent = Parameters<typeof expanded>[0];

const parse = async (line: string): Promise<GenerateEvent> =>
  expanded((line.length > LONG_LINE ? await parseLater(line) : JSON.parse(line)) as Sent);
