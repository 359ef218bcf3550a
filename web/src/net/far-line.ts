// The line to the generator in a worker, so that a drag never waits for a request or for the reading of an answer.
import type { Client } from './client';
import type { Answer, Head, Line } from './line';
import type { FromLine, ToLine } from './line.worker';
import type { GenerateEvent } from './types';

/** A question on its way: whoever waits for its head, and what has come and was not read yet. */
class Open {
  head!: (h: Head) => void;
  fail!: (e: unknown) => void;
  readonly begun = new Promise<Head>((done, fail) => {
    this.head = done;
    this.fail = fail;
  });
  readonly #come: GenerateEvent[] = [];
  #over: { readonly error: unknown } | null = null;
  #wake: (() => void) | null = null;

  add(events: readonly GenerateEvent[]): void {
    this.#come.push(...events);
    this.#wake?.();
  }

  /** Nothing more comes; with an error what came is not all. */
  end(error: unknown = null): void {
    this.#over ??= { error };
    if (error) this.fail(error);
    this.#wake?.();
  }

  async *events(leave: () => void): AsyncGenerator<GenerateEvent> {
    try {
      for (;;) {
        while (this.#come.length) yield this.#come.shift()!;
        if (this.#over) break;
        await new Promise<void>((wake) => (this.#wake = wake));
      }
      if (this.#over.error) throw this.#over.error;
    } finally {
      leave();
    }
  }
}

/** A worker that cannot be had, or that ended. */
class NoWorker extends Error {}

export class FarLine {
  #worker: Worker | null = null;
  #count = 0;
  readonly #open = new Map<number, Open>();

  /** The worker starts at once, before anybody asks. */
  constructor(private readonly client: Client) {
    this.#worker = this.#start();
  }

  readonly ask: Line = async (body, signal) => {
    try {
      return await this.#far(body, signal);
    } catch (e) {
      if (!(e instanceof NoWorker)) throw e;
      const { lineHere } = await import('./line');
      return lineHere(this.client)(body, signal);
    }
  };

  async #far(body: string, signal: AbortSignal): Promise<Answer> {
    const worker = (this.#worker ??= this.#start());
    if (!worker) throw new NoWorker();
    signal.throwIfAborted();
    const id = ++this.#count;
    const question = new Open();
    this.#open.set(id, question);
    const send = (said: ToLine): void => worker.postMessage(said);
    const leave = (): void => {
      signal.removeEventListener('abort', stop);
      if (this.#open.delete(id)) send({ end: id });
    };
    const stop = (): void => {
      leave();
      question.end(signal.reason);
    };
    signal.addEventListener('abort', stop);
    send({ id, body });
    const head = await question.begun;
    return { ...head, events: question.events(leave) };
  }

  #start(): Worker | null {
    if (typeof Worker === 'undefined') return null;
    const worker = new Worker(new URL('./line.worker.ts', import.meta.url), { type: 'module' });
    worker.onmessage = ({ data }: MessageEvent<FromLine>) => {
      const question = this.#open.get(data.id);
      if (!question) return;
      const failed = 'failed' in data;
      if (failed || data.last) this.#open.delete(data.id);
      if (failed) return question.end(new Error(data.failed));
      if (data.head) question.head(data.head);
      question.add(data.events);
      if (data.last) question.end();
    };
    worker.onerror = (e) => {
      e.preventDefault();
      worker.terminate();
      this.#worker = null;
      const lost = [...this.#open.values()];
      this.#open.clear();
      for (const question of lost) question.end(new NoWorker());
    };
    return worker;
  }
}
