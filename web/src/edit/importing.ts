// Files from outside: sent to the server one by one, with a verdict for each.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { SceneJson } from '../model/document/scene-json';
import { Refused, type Beside, type Client } from '../net/client';
import { faultOf } from '../net/problem';
import { inWords } from '../net/refusal';
import type { ImportReply, ImportWarning, Problem } from '../net/types';
import type { Broken } from './broken-file';
import type { Editor } from './editor';
import { foreignKind, kindByName } from './file-kinds';
import type { Library } from './document/library';
import { countAll, type SceneList } from './document/scene-list';
import { TEXTS } from '../texts/files/importing';

export interface ImportedScene {
  readonly id: string;
  readonly name: string;
  /** Road users. */
  readonly count: number;
}

/** What became of one file, and, when it could not be read, what is wrong, where, and what to do. */
export interface FileVerdict {
  readonly file: string;
  /** `saved scene`, `scenario record`, `a PDF`. */
  readonly kind: string;
  readonly ok: boolean;
  readonly scenes: readonly ImportedScene[];
  readonly wrong?: string;
  readonly where?: string;
  readonly todo?: string;
  readonly details?: string;
  /** The lines of the file where it is broken, and the number of the first. */
  readonly excerpt?: Broken['excerpt'];
  /** The rest of it can be taken: without what. */
  readonly without?: readonly string[];
  /** What the reader assumed, left out or changed. */
  readonly notes?: readonly ImportWarning[];
  /** A table whose columns have names of their own: which of them says what? */
  readonly columns?: readonly string[];
  /** Nobody answered: the same may go well later. */
  readonly again?: File;
}

const READING_MS = 120_000;
/** Larger files are not looked into here. */
const MOST_TEXT_BYTES = 20 << 20;
/** After leaving out what is broken more may come to light. */
const MOST_ROUNDS = 6;

