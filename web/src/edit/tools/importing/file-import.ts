// Reads files from outside: sent to the server one by one, with a verdict for each. It loads with the first file.
import type { SceneJson } from '../../../model/document/scene-json';
import { Refused, type Client } from '../../../net/client';
import { importFile, type FileCompanions, type MapCircle } from '../../../net/imports';
import type { ImportReply, Problem } from '../../../net/types';
import type { Editor } from '../../session/editor';
import type { FileVerdict, ImportedScene } from './file-verdict';
import { foreignKind, kindByName, type ForeignKind } from './file-kinds';
import type { Library } from '../../document/library';
import { countAll, type SceneList } from '../../document/scene-list';
import { TEXTS } from '../../../texts/files/importing';

/** Refusals of a map that is too large. */
const TOO_LARGE: readonly Problem['code'][] = ['map-too-large', 'decoded-too-large'];
/** Files of maps of which a part can be read. */
const ofMap = (name: string): boolean => /\.(xodr|osm|xml)(\.gz)?$/i.test(name);

const READING_MS = 120_000;
/** Larger files are not examined here. */
const MOST_TEXT_BYTES = 20 << 20;
/** Rounds of leaving out broken parts; each may reveal more. */
const MOST_ROUNDS = 6;

/** Where files are read to. */
export interface Desk {
  readonly editor: Editor;
  readonly library: Library;
  readonly list: SceneList;
  readonly client: Client;
}

/** The report as it is shown. */
export interface Report {
  readonly verdicts: readonly FileVerdict[];
  show(verdicts: readonly FileVerdict[]): void;
  close(): void;
}

export class FileImport {
  /** Remaining scenes of broken files, by verdict. */
  readonly #rests = new Map<FileVerdict, SceneJson>();
  /** Tables that wait for the meaning of their columns. */
  readonly #tables = new Map<FileVerdict, Blob>();

  constructor(
    private readonly desk: Desk,
    private readonly report: Report,
  ) {}

  async files(files: readonly File[]): Promise<void> {
    const { notices } = this.desk.editor;
    const verdicts: FileVerdict[] = [];
    notices.show(
      { text: TEXTS.reading(files.length === 1 ? files[0].name : TEXTS.countFiles(files.length)) },
      READING_MS,
    );
    for (const { file, net } of inPairs(files)) verdicts.push(await this.#one(file, net));
    const good = verdicts.flatMap((v) => v.scenes);
    await this.#openFirst(good);
    notices.hide();
    if (good.length === 1 && verdicts.every((v) => v.ok)) this.#sayImported(verdicts[0], '', verdicts);
    else this.report.show(verdicts);
  }

  /** Opens the first of them while the list of scenes loads. */
  async #openFirst(scenes: readonly ImportedScene[]): Promise<void> {
    const listed = this.desk.list.refresh().catch(() => undefined);
    if (scenes.length) await this.desk.library.open(scenes[0].id);
    await listed;
  }

