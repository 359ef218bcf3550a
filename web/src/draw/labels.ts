// Labels on pills. Each takes the first free place around its object; without one it is omitted, unless it is
// mandatory.
import type { Pen, Sprite } from './pen';
import { clamp } from '../model/base/geometry';
import { colours, font, paletteStamp } from './theme';
import { roundRect } from './sprites';

export interface Rect {
  x: number;
  y: number;
  w: number;
  h: number;
}
export type Offset = readonly [number, number];

/** The picture that labels are on: its size, and device pixels for each pixel. */
export interface Sheet {
  readonly w: number;
  readonly h: number;
  readonly dpr: number;
}

/** What is wider covers the height of the picture, pixels: a rail of tools does not. */
const RAIL_PX = 150;
/** Cell size of `Taken`, pixels. */
const CELL = 64;

/** Rectangles in a grid, so that a collision test visits only near ones. */
export class Taken {
  private readonly cells = new Map<number, Rect[]>();

  constructor(rects: readonly Rect[]) {
    for (const r of rects)
      Taken.each(r, (cell) => {
        const here = this.cells.get(cell);
        if (here) here.push(r);
        else this.cells.set(cell, [r]);
        return false;
      });
  }

  meets(r: Rect): boolean {
    return Taken.each(r, (cell) => this.cells.get(cell)?.some((u) => meet(r, u)) ?? false);
  }

  /** Visits the cells of a rectangle until `will` returns true. */
  private static each({ x, y, w, h }: Rect, will: (cell: number) => boolean): boolean {
    for (let i = Math.floor(x / CELL); i <= Math.floor((x + w) / CELL); i++)
      for (let k = Math.floor(y / CELL); k <= Math.floor((y + h) / CELL); k++) if (will(i * 4096 + k)) return true;
    return false;
  }
}

const NOTHING_TAKEN = new Taken([]);

export class Labels {
  private used: Rect[] = [];
  private avoided: readonly Rect[] = [];
  private kept: Rect[] = [];
  /** Pills that are painted after all are placed, so that no leader line covers them. */
  private held: (() => void)[] | null = null;
  private taken = NOTHING_TAKEN;

  constructor(
    private sheet: Sheet = { w: 0, h: 0, dpr: 1 },
    private inset = { left: 0, right: 0, top: 0, bottom: 0 },
  ) {}

  /** Device pixels for each pixel. */
  get dpr(): number {
    return this.sheet.dpr;
  }

  reset({ w, h, dpr }: Sheet, inset = this.inset): void {
    this.sheet = { w, h, dpr };
    this.inset = inset;
    this.used = [];
    this.avoided = [];
    this.kept = [];
    this.taken = NOTHING_TAKEN;
  }

  /** Labels avoid all of it while another place is free. */
  keepOffAll(taken: Taken): void {
    this.taken = taken;
  }

  /** Defers painting of pills until `release`. */
  hold(): void {
    this.held = [];
  }

  release(): void {
    const all = this.held ?? [];
    this.held = null;
    for (const paint of all) paint();
  }

  /** Paints a pill now, or above everything painted meanwhile. */
  onTop(paint: () => void): void {
    if (this.held) this.held.push(paint);
    else paint();
  }

  /** Labels avoid it while another place is free. */
  keepOff(r: Rect): void {
    this.kept.push(r);
  }

  /** Is a point outside the picture, or under a panel beside it? Then it gets no label. */
  outside(x: number, y: number): boolean {
    const { sheet, inset } = this;
    const [left, right] = [inset.left, inset.right].map((px) => (px > RAIL_PX ? px : 0));
    return x < left - 8 || y < -8 || x > sheet.w - right + 8 || y > sheet.h + 8;
  }

  block(x: number, y: number, w: number, h: number): void {
    this.used.push({ x, y, w, h });
  }

  /** Labels placed in `place` avoid further rectangles, which later labels may cover. */
  avoiding(rects: readonly Rect[], place: () => void): void {
    this.avoided = rects;
    place();
    this.avoided = [];
  }

