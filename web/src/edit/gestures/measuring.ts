// Draws a line and shows its length.
import type { Chart, Press, State, Tool } from './chart';
import { TEXTS } from '../../texts/desk/gestures';

class Measuring implements State {
  readonly name = 'measuring';
  constructor(
    private readonly chart: Chart,
    private readonly press: Press,
  ) {}

  move(): void {
    const { chart, press } = this;
    const v = chart.surface.view;
    chart.editor.measureBetween({ a: v.from(press.x, press.y), b: v.from(chart.at.x, chart.at.y) });
  }

  /** The line stays until the next click or tool. */
  up(): void {
    this.chart.rest();
  }
}

export const MEASURE: Tool = {
  name: 'measure',
  label: TEXTS.measure,
  key: 'M',
  icon: 'ruler',
  help: 'dragALineTo',
  cursor: 'crosshair',
  picks: false,
  drag: (chart: Chart, press: Press): State => new Measuring(chart, press),
  click: (chart: Chart): void => chart.editor.measureBetween(null),
};
