// The step of the first-minute hint follows the actions of the user.
import { beforeEach, describe, expect, it } from 'vitest';
import { Ui } from '../../src/actions/ui';
import { coach } from '../../src/app/coach-steps';
import { Editor } from '../../src/edit/session/editor';
import { setGoal } from '../../src/model/document/commands';
import { car, crossing } from '../helpers';

let editor: Editor;
let ui: Ui;

const goal = () => {
  const a = car(editor.resting.peek()!);
  return setGoal(a, { ...a.goal, pos: [5, 3] });
};
const drag = () => {
  editor.drag.begin({ part: 'goal', handle: 'body' });
  editor.drag.preview(goal());
};

beforeEach(() => {
  editor = new Editor();
  editor.open(crossing());
  ui = new Ui();
  ui.coachTo(1);
  coach({ editor, ui });
  editor.select('1');
});

describe('the first-minute hint', () => {
  it('goes on with a selection, with a drag, and ends with the release', () => {
    expect(ui.coach.peek()).toBe(2);
    drag();
    expect(ui.coach.peek()).toBe(3);
    editor.drag.end(goal());
    expect(ui.coach.peek()).toBe(0);
  });

  it('returns to the drag when Esc has ended one, and to the click when nothing is selected', () => {
    drag();
    editor.drag.cancel();
    expect(ui.coach.peek()).toBe(2);
    drag();
    expect(ui.coach.peek()).toBe(3);
    editor.drag.cancel();
    editor.select(null);
    expect(ui.coach.peek()).toBe(1);
  });
});
