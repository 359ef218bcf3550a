import { describe, expect, it } from 'vitest';
import { setSignals } from '../../src/model/document/commands';
import { applyDiff, diffOf } from '../../src/model/document/scene-diff';
import { sceneKey, type Scene } from '../../src/model/document/scene';
import { timedJson } from '../../src/model/document/scene-writer';
import {
  addedEdge,
  groupOf,
  movedEdge,
  phasesOf,
  removedEdge,
  withStates,
  type SignalStates,
} from '../../src/model/physics/signal-phases';
import { hasSignals } from '../../src/model/physics/signals';
import type { Vec } from '../../src/model/base/geometry';
import { crossing } from '../helpers';

const CYCLE: SignalStates = [
  [0, 'go'],
  [40, 'caution'],
  [70, 'stop'],
];

const withSignals = (): Scene => {
  const states = CYCLE;
  const signals = ['a', 'b', 'c'].map((lane) => ({ lane, stop: null, states }));
  signals[2] = { ...signals[2], states: [[0, 'stop']] };
  return { ...crossing(), signals };
};

describe('phases of a signal', () => {
  it('last until the next one begins, the last one to the end', () => {
    expect(phasesOf(CYCLE, 9).map(({ light, from, to }) => [light, from, to])).toEqual([
      ['go', 0, 4],
      ['caution', 4, 7],
      ['stop', 7, 9],
    ]);
    expect(phasesOf(CYCLE, 5)).toHaveLength(2);
  });

  it('have edges that stay in order', () => {
    expect(movedEdge(CYCLE, 1, 20, 90)[1]).toEqual([20, 'caution']);
    expect(movedEdge(CYCLE, 1, 80, 90)[1][0]).toBe(69);
    expect(movedEdge(CYCLE, 1, -5, 90)[1][0]).toBe(1);
    expect(movedEdge(CYCLE, 2, 200, 90)[2][0]).toBe(90);
  });

  it('are added in the order of lights, arrows as arrows, and removed', () => {
    expect(addedEdge(CYCLE, 85)).toEqual([...CYCLE, [85, 'go']]);
    expect(addedEdge([[0, 'arrow_go']], 30)).toEqual([
      [0, 'arrow_go'],
      [30, 'arrow_caution'],
    ]);
    expect(addedEdge(CYCLE, 40)).toBeNull();
    expect(removedEdge(CYCLE, 1)).toEqual([CYCLE[0], CYCLE[2]]);
    // The phases around it show the same light: they become one.
    expect(removedEdge([...CYCLE.slice(0, 2), [70, 'go']], 1)).toEqual([CYCLE[0]]);
  });

  it('change for a whole group, in the key, the file and the history', () => {
    const scene = withSignals();
    expect(groupOf(scene, 'a')).toEqual(['a', 'b']);
    const command = setSignals(scene, withStates(scene.signals, ['a', 'b'], movedEdge(CYCLE, 1, 20, 90)));
    const after = command.apply(scene);
    expect(after.drawn).toBe(scene.drawn + 1);
    expect(command.invert(scene).apply(after).signals).toBe(scene.signals);
    const other = setSignals(scene, withStates(scene.signals, ['a', 'b'], movedEdge(CYCLE, 1, 21, 90))).apply(scene);
    expect(new Set([scene, after, other].map(sceneKey)).size).toBe(3);
    const raw = { signals: scene.signals.map(({ lane, states }) => ({ lane, stop_m: [1, 2, 3], states })) };
    const json = timedJson(raw as never, after).signals!;
    expect(json.map((s) => s.states[1]?.[0])).toEqual([20, 20, undefined]);
    expect(json[0].stop_m).toEqual([1, 2, 3]);
    const diff = structuredClone(diffOf(scene, after));
    expect(applyDiff(scene, diff, 'forth').signals).toEqual(after.signals);
    expect(applyDiff(after, diff, 'back').signals).toEqual(scene.signals);
  });
});

describe('the signals of a crosswalk', () => {
  it('are those whose stop line is near', () => {
    const scene = crossing();
    const square = (x: number): Vec[] => [
      [x, 0],
      [x + 4, 0],
      [x + 4, 10],
      [x, 10],
    ];
    const map = { ...scene.map, crosswalks: [square(0), square(60)] };
    const of: Scene = { ...scene, map, signals: [{ lane: 'a', stop: [-3, 5], states: CYCLE }] };
    expect([hasSignals(of, 0), hasSignals(of, 1)]).toEqual([true, false]);
  });
});
