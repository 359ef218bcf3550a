// Road users as sprites, painted once for each kind, size and zoom step, and then stamped.
import type { Pen, Sprite } from './pen';
import type { Agent } from '../model/document/scene';
import type { Kind } from '../model/base/kinds';
import type { OnLine } from '../model/base/geometry';
import { colours, paletteStamp, type ColourName } from './theme';
import type { View } from './view';

/** Least size on screen in pixels at this zoom and closer, so that small ones stay visible. */
const LEAST: Partial<Record<Kind, readonly [number, number]>> = {
  pedestrian: [11, 11],
  cyclist: [17, 8],
  motorcycle: [18, 8],
};
/** Further out all shrink together, so that no pedestrian looks larger than a car. */
const LEAST_FROM_ZOOM = 8;
const LEAST_OF_ALL = [5, 3.5] as const;

export const colourKey = (
  a: Pick<Agent, 'type' | 'parked'>,
): 'vehicle' | 'cyclist' | 'pedestrian' | 'parked' | 'log' =>
  a.type === 'other' ? 'log' : a.parked ? 'parked' : a.type;

export type Sized = Pick<Agent, 'kind' | 'type' | 'length' | 'width' | 'parked'> & { readonly mini?: boolean };

export function sizeOnScreen(a: Sized, z: number): [number, number] {
  if (a.mini) return [Math.max(a.length * z, 2), Math.max(a.width * z, 2)];
  const small = LEAST[a.kind];
  const k = Math.min(1, z / LEAST_FROM_ZOOM);
  const least = (side: 0 | 1): number => (small ? Math.max(LEAST_OF_ALL[1], small[side] * k) : LEAST_OF_ALL[side]);
  return [Math.max(a.length * z, least(0)), Math.max(a.width * z, least(1))];
}

/** The upright rectangle around a road user, in pixels. */
export function boxOnScreen(v: View, a: Sized, p: OnLine): { x: number; y: number; w: number; h: number } {
  const [l, s] = sizeOnScreen(a, v.z);
  const [c, n] = v.ahead(p.heading).map(Math.abs);
  const w = l * c + s * n,
    h = l * n + s * c;
  const [x, y] = v.to(p.x, p.y);
  return { x: x - w / 2, y: y - h / 2, w, h };
}

const PAD = 3;

function sprite(a: Sized, z: number, dpr: number, active: boolean): Sprite {
  const [l, w] = sizeOnScreen(a, z);
  const L = Math.round(l * 2) / 2,
    W = Math.round(w * 2) / 2;
  const colour = active && a.parked ? 'vehicle' : colourKey(a);
  const width = Math.ceil((L + PAD * 2) * dpr),
    height = Math.ceil((W + PAD * 2) * dpr);
  return {
    key: `${a.kind}|${colour}|${L}|${W}|${dpr}|${a.mini ? 'm' : ''}${paletteStamp()}`,
    width,
    height,
    paint(g) {
      g.setTransform(dpr, 0, 0, dpr, width / 2, height / 2);
      paintBody(g, a.kind, L, W, colour, a.mini ? 1 : 2.4);
    },
  };
}

export function stamp(g: Pen, v: View, a: Sized, p: OnLine, active = false): void {
  const s = sprite(a, v.z, v.dpr, active);
  const w = s.width / v.dpr,
    h = s.height / v.dpr;
  const [c, n] = v.ahead(p.heading);
  g.setTransform(v.dpr * c, v.dpr * n, -v.dpr * n, v.dpr * c, v.dpr * v.x(p.x, p.y), v.dpr * v.y(p.x, p.y));
  g.stamp(s, -w / 2, -h / 2, w, h);
}

export function roundRect(g: Pen, x: number, y: number, w: number, h: number, r: number): void {
  g.beginPath();
  g.roundRect(x, y, w, h, Math.max(0, Math.min(r, w / 2, h / 2)));
}

export function outline(g: Pen, kind: Kind, L: number, W: number): void {
  const soft =
    kind === 'pedestrian'
      ? W * 0.42
      : kind === 'cyclist' || kind === 'motorcycle'
        ? W * 0.48
        : kind === 'car'
          ? Math.min(W * 0.28, 6)
          : Math.min(W * 0.14, 4);
  roundRect(g, -L / 2, -W / 2, L, W, soft);
}

function paintBody(g: Pen, kind: Kind, L: number, W: number, colour: ReturnType<typeof colourKey>, halo: number): void {
  const c = colours();
  g.lineJoin = 'round';
  outline(g, kind, L, W);
  g.strokeStyle = c.halo;
  g.lineWidth = halo;
  g.stroke();
  g.fillStyle = c[colour];
  g.fill();
  g.fillStyle = colour === 'log' ? c['parked-glass'] : c[`${colour}-glass` as ColourName];
  if (W < 6 && kind !== 'pedestrian' && kind !== 'cyclist' && kind !== 'motorcycle') return;
  PARTS[kind](g, L, W);
}

const disc = (g: Pen, x: number, y: number, r: number): void => {
  g.beginPath();
  g.arc(x, y, r, 0, Math.PI * 2);
  g.fill();
};
const pane = (g: Pen, x: number, y: number, w: number, h: number, r = 1): void => {
  roundRect(g, x, y, w, h, r);
  g.fill();
};
const rider = (g: Pen, L: number, W: number): void => {
  disc(g, -L * 0.05, 0, Math.max(1.9, W * 0.33));
  g.fillRect(L * 0.2, -W / 2, Math.max(1.4, L * 0.08), W);
};

/** Parts that distinguish front from rear: head, handlebar, windscreen, cab. */
const PARTS: Record<Kind, (g: Pen, L: number, W: number) => void> = {
  pedestrian: (g, L, W) => disc(g, L * 0.17, 0, W * 0.2),
  cyclist: rider,
  motorcycle: rider,
  bus(g, L, W) {
    pane(g, L / 2 - L * 0.085, -W * 0.4, L * 0.055, W * 0.8, 1.5);
    g.globalAlpha = 0.5;
    for (let i = 0; i < 3; i++) pane(g, -L * 0.34 + i * L * 0.22, -W * 0.2, L * 0.13, W * 0.4, 2);
  },
  truck(g, L, W) {
    g.fillRect(L * 0.235, -W / 2, Math.max(1.2, L * 0.018), W);
    pane(g, L * 0.36, -W * 0.38, L * 0.065, W * 0.76, 1.5);
  },
  car(g, L, W) {
    g.beginPath();
    g.moveTo(L * 0.06, -W * 0.36);
    g.lineTo(L * 0.24, -W * 0.42);
    g.lineTo(L * 0.24, W * 0.42);
    g.lineTo(L * 0.06, W * 0.36);
    g.fill();
    g.globalAlpha = 0.55;
    pane(g, -L * 0.36, -W * 0.34, L * 0.09, W * 0.68);
  },
  other: (g, L, W) => pane(g, -L * 0.2, -W * 0.2, L * 0.4, W * 0.4),
};
