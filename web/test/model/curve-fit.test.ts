// Infeasible parts of a speed curve, and the offered remedies.
import { describe, expect, it } from 'vitest';
import { misfitOf, type CurveRequest } from '../../src/model/physics/curve-fit';
import { limitsOf } from '../../src/model/base/domain';
import { motionOf } from '../../src/model/physics/speed-profile';
import type { SpeedPoint } from '../../src/model/document/profile';

const LIMITS = limitsOf({ type: 'vehicle', subtype: 'car' });
const path = {
  x: Array.from({ length: 201 }, (_, i) => i),
  y: Array.from({ length: 201 }, () => 0),
  heading: Array.from({ length: 201 }, () => 0),
};
const p = (t: number, v: number, hold = 0): SpeedPoint => ({ t, v, hold });
const asked = (points: readonly SpeedPoint[], goal: CurveRequest['goal'] = null): CurveRequest => ({
  profile: { path, points },
  limits: LIMITS,
  duration: 12,
  top: 40,
  goal,
});
const speedAt = (points: readonly SpeedPoint[], t: number): number =>
  motionOf({ path, points }, LIMITS, 12).speed[Math.round(t * 10)];

describe('an infeasible speed curve', () => {
  it('is none where all is feasible', () => {
    expect(misfitOf(asked([p(0, 8), p(4, 0, 3), p(9, 4)]))).toBeNull();
  });

  it('names the point that braking does not reach, and its actual speed', () => {
    const m = misfitOf(asked([p(0, 20), p(1, 0), p(9, 4)]))!;
    if (m.what !== 'braking') throw new Error(m.what);
    expect(m.point).toEqual(p(1, 0));
    expect(m.reached).toBeCloseTo(speedAt([p(0, 20), p(1, 0), p(9, 4)], 1));
    expect(m.ways.map((w) => w.kind)).toEqual(['later', 'speed']);
    for (const way of m.ways) expect(misfitOf(asked(way.points))?.what).not.toBe('braking');
  });

  it('gives a point no more time than it needs', () => {
    const [way] = misfitOf(asked([p(0, 20), p(1, 0), p(9, 4)]))!.ways;
    if (way.kind !== 'later') throw new Error(way.kind);
    const sooner = way.points.map((q, i) => (i === 1 ? { ...q, t: q.t - 0.1 } : q));
    expect(misfitOf(asked(sooner))?.what).toBe('braking');
  });

  it('offers a shorter stop where it accelerates too late', () => {
    const m = misfitOf(asked([p(0, 8), p(3, 0, 3), p(7, 12), p(12, 12)]))!;
    if (m.what !== 'gathering') throw new Error(m.what);
    const way = m.ways.find((w) => w.kind === 'shorter')!;
    expect(way.points[1].hold).toBeLessThan(3);
    expect(Math.abs(speedAt(way.points, 7) - 12)).toBeLessThan(0.31);
  });

  it('reports the distance from its goal, and each remedy arrives', () => {
    const stop = [p(0, 8), p(3, 0, 4), p(9, 4)];
    const goal = { at: [19, 0.5] as const, time: 9 };
    const m = misfitOf(asked(stop, goal))!;
    if (m.what !== 'short') throw new Error(m.what);
    const s = motionOf({ path, points: stop }, LIMITS, 12).x[90];
    expect(Math.abs(m.by - (19 - s))).toBeLessThan(0.5);
    expect(m.ways.map((w) => w.kind)).toEqual(['later', 'shorter', 'speed']);
    for (const way of m.ways) {
      const at = motionOf({ path, points: way.points }, LIMITS, 12).x[Math.round((way.goalTime ?? 9) * 10)];
      expect(at).toBeGreaterThanOrEqual(17.9);
    }
  });

  it('ignores a goal off the path', () => {
    expect(misfitOf(asked([p(0, 8), p(9, 0)], { at: [30, 20], time: 9 }))).toBeNull();
  });
});
