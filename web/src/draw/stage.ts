// Schedules painting: map, road users and overlay are each repainted only after a change, within one animation frame.
// While the view moves, the painted map is shifted, scaled and turned; it is repainted when the movement ends or its
// margin is used up.
import { LAYERS, MARGIN, sameShift, type CanvasLayer, type Loupe, type Shift } from './recording/easel';
import { Glide } from './glide';
import type { Pen } from './pen';
import { opaquePen, paintOn } from './recording/replay';
import { Screen } from './recording/screen';
import { Emitter } from '../model/base/emitter';
import type { Point, Vec } from '../model/base/geometry';
import { View } from './view';
import { readPalette } from './theme';

export type Painter = (pen: Pen, v: View) => void;

const REST_MS = 90;
const IN_PLACE: Shift = { dx: 0, dy: 0, scale: 1, angle: 0 };

export class Stage {
  readonly view = new View();
  readonly glide = new Glide(this.view, () => this.viewChanged());
  private readonly screen: Screen;
  private readonly painters: Partial<Record<CanvasLayer, Painter>> = {};
  private readonly dirty = { map: true, agents: true, overlay: true };
  /** The view of the painted map. */
  private painted: View | null = null;
  private shifted: Shift = IN_PLACE;
  private loupe: Loupe | null = null;
  /** Width of the loupe, in CSS pixels. */
  loupePx = 156;
  private frame = 0;
  private rest = 0;
  /** A frame was skipped because the screen was busy; it follows after the next shown picture. */
  private owed = false;
  private hurried = false;
  /** A panel, or a smaller window, has taken room from the picture; with the former view. */
  readonly shrunk = new Emitter<[before: View]>();
  /** The picture has got room. */
  readonly grown = new Emitter();
  /** A sheet has covered a part of the picture; with the former view. */
  readonly covered = new Emitter<[before: View]>();
  /** Once per frame before painting, for animation; with the time of the frame in milliseconds. */
  readonly framed = new Emitter<[now: number]>();
  /** The view has changed. */
  readonly moved = new Emitter();
  readonly #size: ResizeObserver;

  constructor(readonly element: HTMLElement) {
    this.screen = new Screen(
      element,
      () => this.owed && this.request(),
      () => this.invalidate(...LAYERS),
    );
    readPalette();
    this.#size = new ResizeObserver(() => this.resize());
    this.#size.observe(element);
    this.resize();
  }

  /** Stops painting. */
  close(): void {
    this.#size.disconnect();
    cancelAnimationFrame(this.frame);
    clearTimeout(this.rest);
    this.screen.close();
  }

  painter(layer: CanvasLayer, p: Painter): void {
    this.painters[layer] = p;
  }

  /** Paints layers of the screen on another canvas, with `scale` pixels for each CSS pixel. */
  paintOn(canvas: HTMLCanvasElement, layers: readonly CanvasLayer[], scale = this.view.dpr): void {
    const v = this.view.copy();
    v.dpr = scale;
    const [w, h] = [Math.round(v.w * scale), Math.round(v.h * scale)];
    if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
    const g = opaquePen(canvas);
    for (const name of layers) {
      g.setTransform(scale, 0, 0, scale, 0, 0);
      paintOn(g, (pen) => this.painters[name]?.(pen, v));
    }
  }

  /** The same for any pen. */
  paintWith(pen: Pen, layers: readonly CanvasLayer[]): void {
    const v = this.view.copy();
    v.dpr = 1;
    for (const name of layers) {
      pen.setTransform(1, 0, 0, 1, 0, 0);
      this.painters[name]?.(pen, v);
    }
  }

  resize(): void {
    const { view: v } = this;
    const w = this.element.clientWidth,
      h = this.element.clientHeight;
    const dpr = Math.min(2, window.devicePixelRatio || 1);
    if (!w || !h || (w === v.w && h === v.h && dpr === v.dpr && this.painted)) return;
    const was = this.painted && v.copy();
    v.w = w;
    v.h = h;
    v.dpr = dpr;
    // A panel below takes or gives room: what is seen above it stays where it is.
    if (was && w === was.w) v.put([0, 0], was.from(0, 0));
    this.invalidate(...LAYERS);
    this.moved.emit();
    if (was && (w < was.w || h < was.h)) this.shrunk.emit(was);
    else if (was) this.grown.emit();
  }

