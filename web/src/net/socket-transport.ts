// Questions over a persistent connection: separate requests cost the browser three times the work, sixty times a
// second. Without such a connection, questions go as requests.
import { askHere, type Head, type Sender } from './http-transport';
import { problemIn } from './problem';
import { Multiplexer } from './multiplexer';
import { eventsOf, type Together } from './stream';
import { ROOT } from './root';

type Ask = ReturnType<typeof askHere>;

/** Longer questions go as requests: messages have a lower size limit than bodies. */
const MOST_CHARACTERS = 100_000;
/** Further simultaneous questions go as requests: on the connection they would wait for each other. */
const MOST_AT_ONCE = 6;
/** Delay before the first reconnection, milliseconds; each further one doubles it. */
const AGAIN_MS = 500;
const AGAIN_MOST_MS = 60_000;

/** The server's header of an answer, on the first line of a message. */
interface Told {
  readonly ask: number;
  readonly status?: number;
  readonly scene?: string;
  readonly last?: true;
}

/** The connection ended before any answer. */
class Lost extends Error {}

export class SocketTransport {
  #socket: WebSocket | null = null;
  /** Earliest time of the next connection attempt, and the delay after it. */
  #next = { at: -Infinity, after: AGAIN_MS };
  readonly #questions = new Multiplexer<Together>();
  readonly #request: Ask;

  /** Opens the connection at once, before the first question. */
  constructor(
    sender: Sender,
    private readonly connect: () => WebSocket | null,
    private readonly now = () => performance.now(),
  ) {
    this.#request = askHere(sender);
    this.#connected();
  }

  readonly ask: Ask = async (body, signal) => {
    const socket = this.#connected();
    if (!socket || body.length > MOST_CHARACTERS || this.#questions.size >= MOST_AT_ONCE)
      return this.#request(body, signal);
    const send = (text: string): void => socket.send(text);
    const say = {
      ask: (id: number, body: string) => send(`{"ask":${id},"body":${body}}`),
      end: (id: number) => send(`{"end":${id}}`),
    };
    try {
      return await this.#questions.put(body, signal, say);
    } catch (e) {
      if (e instanceof Lost) return this.#request(body, signal);
      throw e;
    }
  };

  /** The connection, if open; else starts one when it is due. */
  #connected(): WebSocket | null {
    if (this.#socket) return this.#socket.readyState === this.#socket.OPEN ? this.#socket : null;
    const now = this.now();
    if (now < this.#next.at) return null;
    const { after } = this.#next;
    this.#next = { at: now + after, after: Math.min(2 * after, AGAIN_MOST_MS) };
    const socket = (this.#socket = this.connect());
    if (!socket) return null;
    socket.onopen = () => (this.#next.after = AGAIN_MS);
    socket.onmessage = ({ data }: MessageEvent<string>) => {
      try {
        this.#hear(data);
      } catch {
        // The other end does not speak this protocol.
        socket.close();
      }
    };
    socket.onclose = () => {
      this.#socket = null;
      this.#questions.lose(new Lost('The connection was lost.'));
    };
    return null;
  }

  #hear(message: string): void {
    const { ask, head, rest, last } = readMessage(message);
    const events = head?.problem ? [] : eventsOf(rest);
    this.#questions.hear(ask, head, events.length ? [events] : [], last);
  }
}

/** A message of the server: the number of its question, the head where it is the first one, a piece of the answer. */
export function readMessage(message: string): { ask: number; head: Head | null; rest: string; last: boolean } {
  const end = message.indexOf('\n');
  const told = JSON.parse(message.slice(0, end)) as Told;
  const rest = message.slice(end + 1);
  return { ask: told.ask, head: headOf(told, rest), rest, last: told.last === true };
}

/** A refusal arrives complete. */
function headOf({ status, scene }: Told, rest: string): Head | null {
  if (status === undefined) return null;
  const problem = status >= 400 ? problemIn(rest, status) : null;
  return { status, held: scene, problem };
}

/** A connection for a path of the server that a script came from. */
export function connection(path: string, script: string): WebSocket | null {
  if (typeof WebSocket === 'undefined') return null;
  const address = new URL(ROOT + path, script);
  address.protocol = address.protocol.replace('http', 'ws');
  return new WebSocket(address);
}
