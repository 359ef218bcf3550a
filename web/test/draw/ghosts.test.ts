// Ghosts: fades and brake ticks.
import { describe, expect, it } from 'vitest';
import { Fades } from '../../src/draw/fades';
import { brakeTicks } from '../../src/draw/ghosts';
import type { Motion } from '../../src/model/base/motion';

const at = (id: string, x: number) => ({ id, place: { x, y: 0, heading: 0, speed: 0 } });
const seen = (f: ReturnType<Fades<ReturnType<typeof at>>['next']>) =>
  f.map(({ ghost, alpha, here }) => [ghost.id, ghost.place.x, Math.round(alpha * 100) / 100, here]);

describe('a ghost', () => {
  it('fades in, and out when it goes', () => {
    const fades = new Fades<ReturnType<typeof at>>();
    expect(seen(fades.next([at('2', 0)], 1000, false))).toEqual([['2', 0, 0, true]]);
    expect(seen(fades.next([at('2', 0)], 1045, false))).toEqual([['2', 0, 0.5, true]]);
    expect(fades.fading).toBe(true);
    expect(seen(fades.next([at('2', 0)], 1090, false))).toEqual([['2', 0, 1, true]]);
    expect(fades.fading).toBe(false);
    expect(seen(fades.next([], 1100, false))).toEqual([['2', 0, 1, false]]);
    expect(seen(fades.next([], 1145, false))).toEqual([['2', 0, 0.5, false]]);
    expect(seen(fades.next([], 1200, false))).toEqual([]);
  });

  it('slides up to two metres, and fades out and in for more', () => {
    const fades = new Fades<ReturnType<typeof at>>();
    fades.next([at('2', 0)], 0, false);
    fades.next([at('2', 0)], 100, false);
    expect(seen(fades.next([at('2', 1.9)], 116, false))).toEqual([['2', 1.9, 1, true]]);
    expect(seen(fades.next([at('2', 4)], 132, false))).toEqual([
      ['2', 1.9, 1, false],
      ['2', 4, 0, true],
    ]);
    expect(seen(fades.next([at('2', 4)], 300, false))).toEqual([['2', 4, 1, true]]);
  });

  it('appears at once with reduced motion', () => {
    const fades = new Fades<ReturnType<typeof at>>();
    expect(seen(fades.next([at('2', 0)], 0, true))).toEqual([['2', 0, 1, true]]);
    expect(seen(fades.next([at('2', 9)], 1, true))).toEqual([['2', 9, 1, true]]);
    expect([seen(fades.next([], 2, true)), fades.fading]).toEqual([[], false]);
  });
});

describe('brake ticks', () => {
  /** Brakes evenly from 10 m/s to a stop after 4 s, and stands. */
  const n = 91;
  const speed = Float64Array.from({ length: n }, (_, i) => Math.max(0, 10 - i / 4));
  const x = new Float64Array(n);
  for (let i = 1; i < n; i++) x[i] = x[i - 1] + speed[i] * 0.1;
  const zeros = new Float64Array(n);
  const braking: Motion = { first: 0, x, y: zeros, heading: zeros, speed, valid: [[0, n]] };

  it('are closer at lower speed, and only along braking', () => {
    const zoom = 8;
    const places = brakeTicks(braking, 0, 4, zoom).map((p) => p.x * zoom);
    const gaps = places.slice(1).map((p, i) => p - places[i]);
    expect(gaps.length).toBeGreaterThan(6);
    expect(gaps[0]).toBeGreaterThan(15);
    expect(gaps.at(-1)).toBeLessThan(13);
    const even: Motion = { ...braking, speed: new Float64Array(n).fill(5) };
    expect(brakeTicks(even, 0, 4, zoom)).toEqual([]);
  });
});
