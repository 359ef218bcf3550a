// Files from outside: sent to the server one by one, with a verdict for each.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import { Refused, type Client } from '../net/client';
import type { ImportReply, Problem } from '../net/types';
import type { Editor } from './editor';
import type { Library } from './library';
import { countAll, type SceneList } from './scene-list';

export interface ImportedScene {
  readonly id: string;
  readonly name: string;
  /** Road users. */
  readonly count: number;
}

/** What became of one file, and, when it could not be read, what is wrong, where, and what to do. */
export interface FileVerdict {
  readonly file: string;
  readonly ok: boolean;
  readonly scenes: readonly ImportedScene[];
  readonly wrong?: string;
  readonly where?: string;
  readonly todo?: string;
  readonly details?: string;
}

const READING_MS = 120_000;

export class Importing {
  readonly #verdicts = signal<readonly FileVerdict[] | null>(null);
  /** The report that is to be shown; null when there is nothing to report. */
  readonly verdicts: ReadonlySignal<readonly FileVerdict[] | null> = this.#verdicts;

  constructor(
    private readonly editor: Editor,
    private readonly library: Library,
    private readonly list: SceneList,
    private readonly client: Client,
  ) {}

  close(): void {
    this.#verdicts.value = null;
  }

  async files(files: readonly File[]): Promise<void> {
    const { notices } = this.editor;
    const verdicts: FileVerdict[] = [];
    notices.show({ text: `Reading ${files.length === 1 ? files[0].name : `${files.length} files`} …` }, READING_MS);
    for (const f of files) verdicts.push(await this.#one(f));
    await this.list.refresh().catch(() => undefined);
    notices.hide();
    const good = verdicts.flatMap((v) => v.scenes);
    if (good.length) await this.library.open(good[0].id);
    if (good.length === 1 && verdicts.every((v) => v.ok)) notices.show({ text: `${good[0].name} imported.` });
    else this.#verdicts.value = verdicts;
  }

  async #one(file: File): Promise<FileVerdict> {
    try {
      return verdictOf(file.name, await this.client.importFile(file.name, file));
    } catch (e) {
      const why = e instanceof Refused ? explain(file.name, e.problem) : AWAY;
      return { file: file.name, ok: false, scenes: [], ...why };
    }
  }
}

type Explanation = Pick<FileVerdict, 'wrong' | 'where' | 'todo' | 'details'>;

const AWAY: Explanation = {
  wrong: 'The server is not answering.',
  todo: 'Try again when the generator is back. The file was not changed.',
};

function verdictOf(file: string, reply: ImportReply): FileVerdict {
  const scenes = reply.scenes.map(({ id = '', name, counts }) => ({
    id,
    name,
    count: countAll(counts),
  }));
  const { skipped } = reply;
  if (!scenes.length) return { file, ok: false, scenes, ...explain(file, skipped[0]?.problem) };
  if (!skipped.length) return { file, ok: true, scenes };
  const { detail } = skipped[0].problem;
  const share = `${skipped.length} of ${scenes.length + skipped.length} scenes in this file could not be read`;
  return { file, ok: true, scenes, wrong: `${share}: ${detail}` };
}

function explain(file: string, p: Problem | undefined): Explanation {
  if (!p) return { wrong: 'There is no scene in this file.' };
  const first = p.errors?.[0];
  const where = [file, first?.pointer, p.offset !== undefined ? `byte ${p.offset}` : ''].filter(Boolean).join(', ');
  const unknown = p.code === 'format-unknown';
  const wrong = unknown ? `“${file}” is not a scene.` : (first?.detail ?? p.reason ?? p.detail ?? p.title);
  return { wrong, where, todo: whatToDo(p.code), details: JSON.stringify(p, null, 2) };
}

function whatToDo(code: Problem['code']): string {
  if (code === 'format-unknown')
    return 'Scenario records, lane maps and saved scenes can be read. Choose another file.';
  if (code.includes('too-large')) return 'The file is larger than the server takes. Split it, or use the command line.';
  if (code === 'unsupported-version') return 'Update this program, or save the scene again with the version you have.';
  return 'Mend the file and drop it again, or choose another one.';
}
