// What painters draw with: the part of a 2D canvas that they need, and three things that a canvas elsewhere can keep.
import type { Vec } from '../model/base/geometry';

/** A path that stays the same over many pictures, in the coordinates of the scene. */
export class Shape {
  /** x and y of all points, line after line. */
  readonly points: number[] = [];
  /** Where each line ends in `points`; negative for one that is closed. */
  readonly ends: number[] = [];

  add(line: readonly Vec[], closed: boolean): void {
    for (const [x, y] of line) this.points.push(x, y);
    this.ends.push(closed ? -this.points.length : this.points.length);
  }
}

/** A small picture that is painted once and stamped often. */
export interface Sprite {
  /** The same key is the same picture. */
  readonly key: string;
  /** In pixels of the device. */
  readonly width: number;
  readonly height: number;
  readonly paint: (pen: Pen) => void;
}

type Canvas2D = CanvasRenderingContext2D;

export interface Pen extends Pick<
  Canvas2D,
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
  /** Strokes are tiles of a sprite from here on, each `scale` times as large as its pixels. */
  strokeTiles(sprite: Sprite, scale: number): void;
}
