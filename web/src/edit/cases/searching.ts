// The search for a case comes when it is wanted: few need it, and nobody in the first moment.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { What } from '../../model/physics/cases';
import type { Editor } from '../editor';
import type { Maker } from '../variants/making';
import type { Cases } from './cases';
import { TEXTS } from '../../texts/editing/generation';

export class Searching {
  readonly #now = signal<Cases | null>(null);

  /** The search, while it is open. */
  readonly open: ReadonlySignal<Cases | null> = computed(() =>
    this.#now.value?.isOpen.value ? this.#now.value : null,
  );

  /** `cancel` drops what the maker has asked. */
  constructor(
    private readonly editor: Editor,
    private readonly maker: Maker,
    private readonly cancel: () => void,
  ) {}

  /** Opens it for those who are selected; with `start` it begins at once. */
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
