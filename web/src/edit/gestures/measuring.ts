// A line is drawn and its length shown.
import type { Chart, State } from './chart';
import type { Press } from './pressed';
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

export const MEASURE = {
  name: 'measure' as const,
  label: TEXTS.measure,
  key: 'M',
  icon: 'ruler',
  help: 'dragALineTo' as const,
  cursor: 'crosshair',
  picks: false,
  drag: (chart: Chart, press: Press): State => new Measuring(chart, press),
  click: (chart: Chart): void => chart.editor.measureBetween(null),
};
