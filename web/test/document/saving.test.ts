// Saving: the content, the time, and the state in the title.
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { rename, setGoal, setSeed } from '../../src/model/document/commands';
import { readScene } from '../../src/model/document/scene-reader';
import { freeGoal } from '../../src/model/document/scene';
import type { Command } from '../../src/model/document/commands';
import { PassingStepStore } from '../../src/net/step-store';
import { crossingJson } from '../helpers';
import { ScriptedServer } from './server';
import { Tab } from './tab';

let server: ScriptedServer;
let tab: Tab;

const pass = (ms: number) => vi.advanceTimersByTimeAsync(ms);
const nameOf = (id: string) => server.scenes.get(id)?.json.name;
const seedOf = (id: string) => server.scenes.get(id)?.json.x_editor?.seed;
const puts = (id: string) => server.seen.filter((s) => s.method === 'PUT' && s.id === id);
/** Opening waits for running requests, so the clock must advance meanwhile. */
const open = async (id: string, t = tab) => {
  const opened = t.library.open(id);
  await pass(3000);
  await opened;
};
const goalFor = (id: string, x: number, y: number): Command => {
  const a = tab.editor.scene.peek()!.agents.get(id)!;
  return setGoal(a, { ...freeGoal(), pos: [x, y] });
};
/** An arrow key: steps of the same kind within 0.6 s are one. */
const folding = (seed: number): Command => ({ ...setSeed(seed), name: 'Seed', fold: 'seed' });

beforeEach(async () => {
  vi.useFakeTimers();
  server = new ScriptedServer();
  for (const id of ['mine', 'other', 'demo-crossing']) server.put(id, { ...crossingJson(), name: id });
  tab = new Tab(server);
  await tab.list.refresh();
  await open('mine');
  return () => vi.useRealTimers();
});

describe('the saved version', () => {
  it('is the committed one, also during a drag', async () => {
    tab.editor.commits.run(setSeed(7));
    tab.editor.select('1');
    tab.editor.drag.begin({ part: 'goal', handle: 'body' });
    tab.editor.drag.preview(goalFor('1', 77, 7));
    await pass(1000);
    tab.editor.drag.cancel();
    await pass(1000);
    expect(tab.saving.state.peek()).toBe('saved');
    expect(seedOf('mine')).toBe(7);
    const goals = puts('mine').map((p) => readScene(p.json!).agents.get('1')!.goal.pos);
    expect(goals).toEqual(goals.map(() => null));
  });

  it('includes a waiting change when another scene is opened', async () => {
    server.fate = (method) => (method === 'PUT' ? { there: 500 } : {});
    tab.editor.commits.run(setSeed(7));
    await pass(400);
    tab.editor.commits.run(setSeed(8));
    await open('other');
    await pass(3000);
    expect(seedOf('mine')).toBe(8);
  });

  it('includes a waiting change when the server is slower than the opening of another scene', async () => {
    tab.editor.commits.run(setSeed(7));
    server.fate = (method) => (method === 'PUT' ? { back: 5000 } : {});
    await pass(400);
    tab.editor.commits.run(setSeed(8));
    await pass(400);
    await open('demo-crossing');
    await pass(10_000);
    expect(puts('demo-crossing')).toEqual([]);
    expect(tab.saving.state.peek()).toBe('example');
    expect(seedOf('mine')).toBe(8);
  });

  it('is kept in memory where neither the server nor this computer stored it, and shown again', async () => {
    class NoStore extends PassingStepStore {
      override read = () => Promise.reject(new Error('forbidden'));
      override append = () => Promise.reject(new Error('forbidden'));
      override rewrite = () => Promise.reject(new Error('forbidden'));
    }
    tab = new Tab(server, { store: new NoStore() });
    await tab.list.refresh();
    await open('mine');
    server.fate = (method) => (method === 'PUT' ? { fails: 'busy' } : {});
    tab.editor.commits.run(setSeed(7));
    await pass(400);
    await open('other');
    await open('mine');
    expect(tab.editor.scene.peek()!.seed).toBe(7);
    server.fate = () => ({});
    await pass(60_000);
    expect(seedOf('mine')).toBe(7);
  });
});

describe('a step that grew after it was saved', () => {
  it.each([
    ['by a key that repeats', (seed: number) => folding(seed)],
    ['by what follows from it', (seed: number): Command => ({ ...setSeed(seed), joins: true })],
  ])('%s is ahead of the server when the scene is opened again', async (_, more) => {
    const store = new PassingStepStore();
    tab = new Tab(server, { store });
    await tab.list.refresh();
    await open('mine');
    tab.editor.commits.run(folding(7));
    await pass(400);
    expect(seedOf('mine')).toBe(7);
    server.fate = (method) => (method === 'PUT' ? { fails: 'request' } : {});
    tab.editor.commits.run(more(8));
    await pass(100);
    const again = new Tab(server, { store });
    await again.list.refresh();
    await open('mine', again);
    expect(again.editor.scene.peek()!.seed).toBe(8);
    expect(again.saving.state.peek()).not.toBe('saved');
    server.fate = () => ({});
    await pass(60_000);
    expect([seedOf('mine'), again.saving.state.peek()]).toEqual([8, 'saved']);
  });
});

