// Stops of a drawn speed profile: a bar across the lane in front of the box, with the duration.
import { paintGhost } from '../../../draw/handles';
import { pill, type Labels, type Rect } from '../../../draw/labels';
import type { Pen } from '../../../draw/pen';
import { polyline } from '../../../draw/strokes';
import { colours } from '../../../draw/theme';
import type { View } from '../../../draw/view';
import type { Vec } from '../../../model/base/geometry';
import { stopsOf } from '../../../model/physics/speed-profile';
import type { SpeedPoint } from '../../../model/document/profile';
import type { Agent } from '../../../model/document/scene';
import { seconds } from '../../../model/base/units';
import type { ToolHandle } from '../../gestures/chart';
import { awayFrom, inRect } from '../../gestures/hit';
import type { ToolOverlay } from '../../overlay/tool-overlay';
import { DraggingHold, DraggingStop } from './dragging-stop';
import type { SpeedCurve } from './speed-curve';
import type { Editor } from '../../session/editor';
import { TEXTS } from '../../../texts/editing/picture';

/** The bar is longer than the box is wide, and lies before its front. */
const WIDER = 1.7;
const AHEAD_M = 0.6;

/** A finger takes objects within this many pixels. */
const BAR_PX = { mouse: 7, finger: 24 };

/** A draggable bar, in pixels, and the point of the curve that stops there. */
interface StopBar {
  readonly ends: readonly [Vec, Vec];
  readonly point: number;
  /** Its words: dragged to change the duration. */
  readonly words: Rect | null;
}

export class StopBars implements ToolOverlay {
  #bars: readonly StopBar[] = [];

  constructor(
    private readonly editor: Pick<Editor, 'reading'>,
    private readonly curve: SpeedCurve,
  ) {}

  watch(): void {
    void this.curve.profile.value;
  }

  get isDecided(): boolean {
    return this.curve.profile.value !== null;
  }

  paintSelected(g: Pen, v: View, labels: Labels, a: Agent): void {
    this.#bars = paintStops(g, labels, v, this.editor, this.curve, a);
  }

  handleAt(x: number, y: number, touch: boolean): ToolHandle | null {
    const { curve } = this;
    const near = touch ? BAR_PX.finger : BAR_PX.mouse;
    const click = (point: number) => () => curve.take(point);
    const bar = this.#bars.find(({ ends }) => awayFrom(ends, x, y) <= near);
    if (bar)
      return {
        cursor: 'grab',
        drag: (chart) => new DraggingStop(chart, curve, bar.point),
        click: click(bar.point),
      };
    const said = this.#bars.find(({ words }) => words && inRect(words, x, y));
    if (!said) return null;
    const { point } = said;
    return {
      cursor: 'resize',
      drag: (chart, press) => new DraggingHold(chart, curve, point, press.x),
      click: click(point),
    };
  }
}

function paintStops(
  g: Pen,
  labels: Labels,
  v: View,
  editor: Pick<Editor, 'reading'>,
  curve: SpeedCurve,
  a: Agent,
): StopBar[] {
  const profile = curve.profile.value;
  const f = profile && editor.reading.futures.value;
  const motion = f?.modes[editor.reading.chosen.value]?.motion;
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
    const said = TEXTS.stopsHereFor(seconds(lasts), curve.placeOf(a, pose));
    const words = pill(g, labels, ...v.to(x, y), said, { radii: [36, 52, 70], leader: c.collision });
    const point = pointOf(curve.points.value, from);
    if (point > 0) bars.push({ ends: [v.to(...bar[0]), v.to(...bar[1])], point, words });
  }
  return bars;
}

/** The zero-speed point next to the time of a stop; -1 where the stop has another cause. */
function pointOf(points: readonly SpeedPoint[], from: number): number {
  const away = points.map((p) => (p.v === 0 ? Math.abs(p.t - from) : Infinity));
  const least = Math.min(...away);
  return Number.isFinite(least) ? away.indexOf(least) : -1;
}
