// Boxes on the ground: overlap, distance, and the closest approach of several.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { gapAtLeast, gapBetween, touching, type Footprint } from '../../src/model/physics/boxes';
import { closestOf, gapNow, timeGapOf, timeToCollision } from '../../src/model/physics/proximity';
import { KIND_NAMES, kindsWords } from '../../src/model/base/kinds';
import { newcomer, settle } from '../../src/model/document/newcomer';
import { PRESETS } from '../../src/model/base/kinds';
import { motionFrom, type Motion } from '../../src/model/base/motion';
import type { Agent } from '../../src/model/document/scene';
import { ghostAt, firstChoice } from '../../src/edit/moves/placing';
import { crossing } from '../helpers';

const box = (x: number, y: number, heading = 0, length = 4, width = 2): Footprint => ({
  pose: { x, y, heading },
  length,
  width,
});
const anyBox = fc
  .tuple(
    fc.double({ min: -20, max: 20, noNaN: true }),
    fc.double({ min: -20, max: 20, noNaN: true }),
    fc.double({ min: -4, max: 4, noNaN: true }),
    fc.double({ min: 0.3, max: 15, noNaN: true }),
    fc.double({ min: 0.3, max: 3, noNaN: true }),
  )
  .map(([x, y, h, l, w]) => box(x, y, h, l, w));

describe('boxes', () => {
  it('know how far they are apart', () => {
    expect(gapBetween(box(0, 0), box(10, 0))).toBeCloseTo(6);
    expect(gapBetween(box(0, 0), box(0, 5, Math.PI / 2))).toBeCloseTo(2);
    expect(gapBetween(box(0, 0), box(3, 0))).toBe(0);
    expect(gapBetween(box(0, 0), box(0.2, 0.1, 1, 1, 1))).toBe(0);
    expect(gapBetween(box(0, 0, 0, 2, 2), box(4, 4, 0, 2, 2))).toBeCloseTo(Math.hypot(2, 2));
  });

  it('agree on it from both sides, with touching, and with what is known at least', () => {
    fc.assert(
      fc.property(anyBox, anyBox, (a, b) => {
        const gap = gapBetween(a, b);
        expect(gapBetween(b, a)).toBeCloseTo(gap, 6);
        expect(gap).toBeGreaterThanOrEqual(gapAtLeast(a, b) - 1e-6);
        expect(touching(a, b)).toBe(touching(b, a));
        expect(touching(a, b)).toBe(gap === 0);
      }),
      { numRuns: 2000 },
    );
  });
});

/** Straight on from a place, for 9 s. */
function straight(
  kind: 'car' | 'pedestrian',
  id: string,
  x: number,
  y: number,
  vx: number,
  vy: number,
): [Agent, Motion] {
  const heading = Math.atan2(vy, vx);
  const a = settle(newcomer(kind, PRESETS[kind][0], { x, y, heading, speed: Math.hypot(vx, vy) }), id);
  const column = (f: (t: number) => number) => Array.from({ length: 91 }, (_, i) => f(i / 10));
  const motion = motionFrom({
    x_m: column((t) => x + vx * t),
    y_m: column((t) => y + vy * t),
    heading_rad: column(() => heading),
    vx_mps: column(() => vx),
    vy_mps: column(() => vy),
  });
  return [a, motion];
}

describe('the closest moment', () => {
  it('is found between the closest two, with its time', () => {
    const found = closestOf(
      [straight('car', '1', 0, 0, 10, 0), straight('car', '2', 50, 30, 0, -5), straight('car', '3', 0, 80, 10, 0)],
      9,
    )!;
    expect([found.a.id, found.b.id]).toEqual(['1', '2']);
    expect(found.time).toBeGreaterThan(4);
    expect(found.time).toBeLessThan(7);
  });

  it('is between unlike types where there are some, and none for a single one or for too many', () => {
    const crowd = [straight('pedestrian', '1', 20, 0, 0, 1), straight('pedestrian', '2', 20.9, 0, 0, 1)];
    const car = straight('car', '3', 0, 0, 4, 0);
    expect(closestOf(crowd, 9)!.gap).toBeLessThan(0.1);
    const mixed = closestOf([...crowd, car], 9)!;
    expect([mixed.a.id, mixed.b.id]).toContain('3');
    expect(closestOf([car], 9)).toBeNull();
    expect(closestOf(Array(81).fill(car), 9)).toBeNull();
    expect(gapNow([box(0, 0)])).toBeNull();
    expect(gapNow([box(0, 0), box(10, 0), box(40, 0)])).toBeCloseTo(6);
  });
});

