import type { ByRoadJson, GoalJson, ModeJson } from '../../src/model/document/scene-json';
export const MEDIAN: string;
export function judged(
  modes: ModeJson[],
  others: readonly [string, string],
  hit?: boolean,
  mayCross?: readonly string[],
): ModeJson[];
export function byRoad(goal: GoalJson): ByRoadJson;
