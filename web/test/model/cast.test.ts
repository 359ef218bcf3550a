// Road users are added, removed, and change kind alone or together: every command has an exact inverse, in any order.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Command } from '../../src/model/document/commands';
import { resetAgent, resetAll, setGoal } from '../../src/model/document/commands';
import { History } from '../../src/model/document/history';
import { PLACED_KINDS, PRESETS } from '../../src/model/base/kinds';
import { copiesText, newcomer, readCopies } from '../../src/model/document/newcomer';
import { readScene } from '../../src/model/document/scene-reader';
import { newIds, sceneKey, startPose, type Agent, type Scene } from '../../src/model/document/scene';
import { writeScene } from '../../src/model/document/scene-writer';
import {
  patchVariant,
  replaceVariants,
  sameCast,
  stateOfVariant,
  takeVariant,
} from '../../src/model/document/variants';
import * as several from '../../src/edit/moves/several';
import { crossing, crossingJson } from '../helpers';

/** A number of runs that the environment may raise. */
const RUNS = Number(process.env.SEQUENCES ?? 300);

/** Numbers as in a file, which has only one zero. */
const number = (min: number, max: number) => fc.double({ min, max, noNaN: true }).map((v) => v + 0);
const metres = number(-150, 150);
const kind = fc.constantFrom(...PLACED_KINDS);
const pose = fc.record({
  x: metres,
  y: metres,
  heading: number(-3, 3),
  speed: number(0, 6),
});
const comer = fc.tuple(kind, pose).map(([k, p]) => newcomer(k, PRESETS[k][0], p));
const does = fc.constantFrom('react', 'log', 'still' as const);

/** A command for some of the present road users; null where none would change. */
type Make = (s: Scene, all: readonly Agent[]) => Command | null;

const makers: fc.Arbitrary<Make> = fc.oneof(
  fc.array(comer, { minLength: 1, maxLength: 4 }).map((all) => (s: Scene) => several.addThem(s, all, 'placed')),
  fc.constant((s: Scene, all: readonly Agent[]) => (all.length ? several.removeThem(s, all) : null)),
  fc.tuple(metres, metres, fc.boolean()).map(
    ([dx, dy, g]): Make =>
      (_, all) =>
        several.moveAll(all, dx, dy, g),
  ),
  fc.tuple(metres, fc.boolean()).map(
    ([a, own]): Make =>
      (_, all) =>
        several.turnAll(all, a, own ? null : several.middleOf(all), true),
  ),
  number(0.1, 3).map(
    (k): Make =>
      (_, all) =>
        several.spreadAll(all, k, 1 / k, several.middleOf(all)),
  ),
  fc.integer({ min: -20, max: 20 }).map(
    (n): Make =>
      (_, all) =>
        several.fasterAll(all, n),
  ),
  fc
    .tuple(
      fc.constantFrom('start', 'goal' as const),
      fc.constantFrom('heading', 'speed', 'time', 'length', 'width' as const),
      number(1, 9),
    )
    .map(
      ([part, field, v]): Make =>
        (_, all) =>
          several.setAll(all, part as 'start', field as 'speed', () => v, 'Value'),
    ),
  kind.map(
    (k): Make =>
      (_, all) =>
        several.setKind(all, k),
  ),
  fc.boolean().map(
    (on): Make =>
      (_, all) =>
        several.lockAll(all, on),
  ),
  does.map(
    (d): Make =>
      (s, all) =>
        several.setDoes(s, all, d as 'react'),
  ),
  fc.option(fc.string({ minLength: 1 })).map(
    (name): Make =>
      (_, all) =>
        all[0] ? several.callIt(all[0], name) : null,
  ),
  fc.string().map(
    (note): Make =>
      (_, all) =>
        all[0] ? several.noteOn(all[0], note) : null,
  ),
  fc.constant<Make>((_, all) => several.clearGoals(all)),
  fc.tuple(metres, metres).map(
    ([x, y]): Make =>
      (_, all) =>
        all[0] ? setGoal(all[0], { ...all[0].goal, pos: [x, y] }) : null,
  ),
  fc.constant<Make>((_, all) => (all[0] ? resetAgent(all[0]) : null)),
  fc.constant<Make>((s) => resetAll(s)),
  fc.array(fc.nat(9999), { minLength: 1, maxLength: 10 }).map(
    (seeds): Make =>
      (s) =>
        replaceVariants(
          s,
          seeds.map((seed) => ({ ...stateOfVariant(s, null), seed })),
        ),
  ),
  fc.tuple(fc.nat(), fc.boolean()).map(([i, kept]): Make => (s) => {
    const v = s.variants[i % Math.max(1, s.variants.length)];
    return v ? patchVariant(s, v.id, { kept }, 'Kept') : null;
  }),
  fc.nat().map((i): Make => (s) => {
    const v = s.variants[i % Math.max(1, s.variants.length)];
    return v && sameCast(s, s.variantStates[v.id]) ? takeVariant(s, s.variantStates[v.id], 'Shown') : null;
  }),
);

