// Editing a map under the pointer: arms are turned and lengthened, lanes added, removed and connected, kerb radii
// changed.
import { clamp, type Point, type Vec } from '../../../model/base/geometry';
import { laneOf } from '../../../model/document/layouts';
import type { Arm } from '../../../net/types';
import type { Knob, Layouts, PlacedKnob } from './layouts';
import type { View } from '../../../draw/view';
import type { Chart, Press, State, Tool } from '../../gestures/chart';
import { Panning } from '../../gestures/panning';
import { TEXTS } from '../../../texts/desk/gestures';
import { Connecting, stops, wayAt } from './ways';

/** Distances of an arm's knob, add buttons and remove buttons from its stop line, metres. */
const KNOB_M = 9;
const MORE_M = 15;
const FEWER_M = 19;
const ASIDE_M = 2.6;
/** Knobs can be dragged within this distance, pixels. */
const REACH_PX = 12;
const REACH_TOUCH_PX = 24;
/** An arm snaps to right angles with another within this many degrees. */
const STICKS_DEG = 3;
const MOST_LANES = 5;
const KERB_M: readonly [number, number] = [3, 20];
const LENGTH_M: readonly [number, number] = [40, 200];
/** A turned arm keeps its length within this radial movement, metres. */
const KEEPS_LENGTH_M = 6;
/** Two clicks within this time and distance are a double click. */
const DOUBLE_MS = 400;
const DOUBLE_PX = 6;

/** All knobs of the map being made, in metres. */
export function knobs(layouts: Layouts): PlacedKnob[] {
  const made = layouts.made.value;
  const arms = layouts.arms.value;
  if (!made || arms.length !== made.arms.length) return [];
  const inLeft = layouts.parameters.value?.traffic === 'left-hand' ? -1 : 1;
  const all: PlacedKnob[] = made.corners.map((c, corner) => ({ kind: 'kerb', corner, at: [c.at_m[0], c.at_m[1]] }));
  made.arms.forEach((place, arm) => {
    const [mx, my] = place.mouth_m;
    const long = Math.hypot(place.end_m[0] - mx, place.end_m[1] - my) || 1;
    const [ux, uy] = [(place.end_m[0] - mx) / long, (place.end_m[1] - my) / long];
    const at = (out: number, left: number): Vec => [mx + ux * out - uy * left, my + uy * out + ux * left];
    for (const [side, sign, kerb] of [
      ['in', inLeft, place.kerbs_m[0]],
      ['out', -inLeft, place.kerbs_m[1]],
    ] as const) {
      const lanes = side === 'in' ? arms[arm].lanes_in : arms[arm].lanes_out;
      const aside = sign * (kerb + ASIDE_M);
      if (lanes < MOST_LANES) all.push({ kind: 'lane', arm, side, by: 1, at: at(MORE_M, aside) });
      const last = arms[arm].lanes_in + arms[arm].lanes_out === 1;
      const shown = arm === layouts.arm.value || arm === armOf(layouts.under.value);
      if (shown && lanes > 0 && !last) all.push({ kind: 'lane', arm, side, by: -1, at: at(FEWER_M, aside) });
    }
    all.push({ kind: 'arm', arm, at: at(KNOB_M, 0) });
  });
  return all;
}

/** The arm of a knob. */
const armOf = (knob: Knob | null): number | null => (knob && 'arm' in knob ? knob.arm : null);

function knobAt(layouts: Layouts, v: View, p: Point, touch: boolean): Knob | null {
  const reach = touch ? REACH_TOUCH_PX : REACH_PX;
  const far = (k: PlacedKnob): number => v.away(k.at, p);
  const near = [...knobs(layouts), ...stops(layouts)].filter((k) => far(k) <= reach).sort((a, b) => far(a) - far(b));
  if (near[0]) return near[0];
  const way = wayAt(layouts, v, p, touch);
  return way ? { kind: 'way', arm: laneOf(way.from)[0], way } : null;
}

/** A refused change is dropped: the last drawable map stays. */
function keepDrawn(layouts: Layouts): void {
  const made = layouts.made.peek();
  if (layouts.fault.peek() && made) layouts.set(made.layout.parameters);
}

class TurningArm implements State {
  readonly name = 'turning an arm';
  readonly followsModifiers = true;
  readonly #before: Arm;
  /** Radial distance of the grab, metres. */
  readonly #out: number;

