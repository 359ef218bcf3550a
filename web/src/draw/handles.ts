// Handles of a selected road user: ring, heading tiller behind, speed arrow ahead, goal flag. Filled is fixed, hollow
// is free. Constant size on screen at every zoom.
import type { Pen } from './pen';
import type { OnLine, Pose, Vec } from '../model/base/geometry';
import type { AgentType } from '../model/base/kinds';
import { outline, roundRect, sizeOnScreen, type Sized } from './sprites';
import { colours } from './theme';
import type { Labels } from './labels';
import type { View } from './view';

/** Seconds of travel the speed arrow shows, in map metres. */
const arrowSeconds = (type: AgentType): number => (type === 'pedestrian' ? 5 : type === 'cyclist' ? 2 : 1);
const STALK = 24;
const GAP = 5;
const SHORTEST_ARROW = 10;

export interface HandlePoints {
  tip: Vec;
  knob: Vec;
  centre: Vec;
  nose: Vec;
}

/** Screen positions of a pose's handles. */
export function handlePoints(v: View, a: Sized, p: Pose): HandlePoints {
  const [right, down] = v.ahead(p.heading);
  const half = sizeOnScreen(a, v.z)[0] / 2;
  const [x, y] = v.to(p.x, p.y);
  const at = (d: number): Vec => [x + right * d, y + down * d];
  const arrow = Math.max(SHORTEST_ARROW * v.grip ** 2, p.speed * arrowSeconds(a.type) * v.z);
  return { centre: [x, y], knob: at(-(half + STALK * v.grip)), nose: at(half + GAP), tip: at(half + GAP + arrow) };
}

/** Speed that puts the arrow tip on a world point; negative behind the bumper. */
export function speedForTip(v: View, a: Sized, p: OnLine, wx: number, wy: number): number {
  const half = sizeOnScreen(a, v.z)[0] / 2 / v.z;
  const ahead = (wx - p.x) * Math.cos(p.heading) + (wy - p.y) * Math.sin(p.heading) - half - GAP / v.z;
  return ahead / arrowSeconds(a.type);
}

export interface HandleStyle {
  colour: string;
  freeHeading?: boolean;
  freeSpeed?: boolean;
  tick: number;
}

export function paintHandles(g: Pen, labels: Labels, v: View, a: Sized, p: Pose, s: HandleStyle): HandlePoints {
  const k = v.grip;
  const h = handlePoints(v, a, p);
  const ahead = v.ahead(p.heading);
  const half = sizeOnScreen(a, v.z)[0] / 2;
  const rear: Vec = [h.centre[0] - ahead[0] * (half + GAP), h.centre[1] - ahead[1] * (half + GAP)];
  haloLine(g, rear, h.knob, s.colour, 2, s.freeHeading);
  knob(g, h.knob, s.colour, s.freeHeading ?? false, 6 * k);
  haloLine(g, h.nose, h.tip, s.colour, 2.5, s.freeSpeed);
  ticks(g, h, ahead, s, v.z * arrowSeconds(a.type));
  arrowHead(g, h.tip, v.angle(p.heading), s, k);
  labels.block(h.tip[0] - 10, h.tip[1] - 10, 20, 20);
  labels.block(h.knob[0] - 8, h.knob[1] - 8, 16, 16);
  labels.block(
    Math.min(h.nose[0], h.tip[0]) - 4,
    Math.min(h.nose[1], h.tip[1]) - 4,
    Math.abs(h.nose[0] - h.tip[0]) + 8,
    Math.abs(h.nose[1] - h.tip[1]) + 8,
  );
  return h;
}

