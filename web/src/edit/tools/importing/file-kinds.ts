// Kind of a file by its content: its name may be wrong.

import { TEXTS } from '../../../texts/files/importing';

/** The name of a kind, alone and within a sentence: `PDF`, `a PDF`. */
export interface ForeignKind {
  readonly name: string;
  readonly inSentence: string;
}

interface FileMark {
  readonly bytes: readonly number[];
  readonly kind: ForeignKind;
  /** Some of these hold a scene: the server examines them. */
  readonly open?: true;
}

const text = (s: string): number[] => [...s].map((c) => c.charCodeAt(0));

const MARKS: readonly FileMark[] = [
  { bytes: text('%PDF'), kind: TEXTS.foreign.pdf },
  { bytes: [0x50, 0x4b, 3, 4], kind: TEXTS.foreign.zip, open: true },
  { bytes: text('AC10'), kind: TEXTS.foreign.drawing },
  { bytes: [0x89, ...text('PNG')], kind: TEXTS.foreign.picture },
  { bytes: [0xff, 0xd8, 0xff], kind: TEXTS.foreign.picture },
  { bytes: text('GIF8'), kind: TEXTS.foreign.picture },
  { bytes: [0xd0, 0xcf, 0x11, 0xe0], kind: TEXTS.foreign.office },
];

/** Number of leading bytes to compare. */
const LOOKED_AT = 16;

/**
 * The kind of a file without a scene, by its first bytes; null where they match none. With `surely: false` some files
 * of the kind do hold a scene.
 */
export async function foreignKind(
  file: Blob,
): Promise<{ readonly kind: ForeignKind; readonly surely: boolean } | null> {
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

/** The kind according to the file's name. */
export function kindByName(name: string): string {
  const ending = name.toLowerCase().replace(/\.gz$/, '').split('.').pop() ?? '';
  return CALLED[ending] ?? TEXTS.file;
}
