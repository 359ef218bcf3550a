// Two fingers pan and zoom at once; the one that stays goes on moving the picture.
import type { Point } from '../../model/geometry';
import { NOTHING } from '../hit';
import type { Chart, State } from './chart';
import { Panning } from './panning';

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
    const { chart } = this;
    const stays = chart.finger;
    if (!stays) return chart.rest();
    const { cx, cy } = chart.surface.view;
    chart.at = stays;
    chart.go(new Panning(chart, { ...stays, touch: true, hit: NOTHING, cx, cy }));
  }
}
