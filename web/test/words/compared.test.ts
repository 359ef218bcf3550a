// A road user's motion compared with its recording, which has gaps, starts late or lasts longer.
import { describe, expect, it } from 'vitest';
import { comparedWithLog, findChanges } from '../../src/model/words/change-words';
import { emptyMotion } from '../../src/model/document/futures';
import { distances, motionFrom, type Motion } from '../../src/model/base/motion';
import { sceneKey, withAgents, type Agent } from '../../src/model/document/scene';
import { car, crossing } from '../helpers';

/** Along x at 10 m/s, recorded in these steps; elsewhere the columns hold zeros, as in files. */
function seen(steps: number, valid: [number, number][], speed = 10): Motion {
  const there = (i: number): boolean => valid.some(([a, b]) => i >= a && i < b);
  const at = Array.from({ length: steps }, (_, i) => i);
  return motionFrom({
    x_m: at.map((i) => (there(i) ? 300 + (i * speed) / 10 : 0)),
    y_m: at.map((i) => (there(i) ? 200 : 0)),
    heading_rad: at.map(() => 0),
    vx_mps: at.map((i) => (there(i) ? speed : 0)),
    vy_mps: at.map(() => 0),
    valid,
  });
}

describe('compared with the log', () => {
  const scene = crossing();
  const of = (log: Motion): Agent => ({ ...car(scene), log });
  const own = seen(91, [[0, 91]], 9);

  it('goes straight over gaps', () => {
    const gaps = seen(91, [
      [0, 20],
      [60, 91],
    ]);
    expect(distances(gaps).at(-1)).toBeCloseTo(90, 6);
    const said = comparedWithLog(of(gaps), own, 9)!;
    expect(said.words).toBe('Covers 9 m less than in the recording.');
    expect(said.d).toBeCloseTo(9, 1);
  });

  it('counts only the time in which both are present', () => {
    expect(comparedWithLog(of(seen(200, [[0, 200]])), own, 9)!.words).toBe('Covers 9 m less than in the recording.');
    // Recorded from 4.5 s on it has half of the time to fall behind.
    expect(comparedWithLog(of(seen(91, [[45, 91]])), own, 9)!.words).toBe('Covers 5 m less than in the recording.');
  });

  it('reports no delay because a recording lasts longer', () => {
    const a = of(seen(200, [[0, 200]]));
    const there = withAgents(scene, [a]);
    const motion = seen(91, [[0, 91]], 9.99);
    const modes = [{ probability: 1, motion, name: 'A' }];
    const set = {
      ...emptyMotion(sceneKey(there)),
      futures: new Map([[a.id, { modes, chosen: 0, step: 5, steps: 5 }]]),
      driving: new Set([a.id]),
    };
    expect(findChanges(there, emptyMotion(sceneKey(there)), set, new Set())).toEqual([]);
  });
});
