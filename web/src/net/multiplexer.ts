// Open questions on a connection that carries several at once, distinguished by numbers.
import type { Head } from './http-transport';
import { faultOf } from './problem';

/** An open question: the promise of its head, and the pieces not read yet. */
class OpenQuestion<Piece> {
  head!: (h: Head) => void;
  fail!: (e: unknown) => void;
  readonly begun = new Promise<Head>((done, fail) => {
    this.head = done;
    this.fail = fail;
  });
  readonly #come: Piece[] = [];
  #over: { readonly error: unknown } | null = null;
  /** Its head has arrived. */
  isAnswered = false;
  #wake: (() => void) | null = null;

  add(pieces: readonly Piece[]): void {
    this.#come.push(...pieces);
    this.#wake?.();
  }

  /** No further pieces; with an error the answer is incomplete. */
  end(error: unknown = null): void {
    this.#over ??= { error };
    if (error) this.fail(error);
    this.#wake?.();
  }

  async *pieces(leave: () => void): AsyncGenerator<Piece> {
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

/** How a connection sends a question, and cancels it. */
export interface QuestionSender {
  ask(id: number, body: string): void;
  end(id: number): void;
}

export class Multiplexer<Piece> {
  #count = 0;
  readonly #open = new Map<number, OpenQuestion<Piece>>();

  /** Number of open questions. */
  get size(): number {
    return this.#open.size;
  }

  /** Sends a question; it is cancelled when the signal aborts, and when its reader leaves early. */
  async put(body: string, signal: AbortSignal, say: QuestionSender): Promise<Head & { pieces: AsyncIterable<Piece> }> {
    signal.throwIfAborted();
    const id = ++this.#count;
    const question = new OpenQuestion<Piece>();
    this.#open.set(id, question);
    const leave = (): void => {
      signal.removeEventListener('abort', stop);
      if (this.#open.delete(id)) say.end(id);
    };
    const stop = (): void => {
      leave();
      question.end(signal.reason);
    };
    signal.addEventListener('abort', stop);
    say.ask(id, body);
    const head = await question.begun;
    return { ...head, pieces: question.pieces(leave) };
  }

  /** The head comes with the first pieces. Pieces of a cancelled question are dropped. */
  hear(id: number, head: Head | null, pieces: readonly Piece[], last: boolean): void {
    const question = this.#open.get(id);
    if (!question) return;
    if (last) this.#open.delete(id);
    // A second head gives the reason why the answer stops.
    const broken = question.isAnswered && head?.problem ? new Error(faultOf(head.problem)) : null;
    if (head) question.head(head);
    question.isAnswered ||= head !== null;
    question.add(pieces);
    if (last) question.end(broken);
  }

  fail(id: number, error: Error): void {
    const question = this.#open.get(id);
    this.#open.delete(id);
    question?.end(error);
  }

  /** The connection is lost. */
  lose(error: Error): void {
    const lost = [...this.#open.values()];
    this.#open.clear();
    for (const question of lost) question.end(error);
  }
}
