// Pressed and not yet moved: the release is a click, a movement becomes what the tool makes of it.
import type { Point } from '../../model/geometry';
import type { Hit } from '../hit';
import type { Chart, State } from './chart';
import type { Tool } from './tools';

/** A press, as the states after it need it. */
export interface Press extends Point {
  readonly touch: boolean;
  readonly hit: Hit;
  /** Middle of the view at the press, in metres. */
  readonly cx: number;
  readonly cy: number;
}

/** A movement shorter than this is a click's. A finger is less steady than a mouse. */
const START_PX = 3;
const START_PX_TOUCH = 8;

export class Pressed implements State {
  readonly name = 'pressed';
  constructor(
    private readonly chart: Chart,
    private readonly tool: Tool,
    private readonly press: Press,
  ) {}

  move(): void {
    const { chart, press } = this;
    const far = Math.hypot(chart.at.x - press.x, chart.at.y - press.y);
    if (far < (press.touch ? START_PX_TOUCH : START_PX)) return;
    chart.go(this.tool.drag(chart, press));
    chart.state.move?.();
  }

  up(timeStamp: number): void {
    this.chart.rest();
    this.tool.click(this.chart, this.press, timeStamp);
  }
}
