// Pictures scaled down and compared. The browser decodes and encodes, so nothing else is needed.

/** Scale and quality of stored pictures. */
const SCALE = 0.5;
const QUALITY = 0.8;
/** Colours nearer than this, summed over red, green and blue, are the same: scaled-down pictures have lost as much. */
const SAME_COLOUR = 72;

/** Small differences in one place are measured in squares of this size. */
const SQUARE_PX = 32;
/** Shares of differing pixels above which two pictures differ: of the whole, and of one square. */
const ALLOWED = { whole: 0.003, square: 0.04 };

export class Pixels {
  #page;

  static async open(browser) {
    const p = new Pixels();
    p.#page = await browser.newPage();
    return p;
  }

  /** A small WebP of a picture. */
  async small(png) {
    const base64 = await this.#page.evaluate(shrink, [png.toString('base64'), SCALE, QUALITY]);
    return Buffer.from(base64, 'base64');
  }

  /** Are two alike, and where not? The share of differing pixels, and their place in words. */
  async differing(a, b) {
    const [p, q] = [await pixelsOf(this.#page, a), await pixelsOf(this.#page, b)];
    const { share, square, box } = await this.#page.evaluate(differing, [p, q, SAME_COLOUR, SQUARE_PX]);
    const [x0, y0, x1, y1] = (box ?? []).map((v) => Math.round(v / SCALE));
    return {
      alike: share <= ALLOWED.whole && square <= ALLOWED.square,
      share,
      square,
      where: box ? ` within x ${x0} to ${x1}, y ${y0} to ${y1}` : '',
    };
  }
}

/** A handle of a picture's pixels in a page. */
export const pixelsOf = (page, picture) => page.evaluateHandle(decoded, picture.toString('base64'));

/** Runs in the page. */
async function decoded(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([bytes]));
  const g = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
  g.drawImage(bitmap, 0, 0);
  return g.getImageData(0, 0, bitmap.width, bitmap.height);
}

/** Runs in the page. */
async function shrink([base64, scale, quality]) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([bytes]));
  const [w, h] = [Math.round(bitmap.width * scale), Math.round(bitmap.height * scale)];
  const canvas = new OffscreenCanvas(w, h);
  const g = canvas.getContext('2d');
  g.imageSmoothingQuality = 'high';
  g.drawImage(bitmap, 0, 0, w, h);
  const blob = await canvas.convertToBlob({ type: 'image/webp', quality });
  const small = new Uint8Array(await blob.arrayBuffer());
  let text = '';
  for (const byte of small) text += String.fromCharCode(byte);
  return btoa(text);
}

/** Runs in the page: share of differing pixels of two pictures, of the worst square, and their bounding rectangle. */
function differing([p, q, same, side]) {
  if (p.width !== q.width || p.height !== q.height) return { share: 1, square: 1, box: null };
  let count = 0;
  const across = Math.ceil(p.width / side);
  const squares = new Uint32Array(across * Math.ceil(p.height / side));
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < p.data.length; i += 4) {
    const d = [0, 1, 2].reduce((sum, k) => sum + Math.abs(p.data[i + k] - q.data[i + k]), 0);
    if (d < same) continue;
    count++;
    const x = (i / 4) % p.width;
    const y = Math.floor(i / 4 / p.width);
    squares[Math.floor(y / side) * across + Math.floor(x / side)]++;
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  }
  return { share: count / (p.width * p.height), square: Math.max(...squares) / side ** 2, box: count ? box : null };
}
