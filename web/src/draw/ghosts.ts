// A possible reaction, drawn so that it cannot be mistaken for the current motion: a dashed box where the road user
// would wait or be slowest, with brake lights, and ticks along its path that are closer for harder braking.
import type { Pen } from './pen';
import type { OnLine } from '../model/base/geometry';
import { poseAt, type Motion } from '../model/base/motion';
import { outline, sizeOnScreen, type Sized } from './sprites';
import { trail } from './strokes';
import { colours } from './theme';
import type { View } from './view';

const PATH_PX = 2.4;
const TICK_PX = 6;
const LAMP_PX = 2.2;
/** Distance between two ticks at a stop and at 30 km/h, in pixels. */
const AT_A_STOP = 6;
const AT_30_KMH = 17;
/** Weaker deceleration does not count as braking, in m/s². */
const BRAKES_MPS2 = 0.5;

export interface GhostStyle {
  readonly colour: string;
  readonly alpha: number;
  /** Does it brake? Then it has lamps and ticks. */
  readonly brakes: boolean;
  /** False where the ghost covers its own box. */
  readonly filled: boolean;
}

/** The path from one scene time to another. */
export function paintWay(g: Pen, v: View, m: Motion, from: number, to: number, s: GhostStyle): void {
  trail(g, v, m, { colour: s.colour, width: PATH_PX, alpha: s.alpha, halo: true, from, to, cap: 'butt' });
  if (!s.brakes) return;
  const c = colours();
  g.globalAlpha = s.alpha;
  g.lineCap = 'round';
  for (const [colour, width] of [
    [c.halo, 3.6],
    [c.collision, 1.8],
  ] as const) {
    g.beginPath();
    for (const { x, y, heading } of brakeTicks(m, from, to, v.z)) {
      const [right, down] = v.ahead(heading);
      const dx = -down * TICK_PX,
        dy = right * TICK_PX;
      const [px, py] = v.to(x, y);
      g.moveTo(px - dx, py - dy);
      g.lineTo(px + dx, py + dy);
    }
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.stroke();
  }
  g.globalAlpha = 1;
}

/** Places of the ticks: only along braking, closer at lower speed. */
export function brakeTicks(m: Motion, from: number, to: number, zoom: number): OnLine[] {
  const out: OnLine[] = [];
  let left = AT_A_STOP / zoom;
  let last = poseAt(m, from);
  for (let t = from + 0.05; last && t <= to + 1e-6; t += 0.05) {
    const p = poseAt(m, t);
    if (!p) break;
    left -= Math.hypot(p.x - last.x, p.y - last.y);
    last = p;
    if (left > 0) continue;
    left = gapAt(p.speed) / zoom;
    if (braking(m, t) > BRAKES_MPS2) out.push({ x: p.x, y: p.y, heading: p.heading });
  }
  return out;
}

const gapAt = (speed: number): number =>
  AT_A_STOP + (AT_30_KMH - AT_A_STOP) * Math.min(2, (Math.abs(speed) * 3.6) / 30);

/** Mean deceleration around a time, m/s². */
function braking(m: Motion, t: number): number {
  const a = poseAt(m, t - 0.3) ?? poseAt(m, t),
    b = poseAt(m, t + 0.3) ?? poseAt(m, t);
  return a && b ? (Math.abs(a.speed) - Math.abs(b.speed)) / 0.6 : 0;
}

export function paintWaiting(g: Pen, v: View, a: Sized, p: OnLine, s: GhostStyle): void {
  const c = colours();
  const [l, w] = sizeOnScreen(a, v.z);
  g.save();
  v.stand(g, p);
  outline(g, a.kind, l, w);
  if (s.filled) {
    g.globalAlpha = s.alpha * 0.7;
    g.fillStyle = c.halo;
    g.fill();
    g.globalAlpha = s.alpha * 0.14;
    g.fillStyle = s.colour;
    g.fill();
  }
  g.globalAlpha = s.alpha;
  g.lineJoin = 'round';
  g.strokeStyle = c.halo;
  g.lineWidth = 4;
  g.stroke();
  g.strokeStyle = s.colour;
  g.lineWidth = 1.75;
  g.setLineDash([4, 2.6]);
  g.stroke();
  g.setLineDash([]);
  g.beginPath();
  g.moveTo(l * 0.12, -w * 0.28);
  g.lineTo(l * 0.32, 0);
  g.lineTo(l * 0.12, w * 0.28);
  g.stroke();
  if (s.brakes) lamps(g, l, w, c.collision, c.halo);
  g.restore();
}

/** Two at the rear; cyclists and pedestrians have one. */
function lamps(g: Pen, l: number, w: number, colour: string, halo: string): void {
  const aside = w > 12 ? [-w * 0.36, w * 0.36] : [0];
  for (const y of aside) {
    g.beginPath();
    g.arc(-l / 2, y, LAMP_PX, 0, Math.PI * 2);
    g.strokeStyle = halo;
    g.lineWidth = 1.6;
    g.stroke();
    g.fillStyle = colour;
    g.fill();
  }
}
