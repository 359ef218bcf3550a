// A rough picture of a map file, from its text: places and stretches, in the coordinates of the file. It is no reader:
// it finds only what is needed to choose a part of a map that is too large to be read whole.
import type { Box, Vec } from '../../../model/base/geometry';

export interface MapOutline {
  /** Pairs of ends; a place alone is a pair of equal ones. */
  readonly lines: readonly (readonly [Vec, Vec])[];
  readonly box: Box;
  /** Are the coordinates degrees (longitude, latitude)? */
  readonly degrees: boolean;
}

/** More lines than this are thinned out. */
const MOST_LINES = 12_000;
/** The end of a text that is read again with the next piece: an element may be cut. */
const CARRIED = 4_000;
const GZIP = [0x1f, 0x8b];

const NODE = /<node\b[^>]*?\blat="(-?[\d.]+)"[^>]*?\blon="(-?[\d.]+)"/g;
const ROAD =
  /<geometry\b[^>]*?\bx="([-+.\deE]+)"[^>]*?\by="([-+.\deE]+)"[^>]*?\bhdg="([-+.\deE]+)"[^>]*?\blength="([-+.\deE]+)"/g;
const LANE = /<lane\b[^>]*?\bshape="(-?[\d.]+),(-?[\d.]+)[^"]*?(-?[\d.]+),(-?[\d.]+)(?:,-?[\d.]+)?"/g;

type Found = readonly [Vec, Vec];

/** Kinds of files: what is looked for, and what a match says. */
const KINDS: readonly { readonly of: RegExp; readonly degrees?: true; line(n: readonly number[]): Found }[] = [
  { of: LANE, line: ([ax, ay, bx, by]) => [[ax, ay], [bx, by]] }, // prettier-ignore
  { of: ROAD, line: ([x, y, h, l]) => [[x, y], [x + l * Math.cos(h), y + l * Math.sin(h)]] }, // prettier-ignore
  { of: NODE, degrees: true, line: ([lat, lon]) => [[lon, lat], [lon, lat]] }, // prettier-ignore
];

/** Its multiples, less their whole parts, fill the range from 0 to 1 evenly. */
const GOLDEN = 0.618_033_988_749_895;

/** Collects lines: all at first, then half of them, a quarter, spread over the file whatever its order. */
class Lines {
  #kept: (readonly [rank: number, line: Found])[] = [];
  #share = 1;
  #count = 0;
  readonly box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };

  get all(): Found[] {
    return this.#kept.map(([, line]) => line);
  }

  get size(): number {
    return this.#kept.length;
  }

  add(line: Found): void {
    if (!line.flat().every(Number.isFinite)) return;
    for (const [x, y] of line) {
      this.box.x0 = Math.min(this.box.x0, x);
      this.box.y0 = Math.min(this.box.y0, y);
      this.box.x1 = Math.max(this.box.x1, x);
      this.box.y1 = Math.max(this.box.y1, y);
    }
    const rank = (this.#count++ * GOLDEN) % 1;
    if (rank >= this.#share) return;
    this.#kept.push([rank, line]);
    if (this.#kept.length <= MOST_LINES) return;
    this.#share /= 2;
    this.#kept = this.#kept.filter(([r]) => r < this.#share);
  }
}

/** The outline of a SUMO network, an OpenDRIVE or an OSM file, packed by gzip or not; null where there is none. */
export async function outlineOf(file: Blob): Promise<MapOutline | null> {
  const head = new Uint8Array(await file.slice(0, 2).arrayBuffer());
  const packed = head[0] === GZIP[0] && head[1] === GZIP[1];
  const bytes = packed ? file.stream().pipeThrough(new DecompressionStream('gzip')) : file.stream();
  const reader = bytes.pipeThrough(new TextDecoderStream()).getReader();
  const found = KINDS.map(() => new Lines());
  let rest = '';
  try {
    for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
      const text = rest + piece.value;
      let end = 0;
      KINDS.forEach(({ of, line }, i) => {
        of.lastIndex = 0;
        for (let m = of.exec(text); m; m = of.exec(text)) {
          found[i].add(line(m.slice(1).map(Number)));
          end = Math.max(end, of.lastIndex);
        }
      });
      rest = text.slice(Math.max(end, text.length - CARRIED));
    }
  } catch {
    // What was read until a fault in the file is enough for a picture.
  }
  const most = found.reduce((a, b) => (b.size > a.size ? b : a));
  if (!most.size) return null;
  return { lines: most.all, box: most.box, degrees: KINDS[found.indexOf(most)].degrees === true };
}
