// What a file is, by what is in it: its name may say something else.

import { TEXTS } from '../texts/files/importing';

interface Mark {
  readonly bytes: readonly number[];
  readonly kind: string;
  /** Some of these hold a scene: the server looks into them. */
  readonly open?: true;
}

const text = (s: string): number[] => [...s].map((c) => c.charCodeAt(0));

const MARKS: readonly Mark[] = [
  { bytes: text('%PDF'), kind: TEXTS.aPdf },
  { bytes: [0x50, 0x4b, 3, 4], kind: TEXTS.aZipArchive, open: true },
  { bytes: text('AC10'), kind: TEXTS.aCadDrawingDwg },
  { bytes: [0x89, ...text('PNG')], kind: TEXTS.aPicture },
  { bytes: [0xff, 0xd8, 0xff], kind: TEXTS.aPicture },
  { bytes: text('GIF8'), kind: TEXTS.aPicture },
  { bytes: [0xd0, 0xcf, 0x11, 0xe0], kind: TEXTS.anOfficeDocument },
];

/** How many bytes tell. */
const LOOKED_AT = 16;

/**
 * The kind of a file that holds no scene, by its first bytes; null where they do not tell. With `surely: false` some
 * files of the kind do hold one.
 */
export async function foreignKind(file: Blob): Promise<{ readonly kind: string; readonly surely: boolean } | null> {
  const head = new Uint8Array(await file.slice(0, LOOKED_AT).arrayBuffer());
  const mark = MARKS.find((m) => m.bytes.every((b, i) => head[i] === b));
  return mark ? { kind: mark.kind, surely: !mark.open } : null;
}

const CALLED: Record<string, string> = {
  json: TEXTS.savedScene,
  tfrecord: TEXTS.scenarioRecord,
  xml: TEXTS.network,
  csv: TEXTS.table,
  parquet: TEXTS.table,
};

/** What its name says that it is. */
export function kindByName(name: string): string {
  const ending = name.toLowerCase().replace(/\.gz$/, '').split('.').pop() ?? '';
  return CALLED[ending] ?? TEXTS.file;
}
