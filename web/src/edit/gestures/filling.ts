// An area to be filled: drawn round with one drag, or corner by corner. Its corners can be moved; a click on somebody
// of the preview pins it.
import type { Vec } from '../../model/base/geometry';
import { armHandleAt, armHandles, rateAfter, type ArmHandle } from '../arm-handles';
import type { Chart, State } from './chart';
import type { Press } from './pressed';
import { TEXTS } from '../../texts/desk/gestures';

/** The line takes a further point after so many metres; it has this many at most. */
const STEP_M = 0.5;
const MOST_POINTS = 600;
/** What is drawn by hand keeps the corners that lie further than this off the line, in pixels. */
const TOLERANCE_PX = 5;
/** A corner can be taken hold of from so far, pixels. */
const CORNER_PX = 9;
const CORNER_PX_TOUCH = 24;
/** An arm's handle can be taken hold of from so far, pixels. */
const HANDLE_PX = 13;
const HANDLE_PX_TOUCH = 26;
/** A click so near to the first corner closes the outline, pixels. */
const CLOSE_PX = 10;

class Outlining implements State {
  readonly name = 'outlining';
  readonly followsView = true;
  #line: readonly Vec[];

  constructor(
    private readonly chart: Chart,
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
    chart.editor.filling.draw(this.#line);
  }

  up(): void {
    const { chart } = this;
    this.move();
    chart.rest();
    chart.editor.filling.closeOutline(simplified(this.#line, TOLERANCE_PX / chart.surface.view.z));
  }

  cancel(): boolean {
    this.chart.editor.filling.draw(null);
    return true;
  }
}

class MovingCorner implements State {
  readonly name = 'moving a corner';
  readonly followsView = true;
  readonly #before: readonly Vec[];

  constructor(
    private readonly chart: Chart,
    private readonly index: number,
  ) {
    this.#before = chart.editor.filling.wish.peek()!.region!;
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
    chart.editor.filling.setRegion(this.#before.map((p, i) => (i === this.index ? at : p)));
  }

  up(): void {
    this.move();
    this.chart.rest();
  }

  cancel(): boolean {
    this.chart.editor.filling.setRegion(this.#before);
    return true;
  }
}

/** An arm's handle in hand: outward more come in. */
class DraggingRate implements State {
  readonly name = 'dragging a rate';

  constructor(
    private readonly chart: Chart,
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
    const { at, editor } = this.chart;
    const px = (at.x - this.press.x) * out[0] + (at.y - this.press.y) * out[1];
    editor.filling.setRate(arm.id, rateAfter(rate, px, arm));
  }

  up(): void {
    this.move();
    this.chart.rest();
  }

  cancel(): boolean {
    this.chart.editor.filling.setRate(this.handle.arm.id, this.handle.rate);
    return true;
  }
}

function handleAt(chart: Chart, press: Pick<Press, 'x' | 'y' | 'touch'>): ArmHandle | null {
  const { filling } = chart.editor;
  const wish = filling.wish.peek();
  const arms = filling.answer.peek()?.arms;
  if (!wish || !arms || filling.drawn.peek()) return null;
  const all = armHandles(arms, wish.rates, chart.surface.view);
  return armHandleAt(all, press.x, press.y, press.touch ? HANDLE_PX_TOUCH : HANDLE_PX);
}

/** The corner of the area under a place; null where there is none. */
function cornerAt(chart: Chart, press: Pick<Press, 'x' | 'y' | 'touch'>): number | null {
  const { view } = chart.surface;
  const reach = press.touch ? CORNER_PX_TOUCH : CORNER_PX;
  const i = (chart.editor.filling.wish.peek()?.region ?? []).findIndex(([x, y]) => {
    const [px, py] = view.to(x, y);
    return Math.hypot(px - press.x, py - press.y) <= reach;
  });
  return i < 0 ? null : i;
}

function click(chart: Chart, press: Press): void {
  const { filling } = chart.editor;
  const { view } = chart.surface;
  const at = view.from(press.x, press.y);
  const drawn = filling.drawn.peek();
  if (!drawn) {
    const who = filling.at(at);
    if (who) filling.togglePin(who);
    else if (cornerAt(chart, press) === null && !handleAt(chart, press)) filling.addCorner(at);
    return;
  }
  const [x, y] = view.to(...drawn[0]);
  if (drawn.length >= 3 && Math.hypot(x - press.x, y - press.y) <= CLOSE_PX) filling.closeOutline();
  else if (drawn.length < MOST_POINTS) filling.addCorner(at);
}

export const FILL = {
  name: 'fill' as const,
  label: TEXTS.fillAnArea,
  key: 'D',
  icon: 'fill',
  help: 'drawRoundA' as const,
  cursor: 'crosshair',
  picks: false,
  hover: (chart: Chart): void => {
    chart.surface.setCursor(handleAt(chart, { ...chart.at, touch: false }) ? 'grab' : '');
  },
  drag: (chart: Chart, press: Press): State => {
    const handle = handleAt(chart, press);
    if (handle) return new DraggingRate(chart, handle, press);
    const corner = cornerAt(chart, press);
    return corner === null ? new Outlining(chart, press) : new MovingCorner(chart, corner);
  },
  click,
};

/** The same line with fewer points: none of those left out lies further than `tolerance` off it. */
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
