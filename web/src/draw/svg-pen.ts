// A pen that writes SVG: the same picture as vectors.
import type { Pen, Shape, Sprite } from './pen';

type Matrix = readonly [number, number, number, number, number, number];
const IDENTITY: Matrix = [1, 0, 0, 1, 0, 0];
/** Corners of the polygon for a full circle. */
const ROUND = 40;

const times = (m: Matrix, [a, b, c, d, e, f]: Matrix): Matrix => [
  m[0] * a + m[2] * b,
  m[1] * a + m[3] * b,
  m[0] * c + m[2] * d,
  m[1] * c + m[3] * d,
  m[0] * e + m[2] * f + m[4],
  m[1] * e + m[3] * f + m[5],
];

const n = (v: number): string => String(Math.round(v * 100) / 100);
export const escaped = (s: string): string =>
  s.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');

/** `600 11px "Inter Variable", system-ui` as attributes. */
function fontOf(font: string): string {
  const [, weight, size, family] = /^(\d+ )?([\d.]+px) (.*)$/.exec(font) ?? [];
  if (!size) return '';
  return `${weight ? ` font-weight="${weight.trim()}"` : ''} font-size="${size}" font-family="${escaped(family)}"`;
}

/** State that `save` stores. */
const initial = () => ({
  m: IDENTITY,
  strokeStyle: '#000',
  fillStyle: '#000',
  lineWidth: 1,
  lineCap: 'butt' as CanvasLineCap,
  lineJoin: 'miter' as CanvasLineJoin,
  globalAlpha: 1,
  font: '10px sans-serif',
  textAlign: 'start' as CanvasTextAlign,
  textBaseline: 'alphabetic' as CanvasTextBaseline,
  dash: [] as readonly number[],
  tiles: null as string | null,
});
type PenState = ReturnType<typeof initial>;

const ANCHOR: Partial<Record<CanvasTextAlign, string>> = { center: 'middle', right: 'end', end: 'end' };

export class SvgPen implements Pen {
  // Drawings have no shadows.
  shadowColor = '';
  shadowBlur = 0;
  shadowOffsetY = 0;
  readonly #out: string[] = [];
  #s: PenState = initial();
  #saved: PenState[] = [];
  #path = '';
  #last: readonly [number, number] | null = null;

  /** `defs` collects drawings that are defined once and used often. */
  constructor(readonly defs: Map<string, { id: string; text: string }> = new Map()) {}

  take(): string {
    return this.#out.join('');
  }

  /** The drawing as a file of this size, in pixels. */
  file(width: number, height: number, title: string, about: string): string {
    const defs = [...this.defs.values()].map((d) => d.text).join('');
    return (
      `<svg xmlns="http://www.w3.org/2000/svg" width="${n(width)}" height="${n(height)}" ` +
      `viewBox="0 0 ${n(width)} ${n(height)}"><title>${escaped(title)}</title><desc>${escaped(about)}</desc>` +
      `<defs>${defs}</defs>${this.take()}</svg>\n`
    );
  }

  set strokeStyle(v: string) {
    this.#s.strokeStyle = v;
    this.#s.tiles = null;
  }
  get strokeStyle(): string {
    return this.#s.strokeStyle;
  }
  set fillStyle(v: string) {
    this.#s.fillStyle = v;
  }
  get fillStyle(): string {
    return this.#s.fillStyle;
  }
  set lineWidth(v: number) {
    this.#s.lineWidth = v;
  }
  get lineWidth(): number {
    return this.#s.lineWidth;
  }
  set lineCap(v: CanvasLineCap) {
    this.#s.lineCap = v;
  }
  get lineCap(): CanvasLineCap {
    return this.#s.lineCap;
  }
  set lineJoin(v: CanvasLineJoin) {
    this.#s.lineJoin = v;
  }
  get lineJoin(): CanvasLineJoin {
    return this.#s.lineJoin;
  }
  set globalAlpha(v: number) {
    this.#s.globalAlpha = v;
  }
  get globalAlpha(): number {
    return this.#s.globalAlpha;
  }
  set font(v: string) {
    this.#s.font = v;
  }
  get font(): string {
    return this.#s.font;
  }
  set textAlign(v: CanvasTextAlign) {
    this.#s.textAlign = v;
  }
  get textAlign(): CanvasTextAlign {
    return this.#s.textAlign;
  }
  set textBaseline(v: CanvasTextBaseline) {
    this.#s.textBaseline = v;
  }
  get textBaseline(): CanvasTextBaseline {
    return this.#s.textBaseline;
  }

