import { describe, expect, it } from 'vitest';
import { limitsOf } from '../../src/model/base/domain';
import {
  addedPoint,
  motionOf,
  movedPoint,
  pathOf,
  stopsOf,
  timeOfStop,
  wantedSpeed,
} from '../../src/model/physics/speed-profile';
import { readProfile } from '../../src/model/document/profile';
import { hardestBraking } from '../../src/model/base/motion';

const line = (metres: number) => ({
  x: Array.from({ length: metres + 1 }, (_, i) => i),
  y: Array.from({ length: metres + 1 }, () => 0),
  heading: Array.from({ length: metres + 1 }, () => 0),
});
const CAR = limitsOf({ type: 'vehicle', subtype: 'car' });
const stop = [
  { t: 0, v: 8, hold: 0 },
  { t: 4, v: 0, hold: 3 },
  { t: 9, v: 4, hold: 0 },
];

describe('a drawn speed profile', () => {
  it('stands exactly still during its hold, and continues', () => {
    const m = motionOf({ path: line(100), points: stop }, CAR, 9);
    const [only, ...more] = stopsOf(m);
    expect(more).toEqual([]);
    expect(only.from).toBeCloseTo(4, 1);
    expect(only.lasts).toBeCloseTo(3, 1);
    expect(new Set(m.x.slice(41, 70)).size).toBe(1);
    // Between two steps the duration is as drawn too.
    const odd = [stop[0], { t: 4.03, v: 0, hold: 2 }, stop[2]];
    const driven = motionOf({ path: line(100), points: odd }, CAR, 9);
    expect(stopsOf(driven)[0].lasts).toBeCloseTo(1.9);
    expect(stopsOf(driven, odd)[0].lasts).toBe(2);
    expect(stopsOf(driven, [stop[0], { t: 4, v: 0, hold: 5 }, stop[2]])[0].lasts).toBeCloseTo(1.9);
    expect(m.speed.at(-1)).toBeCloseTo(4);
    // The distance is the area under the curve.
    expect(m.x[40]).toBeCloseTo(16, 0);
  });

  it('brakes and accelerates no harder than the road user can', () => {
    const points = [
      { t: 0, v: 20, hold: 0 },
      { t: 0.5, v: 0, hold: 0 },
      { t: 1, v: 30, hold: 0 },
    ];
    const m = motionOf({ path: line(300), points }, CAR, 9);
    expect(hardestBraking(m)).toBeLessThanOrEqual(CAR.brake_mps2 + 1e-6);
    for (let i = 1; i < m.speed.length; i++)
      expect((m.speed[i] - m.speed[i - 1]) / 0.1).toBeLessThanOrEqual(CAR.accel_mps2 + 1e-6);
  });

  it('has constant acceleration between points, and a similar one through a point between them', () => {
    const ramp = [
      { t: 0, v: 14, hold: 2 },
      { t: 5.5, v: 0, hold: 3.5 },
    ];
    const braking = (points: typeof ramp, t: number): number =>
      (wantedSpeed(points, t - 0.05) - wantedSpeed(points, t + 0.05)) / 0.1;
    // 14 m/s in 3.5 s, half a second of which are the start and end of braking.
    for (const t of [2.6, 3.5, 4.9]) expect(braking(ramp, t)).toBeCloseTo(14 / 3);
    const through = [ramp[0], { t: 3.75, v: 7, hold: 0 }, ramp[1]];
    for (let t = 2.6; t < 4.9; t += 0.1) expect(Math.abs(braking(through, t) - 4.4)).toBeLessThan(0.5);
    for (const { t, v } of through) expect(wantedSpeed(through, t)).toBeCloseTo(v);
    // Where the speed turns it does not overshoot.
    const dip = [ramp[0], { t: 4, v: 5, hold: 0 }, { t: 6, v: 9, hold: 3 }];
    for (let t = 0; t < 9; t += 0.05) expect(wantedSpeed(dip, t)).toBeGreaterThanOrEqual(5 - 1e-9);
  });

  it('continues straight past the end of its path, and has no path in reverse', () => {
    const m = motionOf({ path: line(10), points: [{ t: 0, v: 5, hold: 0 }] }, CAR, 9);
    expect(m.x.at(-1)).toBeCloseTo(45);
    expect(pathOf({ ...m, speed: m.speed.map((v) => -v) })).toBeNull();
    expect(pathOf(m)!.x.at(-1)).toBeCloseTo(45);
  });

  it('stops with its front at the place of its dragged stop', () => {
    const profile = { path: line(100), points: stop };
    for (const place of [12, 20, 26]) {
      const t = timeOfStop(profile, 1, [place, 1], 2.4, CAR, 9);
      const points = movedPoint(stop, 1, { t }, 9);
      const [{ pose }] = stopsOf(motionOf({ ...profile, points }, CAR, 9));
      expect(Math.abs(pose.x + 2.4 - place)).toBeLessThan(0.3);
    }
  });

  it('has points that pass no other, and no two at a time', () => {
    expect(movedPoint(stop, 1, { t: 20 }, 9)[1]).toMatchObject({ t: 8.7, hold: 0 });
    expect(movedPoint(stop, 1, { t: -1 }, 9)[1].t).toBe(0.3);
    expect(movedPoint(stop, 0, { t: 3, v: 5 }, 9)[0]).toEqual({ t: 0, v: 5, hold: 0 });
    expect(movedPoint(stop, 1, { hold: 60 }, 9)[1].hold).toBeCloseTo(4.7);
    expect(addedPoint(stop, { t: 5, v: 3, hold: 0 })).toBeNull();
    expect(addedPoint(stop, { t: 2, v: 3, hold: 0 })).toMatchObject({ at: 1 });
  });

  it('is read from a file only where it is valid', () => {
    const profile = { path: line(5), points: stop };
    expect(readProfile(JSON.parse(JSON.stringify(profile)))).toEqual(profile);
    for (const bad of [null, 3, {}, { path: line(5) }, { ...profile, path: { x: [1], y: [], heading: [0] } }])
      expect(readProfile(bad)).toBeNull();
    expect(readProfile({ ...profile, points: [...stop].reverse() })).toBeNull();
  });
});
