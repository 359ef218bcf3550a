// Cases shared with the server's engine (models/scene/tests/page_cases.rs): the page gives the same results.
import { describe, expect, it } from 'vitest';
import cases from '../../../assets/cases/physics.json';
import { limitsOf, THRESHOLDS } from '../../src/model/base/domain';
import { hardestBraking, motionFrom, type Motion } from '../../src/model/base/motion';
import type { Agent } from '../../src/model/document/scene';
import { gapBetween, touching } from '../../src/model/physics/boxes';
import { closestTo, timeGapOf, timeToCollision, type Driven } from '../../src/model/physics/proximity';
import { furthestReach } from '../../src/model/physics/reach';

/** Rounded values of the file, metres and seconds. */
const TOLERANCE = 1e-5;
/** A projection that ends within `goal_position_m` has reached its goal, metres. */
const REACH_TOLERANCE_M = THRESHOLDS.goal_position_m.usual + 0.01;

const near = (value: number | null | undefined, expected: number | null, tolerance = TOLERANCE): void => {
  if (expected === null) expect(value).toBeNull();
  else expect(Math.abs(value! - expected)).toBeLessThanOrEqual(tolerance);
};

const driven = ([x, y, heading, length, width, speed]: readonly number[]): Driven => ({
  pose: { x, y, heading, speed },
  length,
  width,
});

/** A road user at a steady speed for 9 s. */
function moving(id: string, [x, y, heading, length, width, speed]: readonly number[]): readonly [Agent, Motion] {
  const [vx, vy] = [speed * Math.cos(heading), speed * Math.sin(heading)];
  const column = (of: (t: number) => number): number[] => Array.from({ length: 91 }, (_, i) => of(i * 0.1));
  const motion = motionFrom({
    x_m: column((t) => x + vx * t),
    y_m: column((t) => y + vy * t),
    heading_rad: column(() => heading),
    vx_mps: column(() => vx),
    vy_mps: column(() => vy),
  });
  return [{ id, type: 'vehicle', length, width } as Agent, motion];
}

describe('the page agrees with the engine', () => {
  it.each(cases.gaps)('on the gap of two boxes: $b', ({ a, b, overlaps, gap_m }) => {
    expect(touching(driven(a), driven(b))).toBe(overlaps);
    near(gapBetween(driven(a), driven(b)), gap_m);
  });

  it.each(cases.collision_times)('on the time to collision: $a, $b', ({ a, b, ttc_s }) => {
    near(timeToCollision(driven(a), driven(b)), ttc_s);
  });

  it.each(cases.encounters)('on who passes whom, and how closely: $a, $b', ({ a, b, pet_s, gap_m }) => {
    const [one, other] = [moving('a', a), moving('b', b)];
    near(timeGapOf(one, other, 9)?.gap ?? null, pet_s);
    near(closestTo(one, [other], 9)?.gap, gap_m);
  });

  it.each(cases.brakings)('on braking at $rate_mps2 m/s²', ({ rate_mps2, hardest_mps2, harsh }) => {
    const column = Array.from({ length: 91 }, (_, i) => Math.max(0, 15 - rate_mps2 * Math.max(0, i * 0.1 - 2)));
    const still = column.map(() => 0);
    const braking = motionFrom({ x_m: still, y_m: still, heading_rad: still, vx_mps: column, vy_mps: still });
    near(hardestBraking(braking), hardest_mps2);
    expect(hardestBraking(braking) > THRESHOLDS.harsh_brake_mps2.usual).toBe(harsh);
  });

  it.each(cases.reaches)('on how far a $type gets from $speed_mps m/s in $time_s s', (c) => {
    const limits = limitsOf({ type: c.type as Agent['type'], subtype: null });
    near(furthestReach(limits, c.speed_mps, c.time_s), c.furthest_m, REACH_TOLERANCE_M);
  });
});
