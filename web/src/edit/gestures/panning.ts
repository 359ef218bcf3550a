// The picture moves with the pointer.
import type { Chart, State } from './chart';
import type { Press } from './pressed';
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

export const PAN = {
  name: 'pan' as const,
  label: TEXTS.moveThePicture,
  key: 'H',
  icon: 'hand',
  help: 'draggingMoves' as const,
  cursor: 'grab',
  picks: false,
  drag: (chart: Chart, press: Press): State => new Panning(chart, press),
  click: (chart: Chart): void => chart.editor.measureBetween(null),
};
