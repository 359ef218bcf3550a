// Saves an export of what is on screen to a file.
import { Refused, type Client } from '../net/client';
import type { Editor } from './editor';
import type { SceneFile } from './scene-file';

const ENDING: Record<string, string> = { dragtraffic: 'json', womd: 'tfrecord' };

export async function download(c: { editor: Editor; file: SceneFile; client: Client }, format: string): Promise<void> {
  const json = c.file.complete();
  if (!json) return;
  try {
    const { blob, name, loss } = await c.client.exportScene(json, format);
    const ending = name.includes('.') ? name.slice(name.indexOf('.') + 1) : (ENDING[format] ?? format);
    const file = `${slug(json.name ?? 'scene')}.${ending}`;
    offer(blob, file);
    c.editor.notices.show(
      { text: loss ? `${file} saved. This format has no place for: ${lossWords(loss)}.` : `${file} saved.` },
      9000,
    );
  } catch (e) {
    c.editor.notices.show({
      text: e instanceof Refused ? `Not exported: ${e.message}` : 'Not exported: the server is not answering.',
    });
  }
}

/** `no-lane-type, no-modes` as people say it; the first few are enough. */
function lossWords(loss: string): string {
  const all = loss
    .split(',')
    .map((s) => s.trim().replace(/^no-/, '').replaceAll('-', ' '))
    .filter(Boolean);
  return all.length > 4 ? `${all.slice(0, 3).join(', ')} and ${all.length - 3} more` : all.join(', ');
}

const slug = (s: string): string =>
  s
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
