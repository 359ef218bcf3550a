// The drawing interface of painters: the used part of a 2D canvas, and three operations that a remote canvas can cache.
import type { Vec } from '../model/base/geometry';

/** A path reused over many frames, in scene coordinates. */
export class Shape {
  /** x and y of all points, line after line. */
  readonly points: number[] = [];
  /** End of each line in `points`; negative for a closed one. */
  readonly ends: number[] = [];

  add(line: readonly Vec[], closed: boolean): void {
    for (const [x, y] of line) this.points.push(x, y);
    this.ends.push(closed ? -this.points.length : this.points.length);
  }
}

/** A small picture that is painted once and stamped often. */
export interface Sprite {
  /** Equal keys mean equal pictures. */
  readonly key: string;
  /** In device pixels. */
  readonly width: number;
  readonly height: number;
  readonly paint: (pen: Pen) => void;
}

type ScreenContext = CanvasRenderingContext2D;

export interface Pen extends Pick<
  ScreenContext,
  | 'beginPath'
  | 'moveTo'
  | 'lineTo'
  | 'quadraticCurveTo'
  | 'arc'
  | 'closePath'
  | 'fillRect'
  | 'fillText'
  | 'save'
  | 'restore'
  | 'translate'
  | 'rotate'
  | 'lineWidth'
  | 'lineCap'
  | 'lineJoin'
  | 'globalAlpha'
  | 'font'
  | 'textAlign'
  | 'textBaseline'
  | 'shadowColor'
  | 'shadowBlur'
  | 'shadowOffsetY'
> {
  strokeStyle: string;
  fillStyle: string;
  stroke(): void;
  fill(): void;
  ellipse(x: number, y: number, rx: number, ry: number, rotation: number, from: number, to: number): void;
  roundRect(x: number, y: number, w: number, h: number, radius: number): void;
  setLineDash(dash: readonly number[]): void;
  setTransform(a: number, b: number, c: number, d: number, e: number, f: number): void;
  strokeShape(shape: Shape): void;
  fillShape(shape: Shape, rule: CanvasFillRule): void;
  stamp(sprite: Sprite, x: number, y: number, w: number, h: number): void;
  /** Makes strokes use tiles of a sprite, each `scale` times as large as its pixels. */
  strokeTiles(sprite: Sprite, scale: number): void;
}

/** The part of a canvas that recordings need. */
export interface Played extends Omit<
  Pen,
  'stroke' | 'fill' | 'strokeStyle' | 'fillStyle' | 'strokeShape' | 'fillShape' | 'stamp' | 'strokeTiles'
> {
  strokeStyle: string | CanvasGradient | CanvasPattern;
  fillStyle: string | CanvasGradient | CanvasPattern;
  stroke(path?: Path2D): void;
  fill(path?: Path2D, rule?: CanvasFillRule): void;
  drawImage(image: CanvasImageSource, x: number, y: number, w: number, h: number): void;
  createPattern(image: CanvasImageSource, repetition: string): CanvasPattern | null;
}
