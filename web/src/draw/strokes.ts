// Lines on the map: each has a halo, one dot per second, and a dash for its certainty.
import type { Pen } from './pen';
import { isValidAt, stretches, type Motion } from '../model/base/motion';
import type { Futures } from '../model/document/futures';
import { LETTERS } from '../model/document/futures';
import { thinned, type Vec } from '../model/base/geometry';
import { colours, font, modeColour, modeOnColour } from './theme';
import type { Labels, Offset } from './labels';
import type { View } from './view';

export interface TrailStyle {
  colour: string;
  width: number;
  alpha?: number;
  halo?: boolean;
  dash?: number[];
  dots?: boolean;
  from?: number;
  to?: number;
  cap?: CanvasLineCap;
}

/** Deviation of a line from its points that is invisible, pixels. */
export const UNSEEN_PX = 0.05;

function tracePath(g: Pen, v: View, m: Motion, i0: number, i1: number): void {
  g.beginPath();
  const at = (i: number): Vec => v.to(m.x[i], m.y[i]);
  for (const [from, to] of stretches(m, Math.max(0, i0), Math.min(i1, m.x.length - 1))) {
    let pen = false;
    thinned(from, to, at, UNSEEN_PX, ([x, y]) => {
      if (pen) g.lineTo(x, y);
      else g.moveTo(x, y);
      pen = true;
    });
  }
}

export function trail(g: Pen, v: View, m: Motion, s: TrailStyle): void {
  const i0 = Math.round((s.from ?? 0) * 10) - m.first,
    i1 = Math.round((s.to ?? 99) * 10) - m.first;
  const alpha = s.alpha ?? 1;
  tracePath(g, v, m, i0, i1);
  g.lineCap = s.cap ?? 'round';
  g.lineJoin = 'round';
  if (s.halo) {
    g.globalAlpha = alpha * 0.75;
    g.strokeStyle = colours().halo;
    g.lineWidth = s.width + 2.5;
    g.stroke();
  }
  g.globalAlpha = alpha;
  g.setLineDash(s.dash ?? []);
  g.strokeStyle = s.colour;
  g.lineWidth = s.width;
  g.stroke();
  g.setLineDash([]);
  if (s.dots) secondDots(g, v, m, s, Math.max(0, i0), i1);
  g.globalAlpha = 1;
}

function secondDots(g: Pen, v: View, m: Motion, s: TrailStyle, i0: number, i1: number): void {
  const every = v.z > 12 ? 5 : 10;
  g.fillStyle = s.colour;
  g.strokeStyle = colours().halo;
  g.lineWidth = 1.2;
  for (let i = Math.max(1, i0); i <= i1 && i < m.x.length; i++) {
    const step = m.first + i;
    if (step % every || !isValidAt(m, step)) continue;
    const r = step % 10 ? s.width * 0.35 + 0.6 : s.width * 0.5 + 1.2;
    g.beginPath();
    g.arc(v.x(m.x[i], m.y[i]), v.y(m.x[i], m.y[i]), r, 0, Math.PI * 2);
    if (s.halo) g.stroke();
    g.fill();
  }
}

/** A line through world points, to be stroked or filled. */
export function traceLine(g: Pen, v: View, pts: readonly Vec[]): void {
  pts.forEach(([wx, wy], i) => {
    const x = v.x(wx, wy),
      y = v.y(wx, wy);
    if (i) g.lineTo(x, y);
    else g.moveTo(x, y);
  });
}

export function polyline(
  g: Pen,
  v: View,
  pts: readonly Vec[],
  colour: string,
  width: number,
  alpha = 1,
  dash: number[] = [],
  cap: CanvasLineCap = 'butt',
): void {
  g.beginPath();
  traceLine(g, v, pts);
  g.strokeStyle = colour;
  g.lineWidth = width;
  g.lineCap = cap;
  g.lineJoin = 'round';
  g.globalAlpha = alpha;
  g.setLineDash(dash);
  g.stroke();
  g.setLineDash([]);
  g.globalAlpha = 1;
}

/** Rank as strength: likely futures are darker and wider. */
export function modeStyle(p: number, max: number): { alpha: number; width: number } {
  const r = Math.sqrt(max > 0 ? p / max : 1);
  return { alpha: 0.35 + 0.65 * r, width: 1.5 + 2.5 * r };
}

export interface FuturesStyle {
  only?: number | null;
  chosen: number;
  alpha?: number;
  outdated?: boolean;
  onlyChosen?: boolean;
  /** End time of drawing, seconds. */
  until?: number;
  /** Verdict on each: kept ones at full strength, rejected ones dotted and pale. */
  said?: readonly ('keep' | 'reject' | null)[];
}

/** Dotted, then dashed, then solid: the refinement of the six. */
function settledDash(f: Futures, outdated: boolean): number[] {
  if (f.sketch || outdated) return [2, 5];
  const left = f.steps - f.step;
  return left <= 0 ? [] : left >= f.steps * 0.5 ? [2, 5] : [8, 4];
}

