// Ways of a map being made: drawn from a stop line to an exit, selected, removed.
import { project, type Point, type Vec } from '../../../model/base/geometry';
import { connectionOf, laneOf, type LaneConnection, type LaneOfArm } from '../../../model/document/layouts';
import type { View } from '../../../draw/view';
import type { Knob, Layouts } from './layouts';
import type { Chart, State } from '../../gestures/chart';

/** Exits catch the pointer within this distance, and ways are selected within this, pixels. */
const CATCH_PX = 20;
const CATCH_TOUCH_PX = 36;
const PICK_PX = 6;
const PICK_TOUCH_PX = 16;

/** Stop lines of the lanes into the junction. */
export function stops(layouts: Layouts): Extract<Knob, { kind: 'stop' }>[] {
  if (!layouts.connects) return [];
  const places = layouts.made.value?.arms ?? [];
  return places.flatMap(({ ins_m }, arm) =>
    ins_m.map(([x, y], lane) => ({ kind: 'stop' as const, arm, lane, at: [x, y] as const })),
  );
}

/** Starts of the lanes out of the junction. */
export function exits(layouts: Layouts): { readonly lane: LaneOfArm; readonly at: Vec }[] {
  const places = layouts.made.value?.arms ?? [];
  return places.flatMap(({ outs_m }, arm) =>
    outs_m.map(([x, y], lane) => ({ lane: [arm, lane] as const, at: [x, y] as const })),
  );
}

/** The way under the pointer; those of the selected arm are on top. */
export function wayAt(layouts: Layouts, v: View, p: Point, touch: boolean): LaneConnection | null {
  const lanes = layouts.made.peek()?.scene.map.lanes;
  const [x, y] = v.from(p.x, p.y);
  const near = layouts.ways.peek().flatMap((way) => {
    const line = lanes?.get(way.lane)?.line;
    if (!line) return [];
    const far = project(line, x, y);
    const px = Math.hypot(far.x - x, far.y - y) * v.z;
    const mine = laneOf(way.from)[0] === layouts.arm.peek();
    return px <= (touch ? PICK_TOUCH_PX : PICK_PX) ? [{ way, rank: px + (mine ? 0 : 1000) }] : [];
  });
  near.sort((a, b) => a.rank - b.rank);
  return near[0] ? { from: near[0].way.from, to: near[0].way.to } : null;
}

/** A way being drawn from a stop line; over an exit the map includes it at once. */
export class Connecting implements State {
  readonly name = 'connecting lanes';
  readonly #from: LaneOfArm;
  readonly #ways: readonly LaneConnection[];
  #to: LaneOfArm | null = null;

  constructor(
    private readonly chart: Chart,
    private readonly layouts: Layouts,
    knob: Extract<Knob, { kind: 'stop' }>,
    private readonly touch: boolean,
  ) {
    this.#from = [knob.arm, knob.lane];
    this.#ways = layouts.ways.peek();
    layouts.take(knob.arm);
    layouts.pickWay(null);
    layouts.hold();
  }

  enter(): void {
    this.chart.surface.setCursor('crosshair');
  }

  leave(): void {
    this.chart.surface.setCursor('');
    this.layouts.drawWay(null);
    this.layouts.letGo();
  }

  move(): void {
    const { surface, at } = this.chart;
    const { layouts } = this;
    const v = surface.view;
    const far = (e: { at: Vec }): number => v.away(e.at, at);
    const nearest = exits(layouts).sort((a, b) => far(a) - far(b))[0];
    const caught = nearest && far(nearest) <= (this.touch ? CATCH_TOUCH_PX : CATCH_PX) ? nearest : null;
    layouts.drawWay({ from: this.#from, to: caught?.lane ?? null, at: caught?.at ?? v.from(at.x, at.y) });
    if (String(caught?.lane ?? null) === String(this.#to)) return;
    this.#to = caught?.lane ?? null;
    layouts.putBack();
    if (this.#to) layouts.addWay(connectionOf(this.#from, this.#to), this.#ways);
  }

  up(): void {
    this.move();
    const way = this.#to && connectionOf(this.#from, this.#to);
    this.chart.rest();
    this.layouts.pickWay(way);
  }

  cancel(): boolean {
    this.layouts.putBack();
    return true;
  }
}