  /** One imported scene is shown: a toast is enough, with a link to the assumptions. */
  #sayImported(v: FileVerdict, without: string, all: readonly FileVerdict[]): void {
    const text = TEXTS.imported(v.scenes[0]?.name || v.file, without);
    const n = v.notes?.length ?? 0;
    const run = (): void => this.report.show(all);
    const action = n ? { label: TEXTS.assumptions(n), run } : undefined;
    this.desk.editor.notices.show({ text, action });
  }

  /** Imports the rest of a file, without its broken parts. */
  async takeRest(v: FileVerdict): Promise<void> {
    const rest = this.#rests.get(v);
    if (!rest) return;
    const name = v.file;
    await this.#replace(v, () => this.#send(name, new Blob([JSON.stringify(rest)]), v.without));
  }

  /** Reads a table with the assigned columns. */
  async readColumns(v: FileVerdict, columns: Record<string, unknown>): Promise<void> {
    const table = this.#tables.get(v);
    if (table) await this.#replace(v, () => this.#send(v.file, table, [], { columns }));
  }

  /** Shows a map file for the choice of its part. */
  choosePart(file: File): void {
    const verdict = { file: file.name, kind: kindByName(file.name), ok: false, scenes: [] };
    this.report.show([{ ...verdict, map: { file, around: null }, wrong: TEXTS.choosePart }]);
  }

  /** Reads a part of a map. */
  async readPart(v: FileVerdict, around: MapCircle): Promise<void> {
    const { map } = v;
    if (map) await this.#replace(v, () => this.#send(v.file, map.file, [], { around }));
  }

  /** Sends the same file again. */
  async tryAgain(v: FileVerdict): Promise<void> {
    if (v.again) await this.#replace(v, () => this.#one(v.again!));
  }

  async #replace(v: FileVerdict, make: () => Promise<FileVerdict>): Promise<void> {
    const now = await make();
    const rest = this.report.verdicts.map((o) => (o === v ? now : o));
    await this.#openFirst(now.scenes);
    if (now.ok && rest.every((o) => o.ok)) {
      this.report.close();
      const without = v.without ? TEXTS.without(v.without.join(', ')) : '';
      this.#sayImported(now, without, rest);
    } else this.report.show(rest);
  }

  async #one(file: File, net?: File): Promise<FileVerdict> {
    const foreign = await foreignKind(file);
    if (foreign?.surely) return foreignVerdict(file.name, foreign.kind);
    return this.#send(file.name, file, [], { net });
  }

  async #send(
    name: string,
    file: Blob,
    without: readonly string[] = [],
    beside: FileCompanions = {},
  ): Promise<FileVerdict> {
    try {
      const v = await verdictOf(name, await importFile(this.desk.client, name, file, beside));
      return without.length && v.ok ? { ...v, wrong: TEXTS.withoutThese(without.join(', ')) } : v;
    } catch (e) {
      if (!(e instanceof Refused)) return awayVerdict(name, file);
      return this.#refused(name, file, e.problem, without, beside.around ?? null);
    }
  }

  /** The fault with its place in the file; stores the rest where it can be imported. */
  async #refused(
    name: string,
    file: Blob,
    p: Problem,
    without: readonly string[],
    around: MapCircle | null,
  ): Promise<FileVerdict> {
    const foreign = p.code === 'format-unknown' ? await foreignKind(file) : null;
    if (foreign) return foreignVerdict(name, foreign.kind);
    const { columnsIn, explain } = await import('./refused-file');
    const plain = { file: name, kind: kindByName(name), ok: false, scenes: [], ...explain(name, p) };
    const columns = columnsIn(p);
    if (columns) {
      const wrong = TEXTS.unknownColumns;
      const verdict: FileVerdict = { ...plain, columns, wrong, todo: TEXTS.assignColumns };
      this.#tables.set(verdict, file);
      return verdict;
    }
    if (around || (TOO_LARGE.includes(p.code) && ofMap(name)))
      return { ...plain, map: { file, around }, todo: TEXTS.choosePart };
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

/** A recording and, in the same drop, its map: each pattern pairs with the one beside it. */
const PAIRS: readonly (readonly [recording: RegExp, map: RegExp])[] = [
  [/^scenario_.*\.parquet$|\.av2\.parquet$/i, /^log_map_archive_.*\.json$/i],
  [/\.fcd\.(xml|csv)(\.gz)?$/i, /\.net\.xml(\.gz)?$/i],
  [/\.db$/i, /\.gpkg$/i],
];

/** Files with their companions; one map goes with all its recordings, by name where there are several. */
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

function foreignVerdict(file: string, { name, inSentence }: ForeignKind): FileVerdict {
  const ending = /\.(json|tfrecord|xml|csv|parquet)(\.gz)?$/i.exec(file)?.[0];
  const wrong = ending ? TEXTS.namedButItIs(ending, inSentence) : TEXTS.isNotASceneIt(file, inSentence);
  return {
    file,
    kind: name,
    ok: false,
    scenes: [],
    wrong,
    todo: TEXTS.chooseAnotherFile(TEXTS.scenarioRecords),
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

async function verdictOf(file: string, reply: ImportReply): Promise<FileVerdict> {
  const kind = kindByName(file);
  const scenes = reply.scenes.map(({ id = '', name, counts }) => ({
    id,
    name,
    count: countAll(counts),
  }));
  const { skipped } = reply;
  const warnings = reply.scenes.flatMap((s) => s.warnings);
  const notes = [...new Map(warnings.map((w) => [w.detail, w])).values()];
  if (scenes.length && !skipped.length) return { file, kind, ok: true, scenes, notes };
  const { explain, faultIn } = await import('./refused-file');
  if (!scenes.length) return { file, kind, ok: false, scenes, ...explain(file, skipped[0]?.problem) };
  const share = TEXTS.ofScenesInThis(skipped.length, scenes.length + skipped.length);
  return { file, kind, ok: true, scenes, wrong: `${share}: ${faultIn(file, skipped[0].problem)}` };
}
