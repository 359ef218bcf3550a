// Files out of what is on screen.
import { Refused, type Client } from '../net/client';
import type { SceneJson } from '../net/types';
import type { Editor } from './editor';
import type { SceneFile } from './scene-file';

export interface ExportedFile {
  readonly blob: Blob;
  readonly name: string;
  /** What the format has no place for, in plain words. */
  readonly losses: readonly string[];
  /** Files that go with it. */
  readonly others?: readonly ExportedFile[];
}

const ENDING: Record<string, string> = { dragtraffic: 'json', womd: 'tfrecord' };

/** What the server's codes of losses mean to whoever saves the file. */
const LOSSES: Record<string, string> = {
  'no-conditions': 'Goals and starts that you set: they become finished motion',
  'no-generated': 'Which motion was worked out: all of it counts as recorded',
  'no-modes': 'The other futures: only the chosen one goes out',
  'no-subtype': 'Finer kinds, such as truck or bus',
  'no-roles': 'Roles in the recording',
  'no-licence': 'The licence of the recording',
  'no-notes': 'Name, tags and notes',
  'no-map': 'The road',
  'no-signals': 'The traffic lights',
  'no-sizes': 'Sizes of road users',
  'no-timing': 'Which moment is now, and how long the scene is',
  'no-lane-graph': 'Which lanes follow each other and lie side by side',
  'no-z': 'Heights',
  'no-unseen': 'Road users whom nobody saw',
  'no-judgements': 'What is said of futures: chances, faults, who reacts to whom',
  'no-drivable': 'The paved areas',
  'no-lane-width': 'Widths of lanes',
  'no-lane-type': 'Some kinds of lanes and kerbs',
  'long-record': 'Nothing, but it is longer than a recording: some readers may not take it',
  'ids-renumbered': 'Numbers of road users: they get new ones',
};

const lossWords = (codes: string | null): string[] =>
  (codes ?? '')
    .split(',')
    .map((s) => s.trim())
    .filter(Boolean)
    .map((code) => LOSSES[code] ?? code.replace(/^no-/, '').replaceAll('-', ' '));

/** The scene on screen in one of the server's formats. */
export async function exported(c: { file: SceneFile; client: Client }, format: string): Promise<ExportedFile | null> {
  const json = c.file.complete();
  return json && exportedJson(c.client, json, format);
}

/** Any scene in one of the server's formats. */
export async function exportedJson(client: Client, json: SceneJson, format: string): Promise<ExportedFile> {
  const { blob, name, loss } = await client.exportScene(json, format);
  const ending = name.includes('.') ? name.slice(name.indexOf('.') + 1) : (ENDING[format] ?? format);
  return { blob, name: `${slug(json.name)}.${ending}`, losses: lossWords(loss) };
}

/** Saves it at once. */
export async function download(c: { editor: Editor; file: SceneFile; client: Client }, format: string): Promise<void> {
  try {
    const made = await exported(c, format);
    if (made) save(c.editor, made);
  } catch (e) {
    c.editor.notices.show({ text: `Not exported: ${whyNot(e)}` });
  }
}

export const whyNot = (e: unknown): string => (e instanceof Refused ? e.message : 'the server is not answering.');

export function save(editor: Editor, file: ExportedFile): void {
  saveAll(editor, [file]);
}

export function saveAll(editor: Editor, files: readonly ExportedFile[]): void {
  for (const { blob, name } of files) offer(blob, name);
  const n = new Set(files.flatMap((f) => f.losses)).size;
  const what = files.length === 1 ? files[0].name : `${files.length} files`;
  editor.notices.show({ text: n ? `${what} saved, without ${n} thing${n > 1 ? 's' : ''}.` : `${what} saved.` });
}

export const slug = (s: string | undefined): string =>
  (s ?? '')
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, '-')
    .replace(/^-|-$/g, '') || 'scene';

function offer(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const a = document.createElement('a');
  a.href = url;
  a.download = name;
  document.body.append(a);
  a.click();
  a.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
