// The picture names the road users that the panel names, and keeps quiet in a drag to a bad place.
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { namedNow } from '../../src/edit/overlay/named';
import { QuietDrag } from '../../src/edit/overlay/quiet-drag';
import type { Editor } from '../../src/edit/session/editor';
import { choose, setGoal } from '../../src/model/document/commands';
import type { ModeJson, RelationKind } from '../../src/model/document/scene-json';
import { judged } from '../standin/judged.mjs';
import { finalWith, late, Session, six } from '../edit/session';

let s: Session;
let editor: Editor;

/** The futures of car 1: with `hit` the first hits car 2; four cross the median, and E has no fault. */
const futures = (chosen: number, hit: boolean) => ({
  chosen,
  modes: judged(six('1').modes as ModeJson[], ['2', '17'], hit),
});
const goal = () => {
  const a = editor.scene.peek()!.agents.get('1')!;
  return setGoal(a, { ...a.goal, pos: [10, 10] });
};
const drag = (chosen: number, hit: boolean) => {
  editor.drag.begin({ part: 'goal', handle: 'body' });
  editor.drag.preview(goal());
  s.generation.preview('1');
  s.generator.last.on.final(finalWith({ '1': futures(chosen, hit) }), 5);
};

beforeEach(() => {
  vi.useFakeTimers();
  s = new Session();
  ({ editor } = s);
  editor.select('1');
});

describe('names on the picture', () => {
  it('are those of the selected one, of those that it meets, and of those that react', () => {
    expect(namedNow(editor)).toEqual(['1']);
    s.generator.last.on.final(finalWith({ '1': futures(0, true) }), 5);
    // It replays the recording: the futures with their faults are possible only.
    expect(namedNow(editor)).toEqual(['1']);
    editor.commits.run(goal());
    vi.advanceTimersByTime(100);
    s.generator.last.on.final(finalWith({ '1': futures(0, true) }), 5);
    expect(namedNow(editor)).toEqual(['1', '2']);
    editor.commits.run(goal());
    vi.advanceTimersByTime(100);
    s.generator.last.on.final(finalWith({ '1': futures(4, false), '17': late('17', 3, '1') }), 5);
    expect(namedNow(editor)).toEqual(['1', '17']);
  });

  it('are that in the name of the shown future, as long as it is shown', () => {
    const modes = six('1').modes as ModeJson[];
    const relation = (kind: RelationKind) => ({ kind, with: '17', time_s: 4, x_m: 0, y_m: 0, gap_s: 2 });
    const two = [
      { ...modes[0], manoeuvre: 'straight' as const, relations: [relation('before')] },
      { ...modes[0], manoeuvre: 'straight' as const, relations: [relation('after')] },
      { ...modes[0], manoeuvre: 'left' as const },
    ];
    editor.commits.run(goal());
    vi.advanceTimersByTime(100);
    s.generator.last.on.final(finalWith({ '1': { chosen: 0, modes: two } }), 5);
    expect(editor.reading.futures.peek()!.modes[0].name).toMatch(/ before Ped/);
    expect(namedNow(editor)).toEqual(['1', '17']);
    s.generator.last.on.final(finalWith({ '1': { chosen: 2, modes: two } }), 5);
    editor.commits.run(choose(editor.agent.peek()!, 2, 'C'));
    expect(namedNow(editor)).toEqual(['1']);
  });

  it('are those of the events while nothing is selected, and none without events', () => {
    editor.select(null);
    expect(namedNow(editor)).toEqual([]);
    editor.select('1');
    editor.commits.run(goal());
    vi.advanceTimersByTime(100);
    s.generator.last.on.final(finalWith({ '1': futures(0, true) }), 5);
    editor.select(null);
    expect(namedNow(editor)).toEqual(['1', '2']);
  });
});

describe('a drag', () => {
  it('is quiet while the shown future has a fault, also between two answers', () => {
    const quiet = new QuietDrag(editor);
    const is = () => quiet.is(editor.agent.peek());
    s.generator.last.on.final(finalWith({ '1': futures(0, true) }), 5);
    expect(is()).toBe(false);
    drag(0, true);
    expect(is()).toBe(true);
    editor.drag.preview(goal());
    expect(is()).toBe(true);
    editor.drag.cancel();
    expect(is()).toBe(false);
    drag(4, false);
    expect(is()).toBe(false);
  });
});
