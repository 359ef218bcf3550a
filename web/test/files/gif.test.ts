// GIF: the output is decoded by a reader in the test, frame by frame, and every code is checked.
import { describe, expect, it } from 'vitest';
import { GifWriter, lzw, paletteOf } from '../../src/edit/tools/outward/gif';

/** Decodes by the specification: an entry for each code, made of the one before and the next value. */
function unpacked(packed: Uint8Array): number[] {
  let entries: number[][] = [];
  let [size, before]: [number, number[] | null] = [9, null];
  const out: number[] = [];
  const begin = () => {
    entries = Array.from({ length: 258 }, (_, i) => (i < 256 ? [i] : []));
    [size, before] = [9, null];
  };
  begin();
  let [held, bits] = [0, 0];
  for (const byte of packed) {
    held |= byte << bits;
    bits += 8;
    while (bits >= size) {
      const code = held & ((1 << size) - 1);
      held >>>= size;
      bits -= size;
      if (code === 257) return out;
      if (code === 256) {
        begin();
        continue;
      }
      const entry: number[] = entries[code] ?? [...before!, before![0]];
      out.push(...entry);
      if (before && entries.length < 4096) entries.push([...before, entry[0]]);
      if (entries.length === 1 << size && size < 12) size++;
      before = entry;
    }
  }
  throw new Error('no end');
}

/** Pseudo-random numbers, equal in each run. */
const noise = (n: number, of: number): Uint8Array => {
  let x = 7;
  return Uint8Array.from({ length: n }, () => (x = (x * 1103515245 + 12345) % 2147483648) % of);
};

describe('LZW', () => {
  it.each([
    ['nothing', new Uint8Array(0)],
    ['one colour', new Uint8Array(20_000)],
    ['two in turn', Uint8Array.from({ length: 5000 }, (_, i) => i % 2)],
    ['noise that fills the table several times', noise(60_000, 256)],
    ['few colours', noise(60_000, 5)],
  ])('gives back %s', (_, indices) => {
    expect(unpacked(lzw(indices))).toEqual([...indices]);
  });
});

describe('a film', () => {
  it('has a header, each frame with its duration, and a trailer', async () => {
    const [w, h] = [3, 2];
    const picture = (r: number) => new Uint8ClampedArray(Array.from({ length: w * h }, () => [r, 200, 30, 255]).flat());
    const g = new GifWriter(w, h, paletteOf(picture(120)));
    g.add(picture(120), 10);
    g.add(picture(122), 10);
    const bytes = new Uint8Array(await g.end().arrayBuffer());
    expect(String.fromCharCode(...bytes.subarray(0, 6))).toBe('GIF89a');
    expect([...bytes.subarray(6, 10)]).toEqual([3, 0, 2, 0]);
    expect([...bytes.subarray(13, 16)]).toEqual([120, 200, 30]);
    expect(bytes.at(-1)).toBe(0x3b);
    const pictures = bytes.filter((b, i) => b === 0x21 && bytes[i + 1] === 0xf9 && bytes[i + 4] === 10);
    expect(pictures).toHaveLength(2);
  });

  it('keeps the most common colours where there are more than fit', () => {
    const many = Uint8ClampedArray.from({ length: 4 * 4096 }, (_, i) =>
      i % 4 === 3 ? 255 : ((i >> 2) * (1 + (i % 4) * 37)) % 256,
    );
    many.fill(9, 0, 4 * 100);
    const palette = paletteOf(many);
    expect(palette).toHaveLength(768);
    expect([...palette.subarray(0, 3)]).toEqual([9, 9, 9]);
  });
});
