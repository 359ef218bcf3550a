// The search for a case is loaded on demand: few users need it, and none at the start.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { What } from '../../../model/physics/cases';
import type { Editor } from '../../session/editor';
import type { Maker } from '../../asking/take-maker';
import type { Cases } from './cases';
import { TEXTS } from '../../../texts/editing/generation';

export class Searching {
  readonly #now = signal<Cases | null>(null);

  /** The search, while it is open. */
  readonly open: ReadonlySignal<Cases | null> = computed(() =>
    this.#now.value?.isOpen.value ? this.#now.value : null,
  );

  /** `cancel` drops the requests of the maker. */
  constructor(
    private readonly editor: Editor,
    private readonly maker: Maker,
    private readonly cancel: () => void,
  ) {}

  /** Opens it for the selected road users; with `start` it begins at once. */
  async begin(what?: What, ids: readonly string[] = this.editor.selected.peek(), start = false): Promise<void> {
    try {
      const { Cases } = await import('./cases');
      const cases = this.#now.peek() ?? new Cases(this.editor, this.maker, this.cancel);
      this.#now.value = cases;
      cases.open(what, ids);
      if (start) await cases.run();
    } catch (e) {
      if (!(e instanceof TypeError)) throw e;
      this.editor.notices.show({ text: TEXTS.theSearchDid });
    }
  }
}
