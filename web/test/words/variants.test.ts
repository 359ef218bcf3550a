// Variants: they are restored exactly, kept ones are never overwritten, names and moments distinguish them.
import { describe, expect, it } from 'vitest';
import { choose, patchScene, setGoal } from '../../src/model/document/commands';
import type { TrafficEvent } from '../../src/model/words/event-words';
import { emptyMotion, type Futures, type MotionSet } from '../../src/model/document/futures';
import { comparisonOf } from '../../src/model/words/comparison';
import { comparisonRows } from '../../src/model/words/comparison-table';
import { motionFrom, type Motion } from '../../src/model/base/motion';
import { readScene } from '../../src/model/document/scene-reader';
import { sceneKey, startPose, type Agent, type Scene } from '../../src/model/document/scene';
import {
  countOf,
  limitsOfSweep,
  usualSweep,
  valueOf,
  valuesOf,
  withValue,
  type Over,
  type Sweep,
} from '../../src/model/physics/sweep';
import { nameVariants, type Nameless } from '../../src/model/words/variant-names';
import {
  keepAsVariant,
  keyOfVariant,
  MOST_VARIANTS,
  patchVariant,
  replaceVariants,
  sceneOfVariant,
  stateOfVariant,
} from '../../src/model/document/variants';
import { writeScene } from '../../src/model/document/scene-writer';
import type { SceneJson } from '../../src/model/document/scene-json';
import { car, crossing, crossingJson, walker } from '../helpers';

const withSeed = (s: Scene, seed: number): Scene => patchScene('', { seed, drawn: 1 }).apply(s);
const states = (s: Scene, ...seeds: number[]) => seeds.map((n) => stateOfVariant(withSeed(s, n), null));
const run = (s: Scene, ...seeds: number[]): Scene => replaceVariants(s, states(s, ...seeds)).apply(s);

/** The same scene with a goal for its car, and the second of its futures picked. */
const asked = (s: Scene): Scene => {
  const a = car(s);
  const p = startPose(a)!;
  const moved = setGoal(a, { ...a.goal, pos: [p.x + 20, p.y + 1], heading: 0.25 }).apply(s);
  return choose(car(moved), 1, 'B').apply(moved);
};

describe('variants in the document', () => {
  it('stand for exactly the document that they were made from, whatever was changed since', () => {
    const start = crossing();
    const there = asked(withSeed(start, 7));
    const state = stateOfVariant(there, car(there).id);
    expect(keyOfVariant(start, state)).toBe(sceneKey(there));
    const other = asked(withSeed(start, 3));
    expect(
      sceneKey(sceneOfVariant(setGoal(walker(other), { ...walker(other).goal, heading: 1 }).apply(other), state)),
    ).toBe(sceneKey(there));
  });

  it('leave kept and starred ones, and number new ones upwards', () => {
    let s = run(crossing(), 1, 2, 3);
    s = patchVariant(s, 2, { kept: true }, '').apply(s);
    s = patchVariant(s, 3, { starred: true, called: 'Mine' }, '').apply(s);
    const next = run(s, 8, 9);
    expect(next.variants.map((v) => v.id)).toEqual([2, 3, 4, 5]);
    expect(next.variants[1]).toEqual({ id: 3, called: 'Mine', kept: false, starred: true });
    expect(next.variants.map((v) => next.variantStates[v.id].seed)).toEqual([2, 3, 8, 9]);
    expect(Object.keys(next.variantStates)).toHaveLength(4);
  });

  it('are bounded', () => {
    let s = crossing();
    for (let i = 0; i < MOST_VARIANTS; i++) s = keepAsVariant(s, '')!.apply(s);
    expect(keepAsVariant(s, '')).toBeNull();
    expect(run(s, 1, 2).variants).toHaveLength(MOST_VARIANTS);
  });

  it('are read back from a file', () => {
    const raw = crossingJson();
    let s = run(asked(readScene(raw)), 5, 6);
    s = patchVariant(s, 1, { kept: true, called: 'Wide' }, '').apply(s);
    const back = readScene(JSON.parse(JSON.stringify(writeScene(raw, s, null))) as SceneJson);
    expect(back.variants).toEqual(s.variants);
    for (const v of s.variants)
      expect(keyOfVariant(back, back.variantStates[v.id])).toBe(keyOfVariant(s, s.variantStates[v.id]));
  });

  it.each([
    ['no list', 7],
    ['not objects', [null, 3, 'x', []]],
    ['without what they need', [{ id: 1 }, { id: 2, seed: 1 }, { id: 0, seed: 1, roster: '' }]],
    ['numbers that are none', [{ id: 1, seed: -1, roster: '' }, { id: 1, seed: 1e99, roster: '' }, { id: '1' }]],
    ['conditions that are none', [{ id: 1, seed: 1, roster: '', conditions: { 1: null, 2: 7, nobody: {} } }]],
  ])('are read with care: %s', (_, variants) => {
    const raw = crossingJson() as SceneJson & { x_editor?: unknown };
    raw.x_editor = { variants } as never;
    const s = readScene(raw);
    for (const v of s.variants) expect(() => keyOfVariant(s, s.variantStates[v.id])).not.toThrow();
    expect(s.variants.length).toBeLessThanOrEqual(1);
  });

  it('keep one of two with the same number, up to the limit', () => {
    const raw = crossingJson() as SceneJson & { x_editor?: unknown };
    const one = (id: number) => ({ id, seed: 1, roster: '', diversity: 99 });
    raw.x_editor = { variants: [one(1), one(1), ...Array.from({ length: 90 }, (_, i) => one(i + 1))] } as never;
    const s = readScene(raw);
    expect(s.variants).toHaveLength(MOST_VARIANTS);
    expect(s.variantStates[1].diversity).toBe(2);
  });
});

