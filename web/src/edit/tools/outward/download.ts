// Exports what is shown as files.
import { Refused, type Client } from '../../../net/client';
import type { SceneJson } from '../../../net/types';
import type { Scene } from '../../../model/document/scene';
import type { Editor } from '../../session/editor';
import type { Loss } from './losses';
import type { SceneFile } from '../../document/scene-file';
import { TEXTS } from '../../../texts/files/download';

interface Source {
  readonly editor: Editor;
  readonly file: SceneFile;
  readonly client: Client;
}

export interface ExportedFile {
  readonly blob: Blob;
  readonly name: string;
  /** Details that the format cannot hold. */
  readonly losses: readonly Loss[];
  /** Companion files. */
  readonly others?: readonly ExportedFile[];
}

const ENDING: Record<string, string> = { dragtraffic: 'json', womd: 'tfrecord' };

/** The shown scene in one of the server's formats. */
export async function exported(c: Source, format: string): Promise<ExportedFile | null> {
  const json = c.file.complete();
  return json && exportedJson(c.client, json, c.editor.scene.peek()!, format);
}

/** Any scene in one of the server's formats. */
export async function exportedJson(
  client: Client,
  json: SceneJson,
  scene: Scene,
  format: string,
): Promise<ExportedFile> {
  const { blob, name, loss } = await client.exportScene(json, format);
  const ending = name.includes('.') ? name.slice(name.indexOf('.') + 1) : (ENDING[format] ?? format);
  const { lossesOf } = await import('./losses');
  return { blob, name: `${slug(json.name)}.${ending}`, losses: lossesOf(loss, scene) };
}

/** Saves it as a download. */
export async function download(c: Source, format: string): Promise<void> {
  try {
    const made = await exported(c, format);
    if (made) save(c.editor, made);
  } catch (e) {
    c.editor.notices.show({ text: TEXTS.notExported(whyNot(e)) });
  }
}

export const whyNot = (e: unknown): string => (e instanceof Refused ? e.message : TEXTS.theServerIsNotThere);

export function save(editor: Editor, file: ExportedFile): void {
  saveAll(editor, [file]);
}

export function saveAll(editor: Editor, files: readonly ExportedFile[]): void {
  for (const { blob, name } of files) offer(blob, name);
  const n = new Set(files.flatMap((f) => f.losses.map((l) => l.what))).size;
  const what = files.length === 1 ? files[0].name : TEXTS.files(files.length);
  editor.notices.show({ text: n ? TEXTS.savedWithout(n, what) : TEXTS.saved(what) });
}

export const slug = (s: string | undefined): string =>
  (s ?? '')
    .toLowerCase()
    .replaceAll('ß', 'ss')
    .normalize('NFKD')
    .replace(/\p{M}/gu, '')
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
