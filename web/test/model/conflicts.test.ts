// Paths that cross within a short time: crossing and meeting count, following and much later passing do not.
import { describe, expect, it } from 'vitest';
import { conflictZones, WITHIN_S } from '../../src/model/physics/conflicts';
import { emptyMotion, type MotionSet } from '../../src/model/document/futures';
import { STEP_S, type Motion } from '../../src/model/base/motion';
import { withAgents, type Agent, type Scene } from '../../src/model/document/scene';
import { car, crossing } from '../helpers';

/** From a place in a direction at 10 m/s, starting after this many seconds. */
function going(x: number, y: number, heading: number, since = 0): Motion {
  const n = 90;
  const at = (i: number) => Math.max(0, i * STEP_S - since) * 10;
  const column = (f: (i: number) => number) => Float64Array.from({ length: n }, (_, i) => f(i));
  return {
    first: 0,
    x: column((i) => x + at(i) * Math.cos(heading)),
    y: column((i) => y + at(i) * Math.sin(heading)),
    heading: column(() => heading),
    speed: column((i) => (i * STEP_S < since ? 0 : 10)),
    valid: [[0, n]],
  };
}

/** Only two cars, each with its motion as the recording. */
function two(a: Motion, b: Motion): { scene: Scene; set: MotionSet } {
  const scene = crossing();
  const like: Agent = { ...car(scene), length: 4, placed: false, parked: false };
  const bare = { ...scene, agents: new Map(), castKey: '' };
  const both = withAgents(bare, [
    { ...like, id: 'a', log: a },
    { ...like, id: 'b', log: b },
  ]);
  return { scene: both, set: emptyMotion('') };
}

const zones = (a: Motion, b: Motion) => {
  const { scene, set } = two(a, b);
  return conflictZones(scene, set);
};

describe('conflict zones', () => {
  it('are where two paths cross, with the time between them', () => {
    const found = zones(going(-30, 0, 0), going(0, -45, Math.PI / 2));
    expect(found.length).toBeGreaterThan(0);
    for (const z of found) expect(Math.hypot(z.x, z.y)).toBeLessThan(6);
    const least = Math.min(...found.map((z) => z.gap));
    expect(least).toBeGreaterThan(0.5);
    expect(least).toBeLessThan(1.5);
  });

  it('are none where one arrives long after the other, follows it, or stands', () => {
    expect(zones(going(-30, 0, 0), going(0, -30, Math.PI / 2, WITHIN_S + 1.5))).toEqual([]);
    expect(zones(going(-30, 0, 0), going(-42, 0, 0))).toEqual([]);
    expect(zones(going(-30, 0, 0), going(0, 0, Math.PI / 2, 99))).toEqual([]);
  });

  it('have no gap where both are present at once', () => {
    const found = zones(going(-30, 0, 0), going(0, -30, Math.PI / 2));
    expect(Math.min(...found.map((z) => z.gap))).toBe(0);
  });
});
