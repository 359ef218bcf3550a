// The bar of a stop is dragged along the path: it stops there, and the time follows. The release is one step.
import type { Chart, State } from './chart';

export class DraggingStop implements State {
  readonly name = 'dragging stop';
  readonly followsView = true;
  constructor(
    private readonly chart: Chart,
    private readonly point: number,
  ) {}

  enter(): void {
    this.chart.surface.setCursor('grabbing');
  }

  leave(): void {
    this.chart.surface.setCursor('');
  }

  move(): void {
    const { editor, surface, at } = this.chart;
    const [x, y] = surface.view.from(at.x, at.y);
    editor.curve.stopAt(this.point, x, y);
    surface.invalidate('overlay');
  }

  up(): void {
    this.chart.editor.curve.release();
    this.chart.rest();
  }

  cancel(): boolean {
    return this.chart.editor.curve.cancel();
  }
}
