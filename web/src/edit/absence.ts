// The generator is away: it is tried again at growing intervals, and the changes that wait for it are counted.
import type { Editor } from './editor';
import { TEXTS } from '../texts/editing/generation';

const RETRY_S = [1, 2, 4, 6];

export class Absence {
  /** Changes nobody has answered. */
  #waiting = 0;
  #tries = 0;
  #timer: ReturnType<typeof setInterval> | undefined;

  /** `came` is called when it answers again, with the number of changes that waited. */
  constructor(
    private readonly editor: Editor,
    private readonly answers: () => Promise<boolean>,
    private readonly came: (waiting: number) => void,
  ) {}

  get now(): boolean {
    return this.editor.away.peek() !== null;
  }

  /** Nobody answered; `change` when a change of the document was to be worked out. */
  begin(change: boolean): void {
    const { editor } = this;
    if (change) this.#waiting++;
    if (!this.now) {
      this.#tries = 0;
      editor.notices.say(TEXTS.generatorAway, true);
    }
    editor.answers.report({ kind: 'away' });
    this.#countDown();
  }

  /** One more change waits. */
  wait(): void {
    this.#waiting++;
    this.editor.answers.missing({ retryIn: this.editor.away.peek()?.retryIn ?? 0, waiting: this.#waiting });
  }

  /** An answer came. */
  end(): void {
    if (!this.now) return;
    const waiting = this.#waiting;
    this.#waiting = 0;
    clearInterval(this.#timer);
    this.editor.answers.back();
    this.came(waiting);
  }

  async tryNow(): Promise<void> {
    clearInterval(this.#timer);
    if (await this.answers()) this.end();
    else this.#countDown();
  }

  #countDown(): void {
    const { answers } = this.editor;
    clearInterval(this.#timer);
    let left = RETRY_S[Math.min(this.#tries++, RETRY_S.length - 1)];
    answers.missing({ retryIn: left, waiting: this.#waiting });
    this.#timer = setInterval(() => {
      left--;
      if (left > 0) answers.missing({ retryIn: left, waiting: this.#waiting });
      else void this.tryNow();
    }, 1000);
  }
}
