// A map that is being made, under the pointer: arms are turned and made longer, lanes come and go and are connected,
// kerbs bend wider.
import { clamp, type Point, type Vec } from '../../model/base/geometry';
import { laneOf } from '../../model/document/layouts';
import type { Arm } from '../../net/types';
import type { Knob, Layouts, Placed } from '../layouts';
import type { View } from '../../draw/view';
import type { Chart, State } from './chart';
import { Panning } from './panning';
import type { Press } from './pressed';
import type { Tool } from './tools';
import { TEXTS } from '../../texts/desk/gestures';
import { Connecting, stops, wayAt } from './ways';

/** The knob of an arm lies so far out from its stop line, its lane buttons and those that take lanes away, metres. */
const KNOB_M = 9;
const MORE_M = 15;
const FEWER_M = 19;
const ASIDE_M = 2.6;
/** Knobs are taken hold of from so far, pixels. */
const REACH_PX = 12;
const REACH_TOUCH_PX = 24;
/** An arm sticks at right angles to another within so many degrees. */
const STICKS_DEG = 3;
const MOST_LANES = 5;
const KERB_M: readonly [number, number] = [3, 20];
const LENGTH_M: readonly [number, number] = [40, 200];
/** So far in or out an arm that is turned keeps its length, metres. */
const KEEPS_LENGTH_M = 6;
/** Two clicks within this time and distance are a double click. */
const DOUBLE_MS = 400;
const DOUBLE_PX = 6;

/** All knobs of the map that is being made, in metres. */
export function knobs(layouts: Layouts): Placed[] {
  const made = layouts.made.value;
  const arms = layouts.arms.value;
  if (!made || arms.length !== made.arms.length) return [];
  const inLeft = layouts.parameters.value?.traffic === 'left-hand' ? -1 : 1;
  const all: Placed[] = made.corners.map((c, corner) => ({ kind: 'kerb', corner, at: [c.at_m[0], c.at_m[1]] }));
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

/** The arm that something belongs to. */
const armOf = (knob: Knob | null): number | null => (knob && 'arm' in knob ? knob.arm : null);

function knobAt(chart: Chart, p: Point, touch: boolean): Knob | null {
  const v: View = chart.surface.view;
  const { layouts } = chart.editor;
  const reach = touch ? REACH_TOUCH_PX : REACH_PX;
  const far = (k: Placed): number => v.away(k.at, p);
  const near = [...knobs(layouts), ...stops(layouts)].filter((k) => far(k) <= reach).sort((a, b) => far(a) - far(b));
  if (near[0]) return near[0];
  const way = wayAt(layouts, v, p, touch);
  return way ? { kind: 'way', arm: laneOf(way.from)[0], way } : null;
}

/** What is refused is not kept: the last map that could be drawn is the one in hand. */
function keepDrawn(layouts: Layouts): void {
  const made = layouts.made.peek();
  if (layouts.fault.peek() && made) layouts.set(made.layout.parameters);
}

class TurningArm implements State {
  readonly name = 'turning an arm';
  readonly followsModifiers = true;
  readonly #before: Arm;
  /** How far out it was taken hold of, metres. */
  readonly #out: number;

  constructor(
    private readonly chart: Chart,
    private readonly arm: number,
    press: Point,
  ) {
    const { layouts } = chart.editor;
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
    this.chart.editor.layouts.turn(null);
    this.chart.editor.layouts.letGo();
  }

  move(): void {
    const { chart } = this;
    const { layouts } = chart.editor;
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
    keepDrawn(this.chart.editor.layouts);
    this.chart.rest();
  }

  cancel(): boolean {
    this.chart.editor.layouts.putBack();
    return true;
  }
}

/** Whole degrees; 15 with Shift, tenths with Alt; at right angles to another arm it sticks. */
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
  /** Which way the knob goes when the radius grows, and how far for a metre. */
  readonly #way: Vec;

  constructor(
    private readonly chart: Chart,
    knob: Extract<Knob, { kind: 'kerb' }>,
  ) {
    const { layouts } = chart.editor;
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
    this.chart.editor.layouts.letGo();
  }

  move(): void {
    const { chart } = this;
    const [x, y] = chart.surface.view.from(chart.at.x, chart.at.y);
    const by = (x - this.#from[0]) * this.#way[0] + (y - this.#from[1]) * this.#way[1];
    const kerb_radius_m = clamp(Math.round((this.#radius + by) * 2) / 2, ...KERB_M);
    if (kerb_radius_m !== chart.editor.layouts.parameters.peek()!.kerb_radius_m)
      chart.editor.layouts.set({ kerb_radius_m });
  }

  up(): void {
    this.move();
    this.chart.rest();
  }

  cancel(): boolean {
    this.chart.editor.layouts.putBack();
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

/** What the pointer does while a map is being made, whatever tool is chosen in the rail. */
export const MAKE: Tool = {
  name: 'make',
  label: TEXTS.makeAMap,
  key: '',
  icon: 'plus',
  help: 'crossingsRoundabouts',
  cursor: '',
  picks: false,
  hover: (chart) => {
    const knob = knobAt(chart, chart.at, false);
    chart.editor.layouts.point(knob);
    chart.surface.setCursor(knob ? CURSORS[knob.kind] : '');
  },
  drag(chart, press): State {
    const knob = knobAt(chart, press, press.touch);
    if (knob?.kind === 'arm') return new TurningArm(chart, knob.arm, press);
    if (knob?.kind === 'kerb') return new BendingKerb(chart, knob);
    if (knob?.kind === 'stop') return new Connecting(chart, knob, press.touch);
    return new Panning(chart, press);
  },
  click(chart: Chart, press: Press, timeStamp: number): void {
    const { layouts } = chart.editor;
    const knob = knobAt(chart, press, press.touch);
    if (knob?.kind === 'way') layouts.pickWay(knob.way);
    else if (knob && knob.kind !== 'kerb') layouts.take(knob.arm);
    if (!knob) {
      layouts.pickWay(null);
      onGround(chart, press, timeStamp);
    }
    if (knob?.kind !== 'lane') return;
    const arm = layouts.arms.peek()[knob.arm];
    layouts.setArm(
      knob.arm,
      knob.side === 'in' ? { lanes_in: arm.lanes_in + knob.by } : { lanes_out: arm.lanes_out + knob.by },
    );
  },
};

/** A double click beyond the junction adds an arm that leads there. */
function onGround(chart: Chart, { x, y }: Press, t: number): void {
  const { layouts } = chart.editor;
  const again = t - clicked.t < DOUBLE_MS && Math.hypot(x - clicked.x, y - clicked.y) < DOUBLE_PX;
  clicked = { x, y, t: again ? -Infinity : t };
  const mouths = layouts.made.peek()?.arms.map((a) => Math.hypot(...a.mouth_m)) ?? [];
  const [mx, my] = chart.surface.view.from(x, y);
  if (again && mouths.length && Math.hypot(mx, my) > Math.min(...mouths))
    layouts.addArm((Math.atan2(my, mx) * 180) / Math.PI);
}
