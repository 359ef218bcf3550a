// A body as lines of text, as they come.

/** The complete lines that end in the same chunk of a body, with their ends. */
export async function* readLines(body: ReadableStream<Uint8Array>): AsyncGenerator<string> {
  const reader = body.getReader();
  const decoder = new TextDecoder();
  let rest = '';
  try {
    for (;;) {
      const { done, value } = await reader.read();
      rest += done ? decoder.decode() : decoder.decode(value, { stream: true });
      const end = done ? rest.length : rest.lastIndexOf('\n') + 1;
      const lines = rest.slice(0, end);
      rest = rest.slice(end);
      if (lines.trim()) yield lines;
      if (done) break;
    }
  } finally {
    // Leaving the loop early must also stop the server's work.
    void reader.cancel().catch(() => undefined);
  }
}

/** The values of lines of JSON. */
export function parseLines<T>(text: string): T[] {
  const lines = text.split('\n').map((line) => line.trim());
  return lines.filter(Boolean).map((line) => JSON.parse(line) as T);
}