/** Width of all futures where none is in force. */
const EVEN_PX = 2;

const REJECTED_DASH = [1, 6];

export function paintFutures(g: Pen, v: View, f: Futures, s: FuturesStyle): void {
  const max = Math.max(...f.modes.map((m) => m.probability));
  const dash = settledDash(f, s.outdated ?? false);
  for (const i of drawOrder(f.modes.length, s.chosen)) {
    if (s.onlyChosen && i !== s.chosen) continue;
    const m = f.modes[i];
    const { alpha, width } = modeStyle(m.probability, max);
    const lit = s.only == null || s.only === i;
    const isChosen = i === s.chosen;
    if (s.said?.[i]) {
      const kept = s.said[i] === 'keep';
      trail(g, v, m.motion, {
        colour: modeColour(i),
        width: kept ? 4 : 2,
        alpha: kept ? 1 : isChosen ? 0.6 : 0.38,
        halo: kept,
        dots: kept,
        dash: kept ? [] : REJECTED_DASH,
        to: s.until,
      });
      continue;
    }
    trail(g, v, m.motion, {
      colour: f.sketch ? colours()['ink-3'] : modeColour(i),
      width: s.chosen < 0 ? EVEN_PX : isChosen ? Math.max(width, 3.2) : width,
      alpha: (lit ? (isChosen ? Math.max(alpha, 0.9) : alpha) : 0.14) * (s.alpha ?? 1),
      halo: lit,
      dots: lit,
      dash,
      to: s.until,
    });
  }
}

/** F first, A over it, the chosen one on top; -1 for none. */
const drawOrder = (n: number, chosen: number): number[] =>
  [...Array(n).keys()]
    .filter((i) => i !== chosen)
    .reverse()
    .concat(chosen >= 0 && chosen < n ? [chosen] : []);

export interface Chip {
  readonly index: number;
  readonly x: number;
  readonly y: number;
}

const CHIP_TRIES: readonly Offset[] = [
  [0, 0],
  [22, 0],
  [0, -24],
  [-22, 0],
  [0, 24],
  [20, -20],
  [-20, -20],
  [20, 20],
  [-20, 20],
  [0, -44],
  [42, 0],
  [-42, 0],
  [0, 44],
  // Several that leave the picture at one place form a column.
  [0, -66],
  [0, 66],
  [22, -44],
  [22, 44],
  [0, -88],
  [0, 88],
];

/** The end of a motion, or where it leaves the uncovered part of the picture. */
export function lastInView(v: View, m: Motion, until = Infinity): [number, number] | null {
  for (let i = Math.min(m.x.length - 1, Math.round(until * 10) - m.first); i >= 0; i--)
    if (v.isClear(m.x[i], m.y[i])) return v.to(m.x[i], m.y[i]);
  return null;
}

/** Letters at the ends of the futures; returns their positions, for clicks. */
export function paintChips(
  g: Pen,
  labels: Labels,
  v: View,
  f: Futures,
  which: readonly number[],
  chosen: number,
  until?: number,
): Chip[] {
  const out: Chip[] = [];
  const R = 8.5;
  for (const i of which) {
    const m = f.modes[i].motion;
    const end = lastInView(v, m, until);
    if (!end) continue;
    const [ex, ey] = end;
    const r = labels.place(
      ex,
      ey,
      2 * R + 2,
      2 * R + 2,
      CHIP_TRIES.map(([a, b]): Offset => [a - R - 1, b - R - 1]),
      true,
    )!;
    const cx = r.x + R + 1,
      cy = r.y + R + 1;
    if (Math.hypot(cx - ex, cy - ey) > 4) {
      g.beginPath();
      g.moveTo(ex, ey);
      g.lineTo(cx, cy);
      g.strokeStyle = modeColour(i);
      g.lineWidth = 1;
      g.globalAlpha = 0.7;
      g.stroke();
      g.globalAlpha = 1;
    }
    letterDisc(g, cx, cy, R, i, i === chosen);
    out.push({ index: i, x: cx, y: cy });
  }
  return out;
}

function letterDisc(g: Pen, x: number, y: number, r: number, i: number, chosen: boolean): void {
  g.beginPath();
  g.arc(x, y, r, 0, Math.PI * 2);
  g.fillStyle = modeColour(i);
  g.strokeStyle = colours().halo;
  g.lineWidth = chosen ? 3.4 : 2;
  g.stroke();
  g.fill();
  if (chosen) {
    g.beginPath();
    g.arc(x, y, r + 2.2, 0, Math.PI * 2);
    g.strokeStyle = colours().select;
    g.lineWidth = 1.4;
    g.stroke();
  }
  g.fillStyle = modeOnColour(i);
  g.font = font(700, 10.5);
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  g.fillText(LETTERS[i] ?? '?', x, y + 0.5);
  g.textAlign = 'left';
}
