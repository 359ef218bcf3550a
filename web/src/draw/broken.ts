// Marks faults on a line: the stretch in red under white dashes, and the crossed ground hatched.
import type { Pen, Sprite } from './pen';
import { isValidAt, STEP_S, type Motion } from '../model/base/motion';
import { colours, paletteStamp } from './theme';
import type { View } from './view';

/** A stretch of a motion, in seconds of the scene. */
export interface MotionStretch {
  readonly motion: Motion;
  readonly from: number;
  readonly to: number;
}

/** Least length of a stretch on screen, in pixels, as far as the path allows. */
const SHORTEST_PX = 12;
/** Most steps added on each side. */
const MOST_STEPS = 8;

/** Corner points of a stretch on screen. */
function pointsOf(v: View, s: MotionStretch): [number, number][] {
  const m = s.motion;
  const at = (i: number): [number, number] => v.to(m.x[i], m.y[i]);
  const inside = (i: number): boolean => i >= 0 && i < m.x.length && isValidAt(m, m.first + i);
  let i0 = Math.round(s.from / STEP_S) - m.first,
    i1 = Math.round(s.to / STEP_S) - m.first;
  i0 = Math.max(0, Math.min(i0, m.x.length - 1));
  i1 = Math.max(i0, Math.min(i1, m.x.length - 1));
  for (let k = 0; k < MOST_STEPS && !isLong(v, m, i0, i1); k++) {
    if (inside(i0 - 1)) i0--;
    if (inside(i1 + 1)) i1++;
  }
  const out: [number, number][] = [];
  for (let i = i0; i <= i1; i++) if (inside(i)) out.push(at(i));
  return out;
}

/** Is a stretch long enough to be seen? */
function isLong(v: View, m: Motion, i0: number, i1: number): boolean {
  let left = SHORTEST_PX / v.z;
  for (let i = i0 + 1; i <= i1 && left > 0; i++) {
    const dx = m.x[i] - m.x[i - 1],
      dy = m.y[i] - m.y[i - 1];
    left -= Math.sqrt(dx * dx + dy * dy);
  }
  return left <= 0;
}

function trace(g: Pen, pts: readonly (readonly [number, number])[]): void {
  pts.forEach(([x, y], i) => (i ? g.lineTo(x, y) : g.moveTo(x, y)));
}

export interface BrokenStyle {
  /** Width of its path, in pixels. */
  readonly width: number;
  readonly colour: string;
  readonly alpha: number;
}

export function paintBroken(g: Pen, v: View, s: MotionStretch, style: BrokenStyle): void {
  const { halo } = colours();
  const pts = pointsOf(v, s);
  if (pts.length < 2) return;
  g.beginPath();
  trace(g, pts);
  g.lineCap = 'butt';
  g.lineJoin = 'round';
  g.globalAlpha = style.alpha;
  g.setLineDash([]);
  g.strokeStyle = halo;
  g.lineWidth = style.width + 4;
  g.stroke();
  g.strokeStyle = style.colour;
  g.lineWidth = style.width + 2;
  g.stroke();
  g.setLineDash([2.5, 3.5]);
  g.strokeStyle = halo;
  g.lineWidth = Math.max(1.6, style.width * 0.55);
  g.stroke();
  g.setLineDash([]);
  g.globalAlpha = 1;
}

/** The ground under stretches, as wide as the road user; where several cross it, it is hatched once. */
export function paintGround(g: Pen, v: View, stretches: readonly MotionStretch[], width: number): void {
  if (!stretches.length) return;
  g.beginPath();
  for (const s of stretches) trace(g, pointsOf(v, s));
  g.lineCap = 'butt';
  g.lineJoin = 'round';
  g.lineWidth = Math.max(10, width * v.z);
  g.strokeTiles(hatching(v.dpr), 1 / v.dpr);
  g.stroke();
}

/** Diagonal lines on a pale ground, six pixels apart. */
function hatching(dpr: number): Sprite {
  const n = Math.max(4, Math.round(6 * dpr));
  return {
    key: `hatching|${dpr}|${paletteStamp()}`,
    width: n,
    height: n,
    paint(g) {
      g.fillStyle = g.strokeStyle = colours().collision;
      g.globalAlpha = 0.16;
      g.fillRect(0, 0, n, n);
      g.globalAlpha = 0.7;
      g.lineWidth = 1.3 * dpr;
      g.beginPath();
      for (const x of [-n, 0, n]) {
        g.moveTo(x - 1, n + 1);
        g.lineTo(x + n + 1, -1);
      }
      g.stroke();
    },
  };
}
