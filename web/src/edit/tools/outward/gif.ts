// GIF according to its specification (GIF89a): pictures of at most 256 colours, LZW-compressed, in sequence.

/** Bits of each channel when the most common colours are counted. */
const BITS = 5;
const MOST_COLOURS = 256;
const MOST_CODE_BITS = 12;
/** Largest size of a data block, in bytes. */
const BLOCK = 255;

/** The most common colours of a picture, as RGB bytes: pictures of maps have few. */
export function paletteOf(rgba: Uint8ClampedArray): Uint8Array {
  const counts = new Uint32Array(1 << (3 * BITS));
  const last = new Uint32Array(counts.length);
  for (let i = 0; i < rgba.length; i += 4) {
    const key = keyOf(rgba[i], rgba[i + 1], rgba[i + 2]);
    counts[key]++;
    last[key] = (rgba[i] << 16) | (rgba[i + 1] << 8) | rgba[i + 2];
  }
  const common = [...counts.keys()].filter((k) => counts[k]).sort((a, b) => counts[b] - counts[a] || a - b);
  const palette = new Uint8Array(3 * MOST_COLOURS);
  common
    .slice(0, MOST_COLOURS)
    .forEach((k, i) => palette.set([last[k] >> 16, (last[k] >> 8) & 255, last[k] & 255], 3 * i));
  return palette;
}

const keyOf = (r: number, g: number, b: number): number =>
  ((r >> (8 - BITS)) << (2 * BITS)) | ((g >> (8 - BITS)) << BITS) | (b >> (8 - BITS));

/** Bytes of a film: header, pictures of one size, trailer. */
export class GifWriter {
  readonly #parts: Uint8Array[] = [];
  /** Palette index of each coarse colour; -1 until computed. */
  readonly #nearest = new Int16Array(1 << (3 * BITS)).fill(-1);

  constructor(
    private readonly width: number,
    private readonly height: number,
    private readonly palette: Uint8Array,
  ) {
    const size = [width & 255, width >> 8, height & 255, height >> 8];
    this.#put(...bytesOf('GIF89a'), ...size, 0xf7, 0, 0);
    this.#parts.push(palette);
    // It loops forever.
    this.#put(0x21, 0xff, 11, ...bytesOf('NETSCAPE2.0'), 3, 1, 0, 0, 0);
  }

  /** A picture with its duration in hundredths of a second. */
  add(rgba: Uint8ClampedArray, hundredths: number): void {
    const { width, height } = this;
    this.#put(0x21, 0xf9, 4, 0, hundredths & 255, hundredths >> 8, 0, 0);
    this.#put(0x2c, 0, 0, 0, 0, width & 255, width >> 8, height & 255, height >> 8, 0, 8);
    const packed = lzw(this.#indices(rgba));
    for (let i = 0; i < packed.length; i += BLOCK) {
      const block = packed.subarray(i, i + BLOCK);
      this.#put(block.length);
      this.#parts.push(block);
    }
    this.#put(0);
  }

  end(): Blob {
    this.#put(0x3b);
    return new Blob(this.#parts as BlobPart[], { type: 'image/gif' });
  }

  #put(...bytes: number[]): void {
    this.#parts.push(Uint8Array.from(bytes));
  }

  #indices(rgba: Uint8ClampedArray): Uint8Array {
    const out = new Uint8Array(rgba.length / 4);
    for (let i = 0; i < out.length; i++) {
      const [r, g, b] = [rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]];
      const key = keyOf(r, g, b);
      if (this.#nearest[key] < 0) this.#nearest[key] = this.#closest(r, g, b);
      out[i] = this.#nearest[key];
    }
    return out;
  }

  #closest(r: number, g: number, b: number): number {
    const p = this.palette;
    let best = 0;
    let least = Infinity;
    for (let i = 0; i < p.length; i += 3) {
      const d = (p[i] - r) ** 2 + (p[i + 1] - g) ** 2 + (p[i + 2] - b) ** 2;
      if (d < least) [best, least] = [i / 3, d];
    }
    return best;
  }
}

const bytesOf = (text: string): number[] => [...text].map((c) => c.charCodeAt(0));

/** Codes of 8-bit indices, the least significant bit first; earlier strings have one code. */
export function lzw(indices: Uint8Array): Uint8Array {
  const [clear, end] = [256, 257];
  const out: number[] = [];
  let bits = 0;
  let held = 0;
  let size = 9;
  let next = end + 1;
  let known = new Map<number, number>();
  const put = (code: number): void => {
    held |= code << bits;
    for (bits += size; bits >= 8; bits -= 8) {
      out.push(held & 255);
      held >>>= 8;
    }
  };
  put(clear);
  let before = indices.length ? indices[0] : -1;
  for (let i = 1; i < indices.length; i++) {
    const key = (before << 8) | indices[i];
    const code = known.get(key);
    if (code !== undefined) {
      before = code;
      continue;
    }
    put(before);
    before = indices[i];
    if (next < 1 << MOST_CODE_BITS) {
      known.set(key, next);
      // A decoder is one entry behind: codes grow once the one that needs it could occur.
      if (next++ === 1 << size) size++;
    } else {
      put(clear);
      [known, size, next] = [new Map(), 9, end + 1];
    }
  }
  if (before >= 0) put(before);
  put(end);
  if (bits) out.push(held & 255);
  return Uint8Array.from(out);
}
