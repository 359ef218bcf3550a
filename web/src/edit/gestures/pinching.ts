// Two fingers pan and zoom at once.
import type { Point } from '../../model/geometry';
import type { Chart, State } from './chart';

export class Pinching implements State {
  readonly name = 'pinching';
  constructor(private readonly chart: Chart) {}

  moveFinger(from: Point, to: Point, other: Point): void {
    const v = this.chart.surface.view;
    const before = Math.hypot(from.x - other.x, from.y - other.y);
    const after = Math.hypot(to.x - other.x, to.y - other.y);
    v.panBy((to.x - from.x) / 2, (to.y - from.y) / 2);
    v.zoomAt((to.x + other.x) / 2, (to.y + other.y) / 2, after / Math.max(1, before));
    this.chart.surface.viewChanged();
  }

  up(): void {
    this.chart.rest();
  }
}
