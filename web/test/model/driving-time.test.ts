import { describe, expect, it } from 'vitest';
import { makeLine, type Vec } from '../../src/model/base/geometry';
import type { Lane } from '../../src/model/document/lanemap';
import { drivingTime } from '../../src/model/physics/driving-time';

const CAR = { type: 'vehicle', subtype: null } as const;
const straight = (length: number) =>
  makeLine([
    [0, 0],
    [length, 0],
  ]);
const lane = (limit: number | null) => ({ limit }) as Lane;
/** A quarter turn of this radius between two straights of 40 m. */
function corner(radius: number) {
  const arc = Array.from({ length: 30 }, (_, i): Vec => {
    const t = ((i + 1) / 30) * (Math.PI / 2);
    return [40 + radius * Math.sin(t), radius * (1 - Math.cos(t))];
  });
  return makeLine([[0, 0], [40, 0], ...arc, [40 + radius, radius + 40]]);
}

describe('the least time without haste', () => {
  it('is that of a steady drive at the limit', () => {
    const way = { line: straight(140), lanes: [lane(14)], ends: [140] };
    expect(drivingTime(CAR, way, 14)).toBeCloseTo(10, 1);
    // From rest at 3 m/s2: 14 / 3 s over 32.7 m, then 107.3 m at 14 m/s.
    expect(drivingTime(CAR, way, 0)).toBeCloseTo(14 / 3 + 107.3 / 14, 0);
  });

  it('takes each limit on its own lane', () => {
    const way = { line: straight(100), lanes: [lane(20), lane(5)], ends: [50, 100] };
    const fast = { line: straight(100), lanes: [lane(20), lane(20)], ends: [50, 100] };
    expect(drivingTime(CAR, way, 20)).toBeGreaterThan(50 / 20 + 50 / 5);
    expect(drivingTime(CAR, fast, 20)).toBeCloseTo(5, 1);
  });

  it('brakes for a corner, and for a slow end', () => {
    const [tight, wide] = [corner(8), corner(60)].map(
      (line) => drivingTime(CAR, { line, lanes: [], ends: [] }, 14) / line.length,
    );
    expect(tight).toBeGreaterThan(1.3 * wide);
    const way = { line: straight(60), lanes: [], ends: [] };
    expect(drivingTime(CAR, way, 14, 0)).toBeGreaterThan(drivingTime(CAR, way, 14) + 1);
  });

  it('is that of a brisk walk on foot', () => {
    const way = { line: straight(20), lanes: [], ends: [] };
    expect(drivingTime({ type: 'pedestrian', subtype: null }, way, 2.2)).toBeCloseTo(20 / 2.2, 1);
  });
});
