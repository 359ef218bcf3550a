// The outline of an area to fill: drawn with one drag, or corner by corner. Corners can be moved; a click on a road
// user of the preview pins it.
import type { Vec } from '../../../model/base/geometry';
import { armHandleAt, armHandles, rateAfter, type ArmHandle } from './arm-handles';
import type { Chart, Press, RailEntry, State, Tool } from '../../gestures/chart';
import type { View } from '../../../draw/view';
import { FILL_NAME, type Filling } from './filling';
import { TEXTS } from '../../../texts/desk/gestures';

/** The line takes a further point after this many metres; it has this many at most. */
const STEP_M = 0.5;
const MOST_POINTS = 600;
/** Tolerance of the simplified outline, in pixels. */
const TOLERANCE_PX = 5;
/** A corner can be dragged within this distance, pixels. */
const CORNER_PX = 9;
const CORNER_PX_TOUCH = 24;
/** An arm's handle can be dragged within this distance, pixels. */
const HANDLE_PX = 13;
const HANDLE_PX_TOUCH = 26;
/** A click within this distance of the first corner closes the outline, pixels. */
const CLOSE_PX = 10;

class Outlining implements State {
  readonly name = 'outlining';
  readonly followsView = true;
  #line: readonly Vec[];

  constructor(
    private readonly chart: Chart,
    private readonly filling: Filling,
    press: Press,
  ) {
    this.#line = [chart.surface.view.from(press.x, press.y)];
  }

  move(): void {
    const { chart } = this;
    const at = chart.surface.view.from(chart.at.x, chart.at.y);
    const last = this.#line.at(-1)!;
    if (this.#line.length < MOST_POINTS && Math.hypot(at[0] - last[0], at[1] - last[1]) >= STEP_M)
      this.#line = [...this.#line, at];
    this.filling.draw(this.#line);
  }

  up(): void {
    const { chart } = this;
    this.move();
    chart.rest();
    this.filling.closeOutline(simplified(this.#line, TOLERANCE_PX / chart.surface.view.z));
  }

  cancel(): boolean {
    this.filling.draw(null);
    return true;
  }
}

class MovingCorner implements State {
  readonly name = 'moving a corner';
  readonly followsView = true;
  readonly #before: readonly Vec[];

  constructor(
    private readonly chart: Chart,
    private readonly filling: Filling,
    private readonly index: number,
  ) {
    this.#before = filling.wish.peek()!.region!;
  }

  enter(): void {
    this.chart.surface.setCursor('grabbing');
  }

  leave(): void {
    this.chart.surface.setCursor('');
  }

  move(): void {
    const { chart } = this;
    const at = chart.surface.view.from(chart.at.x, chart.at.y);
    this.filling.setRegion(this.#before.map((p, i) => (i === this.index ? at : p)));
  }

  up(): void {
    this.move();
    this.chart.rest();
  }

  cancel(): boolean {
    this.filling.setRegion(this.#before);
    return true;
  }
}

/** Drags an arm's handle: further outward means more arrivals. */
class DraggingRate implements State {
  readonly name = 'dragging a rate';

  constructor(
    private readonly chart: Chart,
    private readonly filling: Filling,
    private readonly handle: ArmHandle,
    private readonly press: Press,
  ) {}

  enter(): void {
    this.chart.surface.setCursor('grabbing');
  }

  leave(): void {
    this.chart.surface.setCursor('');
  }

  move(): void {
    const { arm, rate, out } = this.handle;
    const { at } = this.chart;
    const px = (at.x - this.press.x) * out[0] + (at.y - this.press.y) * out[1];
    this.filling.setRate(arm.id, rateAfter(rate, px, arm));
  }

  up(): void {
    this.move();
    this.chart.rest();
  }

  cancel(): boolean {
    this.filling.setRate(this.handle.arm.id, this.handle.rate);
    return true;
  }
}

function handleAt(filling: Filling, view: View, press: Pick<Press, 'x' | 'y' | 'touch'>): ArmHandle | null {
  const wish = filling.wish.peek();
  const arms = filling.answer.peek()?.arms;
  if (!wish || !arms || filling.drawn.peek()) return null;
  const all = armHandles(arms, wish.rates, view);
  return armHandleAt(all, press.x, press.y, press.touch ? HANDLE_PX_TOUCH : HANDLE_PX);
}

/** The corner of the area at a place; null where there is none. */
function cornerAt(filling: Filling, view: View, press: Pick<Press, 'x' | 'y' | 'touch'>): number | null {
  const reach = press.touch ? CORNER_PX_TOUCH : CORNER_PX;
  const i = (filling.wish.peek()?.region ?? []).findIndex(([x, y]) => {
    const [px, py] = view.to(x, y);
    return Math.hypot(px - press.x, py - press.y) <= reach;
  });
  return i < 0 ? null : i;
}

function click(filling: Filling, view: View, press: Press): void {
  const at = view.from(press.x, press.y);
  const drawn = filling.drawn.peek();
  if (!drawn) {
    const who = filling.at(at);
    if (who) filling.togglePin(who);
    else if (cornerAt(filling, view, press) === null && !handleAt(filling, view, press)) filling.addCorner(at);
    return;
  }
  const [x, y] = view.to(...drawn[0]);
  if (drawn.length >= 3 && Math.hypot(x - press.x, y - press.y) <= CLOSE_PX) filling.closeOutline();
  else if (drawn.length < MOST_POINTS) filling.addCorner(at);
}

/** Its button in the rail. */
export const FILL: RailEntry = {
  name: FILL_NAME,
  label: TEXTS.fillAnArea,
  key: 'D',
  icon: 'fill',
  help: 'drawRoundA',
};

export const fillingTool = (filling: Filling): Tool => ({
  ...FILL,
  cursor: 'crosshair',
  picks: false,
  hover: ({ at, surface }) => surface.setCursor(handleAt(filling, surface.view, { ...at, touch: false }) ? 'grab' : ''),
  drag(chart, press) {
    const { view } = chart.surface;
    const handle = handleAt(filling, view, press);
    if (handle) return new DraggingRate(chart, filling, handle, press);
    const corner = cornerAt(filling, view, press);
    return corner === null ? new Outlining(chart, filling, press) : new MovingCorner(chart, filling, corner);
  },
  click: (chart, press) => click(filling, chart.surface.view, press),
});

/** A line with fewer points: removed ones lie within `tolerance` of it. */
export function simplified(line: readonly Vec[], tolerance: number): readonly Vec[] {
  if (line.length < 3) return line;
  const [a, b] = [line[0], line.at(-1)!];
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const far = Math.hypot(dx, dy);
  const off = ([x, y]: Vec): number =>
    far > 1e-9 ? Math.abs((x - a[0]) * dy - (y - a[1]) * dx) / far : Math.hypot(x - a[0], y - a[1]);
  let at = 0;
  for (let i = 1; i < line.length - 1; i++) if (!at || off(line[i]) > off(line[at])) at = i;
  if (off(line[at]) <= tolerance) return [a, b];
  return [...simplified(line.slice(0, at + 1), tolerance).slice(0, -1), ...simplified(line.slice(at), tolerance)];
}
