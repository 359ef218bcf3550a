// Undo and redo, branches, stored steps, and how a scene continues from them.
import { describe, expect, it } from 'vitest';
import { Journal, resume } from '../../src/edit/document/journal';
import { rename, setGoal, setSeed } from '../../src/model/document/commands';
import { History, MOST_STEPS, replay } from '../../src/model/document/history';
import type { GeneratedJson } from '../../src/model/document/scene-json';
import { readScene } from '../../src/model/document/scene-reader';
import { freeGoal, sceneKey, withAgents, type Agent, type Scene } from '../../src/model/document/scene';
import { applyDiff, diffOf, isEmptyDiff, stateOf, withState } from '../../src/model/document/scene-diff';
import { PassingStepStore } from '../../src/net/step-store';
import { crossingJson } from '../helpers';

const file = (): Scene => readScene({ ...crossingJson(), id: 'x' });
const someone = (s: Scene): Agent => [...s.agents.values()].find((a) => a.logStart)!;
const goal = (s: Scene, x: number) => setGoal(someone(s), { ...freeGoal(), pos: [x, 3] });
const without = (s: Scene, id: string): Scene => {
  const agents = new Map(s.agents);
  agents.delete(id);
  return Object.freeze({ ...s, agents });
};
const plainly = (s: Scene) => JSON.stringify([[...s.agents.values()].map((a) => ({ ...a, log: 0 })), s.seed, s.name]);

describe('differences of two documents', () => {
  it('lead in both directions, and can be stored', () => {
    const a = file();
    const b = setSeed(7).apply(goal(a, 12).apply(a));
    const diff = structuredClone(diffOf(a, b));
    expect(diff.agents).toHaveLength(1);
    expect(Object.keys(diff.agents[0].forth!).sort()).toEqual(['goal']);
    expect(plainly(applyDiff(a, diff, 'forth'))).toBe(plainly(b));
    expect(plainly(applyDiff(b, diff, 'back'))).toBe(plainly(a));
    expect(isEmptyDiff(diffOf(a, withAgents(a, [{ ...someone(a) }])))).toBe(true);
  });

  it('restore a removed road user, in its place and with its recording', () => {
    const a = file();
    const { id, log } = someone(a);
    const b = without(a, id);
    const diff = structuredClone(diffOf(a, b));
    const back = applyDiff(b, diff, 'back');
    expect([...back.agents.keys()]).toEqual([...a.agents.keys()]);
    expect(back.agents.get(id)!.log.x).toEqual(log.x);
    expect([...applyDiff(back, diff, 'forth').agents.keys()]).toEqual([...b.agents.keys()]);
  });

  it('a state is the document without the data of its file', () => {
    const a = goal(file(), 9).apply(file());
    const state = structuredClone(stateOf(a));
    expect(JSON.stringify(state)).not.toContain('"log"');
    expect(plainly(withState(file(), state))).toBe(plainly(a));
  });
});

describe('history', () => {
  it('continues beside undone steps, and returns to them', () => {
    const h = new History(file());
    for (const seed of [1, 2, 3]) h.run(setSeed(seed));
    h.undo();
    h.undo();
    h.run(setSeed(9));
    expect(h.line().map((s) => s.name)).toEqual(['Seed 1', 'Seed 9']);
    const third = h.kept().steps.find((s) => s.name === 'Seed 3')!;
    expect(h.goTo(third.id).seed).toBe(3);
    expect(h.line().map((s) => s.name)).toEqual(['Seed 1', 'Seed 2', 'Seed 3']);
    expect(h.goTo(null).seed).toBe(file().seed);
    expect([h.redo()?.name, h.redo()?.name, h.redo()?.name, h.redo()]).toEqual(['Seed 1', 'Seed 2', 'Seed 3', null]);
  });

  it('drops the oldest steps in batches, and the document before the first advances', () => {
    const h = new History(file(), () => 0);
    let shorter = 0;
    h.changed.listen((c) => (shorter += c.shorter ? 1 : 0));
    const last = 2 * MOST_STEPS + 5;
    for (let i = 1; i <= last; i++) h.run(setSeed(i));
    expect(shorter).toBeGreaterThan(0);
    expect(shorter).toBeLessThan(MOST_STEPS / 10);
    expect(h.depth).toBeGreaterThanOrEqual(MOST_STEPS);
    expect(h.depth).toBeLessThan(MOST_STEPS + 50);
    expect(h.first().seed).toBe(last - h.depth);
    while (h.undo());
    expect(h.scene.seed).toBe(last - h.line().length);
  });

  it('drops the branch left longest ago first', () => {
    const h = new History(file(), () => 0);
    const branch = (first: number, steps: number): void => {
      for (let i = 0; i < steps; i++) h.run(setSeed(first + i));
      h.goTo(null);
    };
    branch(1000, 50);
    branch(2000, 105);
    for (let i = 0; h.kept().steps.length > MOST_STEPS || i === 0 || i < 395; i++) h.run(setSeed(3000 + i));
    const left = (from: number) =>
      h.kept().steps.filter(({ diff }) => Math.floor(diff.forth.seed! / 1000) * 1000 === from).length;
    expect([left(1000), left(2000), left(3000)]).toEqual([0, 105, 395]);
  });

  it('is equal after storage', () => {
    const h = new History(file());
    h.run(goal(h.scene, 4));
    h.run(setSeed(5));
    h.run(rename('Late'));
    h.undo();
    const kept = structuredClone(h.kept());
    const scene = replay(file(), kept);
    expect(plainly(scene)).toBe(plainly(h.scene));
    const again = new History(scene, undefined, kept);
    expect([again.undoName, again.redoName]).toEqual(['Seed 5', 'Renamed to Late']);
    expect(again.redo() && again.scene.name).toBe('Late');
    while (again.undo());
    expect(plainly(again.scene)).toBe(plainly(file()));
  });
});

