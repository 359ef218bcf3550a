// Optional ground layers under the road users: conflict zones, speed limits, reach.
import { CELL_M, type Zone } from '../model/physics/conflicts';
import type { Vec } from '../model/base/geometry';
import { pointAt } from '../model/base/geometry';
import type { LaneMap } from '../model/document/lanemap';
import { toUnit, type SpeedUnit } from '../model/base/units';
import type { Pen } from './pen';
import { polyline } from './strokes';
import { colours, font, type ColourName } from './theme';
import type { View } from './view';

/** Below this many seconds, in this colour and strength. */
const HEAT: readonly (readonly [below: number, colour: ColourName, alpha: number])[] = [
  [1, 'collision', 0.5],
  [2, 'near-edge', 0.45],
  [Infinity, 'near', 0.35],
];

export function paintZones(g: Pen, v: View, zones: readonly Zone[]): void {
  const box = v.box(CELL_M * v.z);
  let above = 0;
  for (const [below, colour, alpha] of HEAT) {
    g.beginPath();
    for (const { x, y, gap } of zones) {
      if (gap < above || gap >= below || x < box.x0 || x > box.x1 || y < box.y0 || y > box.y1) continue;
      const [x0, x1] = [x - CELL_M / 2, x + CELL_M / 2];
      const [y0, y1] = [y - CELL_M / 2, y + CELL_M / 2];
      g.moveTo(v.x(x0, y0), v.y(x0, y0));
      g.lineTo(v.x(x1, y0), v.y(x1, y0));
      g.lineTo(v.x(x1, y1), v.y(x1, y1));
      g.lineTo(v.x(x0, y1), v.y(x0, y1));
      g.closePath();
    }
    g.fillStyle = colours()[colour];
    g.globalAlpha = alpha;
    g.fill();
    above = below;
  }
  g.globalAlpha = 1;
}

/** Place of a speed-limit sign, m/s. */
interface SpeedSign {
  readonly x: number;
  readonly y: number;
  readonly limit: number;
}

const SIGN_PX = 9.5;
/** Least distance of two equal signs, pixels. */
const APART_PX = 64;
/** Distance into a lane, metres: past the part it shares with the one before. */
const INTO_LANE_M = 20;

const signs = new WeakMap<LaneMap, readonly SpeedSign[]>();

function signsOf(map: LaneMap): readonly SpeedSign[] {
  const known = signs.get(map);
  if (known) return known;
  const all = [...map.lanes.values()].flatMap((l): SpeedSign[] => {
    if (l.limit === null || l.kind !== 'road' || l.inside) return [];
    const { x, y } = pointAt(l.line, Math.min(INTO_LANE_M, l.line.length / 2));
    return [{ x, y, limit: l.limit }];
  });
  signs.set(map, all);
  return all;
}

export const knowsLimits = (map: LaneMap): boolean => signsOf(map).length > 0;

/** Round signs on the lanes; one for several equal neighbours. */
export function paintLimits(g: Pen, v: View, map: LaneMap, unit: SpeedUnit): void {
  if (v.z < 1.5) return;
  const c = colours();
  const box = v.box(SIGN_PX);
  const done: (readonly [x: number, y: number, text: string])[] = [];
  g.font = font(700, 9.5);
  g.textAlign = 'center';
  g.textBaseline = 'middle';
  for (const s of signsOf(map)) {
    if (s.x < box.x0 || s.x > box.x1 || s.y < box.y0 || s.y > box.y1) continue;
    const [x, y] = v.to(s.x, s.y);
    const text = String(Math.round(toUnit(s.limit, unit)));
    const crowded = done.some(([px, py, said]) => {
      const d = Math.hypot(px - x, py - y);
      return d < 2.2 * SIGN_PX || (said === text && d < APART_PX);
    });
    if (crowded) continue;
    done.push([x, y, text]);
    g.beginPath();
    g.arc(x, y, SIGN_PX, 0, Math.PI * 2);
    g.fillStyle = c.surface;
    g.fill();
    g.strokeStyle = c.collision;
    g.lineWidth = 2.4;
    g.stroke();
    g.fillStyle = c.ink;
    g.fillText(text, x, y + 0.5);
  }
  g.textAlign = 'left';
}

/** Bands along the lanes, each with its width in metres. */
export function paintWays(g: Pen, v: View, ways: readonly { readonly pts: readonly Vec[]; readonly width: number }[]) {
  for (const { pts, width } of ways) polyline(g, v, pts, colours().goal, Math.max(3, width * 0.8 * v.z), 0.2);
}

/** The ground between two distances around a place. */
export function paintRing(g: Pen, v: View, [x, y]: Vec, least: number, most: number): void {
  g.beginPath();
  g.arc(...v.to(x, y), ((least + most) / 2) * v.z, 0, Math.PI * 2);
  g.strokeStyle = colours().goal;
  g.lineWidth = Math.max(2, (most - least) * v.z);
  g.globalAlpha = 0.14;
  g.stroke();
  g.globalAlpha = 1;
}
