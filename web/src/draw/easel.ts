// The three canvases and what is on them: map, road users, overlay. Works in a worker and on the page alike.
import type { News } from './recording';
import { Player, pen2d, surface, type Canvas2D } from './replay';

export const LAYERS = ['map', 'agents', 'overlay'] as const;
export type LayerName = (typeof LAYERS)[number];
export type Canvases = Record<LayerName | 'loupe', HTMLCanvasElement | OffscreenCanvas>;

export interface Size {
  /** Of the picture, in CSS pixels. */
  readonly w: number;
  readonly h: number;
  readonly dpr: number;
}

/** CSS pixels of map painted beyond each side of the picture, so that it can be moved before it is painted again. */
export const MARGIN = 192;

/** Where the map that was painted last lies now, in CSS pixels from the middle, and how it is turned, clockwise. */
export interface Shift {
  readonly dx: number;
  readonly dy: number;
  readonly scale: number;
  readonly angle: number;
}

/** So many times larger is what the loupe shows. */
const LARGER = 1.8;

/** The middle of what the loupe shows and how wide it is, in CSS pixels. */
export interface Loupe {
  readonly x: number;
  readonly y: number;
  readonly px: number;
}

/** What is new on the screen: recordings of the layers that changed. */
export interface Picture {
  readonly size: Size;
  readonly news: News;
  readonly layers: Partial<Record<LayerName, Float64Array>>;
  readonly shift: Shift;
  readonly loupe: Loupe | null;
}

export class Easel {
  readonly #player = new Player();
  readonly #pens: Record<LayerName | 'loupe', Canvas2D>;
  #size: Size | null = null;
  /** The map with its margin, as it was painted. */
  #map = surface(1, 1);
  #shift: Shift | null = null;
  /** What is to be painted next. */
  #next: Omit<Picture, 'news'> | null = null;

  constructor(private readonly canvases: Canvases) {
    const pen = (name: LayerName | 'loupe') =>
      canvases[name].getContext('2d', { alpha: name !== 'map' && name !== 'loupe' }) as Canvas2D;
    this.#pens = { map: pen('map'), agents: pen('agents'), overlay: pen('overlay'), loupe: pen('loupe') };
  }

  /** A picture to be painted; what was to be painted and is not anew in this one stays so. */
  take({ news, ...picture }: Picture): void {
    // Recordings of before speak of what is forgotten now.
    if (news.afresh) this.paint();
    this.#player.learn(news);
    this.#next = { ...picture, layers: { ...this.#next?.layers, ...picture.layers } };
  }

  paint(): void {
    if (!this.#next) return;
    const { size, layers, shift, loupe } = this.#next;
    this.#next = null;
    this.#fit(size);
    if (layers.map) this.#player.play(pen2d(this.#map), layers.map);
    if (layers.map || !sameShift(shift, this.#shift)) this.#placeMap(shift);
    for (const name of ['agents', 'overlay'] as const) {
      const ops = layers[name];
      if (!ops) continue;
      const g = this.#pens[name];
      const { width, height } = this.canvases[name];
      g.setTransform(1, 0, 0, 1, 0, 0);
      g.clearRect(0, 0, width, height);
      g.setTransform(size.dpr, 0, 0, size.dpr, 0, 0);
      this.#player.play(g, ops);
    }
    if (loupe) this.#magnify(loupe, size.dpr);
  }

  /** The three layers around a place, larger. */
  #magnify({ x, y, px }: Loupe, dpr: number): void {
    const g = this.#pens.loupe;
    const { loupe } = this.canvases;
    const side = Math.round(px * dpr);
    if (loupe.width !== side) loupe.width = loupe.height = side;
    const part = side / LARGER;
    g.clearRect(0, 0, side, side);
    for (const name of LAYERS)
      g.drawImage(this.canvases[name], x * dpr - part / 2, y * dpr - part / 2, part, part, 0, 0, side, side);
  }

  #fit(size: Size): void {
    const was = this.#size;
    if (was && was.w === size.w && was.h === size.h && was.dpr === size.dpr) return;
    this.#size = size;
    for (const name of LAYERS) {
      this.canvases[name].width = Math.round(size.w * size.dpr);
      this.canvases[name].height = Math.round(size.h * size.dpr);
    }
    this.#map = surface(Math.round((size.w + 2 * MARGIN) * size.dpr), Math.round((size.h + 2 * MARGIN) * size.dpr));
  }

  #placeMap(shift: Shift): void {
    this.#shift = shift;
    const { width, height } = this.canvases.map;
    const { dpr } = this.#size!;
    const w = this.#map.width * shift.scale,
      h = this.#map.height * shift.scale;
    const g = this.#pens.map;
    if (shift.angle) {
      g.setTransform(1, 0, 0, 1, width / 2 + shift.dx * dpr, height / 2 + shift.dy * dpr);
      g.rotate(shift.angle);
      g.drawImage(this.#map, -w / 2, -h / 2, w, h);
      g.setTransform(1, 0, 0, 1, 0, 0);
      return;
    }
    // On whole pixels: a shift by a part of one would blur every line.
    const x = Math.round((width - w) / 2 + shift.dx * dpr),
      y = Math.round((height - h) / 2 + shift.dy * dpr);
    g.drawImage(this.#map, x, y, w, h);
  }
}

export const sameShift = (a: Shift, b: Shift | null): boolean =>
  b !== null && a.dx === b.dx && a.dy === b.dy && a.scale === b.scale && a.angle === b.angle;