/** Any subset of the present road users. */
const pick = fc.array(fc.nat(1000), { maxLength: 5 });
const picked = (s: Scene, which: readonly number[]): Agent[] => {
  const all = [...s.agents.values()];
  return all.length ? [...new Set(which.map((i) => all[i % all.length]))] : [];
};

/** All that a command may change, in the order of the road users. */
const face = (s: Scene): string =>
  sceneKey(s) +
  s.issued +
  JSON.stringify([s.variants, s.variantStates]) +
  JSON.stringify(Array.from(s.agents.values(), (a) => ({ ...a, log: null, source: null })));

describe('commands that add and remove road users', () => {
  it('are undone exactly by their inverse', { timeout: 3_600_000 }, () => {
    const scene = crossing();
    fc.assert(
      fc.property(makers, pick, (make, which) => {
        const c = make(scene, picked(scene, which));
        if (c) expect(face(c.invert(scene).apply(c.apply(scene)))).toBe(face(scene));
      }),
      { numRuns: RUNS },
    );
  });

  it('come back through any mix of do, undo and redo', { timeout: 3_600_000 }, () => {
    const scene = crossing();
    const step = fc.oneof(
      { weight: 3, arbitrary: fc.record({ make: makers, which: pick }) },
      { weight: 2, arbitrary: fc.constant('undo' as const) },
      { weight: 1, arbitrary: fc.constant('redo' as const) },
    );
    fc.assert(
      fc.property(fc.array(step, { maxLength: 24 }), (steps) => {
        let clock = 0;
        const h = new History(scene, () => (clock += 10_000));
        const past: string[] = [face(scene)];
        let at = 0;
        for (const s of steps) {
          if (s === 'undo') at -= h.undo() ? 1 : 0;
          else if (s === 'redo') at += h.redo() ? 1 : 0;
          else {
            const before = h.scene;
            const c = s.make(before, picked(before, s.which));
            if (c && h.run(c) !== before) {
              past.length = ++at;
              past.push(face(h.scene));
            }
          }
          expect(face(h.scene)).toBe(past[at]);
        }
        while (h.undo());
        expect(face(h.scene)).toBe(past[0]);
      }),
      { numRuns: RUNS },
    );
  });

  it('never reuse an id, not even that of a removed road user', () => {
    const scene = crossing();
    const last = [...scene.agents.values()].reduce((a, b) => (Number(b.id) > Number(a.id) ? b : a));
    const without = several.removeThem(scene, [last]).apply(scene);
    const [id] = newIds(without, 1);
    expect(scene.agents.has(id)).toBe(false);
    const ids = newIds(scene, 50);
    expect(new Set(ids).size).toBe(50);
    expect(ids.some((i) => scene.agents.has(i))).toBe(false);
  });

  it('remove a road user with recording, goal and position in the order, and restore all of it', () => {
    const scene = crossing();
    const a = scene.agents.get('2')!;
    const asked = setGoal(a, { ...a.goal, pos: [3, 4] }).apply(scene);
    const c = several.removeThem(asked, [asked.agents.get('2')!]);
    const gone = c.apply(asked);
    expect(gone.agents.has('2')).toBe(false);
    expect(gone.castKey).not.toBe(asked.castKey);
    const back = c.invert(asked).apply(gone);
    expect(back.agents.get('2')).toBe(asked.agents.get('2'));
    expect([...back.agents.keys()]).toEqual([...asked.agents.keys()]);
    expect(back.castKey).toBe(asked.castKey);
  });

  it('leave locked and read-only road users unchanged when everything is reset', () => {
    const scene = crossing();
    const all = [...scene.agents.values()].slice(0, 2);
    const moved = several.moveAll(all, 5, 0)!.apply(scene);
    const locked = several.lockAll([moved.agents.get(all[0].id)!], true)!.apply(moved);
    const reset = resetAll(locked).apply(locked);
    expect(startPose(reset.agents.get(all[0].id)!)!.x).toBeCloseTo(startPose(all[0])!.x + 5);
    expect(startPose(reset.agents.get(all[1].id)!)!.x).toBeCloseTo(startPose(all[1])!.x);
  });
});