describe('a scene that is opened again', () => {
  async function edited(own: boolean, etag: string | null = '"1"') {
    const store = new PassingStepStore();
    const journal = new Journal(store);
    const h = new History(file());
    journal.follow(h, 'x', null, own);
    h.run(goal(h.scene, 4));
    h.run(setSeed(5));
    if (etag) journal.synced(h.committed, etag);
    await journal.flush();
    return { store, journal, h, kept: async () => (await store.read('x'))! };
  }

  it('continues with its steps where the server has the saved version', async () => {
    const { h, kept } = await edited(true);
    const r = resume(h.scene, await kept(), true, '"1"');
    expect([r.standing, plainly(r.scene)]).toEqual(['same', plainly(h.scene)]);
    expect(new History(r.scene, undefined, r.history).undoName).toBe('Seed 5');
  });

  it('has changes that the server lacks, theirs, or both', async () => {
    const { h, journal, kept } = await edited(true);
    const saved = h.scene;
    const theirs = rename('Theirs').apply(saved);
    expect(resume(theirs, await kept(), true, '"2"').standing).toBe('behind');
    h.run(setSeed(6));
    await journal.flush();
    expect(resume(saved, await kept(), true, '"1"').standing).toBe('ahead');
    expect(resume(theirs, await kept(), true, '"2"').standing).toBe('conflict');
    // The page ended between saving and noting it.
    expect(resume(h.scene, await kept(), true, '"2"').standing).toBe('same');
    expect(resume(saved, await kept(), true, '"2"').standing).toBe('ahead');
  });

  it('of an example starts from its file, whatever became of that', async () => {
    const { h, kept } = await edited(false, null);
    const r = resume(file(), await kept(), false, '"new"');
    expect([r.standing, sceneKey(r.scene)]).toEqual(['ahead', sceneKey(h.scene)]);
  });

  it('stores the motions of the current step, beside the steps', async () => {
    const { store, journal, h, kept } = await edited(false, null);
    const generated = { seed: 5, samples: [] } as unknown as GeneratedJson;
    journal.keepAnswers(generated);
    await journal.flush();
    expect((await kept()).answers).toEqual({ step: h.head, generated });
    // Rewriting the steps keeps them; forgetting the scene does not.
    await journal.retry();
    expect((await kept()).answers?.step).toBe(h.head);
    journal.keepAnswers(null);
    await journal.flush();
    expect((await kept()).answers).toBeNull();
    await store.forget('x');
    journal.letGo();
    journal.keepAnswers(generated);
    await journal.flush();
    expect(await store.read('x')).toBeNull();
  });

  it('starts afresh where stored steps are missing', async () => {
    const { h, kept } = await edited(true);
    const whole = await kept();
    const lost = { ...whole, steps: whole.steps.slice(1) };
    expect(resume(h.scene, lost, true, '"1"').standing).toBe('fresh');
    const nowhere = { ...whole, place: { ...whole.place, head: 99 } };
    expect(resume(h.scene, nowhere, true, '"1"').standing).toBe('fresh');
  });

  it('takes a change made elsewhere as a step, which is stored with the others', async () => {
    const { journal, kept, h } = await edited(true);
    const theirs = rename('Theirs').apply(h.scene);
    const before = await kept();
    const r = resume(theirs, before, true, '"2"');
    expect(r.standing).toBe('behind');
    const again = new History(r.scene, undefined, r.history);
    expect([r.scene.name, again.undoName]).toEqual(['Theirs', 'Changed elsewhere']);
    journal.follow(again, 'x', before, true);
    void journal.retry();
    journal.synced(again.committed, '"2"');
    await journal.flush();
    const next = resume(theirs, await kept(), true, '"2"');
    expect([next.standing, next.scene.name]).toEqual(['same', 'Theirs']);
    const last = new History(next.scene, undefined, next.history);
    expect([last.undo()?.name, last.scene.name]).toEqual(['Changed elsewhere', h.scene.name]);
  });

  it('starts afresh where nothing is stored', () => {
    expect(resume(file(), null, true, '"1"')).toMatchObject({ standing: 'fresh', history: null });
  });

  it('reports full storage, and writes what is missing when there is room again', async () => {
    const store = new PassingStepStore();
    const journal = new Journal(store);
    const h = new History(file());
    journal.follow(h, 'x', null, false);
    h.run(setSeed(1));
    await journal.flush();
    const { append } = store;
    store.append = () => Promise.reject(new DOMException('full', 'QuotaExceededError'));
    h.run(setSeed(2));
    await journal.flush();
    expect(journal.keeping.value).toBe('full');
    store.append = append;
    await journal.retry();
    expect(journal.keeping.value).toBe('kept');
    expect((await store.read('x'))!.steps.map((s) => s.name)).toEqual(['Seed 1', 'Seed 2']);
  });

  it('frees the storage of scenes that the server has unchanged', async () => {
    const { store, journal, h } = await edited(true);
    const other = new History(file());
    journal.follow(other, 'y', null, true);
    other.run(setSeed(3));
    await journal.flush();
    expect(await journal.makeRoom(() => true)).toBe(1);
    expect((await store.places()).map((p) => p.scene)).toEqual(['y']);
    expect(h.depth).toBe(2);
  });
});
