// The painted part of a canvas, so that only that part needs restoring.
import type { Played } from '../pen';

/** Empty where `right` is not above `left`. */
export interface PixelBox {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** Largest width of a letter as a multiple of the font size. */
const WIDEST_LETTER = 1.5;
/** Largest length of a mitre as a multiple of half the line width: the default of a canvas. */
const MITER_LIMIT = 10;
/** Antialiased pixels at an edge. */
const SOFT_PX = 2;

interface ExtentState {
  a: number;
  b: number;
  c: number;
  d: number;
  e: number;
  f: number;
  lineWidth: number;
  lineCap: CanvasLineCap;
  lineJoin: CanvasLineJoin;
  font: string;
  shadowBlur: number;
  shadowOffsetY: number;
}

export class Bounds implements PixelBox {
  left = Infinity;
  top = Infinity;
  right = -Infinity;
  bottom = -Infinity;

  /** Ignores a place with NaN. */
  add(x: number, y: number, around = 0): void {
    if (x - around < this.left) this.left = x - around;
    if (y - around < this.top) this.top = y - around;
    if (x + around > this.right) this.right = x + around;
    if (y + around > this.bottom) this.bottom = y + around;
  }

  addAll(other: Bounds, around: number): void {
    this.add(other.left, other.top, around);
    this.add(other.right, other.bottom, around);
  }
}

/** A canvas that paints nothing: it only records the bounds of painting, never too small. */
export class Extent implements Played {
  readonly #all = new Bounds();
  #path = new Bounds();
  #s: ExtentState;
  readonly #saved: ExtentState[] = [];

  /** Starts like a canvas with this many pixels for each unit; `boundsOf` gives the bounds of an existing path. */
  constructor(
    scale: number,
    private readonly boundsOf: (path: Path2D) => PixelBox,
  ) {
    this.#s = {
      ...{ a: scale, b: 0, c: 0, d: scale, e: 0, f: 0 },
      ...{ lineWidth: 1, lineCap: 'butt', lineJoin: 'miter', font: '10px sans-serif', shadowBlur: 0, shadowOffsetY: 0 },
    };
  }

  /** The painted part, in whole pixels of a canvas of this size. */
  part(width: number, height: number): PixelBox {
    const { left, top, right, bottom } = this.#all;
    return {
      left: Math.max(0, Math.floor(left)),
      top: Math.max(0, Math.floor(top)),
      right: Math.min(width, Math.ceil(right)),
      bottom: Math.min(height, Math.ceil(bottom)),
    };
  }

  #put(to: Bounds, x: number, y: number, around = 0): void {
    const { a, b, c, d, e, f } = this.#s;
    to.add(a * x + c * y + e, b * x + d * y + f, around && around * this.#scale);
  }

  #putBox(to: Bounds, x: number, y: number, w: number, h: number): void {
    this.#put(to, x, y);
    this.#put(to, x + w, y);
    this.#put(to, x, y + h);
    this.#put(to, x + w, y + h);
  }

  /** Upper bound of the transform's scale. */
  get #scale(): number {
    const { a, b, c, d } = this.#s;
    return Math.hypot(a, b, c, d);
  }

  #painted(what: Bounds, around = 0): void {
    const { shadowBlur, shadowOffsetY } = this.#s;
    this.#all.addAll(what, around + SOFT_PX + (shadowBlur ? 2 * shadowBlur + Math.abs(shadowOffsetY) : 0));
  }

  #boundsOf(path: Path2D): Bounds {
    const bounds = new Bounds();
    const { left, top, right, bottom } = this.boundsOf(path);
    this.#putBox(bounds, left, top, right - left, bottom - top);
    return bounds;
  }

  beginPath(): void {
    this.#path = new Bounds();
  }
  moveTo(x: number, y: number): void {
    this.#put(this.#path, x, y);
  }
  lineTo(x: number, y: number): void {
    this.#put(this.#path, x, y);
  }
  quadraticCurveTo(cx: number, cy: number, x: number, y: number): void {
    this.#put(this.#path, cx, cy);
    this.#put(this.#path, x, y);
  }
  arc(x: number, y: number, r: number): void {
    this.#put(this.#path, x, y, r);
  }
  ellipse(x: number, y: number, rx: number, ry: number): void {
    this.#put(this.#path, x, y, Math.max(rx, ry));
  }
  roundRect(x: number, y: number, w: number, h: number): void {
    this.#putBox(this.#path, x, y, w, h);
  }
  closePath(): void {}
  stroke(path?: Path2D): void {
    const { lineWidth, lineCap, lineJoin } = this.#s;
    const out = lineJoin === 'miter' ? MITER_LIMIT : lineCap === 'square' ? Math.SQRT2 : 1;
    this.#painted(path ? this.#boundsOf(path) : this.#path, (lineWidth / 2) * out * this.#scale);
  }
  fill(path?: Path2D): void {
    this.#painted(path ? this.#boundsOf(path) : this.#path);
  }
  fillRect(x: number, y: number, w: number, h: number): void {
    const box = new Bounds();
    this.#putBox(box, x, y, w, h);
    this.#painted(box);
  }
  drawImage(_: CanvasImageSource, x: number, y: number, w: number, h: number): void {
    this.fillRect(x, y, w, h);
  }
  /** For any text alignment. */
  fillText(text: string, x: number, y: number): void {
    const px = Number(/([\d.]+)px/.exec(this.#s.font)?.[1] ?? Infinity);
    const w = px * WIDEST_LETTER * text.length;
    this.fillRect(x - w, y - 2 * px, 2 * w, 4 * px);
  }
  save(): void {
    this.#saved.push({ ...this.#s });
  }
  restore(): void {
    this.#s = this.#saved.pop() ?? this.#s;
  }
  translate(x: number, y: number): void {
    const s = this.#s;
    s.e += s.a * x + s.c * y;
    s.f += s.b * x + s.d * y;
  }
  rotate(angle: number): void {
    const { a, b, c, d } = this.#s;
    const cos = Math.cos(angle),
      sin = Math.sin(angle);
    Object.assign(this.#s, { a: a * cos + c * sin, b: b * cos + d * sin, c: c * cos - a * sin, d: d * cos - b * sin });
  }
  setTransform(a: number, b: number, c: number, d: number, e: number, f: number): void {
    Object.assign(this.#s, { a, b, c, d, e, f });
  }
  setLineDash(): void {}
  createPattern(): null {
    return null;
  }
  set lineWidth(px: number) {
    // A canvas ignores invalid widths too.
    if (px > 0) this.#s.lineWidth = px;
  }
  set lineCap(cap: CanvasLineCap) {
    this.#s.lineCap = cap;
  }
  set lineJoin(join: CanvasLineJoin) {
    this.#s.lineJoin = join;
  }
  set font(font: string) {
    this.#s.font = font;
  }
  set shadowBlur(px: number) {
    if (px >= 0) this.#s.shadowBlur = px;
  }
  set shadowOffsetY(px: number) {
    this.#s.shadowOffsetY = px;
  }
  set globalAlpha(_: number) {}
  set textAlign(_: CanvasTextAlign) {}
  set textBaseline(_: CanvasTextBaseline) {}
  set shadowColor(_: string) {}
  set strokeStyle(_: string | CanvasPattern) {}
  set fillStyle(_: string) {}
}
