// The connection to the generator in a worker, so that a drag never waits for a request or for parsing an answer.
import type { Client } from './client';
import type { Transport } from './http-transport';
import type { FromWorker, ToWorker } from './transport.worker';
import { Multiplexer } from './multiplexer';
import type { GenerateEvent } from './types';

/** The worker is unavailable, or has ended. */
class NoWorker extends Error {}

export class WorkerTransport {
  #worker: Worker | null = null;
  readonly #questions = new Multiplexer<GenerateEvent>();

  /** Starts the worker at once, before the first question. */
  constructor(private readonly client: Client) {
    this.#worker = this.#start();
  }

  readonly ask: Transport = async (body, signal) => {
    try {
      const worker = (this.#worker ??= this.#start());
      if (!worker) throw new NoWorker();
      const send = (said: ToWorker): void => worker.postMessage(said);
      const say = { ask: (id: number, body: string) => send({ id, body }), end: (end: number) => send({ end }) };
      const { pieces: events, ...head } = await this.#questions.put(body, signal, say);
      return { ...head, events };
    } catch (e) {
      if (!(e instanceof NoWorker)) throw e;
      const { httpTransport } = await import('./http-transport');
      return httpTransport(this.client)(body, signal);
    }
  };

  #start(): Worker | null {
    if (typeof Worker === 'undefined') return null;
    const worker = new Worker(new URL('./transport.worker.ts', import.meta.url), { type: 'module' });
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      if ('failed' in data) this.#questions.fail(data.id, new Error(data.failed));
      else this.#questions.hear(data.id, data.head, data.events, data.last);
    };
    worker.onerror = (e) => {
      e.preventDefault();
      worker.terminate();
      this.#worker = null;
      this.#questions.lose(new NoWorker());
    };
    return worker;
  }
}
