// A way out that is pointed at is tried: shown and asked apart, and nothing of it is in the document.
import { describe, expect, it } from 'vitest';
import { setGoal } from '../../src/model/document/commands';
import { motionOf } from '../../src/model/physics/playback';
import { Questions } from '../../src/edit/question';
import { SceneFile } from '../../src/edit/document/scene-file';
import { Supposing } from '../../src/edit/supposing';
import { Trial } from '../../src/edit/trial';
import { finalOf, InMemoryGenerator, json, late, finalWith, six, Session } from './session';

const ID = '1';

class Trying extends Session {
  readonly line = new InMemoryGenerator();
  readonly trial: Trial;

  constructor() {
    super();
    const file = new SceneFile(this.editor);
    file.adopt(json, {} as never, true);
    const supposing = new Supposing(this.editor, new Questions(this.editor, file), this.line, file);
    this.trial = new Trial(this.editor, supposing);
    this.editor.select(ID);
    this.generator.last.on.final(finalOf(ID), 10);
  }

  get command() {
    const a = this.editor.agent.peek()!;
    return setGoal(a, { ...a.goal, pos: [10, 3] });
  }
}

describe('a trial', () => {
  it('shows where the goal would be at once, and what all would do when it is known', () => {
    const t = new Trying();
    const [scene, motion] = [t.editor.scene.peek(), t.editor.motion.peek()];
    const asked = t.generator.asked.length;
    t.trial.begin(t.command);
    expect(t.editor.beside.peek()?.parted).toEqual([ID]);
    expect(t.editor.beside.peek()?.scene.agents.get(ID)?.goal.pos).toEqual([10, 3]);
    expect(t.line.last.options.conditions?.[ID]?.goal).toMatchObject({ x_m: 10, y_m: 3 });
    expect(t.trial.asking.peek()).toBe(true);
    t.line.last.on.final(finalWith({ [ID]: six(ID), 2: late('2', 3, ID) }), 20);
    expect(t.trial.asking.peek()).toBe(false);
    const beside = t.editor.beside.peek()!;
    expect(beside.parted).toEqual([ID, '2']);
    const other = beside.scene.agents.get('2')!;
    expect(motionOf(beside.scene, beside.set, other)).not.toBe(motionOf(scene!, motion, other));
    // The document and what is shown of it are as they were, and nobody was asked about it.
    expect([t.editor.scene.peek(), t.editor.motion.peek()]).toEqual([scene, motion]);
    expect(t.generator.asked).toHaveLength(asked);
    expect(t.editor.undoName.peek()).toBeNull();
    t.trial.stop();
    expect(t.editor.beside.peek()).toBeNull();
  });

  it('is over when it is stopped, made, or somebody else is selected; a late answer shows nothing', () => {
    for (const end of [
      (t: Trying) => t.trial.stop(),
      (t: Trying) => t.editor.run(t.command),
      (t: Trying) => t.editor.select('2'),
    ]) {
      const t = new Trying();
      t.trial.begin(t.command);
      const { on } = t.line.last;
      end(t);
      expect(t.editor.beside.peek()).toBeNull();
      expect(t.line.cancelled).toBe(1);
      on.final(finalOf(ID), 20);
      expect(t.editor.beside.peek()).toBeNull();
    }
  });

  it('takes nothing away that somebody else shows', () => {
    const t = new Trying();
    t.trial.begin(t.command);
    const other = { scene: t.editor.scene.peek()!, set: t.editor.motion.peek(), parted: [] };
    t.editor.showBeside(other);
    t.trial.stop();
    expect(t.editor.beside.peek()).toBe(other);
  });
});
