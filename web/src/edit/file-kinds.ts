// What a file is, by what is in it: its name may say something else.

interface Mark {
  readonly bytes: readonly number[];
  readonly kind: string;
}

const text = (s: string): number[] => [...s].map((c) => c.charCodeAt(0));

const MARKS: readonly Mark[] = [
  { bytes: text('%PDF'), kind: 'a PDF' },
  { bytes: [0x50, 0x4b, 3, 4], kind: 'a ZIP archive' },
  { bytes: text('AC10'), kind: 'a CAD drawing (DWG)' },
  { bytes: [0x89, ...text('PNG')], kind: 'a picture' },
  { bytes: [0xff, 0xd8, 0xff], kind: 'a picture' },
  { bytes: text('GIF8'), kind: 'a picture' },
  { bytes: [0xd0, 0xcf, 0x11, 0xe0], kind: 'an Office document' },
];

/** How many bytes tell. */
const LOOKED_AT = 16;

/** The kind of a file that is surely no scene; null where that cannot be told from its beginning. */
export async function foreignKind(file: Blob): Promise<string | null> {
  const head = new Uint8Array(await file.slice(0, LOOKED_AT).arrayBuffer());
  return MARKS.find((m) => m.bytes.every((b, i) => head[i] === b))?.kind ?? null;
}

const CALLED: Record<string, string> = {
  json: 'saved scene',
  tfrecord: 'scenario record',
  xml: 'network',
  csv: 'table',
  parquet: 'table',
};

/** What its name says that it is. */
export function kindByName(name: string): string {
  const ending = name.toLowerCase().replace(/\.gz$/, '').split('.').pop() ?? '';
  return CALLED[ending] ?? 'file';
}
