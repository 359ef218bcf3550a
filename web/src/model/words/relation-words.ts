// A goal relative to another road user in words: "12 m ahead of Car 1 at 5.0 s, 4 m/s slower, 1 lane left".
import { TEXTS } from '../../texts/editing/relation';
import { lengthUnit, num, seconds, toLength, toUnit, type SpeedUnit } from '../base/units';
import type { GoalRelationJson } from '../document/scene-json';

/** At most one decimal: a typed value stays readable. */
const short = (v: number): string => num(v, Math.abs(v - Math.round(v)) < 0.05 ? 0 : 1);

/** Where the goal is, or when, from the other road user. */
function placeWords(r: Readonly<GoalRelationJson>, name: string): string {
  const gap = (m: number): string => `${short(toLength(m))} ${lengthUnit()}`;
  const time = (s: number): string => `${short(s)} s`;
  if (r.ahead_m != null) return TEXTS.ahead(gap(r.ahead_m), name);
  if (r.behind_m != null) return TEXTS.behind(gap(r.behind_m), name);
  if (r.behind_s != null) return TEXTS.behind(time(r.behind_s), name);
  const after = r.after_s ?? 0;
  return after < 0 ? TEXTS.before(time(-after), name) : TEXTS.after(time(after), name);
}

/** The whole relation; `time` is that of the goal, seconds, null where it is left out. */
export function relationWords(
  r: Readonly<GoalRelationJson>,
  name: string,
  time: number | null,
  unit: SpeedUnit,
): string {
  const at = time === null || r.after_s != null ? '' : TEXTS.at(seconds(time));
  const slower = r.slower_mps ?? 0;
  const speed = `${short(toUnit(Math.abs(slower), unit))} ${unit}`;
  const pace = slower > 0 ? TEXTS.slower(speed) : slower < 0 ? TEXTS.faster(speed) : '';
  const lanes = r.lanes_left ?? 0;
  const [n, figure] = [Math.abs(lanes), num(Math.abs(lanes), 0)];
  const side = lanes > 0 ? TEXTS.lanesLeft(n, figure) : lanes < 0 ? TEXTS.lanesRight(n, figure) : '';
  return `${placeWords(r, name)}${at}${pace}${side}`;
}
