// Where seconds and speeds lie in the plot.
import { toUnit, type SpeedUnit } from '../../model/units';
import type { Motion } from '../../model/motion';
import type { Context } from '../../actions/context';

/** Pixels left of the plot, right of it, for the events above and for the seconds below. */
export const X0 = 52;
const RIGHT = 22;
export const LANE = 24;
const BOTTOM = 20;

export interface Size {
  readonly w: number;
  readonly h: number;
}

export interface Axes {
  readonly x: (t: number) => number;
  readonly y: (v: number) => number;
  readonly x1: number;
  readonly y0: number;
  readonly y1: number;
  readonly height: number;
  /** The speed at the upper edge, in `unit`. */
  readonly top: number;
  readonly unit: SpeedUnit;
  readonly duration: number;
}

export function axesOf(c: Context, { w, h }: Size): Axes {
  const { editor } = c;
  const agent = editor.agent.peek();
  const unit = agent ? editor.unitOf(agent) : editor.speedUnit.peek();
  const duration = editor.scene.peek()?.duration ?? 9;
  const x1 = w - RIGHT;
  const y0 = LANE + 6;
  const y1 = h - BOTTOM;
  const top = topSpeedShown(c, unit);
  return {
    x: (t) => X0 + ((x1 - X0) * t) / duration,
    y: (v) => y1 - ((y1 - y0) * Math.min(top, Math.max(0, v))) / top,
    x1,
    y0,
    y1,
    height: h,
    top,
    unit,
    duration,
  };
}

/** A round figure above everything shown. */
function topSpeedShown(c: Context, unit: SpeedUnit): number {
  const { editor } = c;
  const log = editor.agent.peek()?.log;
  const motions: Motion[] = [...(log ? [log] : []), ...(editor.futures.peek()?.modes.map((m) => m.motion) ?? [])];
  let max = 0;
  for (const m of motions) for (const v of m.speed) max = Math.max(max, toUnit(Math.abs(v), unit));
  const steps = unit === 'm/s' ? [2, 4, 8, 16] : [20, 40, 60, 80, 120, 160, 220];
  return steps.find((s) => s >= max * 1.02) ?? steps[steps.length - 1];
}

/** Left edges of badges near their places, none on top of another: pushed right first, then back from the end. */
export function sideBySide(items: readonly { at: number; w: number }[], from: number, to: number): number[] {
  const x: number[] = [];
  items.forEach(({ at, w }, i) => {
    x[i] = Math.max(at - w / 2, i ? x[i - 1] + items[i - 1].w + 3 : from);
  });
  let limit = to;
  for (let i = items.length - 1; i >= 0; i--) {
    x[i] = Math.max(from, Math.min(x[i], limit - items[i].w));
    limit = x[i] - 3;
  }
  return x;
}