export class Importing {
  readonly #verdicts = signal<readonly FileVerdict[] | null>(null);
  /** What is left of broken files, by their place in the list. */
  #rests = new Map<FileVerdict, SceneJson>();
  /** Tables that wait for what their columns say. */
  #tables = new Map<FileVerdict, Blob>();
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
    this.#rests.clear();
    this.#tables.clear();
  }

  async files(files: readonly File[]): Promise<void> {
    const { notices } = this.editor;
    const verdicts: FileVerdict[] = [];
    notices.show(
      { text: TEXTS.reading(files.length === 1 ? files[0].name : TEXTS.countFiles(files.length)) },
      READING_MS,
    );
    for (const { file, net } of inPairs(files)) verdicts.push(await this.#one(file, net));
    await this.list.refresh().catch(() => undefined);
    notices.hide();
    const good = verdicts.flatMap((v) => v.scenes);
    if (good.length) await this.library.open(good[0].id);
    if (good.length === 1 && verdicts.every((v) => v.ok)) this.#sayImported(verdicts[0], '', verdicts);
    else this.#verdicts.value = verdicts;
  }

  /** One scene is on screen: a word is enough, with the way to what was assumed. */
  #sayImported(v: FileVerdict, without: string, all: readonly FileVerdict[]): void {
    const text = TEXTS.imported(v.scenes[0]?.name || v.file, without);
    const n = v.notes?.length ?? 0;
    const run = (): void => {
      this.#verdicts.value = all;
    };
    const action = n ? { label: TEXTS.thingsAssumed(n), run } : undefined;
    this.editor.notices.show({ text, action });
  }

  /** Takes the rest of a file, without what is broken in it. */
  async takeRest(v: FileVerdict): Promise<void> {
    const rest = this.#rests.get(v);
    if (!rest) return;
    const name = v.file;
    await this.#replace(v, () => this.#send(name, new Blob([JSON.stringify(rest)]), v.without));
  }

  /** Reads a table by what its columns say. */
  async readColumns(v: FileVerdict, columns: Record<string, unknown>): Promise<void> {
    const table = this.#tables.get(v);
    if (table) await this.#replace(v, () => this.#send(v.file, table, [], { columns }));
  }

  /** The same file once more, now that somebody may answer. */
  async tryAgain(v: FileVerdict): Promise<void> {
    if (v.again) await this.#replace(v, () => this.#one(v.again!));
  }

  async #replace(v: FileVerdict, make: () => Promise<FileVerdict>): Promise<void> {
    const now = await make();
    await this.list.refresh().catch(() => undefined);
    const rest = (this.#verdicts.peek() ?? []).map((o) => (o === v ? now : o));
    if (now.scenes.length) await this.library.open(now.scenes[0].id);
    if (now.ok && rest.every((o) => o.ok)) {
      this.close();
      const without = v.without ? TEXTS.without(v.without.join(', ')) : '';
      this.#sayImported(now, without, rest);
    } else this.#verdicts.value = rest;
  }

  async #one(file: File, net?: File): Promise<FileVerdict> {
    const foreign = await foreignKind(file);
    if (foreign?.surely) return foreignVerdict(file.name, foreign.kind);
    return this.#send(file.name, file, [], { net });
  }

  async #send(name: string, file: Blob, without: readonly string[] = [], beside: Beside = {}): Promise<FileVerdict> {
    try {
      const v = verdictOf(name, await this.client.importFile(name, file, beside));
      return without.length && v.ok ? { ...v, wrong: TEXTS.withoutThese(without.join(', ')) } : v;
    } catch (e) {
      if (!(e instanceof Refused)) return awayVerdict(name, file);
      return this.#refused(name, file, e.problem, without);
    }
  }

  /** What is wrong, with the place in the file; the rest of it is kept where it can be taken. */
  async #refused(name: string, file: Blob, p: Problem, without: readonly string[]): Promise<FileVerdict> {
    const foreign = p.code === 'format-unknown' ? await foreignKind(file) : null;
    if (foreign) return foreignVerdict(name, foreign.kind);
    const plain = { file: name, kind: kindByName(name), ok: false, scenes: [], ...explain(name, p) };
    const columns = columnsIn(p);
    if (columns) {
      const wrong = TEXTS.thisTableNames;
      const verdict: FileVerdict = { ...plain, columns, wrong, todo: TEXTS.sayWhatTheyAre };
      this.#tables.set(verdict, file);
      return verdict;
    }
    const text = file.size <= MOST_TEXT_BYTES ? await file.text() : '';
    const { lookInto } = await import('./broken-file');
    const { excerpt, part, mended } = lookInto(text, p);
    const found = { ...plain, excerpt, ...(excerpt ? { where: TEXTS.line(name, excerpt.line) } : {}) };
    const said = part ? { ...found, wrong: `${capital(part.name)}: ${plain.wrong}.` } : found;
    if (!mended || without.length > MOST_ROUNDS) return said;
    const verdict: FileVerdict = { ...said, without: [...without, ...mended.without], todo: undefined };
    this.#rests.set(verdict, mended.scene);
    return verdict;
  }
}

/** Names of a table's columns, where that is what the server asks about; else null. */
function columnsIn(problem: Problem): readonly string[] | null {
  if (problem.code !== 'cannot-represent') return null;
  const said = problem.errors?.[0]?.detail ?? problem.detail ?? '';
  const names = /^no column .+?; there are (.+)\. A file of columns can name them/s.exec(said)?.[1];
  return names ? names.split(', ').filter((n) => n !== '...') : null;
}

/** A recording and, in the same drop, the map that it was made on: each of these goes with the one beside it. */
const PAIRS: readonly (readonly [recording: RegExp, map: RegExp])[] = [
  [/^scenario_.*\.parquet$|\.av2\.parquet$/i, /^log_map_archive_.*\.json$/i],
  [/\.fcd\.(xml|csv)(\.gz)?$/i, /\.net\.xml(\.gz)?$/i],
];

/** Files with what belongs to them; one map goes with all its recordings, by name where there are several. */
export function inPairs(files: readonly File[]): { readonly file: File; readonly net?: File }[] {
  const stem = (name: string) => name.replace(/^(scenario_|log_map_archive_)/i, '').replace(/\..*$/, '');
  const netOf = (file: File): File | undefined => {
    const pair = PAIRS.find(([recording]) => recording.test(file.name));
    const maps = pair ? files.filter((f) => pair[1].test(f.name)) : [];
    return maps.find((f) => stem(f.name) === stem(file.name)) ?? (maps.length === 1 ? maps[0] : undefined);
  };
  const pairs = files.map((file) => ({ file, net: netOf(file) }));
  return pairs.filter(({ file }) => !pairs.some(({ net }) => net === file));
}

