// A run on the server: traffic that is stepped beside a road user that the page drives. Steps go over a WebSocket of
// the run; without one, or when it is lost, as requests.
import type { Schemas } from '../model/base/schemas';
import type { SceneJson } from '../model/document/scene-json';
import type { Client } from './client';
import { Refused } from './client';
import type { Head } from './http-transport';
import { Multiplexer } from './multiplexer';
import { whenFree } from './when-free';
import { connection, readMessage } from './socket-transport';

export type StepReply = Schemas['StepReply'];
type EgoJson = Schemas['Ego'];

/** Beginning of a run. */
export interface RunOf {
  readonly scene: SceneJson;
  /** Id of the driven road user. */
  readonly ego: string;
  readonly seed: number;
}

export class RunLine {
  #socket: WebSocket | null;
  readonly #steps = new Multiplexer<string>();
  readonly #over = new AbortController();
  #last: Promise<unknown> = Promise.resolve();

  private constructor(
    private readonly client: Client,
    private readonly path: string,
    /** Everybody at the start. */
    readonly present: StepReply,
  ) {
    this.#socket = connection(`${path}/step`, location.href);
    if (!this.#socket) return;
    this.#socket.onmessage = ({ data }: MessageEvent<string>) => {
      const { ask, head, rest, last } = readMessage(data);
      this.#steps.hear(ask, head, head?.problem ? [] : [rest], last);
    };
    this.#socket.onclose = () => {
      this.#socket = null;
      this.#steps.lose(new Error('The connection was lost.'));
    };
  }

  /** Fails with `Refused` or `Away`. */
  static async begin(client: Client, { scene, ego, seed }: RunOf): Promise<RunLine> {
    const reply = await client.request('/v1/runs', {
      method: 'POST',
      body: JSON.stringify({ scene, egos: [ego], seed }),
      headers: { 'Content-Type': 'application/json' },
    });
    const { run, present } = (await reply.json()) as Schemas['RunReply'];
    return new RunLine(client, `/v1/runs/${run}`, present);
  }

  /**
   * The next step, numbered from 1 on; it is sent once the one before is answered, and fails where that failed. A
   * number may be sent again: it gives the same reply, so that a busy server is asked until it has room.
   */
  step(number: number, ego: Omit<EgoJson, 'plan'>): Promise<StepReply> {
    const body = JSON.stringify({ number, egos: [ego] });
    const step = this.#last.then(() => whenFree(() => this.#stepNow(body), this.#over.signal));
    this.#last = step;
    return step;
  }

  async #stepNow(body: string): Promise<StepReply> {
    const socket = this.#socket;
    if (socket && socket.readyState === socket.OPEN) {
      const reply = await this.#overLine(socket, body).catch(() => null);
      if (reply?.problem) throw new Refused(reply.status, reply.problem);
      if (reply) return JSON.parse(reply.text) as StepReply;
    }
    const reply = await this.client.request(`${this.path}/step`, {
      method: 'POST',
      body,
      headers: { 'Content-Type': 'application/json' },
      signal: this.#over.signal,
    });
    return (await reply.json()) as StepReply;
  }

  async #overLine(socket: WebSocket, body: string): Promise<Head & { readonly text: string }> {
    const say = {
      ask: (id: number, text: string) => socket.send(`{"ask":${id},"body":${text}}`),
      end: (id: number) => socket.send(`{"end":${id}}`),
    };
    const { pieces, ...head } = await this.#steps.put(body, this.#over.signal, say);
    let text = '';
    for await (const piece of pieces) text += piece;
    return { ...head, text };
  }

  /** Forgets the run, here and on the server. */
  end(): void {
    this.#over.abort();
    this.#socket?.close();
    void this.client.send(this.path, { method: 'DELETE' }).catch(() => undefined);
  }
}
