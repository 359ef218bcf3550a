// Filling an area: drawn outlines, distribution of kinds, pins that stay.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { FillAnswers } from '../../src/edit/tools/filling/fill-answer';
import { FILL_KINDS, EVEN_MIX, shareOf, typesOf } from '../../src/edit/tools/filling/fill-mix';
import { recast, thinned } from '../../src/edit/tools/filling/fill-recast';
import { armHandleAt, armHandles, rateAfter } from '../../src/edit/tools/filling/arm-handles';
import { ANY_SPEED, Filling, NO_ANSWER, type EntryArm } from '../../src/edit/tools/filling/filling';
import { Editor } from '../../src/edit/session/editor';
import { simplified } from '../../src/edit/tools/filling/fill-gesture';
import { inTheWay } from '../../src/edit/moves/room';
import type { Vec } from '../../src/model/base/geometry';
import { PRESETS } from '../../src/model/base/kinds';
import { View } from '../../src/draw/view';
import { motionFrom } from '../../src/model/base/motion';
import { comesLater, newcomer, settle, type Newcomer } from '../../src/model/document/newcomer';
import { readScene } from '../../src/model/document/scene-reader';
import { touched } from '../../src/model/document/scene';
import { wholeAgentJson } from '../../src/model/document/scene-writer';
import { crossingJson } from '../helpers';

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

  it('uses longer ones only where they overlap no road user', () => {
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

describe('the answer of the server', () => {
  it.each([
    [0, 3],
    [1, 4],
    [2, 5],
    [9, 5],
  ])('keeps the number: with %i places missing, %i road users beside two pinned ones', async (unplaced, count) => {
    const drawn = Array.from({ length: 5 }, (_, i) => wholeAgentJson(settle(carAt(400 + 20 * i, 300), `new-${i}`)));
    const reply = { agents: drawn, unplaced, reason: null, arms: [], parking_places: 0 };
    const json = crossingJson();
    const answers = new FillAnswers(
      { raw: json, sentMap: () => json.map } as never,
      { place: () => Promise.resolve(reply) } as never,
    );
    const filling = new Filling(new Editor());
    filling.open(1);
    const wish = { ...filling.wish.peek()!, pinned: [carAt(400, 350), carAt(440, 350)] };
    const { all } = await answers.to(readScene(json), wish, new AbortController().signal);
    expect(all).toHaveLength(count);
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
    const f = new Filling(new Editor());
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
  it('keeps pinned road users, first in the list, and drops all when it is closed', () => {
    const f = new Filling(new Editor());
    f.open(1);
    const all = [carAt(0), carAt(20), carAt(40)];
    f.settle({ ...NO_ANSWER, all });
    f.togglePin(f.at([20.5, 0.4])!);
    expect(f.all.value.map((n) => n.pose.x)).toEqual([20, 0, 40]);
    f.shuffle();
    f.settle({ ...NO_ANSWER, all: [carAt(70)] });
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

const still = (x: number, first = 0): Newcomer => {
  const ten = (v: number): number[] => Array.from({ length: 10 }, () => v);
  const motion = motionFrom({
    first_step: first,
    x_m: first ? Array.from({ length: 10 }, (_, i) => x + i) : ten(x),
    y_m: ten(0),
    heading_rad: ten(0),
    vx_mps: ten(first ? 10 : 0),
    vy_mps: ten(0),
  });
  return { ...carAt(x), motion, parked: first === 0 };
};

describe('parked road users and late arrivals', () => {
  it('are added with their motion, and without conditions', () => {
    const [parked, late] = [settle(still(5), '7'), settle(still(-90, 30), '8')];
    expect([parked.parked, parked.placed, touched(parked)]).toEqual([true, false, false]);
    expect(parked.logStart).toMatchObject({ x: 5, speed: 0 });
    expect([late.logStart, late.start.pos, late.placed]).toEqual([null, null, false]);
    const json = wholeAgentJson(late);
    expect([json.id, json.track.first_step, json.track.x_m.length]).toEqual(['8', 30, 10]);
    expect(json.conditions).toEqual({});
  });

  it('keep their kind, and are not under the pointer before they arrive', () => {
    const heavy = { ...EVEN_MIX, car: 0, heavy: 50, motorcycle: 0, cyclist: 0, pedestrian: 0 };
    const all = [carAt(-40), still(5), still(-90, 30)];
    expect(recast(all, heavy, []).map((n) => n.kind)).toEqual(['truck', 'car', 'car']);
    const f = new Filling(new Editor());
    f.open(1);
    f.settle({ ...NO_ANSWER, all });
    expect(f.at([5, 0])).toBe(all[1]);
    expect(comesLater(all[2]) && f.at([-90, 0])).toBeNull();
  });
});

describe('arms', () => {
  const west: EntryArm = { id: 'west', title: 'West', at: [-50, 0], heading: 0, most: 2400, placed: 0, later: 0 };
  const north: EntryArm = {
    id: 'north-east-2',
    title: 'North-east 2',
    at: [0, 30],
    heading: -Math.PI / 2,
    most: 4800,
    placed: 2,
    later: 1,
  };

  it('have handles that move outward with the rate and stay in the picture', () => {
    const v = new View();
    for (const rate of [0, 600, 2400]) {
      const [w, n] = armHandles([west, north], { west: rate, 'north-east-2': rate }, v);
      expect(w.at[0]).toBeCloseTo(w.base[0] - (110 * rate) / 2400);
      expect(n.at[1]).toBeCloseTo(n.base[1] - (110 * rate) / 4800);
      for (const h of [w, n]) {
        expect(h.at[0]).toBeGreaterThanOrEqual(29.9);
        expect(h.at[1]).toBeGreaterThanOrEqual(29.9);
      }
      expect(armHandleAt([w, n], n.at[0] + 5, n.at[1], 13)?.arm).toBe(north);
      expect(armHandleAt([w, n], 300, 300, 13)).toBeNull();
    }
    expect(armHandles([{ ...west, at: [-500, 0] }], {}, v)).toEqual([]);
  });

  it('take dragged rates between zero and the capacity of their lanes', () => {
    fc.assert(
      fc.property(fc.integer({ min: 0, max: 2400 }), fc.integer({ min: -500, max: 500 }), (before, px) => {
        const rate = rateAfter(before, px, west);
        expect(rate % 20 === 0 && rate >= 0 && rate <= 2400).toBe(true);
        expect(Math.sign(rateAfter(1200, px, west) - 1200) * Math.sign(px)).toBeGreaterThanOrEqual(0);
      }),
    );
  });

  it('are stored by name, and speeds keep their order', () => {
    const f = new Filling(new Editor());
    f.open(1);
    f.setRate('west', 600);
    f.setSpeeds([20, 5]);
    expect(f.wish.value!.rates).toEqual({ west: 600 });
    expect(f.wish.value!.speeds).toEqual([5, 20]);
    f.close();
    f.open(2);
    expect(f.wish.value!.rates).toEqual({});
    expect(f.wish.value!.speeds).toEqual(ANY_SPEED);
  });
});