const capital = (s: string): string => s[0].toUpperCase() + s.slice(1);

const READABLE = TEXTS.scenarioRecords;

function foreignVerdict(file: string, kind: string): FileVerdict {
  const ending = /\.(json|tfrecord|xml|csv|parquet)(\.gz)?$/i.exec(file)?.[0];
  const wrong = ending ? TEXTS.namedButItIs(ending, kind) : TEXTS.isNotASceneIt(file, kind);
  return {
    file,
    kind: kind.replace(/^an? /, ''),
    ok: false,
    scenes: [],
    wrong,
    todo: TEXTS.chooseAnotherFile(READABLE),
  };
}

const awayVerdict = (file: string, again: Blob): FileVerdict => ({
  file,
  kind: kindByName(file),
  ok: false,
  scenes: [],
  wrong: TEXTS.theServerIsNotAnswering,
  todo: TEXTS.tryAgainWhen,
  again: again instanceof File ? again : undefined,
});

function verdictOf(file: string, reply: ImportReply): FileVerdict {
  const kind = kindByName(file);
  const scenes = reply.scenes.map(({ id = '', name, counts }) => ({
    id,
    name,
    count: countAll(counts),
  }));
  const { skipped } = reply;
  const warnings = reply.scenes.flatMap((s) => s.warnings);
  const notes = [...new Map(warnings.map((w) => [w.detail, w])).values()];
  if (!scenes.length) return { file, kind, ok: false, scenes, ...explain(file, skipped[0]?.problem) };
  if (!skipped.length) return { file, kind, ok: true, scenes, notes };
  const share = TEXTS.ofScenesInThis(skipped.length, scenes.length + skipped.length);
  return { file, kind, ok: true, scenes, wrong: `${share}: ${inWords(skipped[0].problem)}` };
}

type Explanation = Pick<FileVerdict, 'wrong' | 'where' | 'todo' | 'details'>;

function explain(file: string, p: Problem | undefined): Explanation {
  if (!p) return { wrong: TEXTS.thereIsNoScene, todo: READABLE };
  const first = p.errors?.[0];
  const where = [file, first?.pointer, p.offset !== undefined ? TEXTS.byte(p.offset) : ''].filter(Boolean).join(', ');
  return { wrong: wrongWith(file, p), where, todo: whatToDo(p.code), details: JSON.stringify(p, null, 2) };
}

/** What a reader of JSON says of a fault. */
const JSON_FAULTS: readonly (readonly [RegExp, keyof typeof TEXTS.jsonFaults])[] = [
  [/: EOF while parsing/, 'end'],
  [/: expected (value|ident)/, 'value'],
  [/: trailing comma/, 'comma'],
  [/: trailing characters/, 'after'],
  [/: key must be a string/, 'name'],
  [/: expected /, 'between'],
  [/: (invalid number|number out of range)/, 'number'],
  [/: (control character|invalid escape|invalid unicode|lone leading surrogate|unexpected end of hex)/, 'text'],
];

/** What the server says, as people would. */
function wrongWith(file: string, p: Problem): string {
  const said = faultOf(p);
  // A file of a kind that is known is called what it is.
  if (p.code === 'format-unknown' && said.startsWith('not a file of a known format')) return TEXTS.isNotAScene(file);
  const points = /^(\d+) points; (\d+) to \d+ expected$/.exec(said);
  if (points) return points[1] === '1' ? TEXTS.itHasOnlyOne(points[2]) : TEXTS.itHasPointsAnd(points[1], points[2]);
  const many = /^\d+ agents; at most (\d+)$/.exec(said);
  if (many) return TEXTS.thisSceneHas(many[1]);
  const fault = p.code === 'malformed-json' && JSON_FAULTS.find(([sentence]) => sentence.test(said));
  if (fault) return TEXTS.isNoJson(TEXTS.jsonFaults[fault[1]]);
  return inWords(p);
}

function whatToDo(code: Problem['code']): string {
  if (code === 'format-unknown') return TEXTS.chooseAnotherFile(READABLE);
  if (code.includes('too-large')) return TEXTS.theFileIsLarger;
  if (code === 'unsupported-version') return TEXTS.updateThisProgram;
  return TEXTS.mendTheFileAnd;
}
