// A range of one number of a road user, gone through in even steps: a variant for each value.
import { rangesOf, topSpeed } from '../base/domain';
import { setGoal, setStart } from '../document/commands';
import { startPose, type Agent, type Scene } from '../document/scene';
import { fromUnit, inTenths, num, seconds, speedLabel, type SpeedUnit, toUnit } from '../base/units';
import { TEXTS } from '../../texts/variants';

/** What is gone through: the speed at the start, the speed at the goal, the time of the goal. */
export type Over = 'start' | 'goal' | 'time';

/** From one value to another, both included, in steps; m/s or seconds. `to` may be the smaller one. */
export interface Sweep {
  readonly over: Over;
  readonly from: number;
  readonly to: number;
  readonly step: number;
}

const TIME_LEAST_S = 1;
/** A range that nobody has set yet goes so many steps to both sides. */
const USUAL_STEPS = 3;
/** Steps are at least so wide, m/s and seconds. */
export const LEAST_STEP = 0.1;

/** How wide steps usually are, in the shown unit. */
export const usualStep = (over: Over, unit: SpeedUnit): number => (over === 'time' || inTenths(unit) ? 1 : 5);

/** The number of a road user as the scene has it; null where it has none. */
export function valueOf(a: Agent, over: Over): number | null {
  if (over === 'start') return startPose(a)?.speed ?? null;
  if (over === 'goal') return a.goal.speed;
  return a.goal.pos ? a.goal.time : null;
}

/** The least and the greatest that may be asked of a road user. */
export function limitsOfSweep(a: Agent, scene: Scene, over: Over): readonly [number, number] {
  if (over === 'time') return [TIME_LEAST_S, scene.duration];
  return [Math.max(0, rangesOf(a).speed_mps[0]), topSpeed(a)];
}

/** A range around what is asked now. */
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

/** How many values a range has. */
export const countOf = ({ from, to, step }: Sweep): number => Math.floor(Math.abs(to - from) / step + 1e-6) + 1;

export function valuesOf(sweep: Sweep): number[] {
  const by = Math.sign(sweep.to - sweep.from) * sweep.step;
  return Array.from({ length: countOf(sweep) }, (_, i) => Number((sweep.from + i * by).toFixed(6)));
}

/** The document with one value of a range asked of a road user, and no future picked for it. */
export function withValue(scene: Scene, id: string, over: Over, value: number): Scene {
  const a = scene.agents.get(id)!;
  if (over === 'start') return setStart(a, { ...a.start, speed: value }).apply(scene);
  return setGoal(a, { ...a.goal, [over === 'goal' ? 'speed' : 'time']: value }).apply(scene);
}

/** What tells a variant by its number. */
export function valueWords(over: Over, value: number, unit: SpeedUnit): string {
  if (over === 'time') return TEXTS.thereAfter(Number.isInteger(value) ? `${num(value, 0)} s` : seconds(value));
  return `${over === 'start' ? TEXTS.startsAt : TEXTS.arrivesAt} ${speedLabel(value, unit)}`;
}
