// The handles of a map that is being made and what they answer: they come when a map is begun.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type * as LayoutTools from './layout-tools';

export class LateTools {
  readonly #tools = signal<typeof LayoutTools | null>(null);

  /** Null until they are there. */
  readonly tools: ReadonlySignal<typeof LayoutTools | null> = this.#tools;

  /** False when they do not come. */
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
