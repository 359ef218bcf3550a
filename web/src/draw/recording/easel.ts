// The canvas that is looked at, and what is on it: map, road users, overlay. Works in a worker and on the page alike.
import type { Part } from './extent';
import type { News } from './recording';
import { Player, opaquePen, surface, type Canvas2D, type Surface } from './replay';

export const LAYERS = ['map', 'agents', 'overlay'] as const;
export type LayerName = (typeof LAYERS)[number];
export const CANVASES = ['picture', 'loupe'] as const;
export type Canvases = Record<(typeof CANVASES)[number], HTMLCanvasElement | OffscreenCanvas>;

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

/** What a layer shows, with what it speaks of. */
interface Layer {
  readonly player: Player;
  readonly ops: Float64Array;
}

/**
 * One opaque canvas rather than one for each layer: the browser then copies it to the screen, where it would have to
 * blend each of them over the others in every frame.
 */
export class Easel {
  #player = new Player();
  readonly #picture: Canvas2D;
  readonly #loupe: Canvas2D;
  #size: Size | null = null;
  /** The map with its margin, as it was painted. */
  #map = surface(1, 1);
  #shift: Shift | null = null;
  #agents: Layer = { player: this.#player, ops: new Float64Array() };
  #overlay = this.#agents;
  /** What lies below the overlay, for the frames in which only that changes; null until one of them comes. */
  #below: Surface | null = null;
  #belowIsOld = true;
  /** What the overlay covers: only there anything else is seen without it. */
  #covered: Part | null = null;
  /** What is to be painted next. */
  #next: Pick<Picture, 'size' | 'shift' | 'loupe'> | null = null;
  #layers: Partial<Record<LayerName, Layer>> = {};

  constructor(private readonly canvases: Canvases) {
    this.#picture = opaquePen(canvases.picture);
    this.#loupe = opaquePen(canvases.loupe);
  }

  /** A picture to be painted; what was to be painted and is not anew in this one stays so. */
  take({ news, layers, ...picture }: Picture): void {
    // Layers of before are still played, by who knows what they speak of.
    if (news.afresh) this.#player = new Player();
    this.#player.learn(news);
    this.#next = picture;
    for (const name of LAYERS) {
      const ops = layers[name];
      if (ops) this.#layers[name] = { player: this.#player, ops };
    }
  }

  paint(): void {
    if (!this.#next) return;
    const { size, shift, loupe } = this.#next;
    const { map, agents, overlay } = this.#layers;
    this.#next = null;
    this.#layers = {};
    const fitted = this.#fit(size);
    if (map) map.player.play(opaquePen(this.#map), map.ops);
    this.#agents = agents ?? this.#agents;
    this.#overlay = overlay ?? this.#overlay;
    if (fitted || map || agents || !sameShift(shift, this.#shift)) {
      this.#shift = shift;
      this.#belowIsOld = true;
      this.#paintBelow(this.#picture);
    } else if (this.#covered) this.#uncover(this.#covered);
    this.#play(this.#picture, this.#overlay);
    if (fitted || overlay) {
      this.#covered = this.#overlay.player.extent(this.#overlay.ops, this.canvases.picture, size.dpr);
    }
    if (loupe) this.#magnify(loupe, size.dpr);
  }

  /** The less is painted, the less the browser copies to the screen. */
  #uncover({ left, top, right, bottom }: Part): void {
    const w = right - left,
      h = bottom - top;
    if (w > 0 && h > 0) this.#picture.drawImage(this.#freshBelow(), left, top, w, h, left, top, w, h);
  }

  #freshBelow(): Surface {
    const { width, height } = this.canvases.picture;
    this.#below ??= surface(width, height);
    if (this.#belowIsOld) this.#paintBelow(opaquePen(this.#below));
    this.#belowIsOld = false;
    return this.#below;
  }

  #paintBelow(g: Canvas2D): void {
    this.#placeMap(g);
    this.#play(g, this.#agents);
  }

  #play(g: Canvas2D, { player, ops }: Layer): void {
    const { dpr } = this.#size!;
    g.save();
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    player.play(g, ops);
    g.restore();
  }

  /** What is around a place, larger. */
  #magnify({ x, y, px }: Loupe, dpr: number): void {
    const { loupe, picture } = this.canvases;
    const side = Math.round(px * dpr);
    if (loupe.width !== side) loupe.width = loupe.height = side;
    const part = side / LARGER;
    this.#loupe.clearRect(0, 0, side, side);
    this.#loupe.drawImage(picture, x * dpr - part / 2, y * dpr - part / 2, part, part, 0, 0, side, side);
  }

  /** True where the size is another one; canvases are empty then. */
  #fit(size: Size): boolean {
    const was = this.#size;
    if (was && was.w === size.w && was.h === size.h && was.dpr === size.dpr) return false;
    this.#size = size;
    const { picture } = this.canvases;
    picture.width = Math.round(size.w * size.dpr);
    picture.height = Math.round(size.h * size.dpr);
    this.#below = null;
    this.#map = surface(Math.round((size.w + 2 * MARGIN) * size.dpr), Math.round((size.h + 2 * MARGIN) * size.dpr));
    return true;
  }

  #placeMap(g: Canvas2D): void {
    const shift = this.#shift!;
    const { width, height } = this.canvases.picture;
    const { dpr } = this.#size!;
    const w = this.#map.width * shift.scale,
      h = this.#map.height * shift.scale;
    if (shift.angle) {
      g.save();
      g.translate(width / 2 + shift.dx * dpr, height / 2 + shift.dy * dpr);
      g.rotate(shift.angle);
      g.drawImage(this.#map, -w / 2, -h / 2, w, h);
      g.restore();
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