  constructor(
    private readonly chart: Chart,
    private readonly layouts: Layouts,
    private readonly arm: number,
    press: Point,
  ) {
    this.#before = layouts.arms.peek()[arm];
    this.#out = Math.hypot(...chart.surface.view.from(press.x, press.y));
    layouts.take(arm);
    layouts.hold();
    layouts.turn({ index: arm, before: this.#before });
  }

  enter(): void {
    this.chart.surface.setCursor('grabbing');
  }

  leave(): void {
    this.chart.surface.setCursor('');
    this.layouts.turn(null);
    this.layouts.letGo();
  }

  move(): void {
    const { chart, layouts } = this;
    const [x, y] = chart.surface.view.from(chart.at.x, chart.at.y);
    const others = layouts.arms.peek().filter((_, i) => i !== this.arm);
    const angle_deg = snapped((Math.atan2(y, x) * 180) / Math.PI, others, chart.modifiers);
    const by = Math.hypot(x, y) - this.#out;
    const past = Math.sign(by) * Math.max(0, Math.abs(by) - KEEPS_LENGTH_M);
    const length_m = past ? clamp(Math.round(this.#before.length_m + past), ...LENGTH_M) : this.#before.length_m;
    const now = layouts.arms.peek()[this.arm];
    if (angle_deg !== now.angle_deg || length_m !== now.length_m) layouts.setArm(this.arm, { angle_deg, length_m });
  }

  up(): void {
    this.move();
    keepDrawn(this.layouts);
    this.chart.rest();
  }

  cancel(): boolean {
    this.layouts.putBack();
    return true;
  }
}

/** Whole degrees; 15 with Shift, tenths with Alt; snaps to right angles with another arm. */
export function snapped(
  degrees: number,
  others: readonly Pick<Arm, 'angle_deg'>[],
  { alt, shift }: { alt: boolean; shift: boolean },
): number {
  const whole = (v: number): number => ((v % 360) + 360) % 360;
  if (alt) return whole(Math.round(degrees * 10) / 10);
  if (shift) return whole(Math.round(degrees / 15) * 15);
  for (const other of others) {
    const right = other.angle_deg + Math.round((degrees - other.angle_deg) / 90) * 90;
    if (Math.abs(degrees - right) <= STICKS_DEG) return whole(right);
  }
  return whole(Math.round(degrees));
}

class BendingKerb implements State {
  readonly name = 'bending a kerb';
  readonly #from: Vec;
  readonly #radius: number;
  /** Movement of the knob for each metre of radius. */
  readonly #way: Vec;

  constructor(
    private readonly chart: Chart,
    private readonly layouts: Layouts,
    knob: Extract<Knob, { kind: 'kerb' }>,
  ) {
    const corner = layouts.made.peek()!.corners[knob.corner];
    const [a, b] = corner.arms.map((i) => (layouts.arms.peek()[i].angle_deg * Math.PI) / 180);
    const [x, y] = [Math.cos(a) + Math.cos(b), Math.sin(a) + Math.sin(b)];
    const long = Math.hypot(x, y) || 1;
    const half = Math.acos(clamp(long / 2, 0.05, 0.999));
    const per = Math.max(0.08, 1 / Math.sin(half) - 1);
    this.#way = [x / long / per, y / long / per];
    this.#from = chart.surface.view.from(chart.at.x, chart.at.y);
    this.#radius = corner.radius_m;
    layouts.hold();
  }

  leave(): void {
    this.layouts.letGo();
  }

  move(): void {
    const { chart, layouts } = this;
    const [x, y] = chart.surface.view.from(chart.at.x, chart.at.y);
    const by = (x - this.#from[0]) * this.#way[0] + (y - this.#from[1]) * this.#way[1];
    const kerb_radius_m = clamp(Math.round((this.#radius + by) * 2) / 2, ...KERB_M);
    if (kerb_radius_m !== layouts.parameters.peek()!.kerb_radius_m) layouts.set({ kerb_radius_m });
  }

  up(): void {
    this.move();
    this.chart.rest();
  }

  cancel(): boolean {
    this.layouts.putBack();
    return true;
  }
}

const CURSORS: Readonly<Record<Knob['kind'], string>> = {
  arm: 'grab',
  kerb: 'grab',
  lane: 'pointer',
  stop: 'crosshair',
  way: 'pointer',
};

/** The last click on free ground. */
let clicked: Point & { t: number } = { x: 0, y: 0, t: -Infinity };

/** Pointer behaviour while a map is being made, whatever the tool of the rail. */
export const makingTool = (layouts: Layouts): Tool => ({
  name: 'make',
  label: TEXTS.makeAMap,
  key: '',
  icon: 'plus',
  help: 'crossingsRoundabouts',
  cursor: '',
  picks: false,
  hover: (chart) => {
    const knob = knobAt(layouts, chart.surface.view, chart.at, false);
    layouts.point(knob);
    chart.surface.setCursor(knob ? CURSORS[knob.kind] : '');
  },
  drag(chart, press): State {
    const knob = knobAt(layouts, chart.surface.view, press, press.touch);
    if (knob?.kind === 'arm') return new TurningArm(chart, layouts, knob.arm, press);
    if (knob?.kind === 'kerb') return new BendingKerb(chart, layouts, knob);
    if (knob?.kind === 'stop') return new Connecting(chart, layouts, knob, press.touch);
    return new Panning(chart, press);
  },
  click(chart: Chart, press: Press, timeStamp: number): void {
    const knob = knobAt(layouts, chart.surface.view, press, press.touch);
    if (knob?.kind === 'way') layouts.pickWay(knob.way);
    else if (knob && knob.kind !== 'kerb') layouts.take(knob.arm);
    if (!knob) {
      layouts.pickWay(null);
      onGround(layouts, chart.surface.view, press, timeStamp);
    }
    if (knob?.kind !== 'lane') return;
    const arm = layouts.arms.peek()[knob.arm];
    layouts.setArm(
      knob.arm,
      knob.side === 'in' ? { lanes_in: arm.lanes_in + knob.by } : { lanes_out: arm.lanes_out + knob.by },
    );
  },
});

/** A double click beyond the junction adds an arm there. */
function onGround(layouts: Layouts, view: View, { x, y }: Press, t: number): void {
  const again = t - clicked.t < DOUBLE_MS && Math.hypot(x - clicked.x, y - clicked.y) < DOUBLE_PX;
  clicked = { x, y, t: again ? -Infinity : t };
  const mouths = layouts.made.peek()?.arms.map((a) => Math.hypot(...a.mouth_m)) ?? [];
  const [mx, my] = view.from(x, y);
  if (again && mouths.length && Math.hypot(mx, my) > Math.min(...mouths))
    layouts.addArm((Math.atan2(my, mx) * 180) / Math.PI);
}
