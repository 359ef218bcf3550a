// A sweep of one number of a road user in even steps: a variant for each value.
import { rangesOf, topSpeed } from '../base/domain';
import { setGoal, setStart } from '../document/commands';
import { startPose, type Agent, type Scene } from '../document/scene';
import { fromUnit, inTenths, type SpeedUnit, toUnit } from '../base/units';

/** The swept number: start speed, goal speed, goal time. */
export type Over = 'start' | 'goal' | 'time';

/** From one value to another, both included, in steps; m/s or seconds. `to` may be the smaller one. */
export interface Sweep {
  readonly over: Over;
  readonly from: number;
  readonly to: number;
  readonly step: number;
}

const TIME_LEAST_S = 1;
/** A default range covers this many steps in both directions. */
const USUAL_STEPS = 3;
/** Least step, m/s and seconds. */
export const LEAST_STEP = 0.1;

/** Default step, in the shown unit. */
export const usualStep = (over: Over, unit: SpeedUnit): number => (over === 'time' || inTenths(unit) ? 1 : 5);

/** The present value of a road user; null where it has none. */
export function valueOf(a: Agent, over: Over): number | null {
  if (over === 'start') return startPose(a)?.speed ?? null;
  if (over === 'goal') return a.goal.speed;
  return a.goal.pos ? a.goal.time : null;
}

/** Allowed range of a road user's value. */
export function limitsOfSweep(a: Agent, scene: Scene, over: Over): readonly [number, number] {
  if (over === 'time') return [TIME_LEAST_S, scene.duration];
  return [Math.max(0, rangesOf(a).speed_mps[0]), topSpeed(a)];
}

/** A default range around the present value. */
export function usualSweep(a: Agent, scene: Scene, over: Over, unit: SpeedUnit): Sweep {
  const now = valueOf(a, over) ?? startPose(a)?.speed ?? 0;
  const step = usualStep(over, unit);
  const [shown, back] =
    over === 'time' ? [now, (v: number) => v] : [toUnit(now, unit), (v: number) => fromUnit(v, unit)];
  const middle = Math.round(shown / step) * step;
  const [least, most] = limitsOfSweep(a, scene, over);
  const within = (v: number): number => Math.min(most, Math.max(least, back(v)));
  const from = within(middle - USUAL_STEPS * step);
  return { over, from, to: within(middle + USUAL_STEPS * step), step: back(step) };
}

/** Number of values of a range. */
export const countOf = ({ from, to, step }: Sweep): number => Math.floor(Math.abs(to - from) / step + 1e-6) + 1;

export function valuesOf(sweep: Sweep): number[] {
  const by = Math.sign(sweep.to - sweep.from) * sweep.step;
  return Array.from({ length: countOf(sweep) }, (_, i) => Number((sweep.from + i * by).toFixed(6)));
}

/** The document with one value of a range, and without a picked future. */
export function withValue(scene: Scene, id: string, over: Over, value: number): Scene {
  const a = scene.agents.get(id)!;
  if (over === 'start') return setStart(a, { ...a.start, speed: value }).apply(scene);
  return setGoal(a, { ...a.goal, [over === 'goal' ? 'speed' : 'time']: value }).apply(scene);
}
