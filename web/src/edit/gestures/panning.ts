// The picture moves with the pointer.
import type { Chart, Press, State, Tool } from './chart';
import { TEXTS } from '../../texts/desk/gestures';

export class Panning implements State {
  readonly name = 'panning';
  constructor(
    private readonly chart: Chart,
    private readonly press: Press,
  ) {}

  enter(): void {
    this.chart.surface.setCursor('grabbing');
  }

  leave(): void {
    this.chart.surface.setCursor('');
  }

  move(): void {
    const { chart, press } = this;
    const v = chart.surface.view;
    v.cx = press.camera.cx;
    v.cy = press.camera.cy;
    v.panBy(chart.at.x - press.x, chart.at.y - press.y);
    chart.surface.viewChanged();
  }

  up(): void {
    this.chart.rest();
  }
}

export const PAN: Tool = {
  name: 'pan',
  label: TEXTS.moveThePicture,
  key: 'H',
  icon: 'hand',
  help: 'draggingMoves',
  cursor: 'grab',
  picks: false,
  drag: (chart: Chart, press: Press): State => new Panning(chart, press),
  click: (chart: Chart): void => chart.editor.measureBetween(null),
};
