// Parsing of large answers in a worker, so that a drag never waits for them. Columns of numbers come back as
// typed arrays, which are handed over instead of copied.

let worker: Worker | null | undefined;
let count = 0;
const waiting = new Map<number, { done: (v: unknown) => void; fail: (e: Error) => void }>();

function start(): Worker | null {
  if (typeof Worker === 'undefined') return null;
  try {
    const w = new Worker(new URL('./decoder.worker.ts', import.meta.url), { type: 'module' });
    w.onmessage = (e: MessageEvent<{ id: number; value?: unknown; error?: string }>) => {
      const job = waiting.get(e.data.id);
      waiting.delete(e.data.id);
      if (e.data.error) job?.fail(new SyntaxError(e.data.error));
      else job?.done(e.data.value);
    };
    w.onerror = () => {
      worker = null;
      for (const job of waiting.values()) job.fail(new Error('decoder stopped'));
      waiting.clear();
    };
    return w;
  } catch {
    return null;
  }
}

export function parseLater(text: string): Promise<unknown> {
  worker ??= start();
  const w = worker;
  if (!w) return Promise.resolve().then(() => JSON.parse(text) as unknown);
  const id = ++count;
  return new Promise<unknown>((done, fail) => {
    waiting.set(id, { done, fail });
    w.postMessage({ id, text });
  }).catch(() => JSON.parse(text) as unknown);
}
