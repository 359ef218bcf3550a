import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { clearGoal, setGoal, setVias } from '../../src/model/document/commands';
import { motionFrom } from '../../src/model/base/motion';
import { conditionOf } from '../../src/model/document/scene-writer';
import {
  heldTolerance,
  inOrder,
  passed,
  placeIn,
  readVias,
  timesOf,
  via,
  viasJson,
  withNew,
  withVia,
} from '../../src/model/document/vias';
import { mirrorAll, moveAll } from '../../src/edit/moves/several';
import { crossing } from '../helpers';

/** East from the origin, a metre a step. */
const EAST = motionFrom({
  x_m: Array.from({ length: 91 }, (_, i) => i),
  y_m: Array(91).fill(0),
  heading_rad: Array(91).fill(0),
});

const car = () => [...crossing().agents.values()].find((a) => a.kind === 'car' && !a.parked)!;

describe('via points', () => {
  it('have a passing time and distance on a motion', () => {
    const all = [via([20, 0.5]), via([60, 3]), via([40, 0], 1, 4), via([70, 0], 1, 4)];
    const seen = passed(all.slice(0, 2), EAST);
    expect(seen.map((p) => p.ok)).toEqual([true, false]);
    expect(seen[0].time).toBeCloseTo(2);
    expect(seen[1].away).toBeCloseTo(3);
    expect(passed(all.slice(2), EAST).map((p) => p.ok)).toEqual([true, false]);
  });

  it('keep a new one in the order of the path', () => {
    const all = [via([20, 0]), via([60, 0])];
    expect([5, 40, 80].map((x) => placeIn(all, EAST, [x, 0]))).toEqual([0, 1, 2]);
    expect(withNew(all, 1, via([40, 0])).map((v) => v.pos[0])).toEqual([20, 40, 60]);
    expect(withVia(all, 0, null).map((v) => v.pos[0])).toEqual([60]);
  });

  it('lose times that are out of order, and keep the rest', () => {
    const all = [via([1, 0], 1, 3), via([2, 0], 1, 5)];
    expect(inOrder(all, 9)).toBe(all);
    expect(inOrder(all, 4).map((v) => v.time)).toEqual([3, null]);
    const [from, to] = timesOf(all, 1, 9);
    expect(from).toBeCloseTo(3.1);
    expect(to).toBeCloseTo(8.9);
    const goal = setGoal(car(), { ...car().goal, via: all, time: 4 })
      .apply(crossing())
      .agents.get(car().id)!.goal;
    expect(goal.via.map((v) => v.time)).toEqual([3, null]);
  });

  it('are read back from a file, whatever it contains', () => {
    fc.assert(
      fc.property(
        fc.array(
          fc.record({
            x: fc.double({ min: -9000, max: 9000, noNaN: true }),
            y: fc.double({ min: -9000, max: 9000, noNaN: true }),
            tolerance: fc.double({ min: 0.5, max: 5, noNaN: true }),
            time: fc.option(fc.double({ min: 0.5, max: 20, noNaN: true })),
          }),
          { maxLength: 4 },
        ),
        (list) => {
          const all = list.map((v) => via([v.x, v.y], v.tolerance, v.time));
          expect(readVias(viasJson(all))).toEqual(all);
        },
      ),
    );
    fc.assert(fc.property(fc.anything(), (v) => readVias(v).length <= 4));
    expect(heldTolerance(0.1)).toBe(0.5);
    expect(heldTolerance(12)).toBe(5);
  });

  it('are sent to the generator, move and are mirrored with the goal, and stay when the goal is cleared', () => {
    const scene = crossing();
    const a = car();
    const led = setVias(a, [via([3, 4], 2)], 'led')
      .apply(scene)
      .agents.get(a.id)!;
    expect(conditionOf(led).via).toEqual([{ x_m: 3, y_m: 4, tolerance_m: 2 }]);
    const withIt = setVias(a, led.goal.via, 'led').apply(scene);
    const moved = moveAll([led], 1, 2, true)!.apply(withIt).agents.get(a.id)!;
    expect(moved.goal.via[0].pos).toEqual([4, 6]);
    const twice = [0, 1].reduce((s) => mirrorAll([s.agents.get(a.id)!])!.apply(s), withIt);
    const [x, y] = twice.agents.get(a.id)!.goal.via[0].pos;
    expect(Math.hypot(x - 3, y - 4)).toBeLessThan(1e-9);
    const goal = { ...led.goal, pos: [30, 0] as const };
    const cleared = clearGoal({ ...led, goal })
      .apply(withIt)
      .agents.get(a.id)!;
    expect(cleared.goal.pos).toBeNull();
    expect(cleared.goal.via).toEqual(led.goal.via);
  });
});
