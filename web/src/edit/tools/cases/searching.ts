// The search for a case is loaded on demand: few users need it, and none at the start.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { What } from '../../../model/physics/cases';
import type { Supplies } from '../feature';
import type { Cases } from './cases';
import { TEXTS } from '../../../texts/editing/generation';

export class Searching {
  readonly #now = signal<Cases | null>(null);

  /** The search, while it is open. */
  readonly open: ReadonlySignal<Cases | null> = computed(() =>
    this.#now.value?.isOpen.value ? this.#now.value : null,
  );

  constructor(private readonly of: Supplies) {}

  /** Opens it for the selected road users; with `start` it begins at once. */
  async begin(what?: What, ids: readonly string[] = this.of.editor.selected.peek(), start = false): Promise<void> {
    try {
      const [{ Cases }, { CaseTries }] = await Promise.all([import('./cases'), import('./tries')]);
      const cases = this.#now.peek() ?? new Cases(this.of.editor, new CaseTries(this.of));
      this.#now.value = cases;
      cases.open(what, ids);
      if (start) await cases.run();
    } catch (e) {
      if (!(e instanceof TypeError)) throw e;
      this.of.editor.notices.show({ text: TEXTS.theSearchDid });
    }
  }
}
