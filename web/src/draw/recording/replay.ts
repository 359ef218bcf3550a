// Plays recordings on a 2D canvas, in a worker or on the page.
import { Bounds, Extent, type PixelBox } from './extent';
import type { Pen, Played } from '../pen';
import { Op, Recording, Vocabulary, type News } from './recording';

export type Canvas2D = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;
export type CanvasSurface = HTMLCanvasElement | OffscreenCanvas;

/** An invisible canvas. */
export function surface(width: number, height: number): CanvasSurface {
  if (typeof OffscreenCanvas !== 'undefined') return new OffscreenCanvas(width, height);
  return Object.assign(document.createElement('canvas'), { width, height });
}

export const pen2d = (s: CanvasSurface): Canvas2D => s.getContext('2d') as Canvas2D;
/** The context of a fully covered canvas, so that it is copied without blending. */
export const opaquePen = (s: CanvasSurface): Canvas2D => s.getContext('2d', { alpha: false }) as Canvas2D;

export class Player {
  #texts: string[] = [];
  #shapes: Path2D[] = [];
  readonly #bounds = new WeakMap<Path2D, PixelBox>();
  #sprites: CanvasSurface[] = [];

  learn(news: News): void {
    if (news.afresh) {
      this.#texts = [];
      this.#shapes = [];
      this.#sprites = [];
    }
    this.#texts.push(...news.texts);
    for (const { id, points, ends } of news.shapes) {
      const path = pathOf(points, ends);
      this.#shapes[id] = path;
      this.#bounds.set(path, boundsOf(points));
    }
    for (const { id, width, height, ops } of news.sprites) {
      const s = surface(width, height);
      this.play(pen2d(s), ops);
      this.#sprites[id] = s;
    }
  }

  /** The part of a canvas that a recording paints on, with a scale in pixels for each unit. */
  extent(o: Float64Array, { width, height }: CanvasSurface, scale: number): PixelBox {
    const extent = new Extent(scale, (path) => this.#bounds.get(path) ?? new Bounds());
    this.play(extent, o);
    return extent.part(width, height);
  }

  play(g: Played, o: Float64Array): void {
    const texts = this.#texts;
    let i = 0;
    while (i < o.length) {
      const op = o[i++] as Op;
      switch (op) {
        case Op.beginPath:
          g.beginPath();
          break;
        case Op.moveTo:
          g.moveTo(o[i], o[i + 1]);
          i += 2;
          break;
        case Op.lineTo:
          g.lineTo(o[i], o[i + 1]);
          i += 2;
          break;
        case Op.quadraticCurveTo:
          g.quadraticCurveTo(o[i], o[i + 1], o[i + 2], o[i + 3]);
          i += 4;
          break;
        case Op.arc:
          g.arc(o[i], o[i + 1], o[i + 2], o[i + 3], o[i + 4], o[i + 5] === 1);
          i += 6;
          break;
        case Op.ellipse:
          g.ellipse(o[i], o[i + 1], o[i + 2], o[i + 3], o[i + 4], o[i + 5], o[i + 6]);
          i += 7;
          break;
        case Op.roundRect:
          g.roundRect(o[i], o[i + 1], o[i + 2], o[i + 3], o[i + 4]);
          i += 5;
          break;
        case Op.closePath:
          g.closePath();
          break;
        case Op.stroke:
          g.stroke();
          break;
        case Op.fill:
          g.fill();
          break;
        case Op.fillRect:
          g.fillRect(o[i], o[i + 1], o[i + 2], o[i + 3]);
          i += 4;
          break;
        case Op.fillText:
          g.fillText(texts[o[i]], o[i + 1], o[i + 2]);
          i += 3;
          break;
        case Op.save:
          g.save();
          break;
        case Op.restore:
          g.restore();
          break;
        case Op.translate:
          g.translate(o[i], o[i + 1]);
          i += 2;
          break;
        case Op.rotate:
          g.rotate(o[i++]);
          break;
        case Op.setTransform:
          g.setTransform(o[i], o[i + 1], o[i + 2], o[i + 3], o[i + 4], o[i + 5]);
          i += 6;
          break;
        case Op.setLineDash: {
          const n = o[i++];
          g.setLineDash(Array.from(o.subarray(i, i + n)));
          i += n;
          break;
        }
        case Op.lineWidth:
          g.lineWidth = o[i++];
          break;
        case Op.lineCap:
          g.lineCap = texts[o[i++]] as CanvasLineCap;
          break;
        case Op.lineJoin:
          g.lineJoin = texts[o[i++]] as CanvasLineJoin;
          break;
        case Op.globalAlpha:
          g.globalAlpha = o[i++];
          break;
        case Op.font:
          g.font = texts[o[i++]];
          break;
        case Op.textAlign:
          g.textAlign = texts[o[i++]] as CanvasTextAlign;
          break;
        case Op.textBaseline:
          g.textBaseline = texts[o[i++]] as CanvasTextBaseline;
          break;
        case Op.shadowColor:
          g.shadowColor = texts[o[i++]];
          break;
        case Op.shadowBlur:
          g.shadowBlur = o[i++];
          break;
        case Op.shadowOffsetY:
          g.shadowOffsetY = o[i++];
          break;
        case Op.strokeStyle:
          g.strokeStyle = texts[o[i++]];
          break;
        case Op.fillStyle:
          g.fillStyle = texts[o[i++]];
          break;
        case Op.strokeShape:
          g.stroke(this.#shapes[o[i++]]);
          break;
        case Op.fillShape:
          g.fill(this.#shapes[o[i]], o[i + 1] ? 'evenodd' : 'nonzero');
          i += 2;
          break;
        case Op.stamp:
          g.drawImage(this.#sprites[o[i]], o[i + 1], o[i + 2], o[i + 3], o[i + 4]);
          i += 5;
          break;
        case Op.strokeTiles: {
          const tiles = g.createPattern(this.#sprites[o[i]], 'repeat');
          tiles?.setTransform(new DOMMatrix([o[i + 1], 0, 0, o[i + 1], 0, 0]));
          if (tiles) g.strokeStyle = tiles;
          i += 2;
          break;
        }
        default:
          op satisfies never;
          return;
      }
    }
  }
}

/** Paints on a canvas of the page itself: for small pictures, or ones that are not for the screen. */
export function paintOn(g: Canvas2D, paint: (pen: Pen) => void): void {
  const words = new Vocabulary();
  const recording = new Recording(words);
  paint(recording);
  const player = new Player();
  player.learn(words.news());
  player.play(g, recording.take());
}

function boundsOf(points: Float64Array): PixelBox {
  const bounds = new Bounds();
  for (let i = 0; i < points.length; i += 2) bounds.add(points[i], points[i + 1]);
  return bounds;
}

function pathOf(points: Float64Array, ends: Int32Array): Path2D {
  const path = new Path2D();
  let at = 0;
  for (const end of ends) {
    for (let first = true; at < Math.abs(end); at += 2, first = false) {
      if (first) path.moveTo(points[at], points[at + 1]);
      else path.lineTo(points[at], points[at + 1]);
    }
    if (end < 0) path.closePath();
  }
  return path;
}
