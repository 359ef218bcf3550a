// A drag in the session while something else changes the document.
import { beforeEach, describe, expect, it } from 'vitest';
import { Editor } from '../../src/edit/session/editor';
import { rename, setGoal, setSeed } from '../../src/model/document/commands';
import { car, crossing } from '../helpers';
import { Pointer } from '../edit/pointer';

let editor: Editor;

const goal = (x: number) => {
  const a = car(editor.resting.peek()!);
  return setGoal(a, { ...a.goal, pos: [x, 3] });
};
const drag = (x: number) => {
  editor.drag.begin({ part: 'goal', handle: 'body' });
  editor.drag.preview(goal(x));
};
const goalX = () => car(editor.scene.peek()!).goal.pos?.[0];
const steps = () => editor.document.history!.line().map((s) => s.name);

beforeEach(() => {
  editor = new Editor();
  editor.open(crossing());
  editor.select('1');
});

describe('during a drag', () => {
  it('a command releases it first, so that neither is lost', () => {
    drag(5);
    editor.commits.run(rename('X'));
    expect([goalX(), editor.scene.peek()!.name, editor.drag.active.peek()]).toEqual([5, 'X', false]);
    expect(steps()).toHaveLength(2);
    editor.drag.preview(goal(9));
    editor.drag.end(goal(9));
    expect([goalX(), steps().length]).toEqual([5, 2]);
  });

  it('undo takes it back, and redo restores it', () => {
    editor.commits.run(setSeed(3));
    drag(5);
    editor.commits.undo();
    expect([goalX(), editor.scene.peek()!.seed]).toEqual([undefined, 3]);
    editor.commits.redo();
    expect(goalX()).toBe(5);
  });

  it('a jump in the history works, and the drag is a branch of it', () => {
    editor.commits.run(setSeed(3));
    drag(5);
    editor.commits.goTo(null);
    expect([goalX(), editor.scene.peek()!.seed]).toEqual([undefined, crossing().seed]);
    expect(editor.document.history!.kept().steps).toHaveLength(2);
  });

  it('a lock cancels it, and the release changes nothing', () => {
    drag(5);
    editor.lockWith({ words: 'Open elsewhere.', label: 'Edit here', run: () => undefined });
    expect([goalX(), editor.drag.active.peek()]).toEqual([undefined, false]);
    editor.lockWith(null);
    editor.drag.preview(goal(6));
    editor.drag.end(goal(6));
    expect([goalX(), steps()]).toEqual([undefined, []]);
  });

  it('another scene ends it, and a drag that goes on changes nothing there', () => {
    const p = new Pointer();
    ({ editor } = p);
    editor.select('1');
    p.hit = { kind: 'grip', grip: { part: 'goal', handle: 'body' } };
    p.down(p.at(0, 0));
    p.move(p.at(9, 0));
    expect(editor.drag.active.peek()).toBe(true);
    editor.open(crossing());
    p.move(p.at(12, 0));
    p.up(p.at(12, 0));
    expect([goalX(), steps()]).toEqual([undefined, []]);
  });
});