/** Only the speed arrow, without a handle; returns its tip. */
export function paintSpeed(
  g: Pen,
  v: View,
  a: Sized,
  p: Pose,
  colour: string,
  free: boolean,
  /** Largest length, in pixels: in a crowd a long arrow would hide the next road user. */
  most = Infinity,
): Vec {
  const { nose, tip } = handlePoints(v, a, p);
  const length = Math.hypot(tip[0] - nose[0], tip[1] - nose[1]);
  const k = Math.min(1, most / Math.max(1, length));
  const end: Vec = [nose[0] + (tip[0] - nose[0]) * k, nose[1] + (tip[1] - nose[1]) * k];
  haloLine(g, nose, end, colour, 1.8, free);
  arrowHead(g, end, v.angle(p.heading), { colour, freeSpeed: free, tick: 1 }, most < Infinity ? 0.5 : 0.7);
  return end;
}

function haloLine(g: Pen, a: Vec, b: Vec, colour: string, width: number, free?: boolean): void {
  g.beginPath();
  g.moveTo(a[0], a[1]);
  g.lineTo(b[0], b[1]);
  g.lineCap = 'round';
  g.strokeStyle = colours().halo;
  g.lineWidth = width + 2.6;
  g.stroke();
  g.strokeStyle = colour;
  g.lineWidth = width;
  g.setLineDash(free ? [3, 3.5] : []);
  g.stroke();
  g.setLineDash([]);
}

function knob(g: Pen, [x, y]: Vec, colour: string, free: boolean, r: number): void {
  const c = colours();
  const ring = (radius: number) => {
    g.beginPath();
    g.arc(x, y, radius, 0, Math.PI * 2);
  };
  ring(r + 1.6);
  g.fillStyle = c.halo;
  g.fill();
  ring(r);
  g.fillStyle = c.surface;
  g.fill();
  g.lineWidth = 2;
  g.strokeStyle = colour;
  g.setLineDash(free ? [2.6, 2.4] : []);
  g.stroke();
  g.setLineDash([]);
  if (free) return;
  ring(r - 3);
  g.fillStyle = colour;
  g.fill();
}

/** Marks along the arrow, so that its length can be read as a speed. */
function ticks(g: Pen, h: HandlePoints, [right, down]: Vec, s: HandleStyle, pxPerMps: number): void {
  const length = Math.hypot(h.tip[0] - h.nose[0], h.tip[1] - h.nose[1]);
  g.strokeStyle = s.colour;
  g.lineWidth = 1.5;
  for (let d = s.tick * pxPerMps, i = 0; d < length - 6 && i < 60; d += s.tick * pxPerMps, i++) {
    const x = h.nose[0] + right * d,
      y = h.nose[1] + down * d;
    g.beginPath();
    g.moveTo(x - down * 3.2, y + right * 3.2);
    g.lineTo(x + down * 3.2, y - right * 3.2);
    g.stroke();
  }
}

function arrowHead(g: Pen, [x, y]: Vec, angle: number, s: HandleStyle, k: number): void {
  const c = colours();
  g.save();
  g.translate(x, y);
  g.rotate(angle);
  g.beginPath();
  g.moveTo(9 * k, 0);
  g.lineTo(-4 * k, 7 * k);
  g.lineTo(-4 * k, -7 * k);
  g.closePath();
  g.lineJoin = 'round';
  g.strokeStyle = c.halo;
  g.lineWidth = 5;
  g.stroke();
  g.fillStyle = s.freeSpeed ? c.surface : s.colour;
  g.fill();
  g.strokeStyle = s.colour;
  g.lineWidth = 2;
  g.setLineDash(s.freeSpeed ? [2.6, 2.4] : []);
  g.stroke();
  g.setLineDash([]);
  g.restore();
}

/** The flag at a goal with its foot on the place, pixels before `View.grip`; `cloth`: height of its cloth. */
export const FLAG = { height: 36, width: 22, cloth: 17 } as const;
/** From its foot to the middle of its cloth, right and down. */
export const PENNANT: Vec = [FLAG.width / 2, FLAG.cloth / 2 - FLAG.height];

