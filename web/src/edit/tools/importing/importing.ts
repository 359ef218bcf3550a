// Files from outside, and the report on them. Reading loads with the first file: few users need it.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { Client } from '../../../net/client';
import type { Editor } from '../../session/editor';
import type { Library } from '../../document/library';
import type { SceneList } from '../../document/scene-list';
import type { FileImport } from './file-import';
import type { FileVerdict } from './file-verdict';
import { TEXTS } from '../../../texts/editing/generation';

export class Importing {
  readonly #verdicts = signal<readonly FileVerdict[] | null>(null);
  #reader: FileImport | null = null;
  /** The report to show; null when there is none. */
  readonly verdicts: ReadonlySignal<readonly FileVerdict[] | null> = this.#verdicts;

  constructor(
    private readonly editor: Editor,
    private readonly library: Library,
    private readonly list: SceneList,
    private readonly client: Client,
  ) {}

  close(): void {
    this.#verdicts.value = this.#reader = null;
  }

  async files(files: readonly File[]): Promise<void> {
    if (await this.#begun()) await this.#reader!.files(files);
  }

  /** Offers to import a part of a map file. */
  async part(file: File): Promise<void> {
    if (await this.#begun()) this.#reader!.choosePart(file);
  }

  /** False when its script did not load. */
  async #begun(): Promise<boolean> {
    try {
      const { FileImport } = await import('./file-import');
      const { editor, library, list, client } = this;
      this.#reader = new FileImport({ editor, library, list, client }, this.#report());
      return true;
    } catch (e) {
      if (!(e instanceof TypeError)) throw e;
      this.editor.notices.show({ text: TEXTS.importDidNotLoad });
      return false;
    }
  }

  /** Reads files of the report in another way; null when it was closed. */
  get reader(): FileImport | null {
    return this.#reader;
  }

  #report(): ConstructorParameters<typeof FileImport>[1] {
    const shown = this.#verdicts;
    return {
      get verdicts() {
        return shown.peek() ?? [];
      },
      show: (verdicts) => (shown.value = verdicts),
      close: () => this.close(),
    };
  }
}
