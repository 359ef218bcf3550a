import type { ByRoadJson, GoalJson, ModeJson } from '../../src/model/json';
export function judged(modes: ModeJson[], others: readonly [string, string], hit?: boolean): ModeJson[];
export function byRoad(goal: GoalJson): ByRoadJson;
