// Opening scenes: from the server, with the steps stored on this computer, one tab at a time.
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { rename, setSeed } from '../../src/model/document/commands';
import { PassingStepStore } from '../../src/net/step-store';
import { crossingJson } from '../helpers';
import { channels, Locks } from '../net/locks';
import { ScriptedServer } from './server';
import { Tab } from './tab';

let server: ScriptedServer;
let store: PassingStepStore;
let locks: LockManager;
let lines: BroadcastChannel[];

const pass = (ms: number) => vi.advanceTimersByTimeAsync(ms);
const newTab = async () => {
  const tab = new Tab(server, { store, browser: { locks, channel: lines.pop()! } });
  await tab.list.refresh();
  return tab;
};
const open = async (tab: Tab, id: string) => {
  const opened = tab.library.open(id);
  await pass(3000);
  await opened;
};
const shown = (tab: Tab) => {
  const { id, name, seed } = tab.editor.scene.peek()!;
  return { id, name, seed };
};
const nameOf = (id: string) => server.scenes.get(id)?.json.name;

beforeEach(() => {
  vi.useFakeTimers();
  server = new ScriptedServer();
  store = new PassingStepStore();
  locks = new Locks() as unknown as LockManager;
  lines = channels(3);
  for (const id of ['mine', 'other', 'third']) server.put(id, { ...crossingJson(), name: id });
  return () => vi.useRealTimers();
});

describe('of two scenes being opened', () => {
  it('the last requested one is shown, whichever arrives first', async () => {
    const tab = await newTab();
    server.fate = (_, id) => (id === 'mine' ? { back: 900 } : { back: 100 });
    void tab.library.open('mine');
    await open(tab, 'other');
    expect(shown(tab).id).toBe('other');
    server.fate = () => ({});
    const second = await newTab();
    await open(second, 'other');
    expect(second.editor.document.lock.peek()).not.toBeNull();
  });

  it('a missing one leaves the scene before on screen, locked and with its changes', async () => {
    const tab = await newTab();
    await open(tab, 'mine');
    tab.editor.commits.run(rename('Mine'));
    await open(tab, 'gone');
    expect(tab.library.openError.peek()).not.toBeNull();
    tab.editor.commits.run(setSeed(4));
    await pass(1000);
    expect([shown(tab).name, nameOf('mine')]).toEqual(['Mine', 'Mine']);
    const second = await newTab();
    await open(second, 'mine');
    expect([second.editor.document.lock.peek() !== null, shown(second).seed]).toEqual([true, 4]);
  });
});

describe('a change while a scene is opened', () => {
  it('is kept and saved when another scene is opened', async () => {
    const tab = await newTab();
    await open(tab, 'mine');
    server.fate = (method, id) => (method === 'GET' && id === 'other' ? { back: 500 } : {});
    const opened = tab.library.open('other');
    await pass(200);
    tab.editor.commits.run(setSeed(4));
    await pass(5000);
    await opened;
    await open(tab, 'mine');
    expect([shown(tab).seed, tab.editor.document.undoName.peek(), tab.saving.state.peek()]).toEqual([
      4,
      'Seed 4',
      'saved',
    ]);
  });

  it('is kept when the same scene is opened again', async () => {
    const tab = await newTab();
    await open(tab, 'mine');
    server.fate = (method, id) => (method === 'GET' && id === 'mine' ? { back: 500 } : {});
    const opened = tab.library.open('mine');
    await pass(200);
    tab.editor.commits.run(setSeed(4));
    await pass(5000);
    await opened;
    expect([shown(tab).seed, tab.editor.document.undoName.peek(), tab.saving.state.peek()]).toEqual([
      4,
      'Seed 4',
      'saved',
    ]);
  });
});

describe('two tabs at one scene', () => {
  it('the second is read-only, follows the first, and takes over on request', async () => {
    const first = await newTab();
    const second = await newTab();
    await open(first, 'mine');
    await open(second, 'mine');
    expect(second.editor.document.lock.peek()).not.toBeNull();
    first.editor.commits.run(setSeed(4));
    await pass(1000);
    expect(shown(second).seed).toBe(4);
    second.library.editHere();
    await pass(6000);
    expect([first.editor.document.lock.peek() !== null, second.editor.document.lock.peek()]).toEqual([true, null]);
    second.editor.commits.run(rename('Second'));
    await pass(1000);
    expect([nameOf('mine'), second.editor.document.undoName.peek(), shown(first).name]).toEqual([
      'Second',
      'Renamed to Second',
      'Second',
    ]);
    second.editor.commits.undo();
    second.editor.commits.undo();
    expect(shown(second).seed).toBe(crossingJson().x_editor?.seed ?? 0);
  });

  it('a change that waits in the tab that left does not replace a later version of the other tab', async () => {
    const [first, second] = [await newTab(), await newTab()];
    await open(first, 'mine');
    await open(second, 'mine');
    // Both versions reach the server, and their replies are lost.
    server.fate = (method) => (method === 'PUT' ? { fails: 'reply' } : {});
    first.editor.commits.run(rename('A'));
    await pass(400);
    first.editor.commits.run(rename('B'));
    void first.library.open('other');
    await pass(1000);
    server.fate = () => ({});
    expect(shown(second).name).toBe('B');
    second.editor.commits.undo();
    await pass(60_000);
    expect([shown(second).name, second.saving.state.peek(), nameOf('mine')]).toEqual(['A', 'saved', 'A']);
  });

  it('the second has the stored steps while the server is unreachable', async () => {
    const first = await newTab();
    const second = await newTab();
    await open(first, 'mine');
    await open(second, 'mine');
    server.fate = () => ({ fails: 'request' });
    first.editor.commits.run(setSeed(4));
    await pass(500);
    second.library.editHere();
    await pass(6000);
    expect([shown(second).seed, second.saving.state.peek()]).toEqual([4, 'local']);
    server.fate = () => ({});
    await pass(60_000);
    expect([server.scenes.get('mine')!.json.x_editor?.seed, second.saving.state.peek()]).toEqual([4, 'saved']);
  });
});
