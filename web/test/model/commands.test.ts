// Any command, then its inverse, gives the same scene; undo and redo are exact.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  choose,
  clearGoal,
  rename,
  resetAgent,
  resetAll,
  setBoth,
  setDiversity,
  setGoal,
  setLength,
  setOthers,
  setReplan,
  setSeed,
  setSize,
  setStart,
  type Command,
} from '../../src/model/document/commands';
import { History } from '../../src/model/document/history';
import type { Agent, GoalSpec, Scene, StartSpec } from '../../src/model/document/scene';
import { LENGTHS, REPLANS, sceneKey } from '../../src/model/document/scene';
import { crossing } from '../helpers';
import { via } from '../../src/model/document/vias';

const number = fc.double({ min: -200, max: 200, noNaN: true });
const pos = fc.option(fc.tuple(number, number).map(([x, y]) => [x, y] as const));
const start: fc.Arbitrary<StartSpec> = fc.record({
  pos,
  heading: fc.option(number),
  speed: fc.option(fc.double({ min: 0, max: 45, noNaN: true })),
});
const goal: fc.Arbitrary<GoalSpec> = fc.record({
  pos,
  heading: fc.option(number),
  speed: fc.option(number),
  time: fc.double({ min: 1, max: 20, noNaN: true }),
  via: fc.array(fc.tuple(number, number), { maxLength: 4 }).map((all) => all.map((p) => via(p))),
  mayCross: fc.array(fc.string(), { maxLength: 3 }),
});

const makers: fc.Arbitrary<(s: Scene, a: Agent) => Command> = fc.oneof(
  start.map((v) => (_: Scene, a: Agent) => setStart(a, v)),
  goal.map((v) => (_: Scene, a: Agent) => setGoal(a, v)),
  fc.tuple(start, goal).map(
    ([p, q]) =>
      (_: Scene, a: Agent) =>
        setBoth(a, p, q),
  ),
  fc.tuple(number, number).map(
    ([l, w]) =>
      (_: Scene, a: Agent) =>
        setSize(a, Math.abs(l), Math.abs(w)),
  ),
  fc.option(fc.nat(5)).map((i) => (_: Scene, a: Agent) => choose(a, i, 'A')),
  fc.constant((_: Scene, a: Agent) => clearGoal(a)),
  fc.constant((_: Scene, a: Agent) => resetAgent(a)),
  fc.constant((s: Scene) => resetAll(s)),
  fc.nat().map((n) => () => setSeed(n)),
  fc.double({ min: 0, max: 2, noNaN: true }).map((d) => () => setDiversity(d)),
  fc.constantFrom('react', 'log', 'still' as const).map((o) => () => setOthers(o as 'react')),
  fc.string().map((n) => () => rename(n)),
  fc.constantFrom(...LENGTHS).map((l) => (s: Scene) => setLength(s, l)),
  fc.constantFrom(...REPLANS).map((r) => () => setReplan(r)),
);

/** All that a command may change, as text. */
const face = (s: Scene): string =>
  sceneKey(s) +
  s.name +
  s.duration +
  JSON.stringify([...s.agents.values()].map((a) => [a.id, a.start, a.goal, a.chosen, a.length, a.width]));

describe('commands', () => {
  const scene = crossing();
  const ids = [...scene.agents.keys()];

  it('are undone exactly by their inverse', () => {
    fc.assert(
      fc.property(makers, fc.constantFrom(...ids), (make, id) => {
        const before = face(scene);
        const c = make(scene, scene.agents.get(id)!);
        const back = c.invert(scene).apply(c.apply(scene));
        expect(face(back)).toBe(before);
      }),
      { numRuns: 300 },
    );
  });

  it('leave the old document untouched and share what did not change', () => {
    const c = setSize(scene.agents.get('1')!, 9, 3);
    const next = c.apply(scene);
    expect(scene.agents.get('1')!.length).toBe(4.6);
    expect(next.agents.get('2')).toBe(scene.agents.get('2'));
    expect(next.map).toBe(scene.map);
    expect(Object.isFrozen(next) && Object.isFrozen(next.agents.get('1'))).toBe(true);
  });

  it('stretch the scene, and move goals that would be after its end', () => {
    const long = setLength(scene, 20).apply(scene);
    expect([long.length, long.duration]).toEqual([20, 20]);
    const a = long.agents.get('1')!;
    const late = setGoal(a, { ...a.goal, pos: [1, 2], time: 17 }).apply(long);
    const short = setLength(late, 12);
    expect(short.apply(late).agents.get('1')!.goal.time).toBe(12);
    expect(short.apply(late).duration).toBe(12);
    expect(short.invert(late).apply(short.apply(late)).agents.get('1')!.goal.time).toBe(17);
    expect(setLength(long, 9).apply(long).duration).toBe(scene.duration);
  });

  it('come back through any mix of do, undo and redo', () => {
    const step = fc.oneof(
      { weight: 3, arbitrary: fc.record({ make: makers, id: fc.constantFrom(...ids) }) },
      { weight: 2, arbitrary: fc.constant('undo' as const) },
      { weight: 1, arbitrary: fc.constant('redo' as const) },
    );
    fc.assert(
      fc.property(fc.array(step, { maxLength: 40 }), (steps) => {
        let clock = 0;
        const h = new History(scene, () => (clock += 10_000));
        const past: string[] = [face(scene)];
        let at = 0;
        for (const s of steps) {
          if (s === 'undo') {
            if (h.undo()) at--;
          } else if (s === 'redo') {
            if (h.redo()) at++;
          } else {
            const before = h.scene;
            h.run(s.make(h.scene, h.scene.agents.get(s.id)!));
            if (h.scene !== before) {
              past.length = ++at;
              past.push(face(h.scene));
            }
          }
          expect(face(h.scene)).toBe(past[at]);
        }
        while (h.undo());
        expect(face(h.scene)).toBe(past[0]);
      }),
      { numRuns: 60 },
    );
  });
});

describe('history', () => {
  it('folds repeats of one field within 600 ms', () => {
    let now = 0;
    const scene = crossing(),
      h = new History(scene, () => now);
    const nudge = (x: number) => {
      const a = h.scene.agents.get('1')!;
      h.run({ ...setGoal(a, { ...a.goal, pos: [x, 0] }), fold: 'goal:pos:1' });
    };
    nudge(1);
    now += 100;
    nudge(2);
    now += 100;
    nudge(3);
    expect(h.depth).toBe(1);
    now += 700;
    nudge(4);
    expect(h.depth).toBe(2);
    h.undo();
    h.undo();
    expect(face(h.scene)).toBe(face(scene));
  });
});
