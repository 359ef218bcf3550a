// A picture as a list of numbers. Painters write it on the page's thread, which is cheap; a canvas in a worker plays it
// (`replay.ts`), which is expensive. Texts, shapes and sprites are sent once and then referred to by number.
import type { Pen, Shape, Sprite } from '../pen';

/** Meaning of the numbers of a recording that are not arguments. */
export const enum Op {
  beginPath,
  moveTo,
  lineTo,
  quadraticCurveTo,
  arc,
  ellipse,
  roundRect,
  closePath,
  stroke,
  fill,
  fillRect,
  fillText,
  save,
  restore,
  translate,
  rotate,
  setTransform,
  setLineDash,
  lineWidth,
  lineCap,
  lineJoin,
  globalAlpha,
  font,
  textAlign,
  textBaseline,
  shadowColor,
  shadowBlur,
  shadowOffsetY,
  strokeStyle,
  fillStyle,
  strokeShape,
  fillShape,
  stamp,
  strokeTiles,
}

export interface ShapeNews {
  readonly id: number;
  readonly points: Float64Array;
  readonly ends: Int32Array;
}

export interface SpriteNews {
  readonly id: number;
  readonly width: number;
  readonly height: number;
  readonly ops: Float64Array;
}

/** Vocabulary that recordings use and the player does not have yet. */
export interface News {
  /** The earlier vocabulary is not used any more. */
  readonly afresh: boolean;
  /** Appended to the earlier texts. */
  readonly texts: string[];
  readonly shapes: ShapeNews[];
  readonly sprites: SpriteNews[];
}

/** Beyond this size the next picture starts a new vocabulary: used entries are sent again. */
const MOST = { texts: 4000, points: 4_000_000, sprites: 600 };

/** Numbers of texts, shapes and sprites, and those not sent yet. */
export class Vocabulary {
  #texts = new Map<string, number>();
  #shapes = new Map<Shape, number>();
  #sprites = new Map<string, number>();
  #points = 0;
  #afresh = true;
  #news: Omit<News, 'afresh'> = { texts: [], shapes: [], sprites: [] };

  text(text: string): number {
    let id = this.#texts.get(text);
    if (id === undefined) {
      this.#texts.set(text, (id = this.#texts.size));
      this.#news.texts.push(text);
    }
    return id;
  }

  shape(shape: Shape): number {
    let id = this.#shapes.get(shape);
    if (id === undefined) {
      this.#shapes.set(shape, (id = this.#shapes.size));
      this.#points += shape.points.length;
      this.#news.shapes.push({ id, points: Float64Array.from(shape.points), ends: Int32Array.from(shape.ends) });
    }
    return id;
  }

  sprite(sprite: Sprite): number {
    let id = this.#sprites.get(sprite.key);
    if (id === undefined) {
      this.#sprites.set(sprite.key, (id = this.#sprites.size));
      const own = new Recording(this);
      sprite.paint(own);
      this.#news.sprites.push({ id, width: sprite.width, height: sprite.height, ops: own.take() });
    }
    return id;
  }

  /** Additions since the last call. To be called only between pictures. */
  news(): News {
    const news = { afresh: this.#afresh, ...this.#news };
    this.#news = { texts: [], shapes: [], sprites: [] };
    this.#afresh = this.#texts.size > MOST.texts || this.#points > MOST.points || this.#sprites.size > MOST.sprites;
    if (this.#afresh) {
      this.#texts = new Map();
      this.#shapes = new Map();
      this.#sprites = new Map();
      this.#points = 0;
    }
    return news;
  }
}

export class Recording implements Pen {
  #ops = new Float64Array(4096);
  #n = 0;

  constructor(private readonly words: Vocabulary) {}

  /** The recording, in its own memory; starts the next picture. */
  take(): Float64Array {
    const ops = this.#ops.slice(0, this.#n);
    this.#n = 0;
    return ops;
  }

  #room(more: number): void {
    if (this.#n + more <= this.#ops.length) return;
    const larger = new Float64Array(Math.max(this.#ops.length * 2, this.#n + more));
    larger.set(this.#ops);
    this.#ops = larger;
  }
  #put(op: Op): void {
    this.#room(1);
    this.#ops[this.#n++] = op;
  }
  #put1(op: Op, a: number): void {
    this.#room(2);
    this.#ops[this.#n++] = op;
    this.#ops[this.#n++] = a;
  }
  #put2(op: Op, a: number, b: number): void {
    this.#room(3);
    this.#ops[this.#n++] = op;
    this.#ops[this.#n++] = a;
    this.#ops[this.#n++] = b;
  }
  #putAll(op: Op, ...all: readonly number[]): void {
    this.#room(all.length + 1);
    this.#ops[this.#n++] = op;
    for (const a of all) this.#ops[this.#n++] = a;
  }

