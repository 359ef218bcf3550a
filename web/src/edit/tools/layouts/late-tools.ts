// The handles of a map being made, and their behaviour: loaded when a map is begun.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type * as LayoutTools from './layout-tools';

export class LateTools {
  readonly #tools = signal<typeof LayoutTools | null>(null);

  /** Null until they are loaded. */
  readonly tools: ReadonlySignal<typeof LayoutTools | null> = this.#tools;

  /** False when loading fails. */
  async fetch(): Promise<boolean> {
    try {
      this.#tools.value ??= await import('./layout-tools');
      return true;
    } catch (e) {
      if (!(e instanceof TypeError)) throw e;
      return false;
    }
  }
}