/** A flag with its foot at a place, scaled by a factor. */
export function paintFlag(g: Pen, labels: Labels, [x, y]: Vec, colour: string, free: boolean, k: number): void {
  const c = colours();
  g.save();
  g.lineCap = g.lineJoin = 'round';
  g.beginPath();
  g.ellipse(x, y, 5 * k, 2.6 * k, 0, 0, Math.PI * 2);
  g.fillStyle = c.halo;
  g.fill();
  g.beginPath();
  g.ellipse(x, y, 3.6 * k, 1.8 * k, 0, 0, Math.PI * 2);
  g.fillStyle = colour;
  g.fill();
  const top = y - FLAG.height * k;
  const pole = () => {
    g.beginPath();
    g.moveTo(x, y);
    g.lineTo(x, top);
  };
  pole();
  g.strokeStyle = c.halo;
  g.lineWidth = 5.4;
  g.stroke();
  g.beginPath();
  g.moveTo(x, top);
  g.lineTo(x + FLAG.width * k, top + 4 * k);
  g.lineTo(x + 16 * k, top + 9 * k);
  g.lineTo(x + FLAG.width * k, top + 15 * k);
  g.lineTo(x, top + FLAG.cloth * k);
  g.closePath();
  g.lineWidth = 4;
  g.stroke();
  g.fillStyle = free ? c.surface : colour;
  g.fill();
  g.strokeStyle = colour;
  g.lineWidth = 2;
  g.setLineDash(free ? [3, 2.6] : []);
  g.stroke();
  g.setLineDash([]);
  pole();
  g.lineWidth = 2.2;
  g.stroke();
  g.restore();
  blockFlag(labels, [x, y], k);
}

/** No label lies on a flag with its foot at a place. */
export const blockFlag = (labels: Labels, [x, y]: Vec, k: number): void =>
  labels.block(x - 4 * k, y - FLAG.height * k, (FLAG.width + 6) * k, FLAG.height * k);

/** A dotted line to the pointer, in pixels. */
export function paintString(g: Pen, from: Vec, hand: Vec): void {
  const c = colours();
  const line = (colour: string, width: number, dash: number[]) => {
    g.beginPath();
    g.moveTo(from[0], from[1]);
    g.lineTo(hand[0], hand[1]);
    g.lineCap = 'round';
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.setLineDash(dash);
    g.stroke();
    g.setLineDash([]);
  };
  line(c.halo, 6, []);
  line(c['near-edge'], 3, [0.1, 5.5]);
  g.beginPath();
  g.arc(hand[0], hand[1], 4, 0, Math.PI * 2);
  g.fillStyle = c.near;
  g.fill();
  g.strokeStyle = c.halo;
  g.lineWidth = 1.6;
  g.stroke();
}

/** Ring around a box: selection, collision. */
export function paintRing(
  g: Pen,
  v: View,
  a: Sized,
  p: OnLine,
  colour: string,
  width = 2,
  gap = 4,
  dash: number[] = [],
): void {
  const [l, w] = sizeOnScreen(a, v.z);
  g.save();
  v.stand(g, p);
  roundRect(g, -l / 2 - gap, -w / 2 - gap, l + 2 * gap, w + 2 * gap, 6);
  g.strokeStyle = colours().halo;
  g.lineWidth = width + 2.5;
  g.stroke();
  g.strokeStyle = colour;
  g.lineWidth = width;
  g.setLineDash(dash);
  g.stroke();
  g.restore();
}

/** A box in outline: goals, ghosts, "before". An arrow inside marks the front. */
export function paintGhost(
  g: Pen,
  v: View,
  a: Sized,
  p: OnLine,
  colour: string,
  fill: string | null,
  dash: number[] = [],
  width = 1.75,
): void {
  const [l, w] = sizeOnScreen(a, v.z);
  g.save();
  v.stand(g, p);
  outline(g, a.kind, l, w);
  if (fill) {
    g.fillStyle = fill;
    g.fill();
  }
  g.strokeStyle = colour;
  g.lineWidth = width;
  g.setLineDash(dash);
  g.stroke();
  g.setLineDash([]);
  g.beginPath();
  g.moveTo(l * 0.14, -w * 0.26);
  g.lineTo(l * 0.32, 0);
  g.lineTo(l * 0.14, w * 0.26);
  g.lineJoin = 'round';
  g.stroke();
  g.restore();
}