/** Along its heading, with a speed for every second. */
function drive(a: Agent, speeds: readonly number[], turn = 0): Motion {
  const p = startPose(a)!;
  const [x, y, heading, vx, vy]: number[][] = [[], [], [], [], []];
  let [px, py, h] = [p.x, p.y, p.heading];
  for (let i = 0; i <= 90; i++) {
    const v = speeds[Math.min(speeds.length - 1, Math.floor(i / 10))];
    x.push(px);
    y.push(py);
    heading.push(h);
    vx.push(v * Math.cos(h));
    vy.push(v * Math.sin(h));
    h += turn / 90;
    px += v * 0.1 * Math.cos(h);
    py += v * 0.1 * Math.sin(h);
  }
  return motionFrom({ x_m: x, y_m: y, heading_rad: heading, vx_mps: vx, vy_mps: vy });
}

function setOf(s: Scene, ways: Readonly<Record<string, Motion>>): MotionSet {
  const futures = new Map<string, Futures>(
    Object.entries(ways).map(([id, motion]) => [
      id,
      { modes: [{ probability: 1, motion, name: 'Straight on' }], chosen: 0, step: 5, steps: 5 },
    ]),
  );
  return { ...emptyMotion(sceneKey(s)), futures, driving: new Set(futures.keys()) };
}

