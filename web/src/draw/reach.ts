// How far a recording reaches: the part of a canvas that it may paint on. What is outside of the parts of this picture
// and the last one stays as it is, and is neither cleared nor composed anew.
import { Op } from './recording';

/** A part of a canvas, in its own pixels; the right and lower edge do not belong to it. */
export interface Part {
  readonly x0: number;
  readonly y0: number;
  readonly x1: number;
  readonly y1: number;
}

/** What recordings refer to, as far as it tells sizes. */
export interface Sizes {
  readonly texts: readonly string[];
  /** Of shapes, in their own coordinates. */
  readonly shapes: readonly Part[];
}

export const NOTHING: Part = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };

export const both = (a: Part, b: Part): Part => ({
  x0: Math.min(a.x0, b.x0),
  y0: Math.min(a.y0, b.y0),
  x1: Math.max(a.x1, b.x1),
  y1: Math.max(a.y1, b.y1),
});

/** Whole pixels of a canvas of this size. */
export const within = (p: Part, width: number, height: number): Part => ({
  x0: Math.max(0, Math.floor(p.x0)),
  y0: Math.max(0, Math.floor(p.y0)),
  x1: Math.min(width, Math.ceil(p.x1)),
  y1: Math.min(height, Math.ceil(p.y1)),
});

/** Half a line's width times this is how far a pointed join reaches: the miter limit of canvases. */
const MITER = 10;
/** Letters are at most so wide and reach so far from their line, in sizes of the font. */
const LETTER = 1.2;
const ABOVE = 1.5;
/** A shadow of so many pixels of blur ends within so many times as many. */
const BLURRED = 2;
/** Soft edges. */
const SPARE_PX = 2;

/** Kept by `save`. */
interface State {
  a: number;
  b: number;
  c: number;
  d: number;
  e: number;
  f: number;
  lineWidth: number;
  pointed: boolean;
  font: number;
  blur: number;
  below: number;
}