describe('the time between two', () => {
  // One drives east along y = 0 at 10 m/s, the other comes from the south along x = 40.
  const east = straight('car', '1', 0, 0, 10, 0);
  const north = (y: number): readonly [Agent, Motion] => straight('car', '2', 40, y, 0, 10);

  it('is from the one leaving the ground to the other coming to it', () => {
    const found = timeGapOf(east, north(-61), 9)!;
    const half = (a: Agent): number => (a.length + a.width) / 2;
    // The rear of one leaves at 4 s and half a box, the front of the other comes at 6.1 s less half a box.
    expect(Math.abs(found.gap - (2.1 - (half(east[0]) + half(north(0)[0])) / 10))).toBeLessThan(0.11);
    expect([found.first.id, found.second.id]).toEqual(['1', '2']);
    expect(found.time).toBeGreaterThan(5);
    expect(timeGapOf(north(-61), east, 9)).toEqual(found);
  });

  it('is that of one behind the other on one lane', () => {
    const behind = straight('car', '2', -20, 0, 10, 0);
    const found = timeGapOf(behind, east, 9)!;
    expect(found.first.id).toBe('1');
    expect(Math.abs(found.gap - (2 - east[0].length / 10))).toBeLessThan(0.11);
  });

  it('is at each moment the time left at constant velocities', () => {
    const driven = (x: number, speed: number) => {
      const { pose, ...rest } = box(x, 0);
      return { ...rest, pose: { ...pose, speed } };
    };
    expect(timeToCollision(driven(0, 10), driven(24, 0))).toBeCloseTo(2);
    expect(timeToCollision(driven(24, 0), driven(0, 10))).toBeCloseTo(2);
    expect(timeToCollision(driven(0, 10), driven(24, 10))).toBeNull();
    expect(timeToCollision(driven(0, 10), driven(3, 0))).toBeNull();
  });

  it('is none where they overlap, share no ground, or one stands', () => {
    expect(timeGapOf(east, north(-40), 9)).toBeNull();
    expect(timeGapOf(east, straight('car', '2', 0, 6, 10, 0), 9)).toBeNull();
    expect(timeGapOf(east, straight('car', '2', 40, 0, 0, 0), 3)).toBeNull();
  });
});

describe('words', () => {
  it('count kinds, most first', () => {
    expect(kindsWords(['car'])).toBe('1 car');
    expect(kindsWords(['pedestrian', 'cyclist', 'pedestrian'])).toBe('2 pedestrians, 1 cyclist');
    expect(kindsWords(['bus', 'bus'])).toBe('2 buses');
    expect(kindsWords(Object.keys(KIND_NAMES) as 'car'[])).toBe('1 car, 1 truck and 5 more types');
  });
});

describe('a ghost', () => {
  const scene = crossing();
  const lane = [...scene.map.lanes.values()].find((l) => l.kind === 'road' && l.line.length > 60)!;

  it('drives with the lane, at its speed, and no faster than the road user ahead allows', () => {
    const empty = { ...scene, agents: new Map() };
    const [x, y] = lane.line.pts[0];
    const free = ghostAt(empty, firstChoice('car'), [x, y], { zoom: 8 });
    expect(free.pose.speed).toBeCloseTo(lane.limit ?? PRESETS.car[0].speed);
    const { heading } = free.pose;
    const standing = settle(
      newcomer('car', PRESETS.car[0], {
        ...free.pose,
        x: free.pose.x + 12 * Math.cos(heading),
        y: free.pose.y + 12 * Math.sin(heading),
        speed: 0,
      }),
      '900',
    );
    const behind = ghostAt({ ...empty, agents: new Map([['900', standing]]) }, firstChoice('car'), [x, y], { zoom: 8 });
    expect(behind.pose.speed).toBeLessThan(Math.sqrt(2 * 3 * 8));
    expect(behind.pose.speed).toBeGreaterThan(3);
  });
});