describe('the difference of variants', () => {
  const s = crossing();
  const a = car(s);
  const card = (id: number, m: Motion) => ({ id, state: states(s, id)[0], scene: s, set: setOf(s, { [a.id]: m }) });
  const on = drive(a, [8]);
  const stops = drive(a, [8, 6, 3, 0]);
  const named = (all: readonly Nameless[]) => nameVariants(all, () => 'km/h');

  it('is its name', () => {
    const names = named([card(1, on), card(2, on), card(3, stops), card(4, drive(a, [8], 1.4))]);
    expect(names[2]).toBe(`${a.name} stops`);
    expect(names[3]).toBe(`${a.name} turns left`);
    expect(new Set(names).size).toBe(4);
    expect(named([card(1, on)])).toEqual(['Variant 1']);
    const meets = { kind: 'collision', what: 'collision', a, b: walker(s), inLog: false } as TrafficEvent;
    const eventful = named([card(1, on), { ...card(2, on), events: [meets] }, card(3, stops)]);
    expect(eventful[1]).toBe(`${a.name} hits ${walker(s).name}`);
  });

  it('is the number of the condition, where each has another', () => {
    const asks = (id: number, over: Over, value: number) => {
      const scene = withValue(s, a.id, over, value);
      return { id, scene, state: stateOfVariant(scene, a.id), set: null };
    };
    expect(named([asks(1, 'start', 30 / 3.6), asks(2, 'start', 35 / 3.6)])).toEqual([
      'Starts at 30 km/h',
      'Starts at 35 km/h',
    ]);
    const there = setGoal(a, { ...a.goal, pos: [1, 2] }).apply(s);
    const timed = [4, 4.5].map((t, i) => {
      const scene = withValue(there, a.id, 'time', t);
      return { id: i + 1, scene, state: stateOfVariant(scene, a.id), set: null };
    });
    expect(named(timed)).toEqual(['Arrives after 4 s', 'Arrives after 4.5 s']);
    // Equal numbers distinguish nothing.
    expect(named([asks(1, 'goal', 5), asks(2, 'goal', 5), asks(3, 'goal', 7)])).toEqual([
      'Variant 1',
      'Variant 2',
      'Arrives at 25 km/h',
    ]);
  });

  it('is listed with the moment of divergence', () => {
    const side = (label: string, m: Motion) => ({ label, scene: s, set: setOf(s, { [a.id]: m }), events: [] });
    const [first, fourth] = [side('1', on), side('4', stops)];
    const p = comparisonOf(first, fourth);
    expect(p.diverging.map((x) => x.agent.id)).toEqual([a.id]);
    expect(p.same).toBe(p.all - 1);
    expect(p.moments).toHaveLength(1);
    expect(p.moments[0].words).toBe(`${a.name} stops only in 4`);
    expect(p.moments[0].time).toBeGreaterThan(1);
    expect(p.moments[0].time).toBeLessThan(2.2);
    const rows = comparisonRows(first, fourth, p.diverging);
    expect(rows.find((r) => r.what === a.name)).toMatchObject({ differs: true });
    expect(comparisonOf(side('1', on), side('2', on)).moments).toEqual([]);
    // If there are too many, the worst of both sides are listed, whichever side they are on.
    const happens = (kind: TrafficEvent['kind'], time: number) =>
      ({
        kind,
        what: 'near_miss',
        time,
        title: kind,
        short: `at ${time}`,
        at: [0, 0],
        a,
        b: null,
        inLog: false,
      }) as unknown as TrafficEvent;
    const many = { ...side('1', on), events: [5, 6, 7, 8, 9].map((t) => happens('near', t)) };
    const worse = { ...side('4', on), events: [happens('near', 2), happens('collision', 3)] };
    const told = (l: typeof many, r: typeof many) => comparisonOf(l, r).moments.map((k) => k.words);
    expect(told(many, worse)).toEqual(['4: near, at 2', '4: collision, at 3', '1: near, at 5', '1: near, at 6']);
    expect(told(worse, many)).toEqual(told(many, worse));
    const wide = comparisonOf(side('1', on), side('2', drive(a, [8], 0.6)));
    expect(wide.moments[0].words).toBe(`${a.name} keeps further left in 2`);
  });
});

describe('a range of a number', () => {
  const sweep = (from: number, to: number, step: number): Sweep => ({ over: 'start', from, to, step });

  it('goes up and down, with both ends, and stops before a step beyond', () => {
    expect(valuesOf(sweep(30, 60, 5))).toEqual([30, 35, 40, 45, 50, 55, 60]);
    expect(valuesOf(sweep(6, 3, 1))).toEqual([6, 5, 4, 3]);
    expect(valuesOf(sweep(0, 1, 0.3))).toEqual([0, 0.3, 0.6, 0.9]);
    expect(valuesOf(sweep(2, 2, 1))).toEqual([2]);
    // Steps of 5 km/h are not round numbers of m/s.
    expect(valuesOf(sweep(30 / 3.6, 60 / 3.6, 5 / 3.6))).toHaveLength(7);
  });

  it('begins around the present value, within the limits', () => {
    const s = crossing();
    const a = car(s);
    for (const over of ['start', 'goal', 'time'] as const) {
      const usual = usualSweep(a, s, over, 'km/h');
      const [least, most] = limitsOfSweep(a, s, over);
      expect(Math.min(...valuesOf(usual))).toBeGreaterThanOrEqual(least);
      expect(Math.max(...valuesOf(usual))).toBeLessThanOrEqual(most);
      expect(countOf(usual)).toBeGreaterThan(1);
    }
  });

  it('sets each value, and drops an old pick', () => {
    const s = asked(crossing());
    expect(car(s).chosen).toBe(1);
    for (const [over, of] of [
      ['start', (a: Agent) => a.start.speed],
      ['goal', (a: Agent) => a.goal.speed],
      ['time', (a: Agent) => a.goal.time],
    ] as const) {
      const a = car(withValue(s, '1', over, 4));
      expect(of(a)).toBe(4);
      expect(valueOf(a, over)).toBe(4);
      expect(a.chosen).toBeNull();
    }
  });
});