  place(x: number, y: number, w: number, h: number, tries: readonly Offset[], must: boolean): Rect | null {
    const { sheet, inset } = this;
    const at = (o: Offset): Rect => ({
      x: clamp(x + o[0], 6 + inset.left, Math.max(6, sheet.w - w - 6 - inset.right)),
      y: clamp(y + o[1], 6, sheet.h - h - 6),
      w,
      h,
    });
    const free = (r: Rect, ...of: (readonly Rect[])[]): boolean => !of.some((list) => list.some((u) => meet(r, u)));
    const all = tries.map(at);
    const r =
      all.find((o) => free(o, this.used, this.avoided, this.kept) && !this.taken.meets(o)) ??
      all.find((o) => free(o, this.used, this.avoided)) ??
      (must ? all[0] : null);
    if (!r) return null;
    this.used.push(r);
    return r;
  }
}

const meet = (a: Rect, b: Rect): boolean => a.x < b.x + b.w && a.x + a.w > b.x && a.y < b.y + b.h && a.y + a.h > b.y;

/** Eight directions at six distances, nearest first. */
function around(w: number, h: number, radii: readonly number[]): Offset[] {
  const out: Offset[] = [];
  for (const r of radii)
    for (const d of [-45, 45, -135, 135, -90, 90, 0, 180]) {
      const x = Math.cos((d * Math.PI) / 180) * r,
        y = Math.sin((d * Math.PI) / 180) * r;
      out.push([x + (x > 8 ? 0 : x < -8 ? -w : -w / 2), y - h / 2]);
    }
  return out;
}

export type PillIcon = 'cross' | 'triangle' | 'bar' | 'flag' | 'pin';

export interface PillStyle {
  fg?: string;
  bg?: string;
  border?: string;
  weight?: number;
  height?: number;
  icon?: PillIcon;
  leader?: string;
  tries?: readonly Offset[];
  radii?: readonly number[];
  must?: boolean;
}

/** A mandatory label takes any free place before it covers another. */
function places(w: number, h: number, s: PillStyle): readonly Offset[] {
  if (!s.tries) return around(w, h, s.radii ?? [24, 36, 52, 72, 96, 124]);
  return s.must === false ? s.tries : [...s.tries, ...around(w, h, [30, 44, 60, 80])];
}

/** Space of the icon before the words. */
const ICON_PX = 15;

const widths = new Map<string, number>();
let ruler: CanvasRenderingContext2D | null = null;

/** Width of a text in a font, pixels. */
export function textWidth(f: string, text: string): number {
  const key = f + text;
  let w = widths.get(key);
  if (w === undefined) {
    if (widths.size > 2000) widths.clear();
    ruler ??= document.createElement('canvas').getContext('2d')!;
    ruler.font = f;
    widths.set(key, (w = Math.ceil(ruler.measureText(text).width)));
  }
  return w;
}

export function pill(g: Pen, labels: Labels, x: number, y: number, text: string, s: PillStyle = {}): Rect | null {
  if (labels.outside(x, y)) return null;
  const f = font(s.weight ?? 600, 11);
  const h = s.height ?? 20;
  const w = textWidth(f, text) + 14 + (s.icon ? ICON_PX : 0);
  const r = labels.place(x, y, w, h, places(w, h, s), s.must ?? true);
  if (!r) return null;
  if (s.leader) leaderLine(g, x, y, r, s.leader);
  labels.onTop(() => paintPill(g, r, text, f, s, labels.dpr));
  return r;
}

/** How far the shadow of a pill reaches, pixels. */
const SHADOW_PX = 6;

/** A pill without its words. A sprite, because the shadow costs more than all the rest of a label. */
function pillBody({ w, h }: Rect, { bg = colours().surface, border }: PillStyle, dpr: number): Sprite {
  const [width, height] = [w, h].map((px) => Math.ceil((px + 2 * SHADOW_PX) * dpr));
  return {
    key: `pill|${w}|${h}|${bg}|${border}|${dpr}|${paletteStamp()}`,
    width,
    height,
    paint(g) {
      g.setTransform(dpr, 0, 0, dpr, SHADOW_PX * dpr, SHADOW_PX * dpr);
      roundRect(g, 0, 0, w, h, h / 2);
      g.save();
      g.shadowColor = 'rgba(16,20,26,.22)';
      g.shadowBlur = 4;
      g.shadowOffsetY = 1;
      g.fillStyle = bg;
      g.fill();
      g.restore();
      if (!border) return;
      g.strokeStyle = border;
      g.lineWidth = 1.25;
      g.stroke();
    },
  };
}

