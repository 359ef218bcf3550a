// A road user driven by any keys stays within its motion limits.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { limitsOf, topSpeed, type Typed } from '../../src/model/base/domain';
import { wrapAngle } from '../../src/model/base/geometry';
import { driveOn, type Controls, type DrivenPose } from '../../src/model/physics/steering';

const KINDS: readonly Typed[] = [
  { type: 'vehicle', subtype: 'car' },
  { type: 'vehicle', subtype: 'bus' },
  { type: 'cyclist', subtype: null },
  { type: 'pedestrian', subtype: null },
];
const at = (speed: number): DrivenPose => ({ x: 0, y: 0, heading: 0, speed, accel: 0, bend: 0 });
const NONE: Controls = { pace: 0, turn: 0, hard: false };

const sign = fc.constantFrom(-1 as const, 0 as const, 1 as const);
const controls: fc.Arbitrary<Controls> = fc.record({ pace: sign, turn: sign, hard: fc.boolean() });

describe('a driven road user', () => {
  it('keeps its motion limits, whatever is pressed', () => {
    fc.assert(
      fc.property(
        fc.constantFrom(...KINDS),
        fc.double({ min: 0, max: 1, noNaN: true }),
        fc.array(controls, { minLength: 1, maxLength: 60 }),
        (a, share, pressed) => {
          const { accel_mps2, brake_mps2, lateral_mps2, curvature_per_m } = limitsOf(a);
          let me = at(share * topSpeed(a));
          for (const c of pressed) {
            const next = driveOn(a, me, c, 0.1);
            const mean = Math.hypot(next.x - me.x, next.y - me.y) / 0.1;
            const turned = Math.abs(wrapAngle(next.heading - me.heading)) / 0.1;
            const change = (next.speed - me.speed) / 0.1;
            expect(change).toBeLessThanOrEqual(accel_mps2 + 1e-6);
            expect(change).toBeGreaterThanOrEqual(-brake_mps2 - 1e-6);
            expect(next.speed).toBeGreaterThanOrEqual(0);
            expect(next.speed).toBeLessThanOrEqual(topSpeed(a) + 1e-9);
            const faster = Math.max(next.speed, me.speed);
            expect(mean).toBeLessThanOrEqual(faster + 0.05);
            expect(turned * mean).toBeLessThanOrEqual(lateral_mps2 + 0.05);
            if (curvature_per_m !== null) expect(turned).toBeLessThanOrEqual(curvature_per_m * (faster + 0.05));
            me = next;
          }
        },
      ),
    );
  });

  it('keeps its speed and goes straight on while nothing is pressed', () => {
    const me = driveOn(KINDS[0], at(10), NONE, 2);
    expect(me.x).toBeCloseTo(20, 6);
    expect([me.y, me.heading, me.speed]).toEqual([0, 0, 10]);
  });

  it('stops and does not reverse', () => {
    const me = driveOn(KINDS[0], at(5), { ...NONE, pace: -1 }, 4);
    expect(me.speed).toBe(0);
    expect(driveOn(KINDS[0], me, { ...NONE, pace: -1 }, 1).x).toBe(me.x);
  });

  it('moves the same in one step as in frames', () => {
    const c: Controls = { pace: 1, turn: 1, hard: false };
    let frames = at(5);
    for (let i = 0; i < 60; i++) frames = driveOn(KINDS[0], frames, c, 1 / 60);
    const once = driveOn(KINDS[0], at(5), c, 1);
    expect(Math.hypot(frames.x - once.x, frames.y - once.y)).toBeLessThan(0.02);
  });

  it('turns left by the left key, on foot also where it stands', () => {
    for (const a of KINDS) expect(driveOn(a, at(3), { ...NONE, turn: 1 }, 0.5).heading).toBeGreaterThan(0.05);
    expect(driveOn(KINDS[3], at(0), { ...NONE, turn: -1 }, 0.5).heading).toBeLessThan(-0.3);
    expect(driveOn(KINDS[0], at(0), { ...NONE, turn: 1 }, 0.5).heading).toBe(0);
  });
});
