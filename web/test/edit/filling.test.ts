// Filling an area: outlines drawn by hand, kinds shared out, pins that stay.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { FILL_KINDS, EVEN_MIX, recast, shareOf, thinned, typesOf } from '../../src/edit/fill-mix';
import { Filling } from '../../src/edit/filling';
import { simplified } from '../../src/edit/gestures/filling';
import { inTheWay } from '../../src/edit/room';
import type { Vec } from '../../src/model/geometry';
import { PRESETS } from '../../src/model/kinds';
import { newcomer } from '../../src/model/newcomer';

const carAt = (x: number, y = 0) => newcomer('car', PRESETS.car[0], { x, y, heading: 0, speed: 10 });

describe('a mix of kinds', () => {
  it('has shares that sum to one', () => {
    fc.assert(
      fc.property(fc.record(Object.fromEntries(FILL_KINDS.map((k) => [k, fc.nat(100)]))), (mix) => {
        const t = typesOf(mix as never);
        if (Object.values(mix).some((v) => v)) expect(t.vehicle + t.cyclist + t.pedestrian).toBeCloseTo(1, 9);
        expect(Math.min(t.vehicle, t.cyclist, t.pedestrian)).toBeGreaterThanOrEqual(0);
      }),
    );
    expect(shareOf(EVEN_MIX, 'car')).toBeCloseTo(0.7);
  });

  it('puts longer ones only where they touch nobody', () => {
    const heavy = { ...EVEN_MIX, car: 50, heavy: 50, motorcycle: 0, cyclist: 0, pedestrian: 0 };
    const roomy = recast(
      Array.from({ length: 10 }, (_, i) => carAt(i * 40)),
      heavy,
      [],
    );
    expect(roomy.filter((n) => n.kind === 'truck' || n.kind === 'bus')).toHaveLength(5);
    expect(roomy.map((n) => n.pose.x)).toEqual(Array.from({ length: 10 }, (_, i) => i * 40));
    const dense = recast(
      Array.from({ length: 10 }, (_, i) => carAt(i * 5)),
      heavy,
      [],
    );
    for (const n of dense)
      expect(
        inTheWay(
          n,
          dense.filter((o) => o !== n),
        ),
      ).toBeUndefined();
    const taken = [{ pose: { x: 5, y: 0, heading: 0 }, length: 4, width: 2 }];
    expect(recast([carAt(0)], { ...heavy, car: 0 }, taken)[0].kind).toBe('car');
  });
});

describe('an outline drawn by hand', () => {
  it('keeps its ends and stays within the tolerance', () => {
    const point = fc.tuple(fc.integer({ min: -50, max: 50 }), fc.integer({ min: -50, max: 50 }));
    fc.assert(
      fc.property(fc.array(point, { minLength: 2, maxLength: 60 }), (line) => {
        const out = simplified(line as Vec[], 3);
        expect(out[0]).toEqual(line[0]);
        expect(out.at(-1)).toEqual(line.at(-1));
        expect(out.length).toBeLessThanOrEqual(line.length);
        for (const p of out) expect(line).toContainEqual(p);
      }),
    );
    const straight: Vec[] = Array.from({ length: 40 }, (_, i) => [i, i % 2 ? 0.1 : 0]);
    expect(simplified(straight, 1)).toHaveLength(2);
  });

  it('is an area only with an inside', () => {
    const f = new Filling();
    f.open(3);
    f.addCorner([0, 0]);
    f.addCorner([20, 0]);
    expect(f.closeOutline()).toBe(false);
    expect(f.wish.value!.region).toBeNull();
    for (const p of [
      [0, 0],
      [20, 0],
      [20, 9],
    ] as Vec[])
      f.addCorner(p);
    expect(f.closeOutline()).toBe(true);
    expect(f.wish.value!.region).toHaveLength(3);
    expect(f.drawn.value).toBeNull();
  });
});

describe('a preview', () => {
  it('keeps whoever is pinned, first in the list, and forgets all when it is closed', () => {
    const f = new Filling();
    f.open(1);
    const all = [carAt(0), carAt(20), carAt(40)];
    f.settle({ all, reason: null, replaced: [] });
    f.togglePin(f.at([20.5, 0.4])!);
    expect(f.all.value.map((n) => n.pose.x)).toEqual([20, 0, 40]);
    f.shuffle();
    f.settle({ all: [carAt(70)], reason: null, replaced: [] });
    expect(f.all.value.map((n) => n.pose.x)).toEqual([20, 70]);
    f.togglePin(f.all.value[0]);
    expect(f.wish.value!.pinned).toEqual([]);
    expect(f.all.value).toHaveLength(2);
    f.close();
    expect(f.wish.value).toBeNull();
    expect(f.all.value).toEqual([]);
  });
});

describe('too many at once', () => {
  it('leaves an even share', () => {
    const all = Array.from({ length: 256 }, (_, i) => i);
    const some = thinned(all, 100);
    expect(some).toHaveLength(100);
    for (let from = 0; from < 256; from += 64) {
      const there = some.filter((i) => i >= from && i < from + 64);
      expect(Math.abs(there.length - 25)).toBeLessThanOrEqual(1);
    }
    expect(thinned([1, 2], 5)).toEqual([1, 2]);
  });
});