function paintPill(g: Pen, r: Rect, text: string, f: string, s: PillStyle, dpr: number): void {
  const c = colours();
  const body = pillBody(r, s, dpr);
  // On whole device pixels the body stays sharp.
  const [x, y] = [r.x, r.y].map((at) => Math.round(at * dpr) / dpr);
  g.stamp(body, x - SHADOW_PX, y - SHADOW_PX, body.width / dpr, body.height / dpr);
  if (s.icon) paintIcon(g, s.icon, x + 12, y + r.h / 2, s.fg ?? c.ink);
  g.font = f;
  g.fillStyle = s.fg ?? c.ink;
  g.textBaseline = 'middle';
  g.textAlign = 'left';
  g.fillText(text, x + 7 + (s.icon ? ICON_PX : 0), y + r.h / 2 + 0.5);
}

function leaderLine(g: Pen, x: number, y: number, r: Rect, colour: string): void {
  g.beginPath();
  g.moveTo(x, y);
  g.lineTo(clamp(x, r.x + 6, r.x + r.w - 6), clamp(y, r.y, r.y + r.h));
  g.strokeStyle = colours().halo;
  g.lineWidth = 3.5;
  g.stroke();
  g.strokeStyle = colour;
  g.lineWidth = 1.25;
  g.stroke();
}

export function paintIcon(g: Pen, kind: PillIcon, x: number, y: number, colour: string): void {
  g.beginPath();
  g.strokeStyle = g.fillStyle = colour;
  g.lineCap = 'round';
  g.lineWidth = 1.9;
  switch (kind) {
    case 'cross':
      g.moveTo(x - 3.2, y - 3.2);
      g.lineTo(x + 3.2, y + 3.2);
      g.moveTo(x + 3.2, y - 3.2);
      g.lineTo(x - 3.2, y + 3.2);
      g.stroke();
      return;
    case 'bar':
      g.lineWidth = 1.7;
      g.arc(x, y, 4.2, 0, Math.PI * 2);
      g.moveTo(x - 2.9, y + 2.9);
      g.lineTo(x + 2.9, y - 2.9);
      g.stroke();
      return;
    case 'flag':
      g.lineWidth = 1.5;
      g.setLineDash([2.2, 1.8]);
      g.moveTo(x - 3, y + 4.5);
      g.lineTo(x - 3, y - 4.5);
      g.lineTo(x + 4.5, y - 2.8);
      g.lineTo(x + 2.5, y - 0.8);
      g.lineTo(x + 4.5, y + 1.2);
      g.lineTo(x - 3, y + 1);
      g.stroke();
      g.setLineDash([]);
      return;
    case 'pin':
      g.lineWidth = 1.5;
      g.moveTo(x - 2.6, y - 4.4);
      g.lineTo(x + 2.6, y - 4.4);
      g.moveTo(x - 1.5, y - 4.4);
      g.lineTo(x - 1.5, y - 1);
      g.lineTo(x - 3.4, y + 1);
      g.lineTo(x + 3.4, y + 1);
      g.lineTo(x + 1.5, y - 1);
      g.lineTo(x + 1.5, y - 4.4);
      g.moveTo(x, y + 1);
      g.lineTo(x, y + 4.8);
      g.stroke();
      return;
    case 'triangle':
      g.moveTo(x, y - 4.4);
      g.lineTo(x + 4.6, y + 3.6);
      g.lineTo(x - 4.6, y + 3.6);
      g.closePath();
      g.fill();
  }
}

/** A pill at a place given as a pair. */
export function tag(g: Pen, labels: Labels, [x, y]: readonly [number, number], text: string, s: PillStyle): void {
  pill(g, labels, x, y, text, s);
}
