// Traffic signals of a scene: the light at a time, and the place of the stop line.
import { makeLine, pointAt, project, type Vec } from '../base/geometry';
import { STEP_S } from '../base/motion';
import type { Lane } from '../document/lanemap';
import type { Scene, Signal } from '../document/scene';

export type Light = 'stop' | 'caution' | 'go' | 'unknown';

const LIGHTS = ['stop', 'caution', 'go'] as const;

/** The step of a time, seconds. */
const stepAt = (time: number): number => Math.floor(time / STEP_S + 1e-6);

const nameAt = ({ states }: Signal, step: number): string =>
  states.findLast(([first]) => first <= step)?.[1] ?? 'unknown';

/** The light of a state by its name. */
export const lightOf = (name: string): Light => LIGHTS.find((light) => name.includes(light)) ?? 'unknown';

export const lightAt = (signal: Signal, time: number): Light => lightOf(nameAt(signal, stepAt(time)));

/** When the next state begins, seconds; null for the last one. */
export function changesAt(signal: Signal, time: number): number | null {
  const step = stepAt(time);
  const now = nameAt(signal, step);
  const next = signal.states.find(([first, name]) => first > step && name !== now);
  return next ? next[0] * STEP_S : null;
}

/** Where its lane is stopped: as recorded, else where the lane begins. */
export function stopOf({ stop }: Signal, lane: Lane | undefined): Vec | null {
  if (stop || !lane) return stop;
  const { x, y } = pointAt(lane.line, 0);
  return [x, y];
}

/** A crosswalk belongs to the signals whose stop line is within this distance of its edge, metres. */
const OF_CROSSWALK_M = 12;

/** Do signals control the crosswalk? */
export function hasSignals({ map, signals }: Scene, crosswalk: number): boolean {
  const corners = map.crosswalks[crosswalk];
  const edge = makeLine([...corners, corners[0]]);
  return signals.some((signal) => {
    const stop = stopOf(signal, map.lanes.get(signal.lane));
    return stop !== null && project(edge, ...stop).d <= OF_CROSSWALK_M;
  });
}
