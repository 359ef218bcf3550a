// Compares two folders of pictures. The browser decodes them, so nothing else is needed.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { launch } from './editor.js';

/** Colours nearer than this, summed over red, green and blue, are the same: anti-aliasing may differ by a shade. */
const SAME_COLOUR = 24;
/** Share of differing pixels above which two pictures are called different. */
const ALLOWED = 0.001;

/** Prints one line a picture; true when all are alike. */
export async function compare(before, after) {
  const browser = await launch();
  const page = await browser.newPage();
  let alike = true;
  try {
    for (const name of readdirSync(before).filter((n) => n.endsWith('.png'))) {
      if (!existsSync(`${after}/${name}`)) {
        console.log(`${name}: missing in ${after}`);
        alike = false;
        continue;
      }
      const [a, b] = [before, after].map((folder) => readFileSync(`${folder}/${name}`).toString('base64'));
      const { share, box } = await page.evaluate(differing, [a, b, SAME_COLOUR]);
      const where = box ? ` within x ${box[0]} to ${box[2]}, y ${box[1]} to ${box[3]}` : '';
      console.log(`${name}: ${(share * 100).toFixed(4)} % of the pixels differ${where}`);
      alike &&= share <= ALLOWED;
    }
  } finally {
    await browser.close();
  }
  return alike;
}

/** Runs in the page: share of differing pixels of two PNGs, and the rectangle they lie in. */
async function differing([a, b, same]) {
  const read = async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const g = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    g.drawImage(bitmap, 0, 0);
    return g.getImageData(0, 0, bitmap.width, bitmap.height);
  };
  const [p, q] = [await read(a), await read(b)];
  if (p.width !== q.width || p.height !== q.height) return { share: 1, box: null };
  let count = 0;
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < p.data.length; i += 4) {
    const d = [0, 1, 2].reduce((sum, k) => sum + Math.abs(p.data[i + k] - q.data[i + k]), 0);
    if (d < same) continue;
    count++;
    const x = (i / 4) % p.width;
    const y = Math.floor(i / 4 / p.width);
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  }
  return { share: count / (p.width * p.height), box: count ? box : null };
}
