// Pinned futures: they stay when others are drawn again, are stored with the scene, and can be taken again.
import { describe, expect, it } from 'vitest';
import { clearGoal, drawAnew, setGoal, setSeed } from '../../src/model/document/commands';
import { MOST_PINS, motionOfPin, takenPin, takePin, unpin } from '../../src/model/document/pins';
import { motionOf } from '../../src/model/physics/playback';
import { misfit } from '../../src/model/words/pin-words';
import { readScene } from '../../src/model/document/scene-reader';
import { withAgents } from '../../src/model/document/scene';
import { writeScene } from '../../src/model/document/scene-writer';
import { requestForChange } from '../../src/edit/asking/request-for-change';
import { pinnedAt, pinsApart, togglePin } from '../../src/edit/moves/pins';
import { finalOf, finalWith, json, Session, six } from './session';

const ID = '1';

class Pinning extends Session {
  constructor() {
    super();
    this.editor.select(ID);
    this.generator.last.on.final(finalOf(ID), 10);
  }

  get agent() {
    return this.editor.agent.peek()!;
  }

  toggle(index: number): string | undefined {
    const done = togglePin(this.editor, this.agent, index);
    if (typeof done === 'string') return done;
    this.editor.commits.run(done);
    return undefined;
  }

  /** Other futures than before: all are shifted by this many metres. */
  drawnAnew(shift: number): void {
    const other = six(ID);
    for (const m of other.modes) m.x_m = Array.from(m.x_m, (x) => x + shift);
    this.editor.answers.look(ID, { ...this.editor.reading.futures.peek()!, modes: [] }, null);
    this.generation.begin(false);
    this.editor.answers.settle(
      this.editor.scene.peek()!,
      { ...this.editor.answers.motion.peek(), futures: new Map(), stale: false },
      null,
    );
    this.editor.select(null);
    this.editor.select(ID);
    this.generator.last.on.final(finalWith({ [ID]: other }), 10);
  }
}

describe('a pinned future', () => {
  it('has a mark, is one step, and at most three are pinned', () => {
    const t = new Pinning();
    for (let i = 0; i < MOST_PINS; i++) expect(t.toggle(i)).toBeUndefined();
    expect(t.toggle(MOST_PINS)).toMatch(/the maximum/);
    expect(pinnedAt(t.editor, 1)).toBe(t.agent.pins[1]);
    expect(pinsApart(t.editor)).toEqual([]);
    t.toggle(1);
    expect(t.agent.pins).toHaveLength(MOST_PINS - 1);
    t.editor.commits.undo();
    t.editor.commits.undo();
    expect(t.agent.pins).toHaveLength(MOST_PINS - 1);
  });

  it('stays when others are drawn again, and in the file', () => {
    const t = new Pinning();
    const [, b] = t.editor.reading.futures.peek()!.modes;
    t.toggle(1);
    t.drawnAnew(4);
    expect(pinsApart(t.editor).map((p) => [p.pin.name, p.why])).toEqual([[b.name, null]]);
    const file = writeScene(json, t.editor.scene.peek()!, null);
    const again = readScene(JSON.parse(JSON.stringify(file)) as typeof file).agents.get(ID)!;
    expect(again.pins).toEqual(t.agent.pins);
    const broken = { ...file, x_editor: { ...file.x_editor, pins: { [ID]: [{ name: 'x' }, null] } } } as never;
    expect(readScene(broken).agents.get(ID)!.pins).toEqual([]);
  });

  it('reports why it no longer fits, and restores its start and goal when it is taken', () => {
    const t = new Pinning();
    t.toggle(2);
    const [pin] = t.agent.pins;
    const { goal } = t.agent;
    expect(misfit(t.agent, pin, 'km/h')).toBeNull();
    const end = motionOfPin(pin);
    const [x, y] = [end.x[end.x.length - 1], end.y[end.y.length - 1]];
    t.editor.commits.run(setGoal(t.agent, { ...goal, pos: [x + 12, y] }));
    expect(misfit(t.agent, pin, 'km/h')).toBe('12 m from the goal');
    const turned = { ...t.agent, start: { ...t.agent.start, speed: 1 } };
    expect(misfit(turned, pin, 'km/h')).toMatch(/^starts at \d+ km\/h$/);
    t.editor.commits.run(takePin(t.agent, pin));
    expect([t.agent.chosen, t.agent.goal, takenPin(t.agent)]).toEqual([0, goal, pin]);
    expect(t.editor.reading.futures.peek()!.modes).toHaveLength(1);
    const motion = motionOf(t.editor.scene.peek()!, t.editor.answers.motion.peek(), t.agent);
    expect(motion).toBe(motionOfPin(pin));
    // Unpinned, it is free again.
    t.editor.commits.run(unpin(t.agent, pin));
    expect([t.agent.chosen, t.agent.pins]).toEqual([null, []]);
  });

  it('continues when all others are drawn again, and is present whatever answer was stored', () => {
    const t = new Pinning();
    t.toggle(3);
    t.editor.commits.run(takePin(t.agent, t.agent.pins[0]));
    const { editor } = t;
    const anew = drawAnew(editor.scene.peek()!).apply(editor.scene.peek()!);
    const asked = requestForChange(editor, anew, { name: '', agent: null, undo: false, everybody: true });
    expect(asked).toMatchObject({ react: false });
    expect((asked as { agents: string[] }).agents).not.toContain(ID);
    expect((asked as { kept: ReadonlySet<string> }).kept.has(ID)).toBe(true);
    const seeded = setSeed(7).apply(editor.scene.peek()!);
    expect(requestForChange(editor, seeded, { name: '', agent: null, undo: false })).toMatchObject({ pinned: [ID] });
    // A scene opened without an answer has it too.
    editor.open(editor.scene.peek()!);
    const f = editor.answers.motion.peek().futures.get(ID)!;
    expect(f.modes[0].motion).toBe(motionOfPin(editor.scene.peek()!.agents.get(ID)!.pins[0]));
    // A road user without a taken one has no futures.
    const free = withAgents(editor.scene.peek()!, [{ ...editor.scene.peek()!.agents.get(ID)!, chosen: null }]);
    editor.open(clearGoal(free.agents.get(ID)!).apply(free));
    expect(editor.answers.motion.peek().futures.size).toBe(0);
  });
});
