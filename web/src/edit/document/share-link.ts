// A scene inside a link: packed, deflated, and written in the fragment, which browsers never send.
import type { SceneJson } from '../../model/document/scene-json';
import type { Camera } from '../../model/document/history';
import { pack, PackError, unpack } from '../../model/document/pack';
import { MARK } from './share-mark';
import { TEXTS } from '../../texts/files/share';

/** Longer links are cut by mail programs and chats. */
export const MOST_LINK_BYTES = 60 * 1024;
/** Limit of the unpacked text: more than any link made here holds. */
const MOST_TEXT_BYTES = 16 << 20;
const VERSION = 1;

/** Start of a playback: time and camera. */
export interface ShownAt {
  readonly time: number;
  readonly camera: Camera;
}

export interface SharedScene {
  readonly scene: SceneJson;
  readonly at: ShownAt | null;
}

export class LinkError extends Error {}

/** The fragment of the link, and its size in bytes. */
export async function writeLink(shared: SharedScene): Promise<{ hash: string; bytes: number }> {
  const text = JSON.stringify({ v: VERSION, at: shared.at, scene: pack(shared.scene) });
  const bytes = await through(new Blob([text]).stream(), new CompressionStream('deflate-raw'), MOST_TEXT_BYTES);
  return { hash: MARK + toBase64(bytes), bytes: bytes.length };
}

export async function readLink(hash: string): Promise<SharedScene> {
  const coded = hash.slice(MARK.length);
  if (coded.length > 2 * MOST_LINK_BYTES) throw new LinkError(TEXTS.linkTooLong);
  try {
    const bytes = fromBase64(coded);
    const text = await through(new Blob([bytes]).stream(), new DecompressionStream('deflate-raw'), MOST_TEXT_BYTES);
    const read = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(text)) as Record<string, unknown>;
    if (read?.v !== VERSION) throw new LinkError(TEXTS.theLinkWasMade);
    const scene = unpack(read.scene);
    if (typeof scene !== 'object' || scene === null) throw new PackError(TEXTS.noScene);
    return { scene: scene as SceneJson, at: readShownAt(read.at) };
  } catch (e) {
    if (e instanceof LinkError) throw e;
    throw new LinkError(TEXTS.linkIncomplete);
  }
}

function readShownAt(v: unknown): ShownAt | null {
  const { time, camera } = (v ?? {}) as Partial<ShownAt>;
  const numbers = [time, camera?.cx, camera?.cy, camera?.z, camera?.turn ?? 0];
  return numbers.every((n) => Number.isFinite(n)) && camera!.z > 0 ? { time: time!, camera: camera! } : null;
}

/** Reads a stream, up to a limit. */
async function through(
  from: ReadableStream<Uint8Array>,
  by: GenericTransformStream,
  most: number,
): Promise<Uint8Array<ArrayBuffer>> {
  const parts: Uint8Array[] = [];
  let length = 0;
  const reader = (from.pipeThrough(by) as ReadableStream<Uint8Array>).getReader();
  for (let r = await reader.read(); !r.done; r = await reader.read()) {
    length += r.value.length;
    if (length > most) {
      void reader.cancel();
      throw new LinkError(TEXTS.linkExceedsLimits);
    }
    parts.push(r.value);
  }
  const all = new Uint8Array(length);
  let at = 0;
  for (const p of parts) {
    all.set(p, at);
    at += p.length;
  }
  return all;
}

const CHUNK = 0x8000;

function toBase64(bytes: Uint8Array): string {
  let text = '';
  for (let i = 0; i < bytes.length; i += CHUNK) text += String.fromCharCode(...bytes.subarray(i, i + CHUNK));
  return btoa(text).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const plain = atob(text.replace(/-/g, '+').replace(/_/g, '/'));
  return Uint8Array.from(plain, (c) => c.charCodeAt(0));
}
