// Notices beside the picture: the toast, the voice for screen readers, the report of a crash.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { Toast } from '../document/session';

export interface Spoken {
  readonly text: string;
  /** Spoken at once, interrupting anything else. */
  readonly urgent: boolean;
}

const TOAST_MS = 6000;

export class Notices {
  readonly #toast = signal<Toast | null>(null);
  readonly #spoken = signal<Spoken>({ text: '', urgent: false });
  readonly #crash = signal<string | null>(null);
  #timer: ReturnType<typeof setTimeout> | undefined;

  readonly toast: ReadonlySignal<Toast | null> = this.#toast;
  readonly spoken: ReadonlySignal<Spoken> = this.#spoken;
  /** Text of an internal error, to be saved for a bug report. */
  readonly crash: ReadonlySignal<string | null> = this.#crash;

  show(toast: Toast, ms = TOAST_MS): void {
    clearTimeout(this.#timer);
    this.#toast.value = toast;
    this.#timer = setTimeout(() => this.hide(), ms);
  }

  hide(): void {
    clearTimeout(this.#timer);
    this.#toast.value = null;
  }

  say(text: string, urgent = false): void {
    this.#spoken.value = { text, urgent };
  }

  /** Reports why an action is not possible: spoken, and shown unless a toast with a remedy is visible. */
  refuse(why: string): void {
    this.say(why);
    const shown = this.#toast.peek();
    if (!shown?.undo && !shown?.action) this.show({ text: why });
  }

  crashed(error: unknown): void {
    this.#crash.value = error instanceof Error ? `${error.message}\n${error.stack ?? ''}` : String(error);
  }
}
