// A remedy under the pointer is tried: shown and requested separately, without a change of the document.
import { describe, expect, it } from 'vitest';
import { setGoal } from '../../src/model/document/commands';
import { motionOf } from '../../src/model/physics/playback';
import { RequestBuilder } from '../../src/edit/asking/request-builder';
import { SceneFile } from '../../src/edit/document/scene-file';
import { WhatIf } from '../../src/edit/asking/what-if';
import { RemedyPreview } from '../../src/edit/asking/remedy-preview';
import { finalOf, InMemoryGenerator, json, late, finalWith, six, Session } from './session';

const ID = '1';

class Trying extends Session {
  readonly line = new InMemoryGenerator();
  readonly trial: RemedyPreview;

  constructor() {
    super();
    const file = new SceneFile(this.editor);
    file.adopt(json, {} as never, true);
    const whatIf = new WhatIf(this.editor, new RequestBuilder(this.editor, file), this.line, file);
    this.trial = new RemedyPreview(this.editor, whatIf);
    this.editor.select(ID);
    this.generator.last.on.final(finalOf(ID), 10);
  }

  get command() {
    const a = this.editor.agent.peek()!;
    return setGoal(a, { ...a.goal, pos: [10, 3] });
  }
}

describe('a trial', () => {
  it('shows the new goal at once, and the resulting motions when they are known', () => {
    const t = new Trying();
    const [scene, motion] = [t.editor.scene.peek(), t.editor.answers.motion.peek()];
    const asked = t.generator.asked.length;
    t.trial.begin(t.command);
    expect(t.editor.view.beside.peek()?.diverging).toEqual([ID]);
    expect(t.editor.view.beside.peek()?.scene.agents.get(ID)?.goal.pos).toEqual([10, 3]);
    expect(t.line.last.options.conditions?.[ID]?.goal).toMatchObject({ x_m: 10, y_m: 3 });
    expect(t.trial.asking.peek()).toBe(true);
    t.line.last.on.final(finalWith({ [ID]: six(ID), 2: late('2', 3, ID) }), 20);
    expect(t.trial.asking.peek()).toBe(false);
    const beside = t.editor.view.beside.peek()!;
    expect(beside.diverging).toEqual([ID, '2']);
    const other = beside.scene.agents.get('2')!;
    expect(motionOf(beside.scene, beside.set, other)).not.toBe(motionOf(scene!, motion, other));
    // The document and the answers are unchanged, and no regular request was sent.
    expect([t.editor.scene.peek(), t.editor.answers.motion.peek()]).toEqual([scene, motion]);
    expect(t.generator.asked).toHaveLength(asked);
    expect(t.editor.document.undoName.peek()).toBeNull();
    t.trial.stop();
    expect(t.editor.view.beside.peek()).toBeNull();
  });

  it('ends when it is stopped, taken, or another road user is selected; a late answer shows nothing', () => {
    for (const end of [
      (t: Trying) => t.trial.stop(),
      (t: Trying) => t.editor.commits.run(t.command),
      (t: Trying) => t.editor.select('2'),
    ]) {
      const t = new Trying();
      t.trial.begin(t.command);
      const { on } = t.line.last;
      end(t);
      expect(t.editor.view.beside.peek()).toBeNull();
      expect(t.line.cancelled).toBe(1);
      on.final(finalOf(ID), 20);
      expect(t.editor.view.beside.peek()).toBeNull();
    }
  });

  it('leaves previews of other owners in place', () => {
    const t = new Trying();
    t.trial.begin(t.command);
    const other = { scene: t.editor.scene.peek()!, set: t.editor.answers.motion.peek(), diverging: [] };
    t.editor.view.showBeside(other);
    t.trial.stop();
    expect(t.editor.view.beside.peek()).toBe(other);
  });
});