  save(): void {
    this.#saved.push({ ...this.#s });
  }
  restore(): void {
    this.#s = this.#saved.pop() ?? this.#s;
  }
  setTransform(a: number, b: number, c: number, d: number, e: number, f: number): void {
    this.#s.m = [a, b, c, d, e, f];
  }
  translate(x: number, y: number): void {
    this.#s.m = times(this.#s.m, [1, 0, 0, 1, x, y]);
  }
  rotate(angle: number): void {
    const c = Math.cos(angle),
      s = Math.sin(angle);
    this.#s.m = times(this.#s.m, [c, s, -s, c, 0, 0]);
  }
  setLineDash(dash: readonly number[]): void {
    this.#s.dash = dash;
  }

  // -------------------------------------------------------------- paths

  #at(x: number, y: number): string {
    const [a, b, c, d, e, f] = this.#s.m;
    return `${n(a * x + c * y + e)} ${n(b * x + d * y + f)}`;
  }

  beginPath(): void {
    this.#path = '';
    this.#last = null;
  }
  moveTo(x: number, y: number): void {
    this.#path += `M${this.#at(x, y)}`;
    this.#last = [x, y];
  }
  lineTo(x: number, y: number): void {
    this.#path += `${this.#last ? 'L' : 'M'}${this.#at(x, y)}`;
    this.#last = [x, y];
  }
  quadraticCurveTo(cx: number, cy: number, x: number, y: number): void {
    if (!this.#last) this.moveTo(cx, cy);
    this.#path += `Q${this.#at(cx, cy)} ${this.#at(x, y)}`;
    this.#last = [x, y];
  }
  closePath(): void {
    this.#path += 'Z';
  }
  arc(x: number, y: number, r: number, from: number, to: number, back = false): void {
    const full = 2 * Math.PI;
    const sweep = back ? -(from - to >= full ? full : (((from - to) % full) + full) % full) : to - from;
    this.ellipse(x, y, r, r, 0, from, from + (back ? sweep : Math.min(full, sweep)));
  }
  ellipse(x: number, y: number, rx: number, ry: number, rotation: number, from: number, to: number): void {
    const steps = Math.max(2, Math.ceil((Math.abs(to - from) / (2 * Math.PI)) * ROUND));
    const c = Math.cos(rotation),
      s = Math.sin(rotation);
    for (let i = 0; i <= steps; i++) {
      const t = from + ((to - from) * i) / steps;
      const px = rx * Math.cos(t),
        py = ry * Math.sin(t);
      this.lineTo(x + px * c - py * s, y + px * s + py * c);
    }
  }
  roundRect(x: number, y: number, w: number, h: number, radius: number): void {
    const r = Math.min(radius, Math.abs(w) / 2, Math.abs(h) / 2);
    this.moveTo(x + r, y);
    for (const [x1, y1, cx, cy, x2, y2] of [
      [x + w - r, y, x + w, y, x + w, y + r],
      [x + w, y + h - r, x + w, y + h, x + w - r, y + h],
      [x + r, y + h, x, y + h, x, y + h - r],
      [x, y + r, x, y, x + r, y],
    ]) {
      this.lineTo(x1, y1);
      this.quadraticCurveTo(cx, cy, x2, y2);
    }
    this.closePath();
  }

  // -------------------------------------------------------------- paint

  get #scale(): number {
    const [a, b] = this.#s.m;
    return Math.hypot(a, b);
  }

  #alpha(): string {
    return this.#s.globalAlpha < 1 ? ` opacity="${n(this.#s.globalAlpha)}"` : '';
  }

  stroke(): void {
    this.#strokePath(this.#path);
  }
  #strokePath(d: string): void {
    if (!d) return;
    const s = this.#s;
    const k = this.#scale;
    const dash = s.dash.length ? ` stroke-dasharray="${s.dash.map((v) => n(v * k)).join(' ')}"` : '';
    this.#out.push(
      `<path d="${d}" fill="none" stroke="${s.tiles ?? escaped(s.strokeStyle)}" stroke-width="${n(s.lineWidth * k)}" ` +
        `stroke-linecap="${s.lineCap}" stroke-linejoin="${s.lineJoin}"${dash}${this.#alpha()}/>`,
    );
  }
  fill(): void {
    this.#fillPath(this.#path, 'nonzero');
  }
  #fillPath(d: string, rule: CanvasFillRule): void {
    const even = rule === 'evenodd' ? ' fill-rule="evenodd"' : '';
    if (d) this.#out.push(`<path d="${d}" fill="${escaped(this.#s.fillStyle)}"${even}${this.#alpha()}/>`);
  }
  fillRect(x: number, y: number, w: number, h: number): void {
    const d = `M${this.#at(x, y)}L${this.#at(x + w, y)}L${this.#at(x + w, y + h)}L${this.#at(x, y + h)}Z`;
    this.#fillPath(d, 'nonzero');
  }
  fillText(text: string, x: number, y: number): void {
    const s = this.#s;
    const at = times(s.m, [1, 0, 0, 1, x, y]).map(n).join(' ');
    const base = s.textBaseline === 'middle' ? ' dominant-baseline="central"' : '';
    this.#out.push(
      `<text transform="matrix(${at})" fill="${escaped(s.fillStyle)}" text-anchor="${ANCHOR[s.textAlign] ?? 'start'}"` +
        `${base}${fontOf(s.font)}${this.#alpha()}>${escaped(text)}</text>`,
    );
  }

  // -------------------------------------------------------------- definitions

  #shapePath({ points, ends }: Shape): string {
    let d = '';
    let i = 0;
    for (const end of ends) {
      for (let first = true; i < Math.abs(end); i += 2, first = false)
        d += `${first ? 'M' : 'L'}${this.#at(points[i], points[i + 1])}`;
      if (end < 0) d += 'Z';
    }
    return d;
  }
  strokeShape(shape: Shape): void {
    this.#strokePath(this.#shapePath(shape));
  }
  fillShape(shape: Shape, rule: CanvasFillRule): void {
    this.#fillPath(this.#shapePath(shape), rule);
  }

  /** The id of a drawing that is defined once. */
  #defined(key: string, write: (id: string, drawing: string) => string, sprite: Sprite): string {
    const known = this.defs.get(key);
    if (known) return known.id;
    const id = `d${this.defs.size + 1}`;
    const own = new SvgPen(this.defs);
    this.defs.set(key, { id, text: '' });
    sprite.paint(own);
    this.defs.set(key, { id, text: write(id, own.take()) });
    return id;
  }
  stamp(sprite: Sprite, x: number, y: number, w: number, h: number): void {
    const id = this.#defined(sprite.key, (name, drawing) => `<g id="${name}">${drawing}</g>`, sprite);
    const at = times(this.#s.m, [w / sprite.width, 0, 0, h / sprite.height, x, y]);
    this.#out.push(`<use href="#${id}" transform="matrix(${at.map(n).join(' ')})"${this.#alpha()}/>`);
  }
  strokeTiles(sprite: Sprite, scale: number): void {
    const { width, height } = sprite;
    const write = (name: string, drawing: string): string =>
      `<pattern id="${name}" width="${width}" height="${height}" patternUnits="userSpaceOnUse" ` +
      `patternTransform="scale(${n(scale * this.#scale)})">${drawing}</pattern>`;
    this.#s.tiles = `url(#${this.#defined(`tiles:${sprite.key}`, write, sprite)})`;
  }
}
