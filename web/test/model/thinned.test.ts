import { describe, expect, it } from 'vitest';
import { thinned, type Vec } from '../../src/model/base/geometry';

const kept = (points: readonly Vec[], tolerance = 0.05): Vec[] => {
  const out: Vec[] = [];
  thinned(
    0,
    points.length - 1,
    (i) => points[i],
    tolerance,
    (p) => out.push(p),
  );
  return out;
};

/** Distance of a point from a polyline. */
const off = (line: readonly Vec[], [x, y]: Vec): number =>
  Math.min(
    ...line.slice(1).map(([bx, by], i) => {
      const [ax, ay] = line[i];
      const [dx, dy] = [bx - ax, by - ay];
      const k = Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
      return Math.hypot(x - ax - k * dx, y - ay - k * dy);
    }),
  );

describe('a line in few points', () => {
  it('keeps only the ends where it is straight', () => {
    const straight = Array.from({ length: 90 }, (_, i): Vec => [i * 3.7, 100 - i * 1.3]);
    expect(kept(straight)).toEqual([straight[0], straight[89]]);
  });

  it('misses no point by more than the tolerance', () => {
    const curve = Array.from({ length: 90 }, (_, i): Vec => [300 * Math.cos(i / 75), 200 * Math.sin(i / 54)]);
    const few = kept(curve);
    expect(few.length).toBeLessThan(60);
    for (const p of curve) expect(off(few, p)).toBeLessThanOrEqual(0.0501);
  });

  it('keeps points where it turns back, and a single point', () => {
    const there: Vec[] = [
      [0, 0],
      [5, 0],
      [10, 0],
      [7, 0],
      [3, 0],
    ];
    expect(kept(there)).toEqual([
      [0, 0],
      [10, 0],
      [3, 0],
    ]);
    expect(kept([[4, 2]])).toEqual([[4, 2]]);
  });

  it('handles a line in one place', () => {
    expect(kept(Array.from({ length: 20 }, (): Vec => [3, 3]))).toHaveLength(2);
  });
});
