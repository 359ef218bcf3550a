// Phases of a signal: stretches of one state. An edge is the time at which the next phase begins.
import { STEP_S } from '../base/motion';
import type { Scene, Signal } from '../document/scene';
import { lightOf, type Light } from './signals';

export type SignalStates = Signal['states'];

export interface Phase {
  readonly light: Light;
  /** Seconds; the last phase lasts to the end of the time. */
  readonly from: number;
  readonly to: number;
}

/** The light after each, in a cycle. */
const NEXT: Readonly<Record<Light, Light>> = { stop: 'go', go: 'caution', caution: 'stop', unknown: 'stop' };

/** The next light of the cycle. */
export const nextLight = (light: Light): Light => NEXT[light];

/** Phases within a time, seconds. Those that begin after its end are left out. */
export function phasesOf(states: SignalStates, duration: number): Phase[] {
  const within = states.filter(([first]) => first * STEP_S <= duration + 1e-6);
  return within.map(([first, name], i) => ({
    light: lightOf(name),
    from: Math.max(0, first * STEP_S),
    to: i + 1 < within.length ? within[i + 1][0] * STEP_S : duration,
  }));
}

const same = (a: SignalStates, b: SignalStates): boolean =>
  a.length === b.length && a.every(([first, name], i) => first === b[i][0] && name === b[i][1]);

/** Lanes whose signals have the states of this one's, itself included: one signal group. */
export function groupOf({ signals }: Scene, lane: string): readonly string[] {
  const one = signals.find((s) => s.lane === lane);
  return one ? signals.filter((s) => same(s.states, one.states)).map((s) => s.lane) : [];
}

/** The edge before phase `i` at another step: after the edge before it, before the one after it. */
export function movedEdge(states: SignalStates, i: number, step: number, last: number): SignalStates {
  const least = states[i - 1][0] + 1;
  const most = i + 1 < states.length ? states[i + 1][0] - 1 : last;
  const to = Math.min(Math.max(step, least), Math.max(least, most));
  return states.map((s, k) => (k === i ? [to, s[1]] : s));
}

/** Another edge at a step, to the next light of the cycle; null where one is there, or before the first. */
export function addedEdge(states: SignalStates, step: number): SignalStates | null {
  const at = states.findLastIndex(([first]) => first < step);
  if (at < 0 || states[at + 1]?.[0] === step) return null;
  const [, name] = states[at];
  const light = lightOf(name);
  const next = light === 'unknown' ? NEXT[light] : name.replace(light, NEXT[light]);
  return [...states.slice(0, at + 1), [step, next], ...states.slice(at + 1)];
}

/** Without the edge before phase `i`: the phase before it lasts longer. */
export const removedEdge = (states: SignalStates, i: number): SignalStates =>
  // Two phases of one state are one.
  states.filter((_, k) => k !== i).filter(([, name], k, all) => !k || all[k - 1][1] !== name);

/** Signals with other states on these lanes. */
export const withStates = (
  signals: Scene['signals'],
  lanes: readonly string[],
  states: SignalStates,
): Scene['signals'] => signals.map((s) => (lanes.includes(s.lane) ? { ...s, states, edited: true } : s));
