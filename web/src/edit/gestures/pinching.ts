// Two fingers pan, zoom and turn at once; a single remaining finger still moves the picture.
import { rad, wrapAngle, type Point } from '../../model/base/geometry';
import { NOTHING, type Chart, type State } from './chart';
import { Panning } from './panning';

/** A turn below this is an imprecise pinch. */
const STRAIGHT_RAD = rad(8);
/** Within this of north the picture snaps to it. */
const STICKS_RAD = rad(5);

export class Pinching implements State {
  readonly name = 'pinching';
  /** Turn of the fingers about each other, counter-clockwise, until the picture turns with them. */
  #fingers = 0;
  #turning = false;
  /** The picture's turn without the snap to north. */
  #turn: number;

  constructor(private readonly chart: Chart) {
    this.#turn = chart.surface.view.turn;
  }

  moveFinger(from: Point, to: Point, other: Point): void {
    const v = this.chart.surface.view;
    const before = Math.hypot(from.x - other.x, from.y - other.y);
    const after = Math.hypot(to.x - other.x, to.y - other.y);
    const [mx, my] = [(to.x + other.x) / 2, (to.y + other.y) / 2];
    v.panBy((to.x - from.x) / 2, (to.y - from.y) / 2);
    v.zoomAt(mx, my, after / Math.max(1, before));
    this.#turnBy(turnOf(from, to, other), mx, my);
    this.chart.surface.viewChanged();
  }

  #turnBy(angle: number, mx: number, my: number): void {
    if (this.#turning) this.#turn += angle;
    else {
      this.#fingers += angle;
      if (Math.abs(this.#fingers) < STRAIGHT_RAD) return;
      this.#turning = true;
      // The turn starts at the current angle; from north at the snap limit.
      if (!this.#turn) this.#turn = Math.sign(this.#fingers) * STICKS_RAD;
    }
    const turn = wrapAngle(this.#turn);
    this.chart.surface.view.turnAt(mx, my, Math.abs(turn) < STICKS_RAD ? 0 : turn);
  }

  up(): void {
    const { chart } = this;
    const stays = chart.finger;
    if (!stays) return chart.rest();
    chart.at = stays;
    chart.go(new Panning(chart, { ...stays, touch: true, hit: NOTHING, camera: chart.surface.view.camera }));
  }
}

/** Turn of one finger about the other, counter-clockwise. */
export function turnOf(from: Point, to: Point, other: Point): number {
  const angle = (a: Point): number => Math.atan2(a.y - other.y, a.x - other.x);
  // Pixels count downwards.
  return -wrapAngle(angle(to) - angle(from));
}
