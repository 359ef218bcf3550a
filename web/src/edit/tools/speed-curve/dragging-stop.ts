// Drags a stop on the road. Its bar moves along the path: the stop place changes, and its time follows. Its words are
// dragged sideways for the duration. The release is one step.
import type { Chart, State } from '../../gestures/chart';
import type { SpeedCurve } from './speed-curve';

/** A stop place catches the bar within this distance, pixels. */
const CAPTURE_PX = 8;
/** Change of the duration for this many pixels. */
const STEP_S = 0.1;
const STEP_PX = 4;

abstract class Dragging implements State {
  abstract readonly name: string;
  abstract readonly followsView: boolean;
  protected abstract readonly cursor: string;
  constructor(
    protected readonly chart: Chart,
    protected readonly curve: SpeedCurve,
    protected readonly point: number,
  ) {}

  abstract move(): void;

  enter(): void {
    this.chart.surface.setCursor(this.cursor);
  }

  leave(): void {
    this.chart.surface.setCursor('');
  }

  up(): void {
    this.curve.release();
    this.chart.rest();
  }

  cancel(): boolean {
    return this.curve.cancel();
  }
}

export class DraggingStop extends Dragging {
  readonly name = 'dragging stop';
  readonly followsView = true;
  protected readonly cursor = 'grabbing';

  move(): void {
    const { surface, at, modifiers } = this.chart;
    const sticks = modifiers.alt ? 0 : CAPTURE_PX / surface.view.z;
    this.curve.stopAt(this.point, surface.view.from(at.x, at.y), sticks);
    surface.invalidate('overlay');
  }
}

export class DraggingHold extends Dragging {
  readonly name = 'dragging hold';
  readonly followsView = false;
  protected readonly cursor = 'resize';
  readonly #was: number;

  constructor(
    chart: Chart,
    curve: SpeedCurve,
    point: number,
    private readonly from: number,
  ) {
    super(chart, curve, point);
    this.#was = curve.points.peek()[point]?.hold ?? 0;
  }

  move(): void {
    const { surface, at, modifiers } = this.chart;
    const wanted = this.#was + ((at.x - this.from) / STEP_PX) * STEP_S;
    const step = modifiers.shift ? 1 : STEP_S;
    this.curve.drag(this.point, { hold: Math.max(0, Math.round(wanted / step) * step) });
    surface.invalidate('overlay');
  }
}
