// The visible canvas and its layers: map, road users, overlay. Works in a worker and on the page.
import type { PixelBox } from './extent';
import type { News } from './recording';
import { Player, opaquePen, surface, type Canvas2D, type CanvasSurface } from './replay';

export const LAYERS = ['map', 'agents', 'overlay'] as const;
export type CanvasLayer = (typeof LAYERS)[number];
export const CANVASES = ['picture', 'loupe'] as const;
export type Canvases = Record<(typeof CANVASES)[number], HTMLCanvasElement | OffscreenCanvas>;

export interface Size {
  /** Of the picture, in CSS pixels. */
  readonly w: number;
  readonly h: number;
  readonly dpr: number;
}

/** Margin of painted map around the picture, in CSS pixels, so that it can move before a repaint. */
export const MARGIN = 192;

/** Offset of the last painted map from the middle, in CSS pixels, with its scale and its turn, clockwise. */
export interface Shift {
  readonly dx: number;
  readonly dy: number;
  readonly scale: number;
  readonly angle: number;
}

/** Magnification of the loupe. */
const LARGER = 1.8;

/** Centre and width of the loupe's view, in CSS pixels. */
export interface Loupe {
  readonly x: number;
  readonly y: number;
  readonly px: number;
}

/** An update of the screen: recordings of the changed layers. */
export interface PictureUpdate {
  readonly size: Size;
  readonly news: News;
  readonly layers: Partial<Record<CanvasLayer, Float64Array>>;
  readonly shift: Shift;
  readonly loupe: Loupe | null;
}

/** Recording of a layer, with the player that has its vocabulary. */
interface LayerRecording {
  readonly player: Player;
  readonly ops: Float64Array;
}

/**
 * One opaque canvas instead of one for each layer: the browser copies it to the screen, whereas it would blend several
 * in every frame.
 */
export class Easel {
  #player = new Player();
  readonly #picture: Canvas2D;
  readonly #loupe: Canvas2D;
  #size: Size | null = null;
  /** The painted map with its margin. */
  #map = surface(1, 1);
  #shift: Shift | null = null;
  #agents: LayerRecording = { player: this.#player, ops: new Float64Array() };
  #overlay = this.#agents;
  /** Everything below the overlay, for frames in which only the overlay changes; null until the first such frame. */
  #below: CanvasSurface | null = null;
  #belowIsOld = true;
  /** The area covered by the overlay: elsewhere the picture is the same without it. */
  #covered: PixelBox | null = null;
  /** The next picture to paint. */
  #next: Pick<PictureUpdate, 'size' | 'shift' | 'loupe'> | null = null;
  #layers: Partial<Record<CanvasLayer, LayerRecording>> = {};

  constructor(private readonly canvases: Canvases) {
    this.#picture = opaquePen(canvases.picture);
    this.#loupe = opaquePen(canvases.loupe);
  }

  /** Takes a picture to paint; layers that it does not renew stay. */
  take({ news, layers, ...picture }: PictureUpdate): void {
    // Older layers are still played by the player that has their vocabulary.
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

  /** The smaller the painted area, the less the browser copies to the screen. */
  #uncover({ left, top, right, bottom }: PixelBox): void {
    const w = right - left,
      h = bottom - top;
    if (w > 0 && h > 0) this.#picture.drawImage(this.#freshBelow(), left, top, w, h, left, top, w, h);
  }

  #freshBelow(): CanvasSurface {
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

  #play(g: Canvas2D, { player, ops }: LayerRecording): void {
    const { dpr } = this.#size!;
    g.save();
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    player.play(g, ops);
    g.restore();
  }

  /** Magnifies the surroundings of a place. */
  #magnify({ x, y, px }: Loupe, dpr: number): void {
    const { loupe, picture } = this.canvases;
    const side = Math.round(px * dpr);
    if (loupe.width !== side) loupe.width = loupe.height = side;
    const part = side / LARGER;
    this.#loupe.clearRect(0, 0, side, side);
    this.#loupe.drawImage(picture, x * dpr - part / 2, y * dpr - part / 2, part, part, 0, 0, side, side);
  }

  /** True when the size has changed; the canvases are empty then. */
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
    // On whole pixels: a fractional shift would blur every line.
    const x = Math.round((width - w) / 2 + shift.dx * dpr),
      y = Math.round((height - h) / 2 + shift.dy * dpr);
    g.drawImage(this.#map, x, y, w, h);
  }
}

export const sameShift = (a: Shift, b: Shift | null): boolean =>
  b !== null && a.dx === b.dx && a.dy === b.dy && a.scale === b.scale && a.angle === b.angle;