describe('a scene as a file', () => {
  const json = crossingJson();

  it(
    'keeps added, removed, named and locked road users, their new kinds, and their behaviour',
    { timeout: 60_000 },
    () => {
      fc.assert(
        fc.property(fc.array(fc.tuple(makers, pick), { maxLength: 8 }), (steps) => {
          let scene = readScene(json);
          for (const [make, which] of steps) scene = make(scene, picked(scene, which))?.apply(scene) ?? scene;
          const text = JSON.stringify(writeScene(json, scene, null));
          const read = readScene(JSON.parse(text));
          // Written again it is equal: reading loses nothing.
          expect(JSON.parse(JSON.stringify(writeScene(json, read, null)))).toEqual(JSON.parse(text));
          expect(read.castKey).toBe(scene.castKey);
          for (const a of scene.agents.values()) {
            const b = read.agents.get(a.id)!;
            expect([b.type, b.kind, b.name, b.note, b.locked, b.does, b.placed]).toEqual([
              a.type,
              a.kind,
              a.name,
              a.note,
              a.locked,
              a.does,
              a.placed,
            ]);
            expect([b.length, b.width, b.goal]).toEqual([a.length, a.width, a.goal]);
            const [p, q] = [startPose(a), startPose(b)];
            expect(q?.x).toBeCloseTo(p?.x ?? 0, 2);
            expect(q?.speed).toBeCloseTo(p?.speed ?? 0, 2);
          }
        }),
        { numRuns: Math.min(RUNS, 60) },
      );
    },
  );
});

describe('copies as text', () => {
  it('are restored as they were', () => {
    fc.assert(
      fc.property(fc.array(comer, { minLength: 1, maxLength: 5 }), (all) => {
        const back = readCopies(copiesText(all))!;
        expect(JSON.parse(JSON.stringify(back))).toEqual(JSON.parse(JSON.stringify(all)));
      }),
    );
  });

  it('are empty where the text is something else, and never more than a scene holds', () => {
    for (const text of [
      '',
      'hello',
      '{}',
      '[]',
      'null',
      '{"kind":"dragtraffic road users","road_users":[{"kind":"car"}]}',
    ])
      expect(readCopies(text)).toBeNull();
    fc.assert(
      fc.property(fc.json(), (text) => {
        expect(readCopies(text)).toBeNull();
      }),
    );
    const one = newcomer('car', PRESETS.car[0], { x: 0, y: 0, heading: 0, speed: 1 });
    expect(readCopies(copiesText(Array(1000).fill(one)))!.length).toBe(256);
    const bad = copiesText([one]).replace('"x_m":0', '"x_m":1e99');
    expect(readCopies(bad)).toBeNull();
  });
});