  invalidate(...layers: CanvasLayer[]): void {
    for (const l of layers) this.dirty[l] = true;
    this.request();
  }

  /** The same without a wait for the next frame: for changes that do not come from input. */
  soon(...layers: CanvasLayer[]): void {
    for (const l of layers) this.dirty[l] = true;
    if (this.hurried) return;
    this.hurried = true;
    queueMicrotask(() => {
      this.hurried = false;
      this.paint();
    });
  }

  /** The view moved: shifts the painted map, and repaints it when the movement ends. */
  viewChanged(): void {
    this.dirty.agents = this.dirty.overlay = true;
    clearTimeout(this.rest);
    this.rest = window.setTimeout(() => this.invalidate('map'), REST_MS);
    this.request();
    this.moved.emit();
  }

  /** Sets the cursor over the picture; empty for the default one. */
  setCursor(name: string): void {
    const { dataset } = this.element;
    if ((dataset.cursor ?? '') === name) return;
    if (name) dataset.cursor = name;
    else delete dataset.cursor;
  }

  /** A loupe centred on a place, in the upper corner away from it; null removes it. */
  magnify(place: Point | null): void {
    if (!place && !this.loupe) return;
    this.loupe = place && { ...place, px: this.loupePx };
    const { dataset } = this.element;
    const { left, right } = this.view.inset;
    if (!place) delete dataset.loupe;
    else dataset.loupe = place.x < (this.view.w + left - right) / 2 ? 'right' : 'left';
    this.invalidate('overlay');
  }

  themeChanged(): void {
    readPalette();
    this.invalidate(...LAYERS);
  }

  private request(): void {
    if (!this.frame) this.frame = requestAnimationFrame((now) => this.tick(now));
  }

  private tick(now: number): void {
    this.frame = 0;
    this.glide.frame();
    this.framed.emit(now);
    this.paint();
  }

  /** Paints what has changed. */
  private paint(): void {
    // Otherwise pictures would queue up, each later than the one before.
    this.owed = this.screen.busy;
    if (this.owed) return;
    const v = this.view;
    const layers: Partial<Record<CanvasLayer, Float64Array>> = {};
    let shift = this.shift();
    if (this.dirty.map || !shift) {
      layers.map = this.paintMap();
      shift = IN_PLACE;
    }
    for (const name of ['agents', 'overlay'] as const) {
      if (!this.dirty[name]) continue;
      this.dirty[name] = false;
      layers[name] = this.screen.record((pen) => this.painters[name]?.(pen, v));
    }
    if (!Object.keys(layers).length && sameShift(shift, this.shifted)) return;
    this.shifted = shift;
    this.screen.show({ w: v.w, h: v.h, dpr: v.dpr }, layers, shift, this.loupe);
  }

  private paintMap(): Float64Array {
    this.dirty.map = false;
    clearTimeout(this.rest);
    const v = this.view.copy();
    v.w += 2 * MARGIN;
    v.h += 2 * MARGIN;
    this.painted = this.view.copy();
    return this.screen.record((pen) => this.painters.map?.(pen, v));
  }

  /** Position of the painted map under the current view; null when its margin is too small. */
  private shift(): Shift | null {
    const p = this.painted,
      v = this.view;
    if (!p || p.w !== v.w || p.h !== v.h || p.dpr !== v.dpr) return null;
    const scale = v.z / p.z;
    const [x, y] = v.to(p.cx, p.cy);
    const covered = ([sx, sy]: Vec): boolean => p.shows(...v.from(sx, sy), MARGIN);
    const corners: readonly Vec[] = [
      [0, 0],
      [v.w, 0],
      [v.w, v.h],
      [0, v.h],
    ];
    if (scale > 3 || !corners.every(covered)) return null;
    return { dx: x - v.w / 2, dy: y - v.h / 2, scale, angle: p.turn - v.turn };
  }
}
