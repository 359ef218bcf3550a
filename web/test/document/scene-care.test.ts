// Whole scenes: copied, renamed, deleted and restored.
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { rename, setGoal, setSeed } from '../../src/model/document/commands';
import { crossingJson } from '../helpers';
import { ScriptedServer } from './server';
import { Tab } from './tab';

let server: ScriptedServer;
let tab: Tab;

const pass = (ms: number) => vi.advanceTimersByTimeAsync(ms);
const whole = async (work: Promise<unknown>) => {
  await pass(5000);
  await work;
};
const names = () => [...server.scenes.values()].map((s) => s.json.name);
const shown = () => tab.editor.scene.peek()!;

beforeEach(async () => {
  vi.useFakeTimers();
  server = new ScriptedServer();
  for (const id of ['mine', 'other', 'demo-crossing']) server.put(id, { ...crossingJson(), name: id });
  tab = new Tab(server);
  await tab.list.refresh();
  await whole(tab.library.open('mine'));
  return () => vi.useRealTimers();
});

describe('a copy', () => {
  it("of the open scene has the committed version, not the drag's preview", async () => {
    tab.editor.commits.run(setSeed(7));
    const a = shown().agents.get('1')!;
    tab.editor.drag.begin({ part: 'goal', handle: 'body' });
    tab.editor.drag.preview(setGoal(a, { ...a.goal, pos: [77, 7] }));
    tab.editor.select('1');
    tab.editor.playhead.moveTo(2);
    await whole(tab.care.saveCopy());
    expect([tab.editor.selection.peek(), tab.editor.playhead.time.peek()]).toEqual(['1', 2]);
    const copy = [...server.scenes.values()].at(-1)!.json;
    expect([copy.name, copy.x_editor?.seed, copy.meta?.parent_id]).toEqual(['mine, copy', 7, 'mine']);
    expect(copy.agents.find(({ id }) => id === '1')!.conditions ?? {}).toEqual({});
    expect(shown().name).toBe('mine, copy');
  });

  it('of an example is saved from then on', async () => {
    await whole(tab.library.open('demo-crossing'));
    tab.editor.commits.run(setSeed(7));
    await whole(tab.care.saveCopy());
    tab.editor.commits.run(setSeed(8));
    await pass(1000);
    expect([tab.saving.state.peek(), [...server.scenes.values()].at(-1)!.json.x_editor?.seed]).toEqual(['saved', 8]);
  });

  it('goes on with the steps of its original, under its own name', async () => {
    await whole(tab.library.open('demo-crossing'));
    const { seed: first } = shown();
    tab.editor.commits.run(setSeed(7));
    tab.editor.commits.run(rename('tried'));
    tab.editor.commits.run(setSeed(8));
    tab.editor.commits.undo();
    await whole(tab.care.saveCopy());
    const [id, copy] = [...server.scenes].at(-1)!;
    expect([shown().id, shown().name, shown().seed]).toEqual([id, copy.json.name, 7]);
    tab.editor.commits.redo();
    expect(shown().seed).toBe(8);
    for (const seed of [7, 7, first]) {
      tab.editor.commits.undo();
      expect([shown().name, shown().seed]).toEqual([copy.json.name, seed]);
    }
    expect(tab.editor.document.undoName.peek()).toBe(null);
    await pass(1000);
    expect([tab.saving.state.peek(), tab.saving.conflict.peek()]).toEqual(['saved', null]);
    // The steps of the example stay with it.
    await whole(tab.library.open('demo-crossing'));
    expect([shown().name, shown().seed, tab.editor.document.redoName.peek() !== null]).toEqual(['tried', 7, true]);
  });

  it('has a free name', async () => {
    await whole(tab.care.saveAs('other'));
    await whole(tab.care.saveCopy());
    await whole(tab.care.newOnThisRoad());
    await whole(tab.care.newOnThisRoad());
    expect(names().slice(-3)).toEqual(['other, copy', 'New scene', 'New scene 2']);
    expect(shown().agents.size).toBe(0);
  });
});

describe('a name', () => {
  it('of the open scene is a step; of another it is changed on the server', async () => {
    await whole(tab.care.rename('mine', 'Mine'));
    await whole(tab.care.rename('other', 'Other'));
    expect(tab.editor.document.undoName.peek()).toBe('Renamed to Mine');
    expect(names()).toEqual(['Mine', 'Other', 'demo-crossing']);
  });

  it('changed elsewhere meanwhile is not overwritten, and a notice reports it', async () => {
    server.put('other', { ...crossingJson(), name: 'Theirs' });
    await whole(tab.care.rename('other', 'Other'));
    expect(names()).toContain('Theirs');
    expect(tab.editor.notices.toast.peek()?.text).toMatch(/^Not renamed/);
  });
});

describe('a deleted scene', () => {
  it('is restored unchanged, with its steps', async () => {
    tab.editor.commits.run(rename('Mine'));
    await whole(tab.care.remove('mine'));
    expect([names(), shown().id]).toEqual([['other', 'demo-crossing'], 'other']);
    tab.editor.notices.toast.peek()!.action!.run();
    await pass(5000);
    expect([names().at(-1), shown().id, tab.saving.state.peek()]).toEqual(['Mine', 'mine', 'saved']);
    tab.editor.commits.undo();
    await pass(1000);
    expect(server.scenes.get('mine')!.json.name).toBe('mine');
  });

  it('stays where the server refuses', async () => {
    server.fate = (method) => (method === 'DELETE' ? { fails: 'busy' } : {});
    await whole(tab.care.remove('mine'));
    expect([names().includes('mine'), shown().id]).toEqual([true, 'mine']);
    expect(tab.editor.notices.toast.peek()?.text).toMatch(/^Not deleted/);
  });
});