describe('a scene that was deleted elsewhere', () => {
  it('is a conflict that ends when this version is kept: the scene is created again', async () => {
    server.scenes.delete('mine');
    tab.editor.commits.run(rename('Kept'));
    await pass(400);
    expect(tab.saving.state.peek()).toBe('conflict');
    const kept = tab.saving.keepMine();
    await pass(1000);
    await kept;
    expect([tab.saving.state.peek(), tab.saving.conflict.peek(), nameOf('mine')]).toEqual(['saved', null, 'Kept']);
    tab.editor.commits.run(rename('Further'));
    await pass(400);
    expect([tab.saving.state.peek(), nameOf('mine')]).toEqual(['saved', 'Further']);
  });
});

describe('a conflict', () => {
  const conflict = async () => {
    server.put('mine', { ...crossingJson(), name: 'Theirs' });
    tab.editor.commits.run(rename('Mine'));
    await pass(400);
    expect(tab.saving.state.peek()).toBe('conflict');
  };

  it('overwrites nothing until this version is kept', async () => {
    await conflict();
    tab.editor.commits.run(setSeed(9));
    await pass(1000);
    expect(nameOf('mine')).toBe('Theirs');
    void tab.saving.keepMine();
    await pass(1000);
    expect([nameOf('mine'), seedOf('mine'), tab.saving.conflict.peek()]).toEqual(['Mine', 9, null]);
  });

  it('ends with "keep" also where another change follows during the request', async () => {
    await conflict();
    server.fate = (method) => (method === 'PUT' ? { there: 200, back: 200 } : {});
    void tab.saving.keepMine();
    await pass(100);
    tab.editor.commits.run(setSeed(9));
    await pass(2000);
    expect(tab.saving.conflict.peek()).toBeNull();
    expect([nameOf('mine'), seedOf('mine'), tab.saving.state.peek()]).toEqual(['Mine', 9, 'saved']);
  });

  it('stays ended where the scene is opened again during the request', async () => {
    await conflict();
    server.fate = (method) => (method === 'PUT' ? { there: 400, back: 200 } : { back: 200 });
    void tab.library.open('mine');
    await pass(100);
    void tab.saving.keepMine();
    await pass(5000);
    expect([nameOf('mine'), tab.saving.state.peek(), tab.editor.scene.peek()!.name]).toEqual(['Mine', 'saved', 'Mine']);
  });

  it('does not occur where only the reply to our own save was lost', async () => {
    server.fate = (method) => (method === 'PUT' ? { fails: 'reply' } : {});
    tab.editor.commits.run(rename('Mine'));
    await pass(400);
    expect(tab.saving.state.peek()).toBe('local');
    server.fate = () => ({});
    tab.editor.commits.run(setSeed(9));
    await pass(1000);
    expect([nameOf('mine'), seedOf('mine'), tab.saving.state.peek()]).toEqual(['Mine', 9, 'saved']);
  });

  it('ends with the other version as a step that can be undone', async () => {
    await conflict();
    const taken = tab.library.takeTheirs();
    await pass(1000);
    await taken;
    expect([tab.editor.scene.peek()!.name, tab.saving.state.peek()]).toEqual(['Theirs', 'saved']);
    tab.editor.commits.undo();
    await pass(1000);
    expect(nameOf('mine')).toBe('Mine');
  });
});

describe('a server that does not answer', () => {
  it('is retried, and the title reports that the change is only local', async () => {
    server.fate = (method) => (method === 'PUT' ? { fails: 'busy' } : {});
    tab.editor.commits.run(setSeed(7));
    await pass(400);
    expect(tab.saving.state.peek()).toBe('local');
    server.fate = () => ({});
    await pass(60_000);
    expect([seedOf('mine'), tab.saving.state.peek()]).toEqual([7, 'saved']);
  });
});

describe('a scene that is newer on the server', () => {
  it('is shown as on the server, and undo leads back to the local version', async () => {
    const store = new PassingStepStore();
    tab = new Tab(server, { store });
    await tab.list.refresh();
    await open('mine');
    tab.editor.commits.run(rename('Before'));
    await pass(1000);
    server.put('mine', { ...server.scenes.get('mine')!.json, name: 'Newer' });
    const again = new Tab(server, { store });
    await again.list.refresh();
    await open('mine', again);
    expect(again.editor.scene.peek()!.name).toBe('Newer');
    again.editor.commits.undo();
    expect(again.editor.scene.peek()!.name).toBe('Before');
  });
});

describe('a document that was saved', () => {
  it('is read back unchanged', async () => {
    tab.editor.commits.run(goalFor('1', 12, 3));
    await pass(1000);
    const there = readScene(server.scenes.get('mine')!.json);
    expect(there.agents.get('1')!.goal.pos).toEqual([12, 3]);
  });
});

describe('a scene that is opened again while a change waits', () => {
  it('is not overwritten by the waiting change if it was changed elsewhere meanwhile', async () => {
    const store = new PassingStepStore();
    tab = new Tab(server, { store });
    await tab.list.refresh();
    await open('mine');
    tab.editor.commits.run(setSeed(7));
    await pass(1000);
    server.put('mine', { ...server.scenes.get('mine')!.json, name: 'Theirs' });
    server.fate = (method) => (method === 'GET' ? { there: 50 } : {});
    const opened = tab.library.again();
    tab.editor.commits.run(setSeed(8));
    tab.editor.commits.undo();
    await pass(3000);
    await opened;
    expect([nameOf('mine'), tab.editor.scene.peek()!.name, tab.saving.state.peek()]).toEqual([
      'Theirs',
      'Theirs',
      'saved',
    ]);
  });
});