  beginPath(): void {
    this.#put(Op.beginPath);
  }
  moveTo(x: number, y: number): void {
    this.#put2(Op.moveTo, x, y);
  }
  lineTo(x: number, y: number): void {
    this.#put2(Op.lineTo, x, y);
  }
  quadraticCurveTo(cx: number, cy: number, x: number, y: number): void {
    this.#putAll(Op.quadraticCurveTo, cx, cy, x, y);
  }
  arc(x: number, y: number, r: number, from: number, to: number, counter = false): void {
    this.#putAll(Op.arc, x, y, r, from, to, Number(counter));
  }
  ellipse(x: number, y: number, rx: number, ry: number, rotation: number, from: number, to: number): void {
    this.#putAll(Op.ellipse, x, y, rx, ry, rotation, from, to);
  }
  roundRect(x: number, y: number, w: number, h: number, radius: number): void {
    this.#putAll(Op.roundRect, x, y, w, h, radius);
  }
  closePath(): void {
    this.#put(Op.closePath);
  }
  stroke(): void {
    this.#put(Op.stroke);
  }
  fill(): void {
    this.#put(Op.fill);
  }
  fillRect(x: number, y: number, w: number, h: number): void {
    this.#putAll(Op.fillRect, x, y, w, h);
  }
  fillText(text: string, x: number, y: number): void {
    this.#putAll(Op.fillText, this.words.text(text), x, y);
  }
  save(): void {
    this.#put(Op.save);
  }
  restore(): void {
    this.#put(Op.restore);
  }
  translate(x: number, y: number): void {
    this.#put2(Op.translate, x, y);
  }
  rotate(angle: number): void {
    this.#put1(Op.rotate, angle);
  }
  setTransform(a: number, b: number, c: number, d: number, e: number, f: number): void {
    this.#putAll(Op.setTransform, a, b, c, d, e, f);
  }
  setLineDash(dash: readonly number[]): void {
    this.#putAll(Op.setLineDash, dash.length, ...dash);
  }
  set lineWidth(w: number) {
    this.#put1(Op.lineWidth, w);
  }
  set lineCap(cap: CanvasLineCap) {
    this.#put1(Op.lineCap, this.words.text(cap));
  }
  set lineJoin(join: CanvasLineJoin) {
    this.#put1(Op.lineJoin, this.words.text(join));
  }
  set globalAlpha(alpha: number) {
    this.#put1(Op.globalAlpha, alpha);
  }
  set font(font: string) {
    this.#put1(Op.font, this.words.text(font));
  }
  set textAlign(align: CanvasTextAlign) {
    this.#put1(Op.textAlign, this.words.text(align));
  }
  set textBaseline(base: CanvasTextBaseline) {
    this.#put1(Op.textBaseline, this.words.text(base));
  }
  set shadowColor(colour: string) {
    this.#put1(Op.shadowColor, this.words.text(colour));
  }
  set shadowBlur(px: number) {
    this.#put1(Op.shadowBlur, px);
  }
  set shadowOffsetY(px: number) {
    this.#put1(Op.shadowOffsetY, px);
  }
  set strokeStyle(colour: string) {
    this.#put1(Op.strokeStyle, this.words.text(colour));
  }
  set fillStyle(colour: string) {
    this.#put1(Op.fillStyle, this.words.text(colour));
  }
  strokeShape(shape: Shape): void {
    this.#put1(Op.strokeShape, this.words.shape(shape));
  }
  fillShape(shape: Shape, rule: CanvasFillRule): void {
    this.#put2(Op.fillShape, this.words.shape(shape), Number(rule === 'evenodd'));
  }
  stamp(sprite: Sprite, x: number, y: number, w: number, h: number): void {
    this.#putAll(Op.stamp, this.words.sprite(sprite), x, y, w, h);
  }
  strokeTiles(sprite: Sprite, scale: number): void {
    this.#put2(Op.strokeTiles, this.words.sprite(sprite), scale);
  }
}
