// Where somebody with a speed drawn by hand stands: a bar across the lane in front of the box, and for how long.
import { paintGhost } from '../draw/handles';
import { pill, type Labels, type Rect } from '../draw/labels';
import type { Pen } from '../draw/pen';
import { polyline } from '../draw/strokes';
import { colours } from '../draw/theme';
import type { View } from '../draw/view';
import type { Vec } from '../model/base/geometry';
import { stopsOf } from '../model/physics/speed-profile';
import type { SpeedPoint } from '../model/document/profile';
import type { Agent } from '../model/document/scene';
import { seconds } from '../model/base/units';
import type { Editor } from './editor';
import { TEXTS } from '../texts/editing/picture';

/** The bar is longer than the box is wide, and lies before its front. */
const WIDER = 1.7;
const AHEAD_M = 0.6;

/** A bar to take hold of, in pixels, and the point of the curve that stops there. */
export interface StopBar {
  readonly ends: readonly [Vec, Vec];
  readonly point: number;
  /** Its words: they are pulled for how long it stops. */
  readonly words: Rect | null;
}

export function paintStops(g: Pen, labels: Labels, v: View, editor: Editor, a: Agent): StopBar[] {
  const profile = editor.curve.profile.value;
  const f = profile && editor.futures.value;
  const motion = f?.modes[editor.chosen.value]?.motion;
  if (!motion) return [];
  const c = colours();
  const bars: StopBar[] = [];
  for (const { pose, from, lasts } of stopsOf(motion, profile?.points)) {
    const [cos, sin] = [Math.cos(pose.heading), Math.sin(pose.heading)];
    const ahead = a.length / 2 + AHEAD_M;
    const half = (a.width * WIDER) / 2;
    const [x, y] = [pose.x + cos * ahead, pose.y + sin * ahead];
    paintGhost(g, v, a, pose, c.ink, null, [4, 3]);
    const bar = [
      [x - sin * half, y + cos * half],
      [x + sin * half, y - cos * half],
    ] as const;
    polyline(g, v, bar, c.halo, 8, 1, [], 'round');
    polyline(g, v, bar, c.collision, 5, 1, [], 'round');
    const said = TEXTS.stopsHereFor(seconds(lasts), editor.curve.placeOf(a, pose));
    const words = pill(g, labels, ...v.to(x, y), said, { radii: [36, 52, 70], leader: c.collision });
    const point = pointOf(editor.curve.points.value, from);
    if (point > 0) bars.push({ ends: [v.to(...bar[0]), v.to(...bar[1])], point, words });
  }
  return bars;
}

/** The point at zero that is next to the time of a stop; -1 where it stands for another reason. */
function pointOf(points: readonly SpeedPoint[], from: number): number {
  const away = points.map((p) => (p.v === 0 ? Math.abs(p.t - from) : Infinity));
  const least = Math.min(...away);
  return Number.isFinite(least) ? away.indexOf(least) : -1;
}
