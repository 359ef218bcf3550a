// Three stacked canvases: map, agents, overlay. Each is repainted only when what it shows changed, inside one
// animation frame. While the view moves, the finished map picture is shifted and scaled; it is painted afresh
// when the movement rests or when its margin is used up.
import { View } from './view';
import { readPalette } from './theme';

export type Painter = (g: CanvasRenderingContext2D, v: View) => void;

/** Pixels of map painted beyond each side of the stage. */
const MARGIN = 192;
const REST_MS = 90;

export class Stage {
  readonly view = new View();
  private readonly canvases: Record<'map' | 'agents' | 'overlay', HTMLCanvasElement>;
  private readonly painters: Partial<Record<'map' | 'agents' | 'overlay', Painter>> = {};
  private readonly dirty = { map: true, agents: true, overlay: true };
  private painted: View | null = null;
  private frame = 0;
  private rest = 0;
  /** Called once per frame before painting, for animation. */
  onFrame: ((now: number) => void) | null = null;
  onView: (() => void) | null = null;

  constructor(readonly element: HTMLElement) {
    const make = (name: string) => {
      const c = document.createElement('canvas');
      c.className = `layer ${name}`;
      c.setAttribute('aria-hidden', 'true');
      element.append(c);
      return c;
    };
    this.canvases = { map: make('map'), agents: make('agents'), overlay: make('overlay') };
    readPalette();
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
  }

  painter(layer: 'map' | 'agents' | 'overlay', p: Painter): void {
    this.painters[layer] = p;
  }

  resize(): void {
    const { view: v } = this;
    const w = this.element.clientWidth,
      h = this.element.clientHeight;
    const dpr = Math.min(2, window.devicePixelRatio || 1);
    if (!w || !h || (w === v.w && h === v.h && dpr === v.dpr && this.canvases.agents.width)) return;
    v.w = w;
    v.h = h;
    v.dpr = dpr;
    for (const [name, c] of Object.entries(this.canvases)) {
      const m = name === 'map' ? MARGIN : 0;
      c.width = Math.round((w + 2 * m) * dpr);
      c.height = Math.round((h + 2 * m) * dpr);
      c.style.width = `${w + 2 * m}px`;
      c.style.height = `${h + 2 * m}px`;
      if (m) {
        c.style.left = `${-m}px`;
        c.style.top = `${-m}px`;
      }
    }
    this.invalidate('map', 'agents', 'overlay');
    this.onView?.();
  }

  invalidate(...layers: ('map' | 'agents' | 'overlay')[]): void {
    for (const l of layers) this.dirty[l] = true;
    if (!this.frame) this.frame = requestAnimationFrame((now) => this.tick(now));
  }

  /** The view moved: shift what is there now, repaint the map when it rests. */
  viewChanged(): void {
    this.dirty.agents = this.dirty.overlay = true;
    clearTimeout(this.rest);
    this.rest = window.setTimeout(() => this.invalidate('map'), REST_MS);
    this.invalidate();
    this.onView?.();
  }

  /** The shape of the pointer over the picture; empty for the plain one. */
  setCursor(name: string): void {
    const { dataset } = this.element;
    if ((dataset.cursor ?? '') === name) return;
    if (name) dataset.cursor = name;
    else delete dataset.cursor;
  }

  themeChanged(): void {
    readPalette();
    this.invalidate('map', 'agents', 'overlay');
  }

  private tick(now: number): void {
    this.frame = 0;
    this.onFrame?.(now);
    if (this.dirty.map || !this.shift()) this.paintMap();
    for (const name of ['agents', 'overlay'] as const) {
      if (!this.dirty[name]) continue;
      this.dirty[name] = false;
      const c = this.canvases[name];
      const g = c.getContext('2d')!;
      g.setTransform(1, 0, 0, 1, 0, 0);
      g.clearRect(0, 0, c.width, c.height);
      g.setTransform(this.view.dpr, 0, 0, this.view.dpr, 0, 0);
      this.painters[name]?.(g, this.view);
    }
  }

  private paintMap(): void {
    this.dirty.map = false;
    clearTimeout(this.rest);
    const v = this.view.copy();
    v.w += 2 * MARGIN;
    v.h += 2 * MARGIN;
    this.painted = this.view.copy();
    const c = this.canvases.map;
    c.style.transform = '';
    this.painters.map?.(c.getContext('2d', { alpha: false })!, v);
  }

  /** Moves the painted map under the present view; false when its margin does not reach. */
  private shift(): boolean {
    const p = this.painted,
      v = this.view;
    if (!p || p.w !== v.w || p.h !== v.h) return false;
    const k = v.z / p.z;
    const dx = (p.cx - v.cx) * v.z,
      dy = (v.cy - p.cy) * v.z;
    if (k === 1 && dx === 0 && dy === 0) return true;
    const reachX = (p.w / 2 + MARGIN) * k - v.w / 2,
      reachY = (p.h / 2 + MARGIN) * k - v.h / 2;
    if (k > 3 || Math.abs(dx) > reachX || Math.abs(dy) > reachY) return false;
    this.canvases.map.style.transform = `translate(${dx}px, ${dy}px) scale(${k})`;
    return true;
  }
}