/** Of recorded operations, whose coordinates begin as `dpr` pixels each. */
export function reachOf(o: Float64Array, { texts, shapes }: Sizes, dpr: number): Part {
  let x0 = Infinity,
    y0 = Infinity,
    x1 = -Infinity,
    y1 = -Infinity;
  let s: State = {
    a: dpr,
    b: 0,
    c: 0,
    d: dpr,
    e: 0,
    f: 0,
    lineWidth: 1,
    pointed: true,
    font: 10,
    blur: 0,
    below: 0,
  };
  const kept: State[] = [];
  // The path at hand, in pixels.
  let px0 = Infinity,
    py0 = Infinity,
    px1 = -Infinity,
    py1 = -Infinity;
  const size = (): number => Math.max(Math.hypot(s.a, s.b), Math.hypot(s.c, s.d));
  const point = (x: number, y: number): void => {
    const dx = s.a * x + s.c * y + s.e,
      dy = s.b * x + s.d * y + s.f;
    if (dx < px0) px0 = dx;
    if (dx > px1) px1 = dx;
    if (dy < py0) py0 = dy;
    if (dy > py1) py1 = dy;
  };
  const round = (x: number, y: number, r: number): void => {
    point(x - r, y - r);
    point(x + r, y - r);
    point(x - r, y + r);
    point(x + r, y + r);
  };
  const box = (x: number, y: number, w: number, h: number): void => {
    point(x, y);
    point(x + w, y);
    point(x, y + h);
    point(x + w, y + h);
  };
  const afresh = (): void => {
    px0 = py0 = Infinity;
    px1 = py1 = -Infinity;
  };
  /** The path is painted, so far beyond its points. */
  const paint = (beyond: number): void => {
    if (px1 < px0) return;
    const more = beyond + SPARE_PX + (s.blur ? BLURRED * s.blur : 0);
    x0 = Math.min(x0, px0 - more);
    x1 = Math.max(x1, px1 + more);
    y0 = Math.min(y0, py0 - more);
    y1 = Math.max(y1, py1 + more + Math.max(0, s.below));
  };
  const line = (): number => 0.5 * s.lineWidth * size() * (s.pointed ? MITER : 1.5);
  /** Something beside the path. */
  const aside = (put: () => void, beyond = 0): void => {
    const [ax0, ay0, ax1, ay1] = [px0, py0, px1, py1];
    afresh();
    put();
    paint(beyond);
    [px0, py0, px1, py1] = [ax0, ay0, ax1, ay1];
  };
  const shape = (id: number): void => {
    const at = shapes[id];
    box(at.x0, at.y0, at.x1 - at.x0, at.y1 - at.y0);
  };
  let i = 0;
  while (i < o.length) {
    const op = o[i++] as Op;
    switch (op) {
      case Op.beginPath:
        afresh();
        break;
      case Op.moveTo:
      case Op.lineTo:
        point(o[i], o[i + 1]);
        i += 2;
        break;
      case Op.quadraticCurveTo:
        point(o[i], o[i + 1]);
        point(o[i + 2], o[i + 3]);
        i += 4;
        break;
      case Op.arc:
        round(o[i], o[i + 1], o[i + 2]);
        i += 6;
        break;
      case Op.ellipse:
        round(o[i], o[i + 1], Math.max(o[i + 2], o[i + 3]));
        i += 7;
        break;
      case Op.roundRect:
        box(o[i], o[i + 1], o[i + 2], o[i + 3]);
        i += 5;
        break;
      case Op.closePath:
        break;
      case Op.stroke:
        paint(line());
        break;
      case Op.fill:
        paint(0);
        break;
      case Op.fillRect: {
        const at = i;
        aside(() => box(o[at], o[at + 1], o[at + 2], o[at + 3]));
        i += 4;
        break;
      }
      case Op.fillText: {
        const [w, h] = [texts[o[i]].length * s.font * LETTER, s.font * ABOVE];
        const [x, y] = [o[i + 1], o[i + 2]];
        aside(() => box(x - w, y - h, 2 * w, 2 * h));
        i += 3;
        break;
      }
      case Op.save:
        kept.push({ ...s });
        break;
      case Op.restore:
        s = kept.pop() ?? s;
        break;
      case Op.translate:
        s.e += s.a * o[i] + s.c * o[i + 1];
        s.f += s.b * o[i] + s.d * o[i + 1];
        i += 2;
        break;
      case Op.rotate: {
        const [cos, sin] = [Math.cos(o[i]), Math.sin(o[i])];
        const { a, b, c, d } = s;
        s.a = a * cos + c * sin;
        s.b = b * cos + d * sin;
        s.c = c * cos - a * sin;
        s.d = d * cos - b * sin;
        i++;
        break;
      }
      case Op.setTransform:
        [s.a, s.b, s.c, s.d, s.e, s.f] = [o[i], o[i + 1], o[i + 2], o[i + 3], o[i + 4], o[i + 5]];
        i += 6;
        break;
      case Op.setLineDash:
        i += o[i] + 1;
        break;
      case Op.lineWidth:
        s.lineWidth = o[i++];
        break;
      case Op.lineJoin:
        s.pointed = texts[o[i++]] === 'miter';
        break;
      case Op.font:
        s.font = Number(/([\d.]+)px/.exec(texts[o[i++]])?.[1] ?? 16);
        break;
      case Op.shadowBlur:
        s.blur = o[i++];
        break;
      case Op.shadowOffsetY:
        s.below = o[i++];
        break;
      case Op.lineCap:
      case Op.globalAlpha:
      case Op.textAlign:
      case Op.textBaseline:
      case Op.shadowColor:
      case Op.strokeStyle:
      case Op.fillStyle:
        i++;
        break;
      case Op.strokeShape: {
        const id = o[i++];
        aside(() => shape(id), line());
        break;
      }
      case Op.fillShape: {
        const id = o[i];
        aside(() => shape(id));
        i += 2;
        break;
      }
      case Op.stamp: {
        const at = i + 1;
        aside(() => box(o[at], o[at + 1], o[at + 2], o[at + 3]));
        i += 5;
        break;
      }
      case Op.strokeTiles:
        i += 2;
        break;
      default:
        op satisfies never;
        return { x0: -Infinity, y0: -Infinity, x1: Infinity, y1: Infinity };
    }
  }
  return { x0, y0, x1, y1 };
}
