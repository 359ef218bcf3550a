// An animated WebP of screenshots with a drawn pointer. The browser encodes each frame, so nothing else is needed.

const QUALITY = 0.75;
/** Colours nearer than this, summed over red, green and blue, are the same. */
const SAME_COLOUR = 6;
/** A frame has the changed squares of this size, which is that of WebP's blocks: no colour bleeds over their edges. */
const BLOCK_PX = 16;

export class Animation {
  #page;
  #size;
  #frames = [];

  static async open(browser, [width, height]) {
    const a = new Animation();
    a.#size = [width, height];
    a.#page = await browser.newPage();
    await a.#page.evaluate(keepCanvas, a.#size);
    return a;
  }

  /** A frame of `ms` milliseconds with the pointer at a place of the picture. */
  async add(png, pointer, ms) {
    const drawn = await this.#page.evaluate(changes, [png.toString('base64'), pointer, SAME_COLOUR, BLOCK_PX, QUALITY]);
    if (drawn) this.#frames.push({ ...drawn, ms });
    else this.#frames.at(-1).ms += ms;
  }

  /** The file (WebP container: VP8X, ANIM, one ANMF for each frame). */
  bytes() {
    const [width, height] = this.#size;
    const [alpha, animated] = [0x10, 0x02];
    const head = Buffer.concat([Buffer.from([alpha | animated, 0, 0, 0]), u24(width - 1), u24(height - 1)]);
    const frames = this.#frames.map(({ x, y, w, h, ms, webp }) => {
      const numbers = [x / 2, y / 2, w - 1, h - 1, ms].map(u24);
      return chunk('ANMF', Buffer.concat([...numbers, Buffer.alloc(1), pictureOf(Buffer.from(webp, 'base64'))]));
    });
    const chunks = [chunk('VP8X', head), chunk('ANIM', Buffer.alloc(6)), ...frames];
    return chunk('RIFF', Buffer.concat([Buffer.from('WEBP'), ...chunks]));
  }
}

function u24(number) {
  const bytes = Buffer.alloc(3);
  bytes.writeUIntLE(number, 0, 3);
  return bytes;
}

function chunk(name, content) {
  const size = Buffer.alloc(4);
  size.writeUInt32LE(content.length);
  return Buffer.concat([Buffer.from(name), size, content, Buffer.alloc(content.length % 2)]);
}

/** The chunks of a still WebP that a frame of an animation has too. */
function pictureOf(webp) {
  const parts = [];
  for (let at = 12; at < webp.length;) {
    const end = at + 8 + webp.readUInt32LE(at + 4);
    if (/^(ALPH|VP8 |VP8L)$/.test(webp.toString('latin1', at, at + 4))) {
      parts.push(chunk(webp.toString('latin1', at, at + 4), webp.subarray(at + 8, end)));
    }
    at = end + (end % 2);
  }
  return Buffer.concat(parts);
}

/** Runs in the page: the canvas on which each frame is drawn, and the pixels that the frames so far show. */
function keepCanvas([width, height]) {
  window.drawing = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  window.shown = new Uint8ClampedArray(width * height * 4);
}

/** Runs in the page: the rectangle of the changed squares, transparent between them; null without a change. */
async function changes([base64, [px, py], same, block, quality]) {
  const { drawing: g, shown } = window;
  const { width, height } = g.canvas;
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  g.drawImage(await createImageBitmap(new Blob([bytes])), 0, 0);
  const arrow = new Path2D('M0 0V17L4 13.5L6.5 19L9 18L6.6 12.5H12Z');
  g.setTransform(1, 0, 0, 1, px, py);
  g.strokeStyle = 'white';
  g.lineWidth = 2;
  g.stroke(arrow);
  g.fill(arrow);
  g.resetTransform();
  const frame = g.getImageData(0, 0, width, height);
  const across = Math.ceil(width / block);
  const changed = new Set();
  const blockOf = (i) => Math.floor(i / 4 / width / block) * across + Math.floor(((i / 4) % width) / block);
  for (let i = 0; i < shown.length; i += 4) {
    let d = shown[i + 3] ? 0 : same;
    for (let k = 0; k < 3; k++) d += Math.abs(frame.data[i + k] - shown[i + k]);
    if (d >= same) changed.add(blockOf(i));
  }
  if (!changed.size) return null;
  for (let i = 0; i < shown.length; i += 4) {
    if (changed.has(blockOf(i))) shown.set(frame.data.subarray(i, i + 4), i);
    else frame.data[i + 3] = 0;
  }
  const [columns, rows] = [[...changed].map((n) => n % across), [...changed].map((n) => Math.floor(n / across))];
  const [x0, y0] = [Math.min(...columns) * block, Math.min(...rows) * block];
  const [w, h] = [
    Math.min((Math.max(...columns) + 1) * block, width) - x0,
    Math.min((Math.max(...rows) + 1) * block, height) - y0,
  ];
  const part = new OffscreenCanvas(w, h);
  part.getContext('2d').putImageData(frame, -x0, -y0);
  const blob = await part.convertToBlob({ type: 'image/webp', quality });
  const url = await new Promise((resolve) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result);
    reader.readAsDataURL(blob);
  });
  return { x: x0, y: y0, w, h, webp: url.slice(url.indexOf(',') + 1) };
}
