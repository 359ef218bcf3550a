// What is said of the others while the hand moves: a new one is said at once, but a verb changes and a name goes only
// after a while of agreement, so that nobody flickers between waiting and going.
import type { Change } from '../model/words/change-words';
import { TEXTS } from '../texts/editing/generation';

/** For so long the newer answers agree before another verb is said. */
export const AGREED_MS = 400;

interface Doubt {
  readonly verb: string;
  readonly timer: ReturnType<typeof setTimeout>;
}

/** What is being done and for whom; the numbers in a sentence may change at any time. */
const verbOf = (c: Change | undefined): string =>
  c ? `${c.reaction?.kind} ${c.reaction?.ahead} ${c.reaction?.cause.id}` : TEXTS.asBefore;

export class Steady {
  readonly #said = new Map<string, Change>();
  #heard = new Map<string, Change>();
  readonly #doubts = new Map<string, Doubt>();

  /** `say` is called with who is most affected first. */
  constructor(private readonly say: (changes: readonly Change[]) => void) {}

  hear(changes: readonly Change[]): void {
    this.#heard = new Map(changes.map((c) => [c.id, c]));
    for (const id of new Set([...this.#heard.keys(), ...this.#said.keys()])) this.#weigh(id);
    this.#tell();
  }

  /** The drag is over. */
  forget(): void {
    for (const { timer } of this.#doubts.values()) clearTimeout(timer);
    this.#doubts.clear();
    this.#said.clear();
    this.#heard.clear();
  }

  #weigh(id: string): void {
    const is = this.#heard.get(id);
    const verb = verbOf(is);
    const was = this.#said.get(id);
    if (!was || verbOf(was) === verb) {
      this.#settle(id);
      return;
    }
    const doubt = this.#doubts.get(id);
    if (doubt?.verb === verb) return;
    clearTimeout(doubt?.timer);
    const timer = setTimeout(() => {
      this.#settle(id);
      this.#tell();
    }, AGREED_MS);
    this.#doubts.set(id, { verb, timer });
  }

  #settle(id: string): void {
    clearTimeout(this.#doubts.get(id)?.timer);
    this.#doubts.delete(id);
    const is = this.#heard.get(id);
    if (is) this.#said.set(id, is);
    else this.#said.delete(id);
  }

  #tell(): void {
    this.say([...this.#said.values()].sort((a, b) => b.lost - a.lost || b.size - a.size));
  }
}
