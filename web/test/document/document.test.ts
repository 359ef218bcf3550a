// The committed document, and the trial of a drag on top of it.
import { beforeEach, describe, expect, it } from 'vitest';
import { Document, TrialOpenError } from '../../src/edit/document/document';
import { rename, setGoal, setSeed, type Command } from '../../src/model/document/commands';
import { freeGoal } from '../../src/model/document/scene';
import { car, crossing } from '../helpers';

let document: Document;

const goal = (x: number): Command => setGoal(car(document.scene.peek()!), { ...freeGoal(), pos: [x, 3] });
const goalX = () => car(document.shown.peek()!).goal.pos?.[0];
const steps = () => document.history!.line().map((s) => s.name);

beforeEach(() => {
  document = new Document();
  document.open(crossing());
});

describe('every change of the document', () => {
  it('raises its version: commits, folds, undo and redo, another version, another scene', () => {
    const folding = (seed: number): Command => ({ ...setSeed(seed), name: 'Seed', fold: 'seed' });
    const changes: (() => void)[] = [
      () => document.run(setSeed(1)),
      () => document.run(folding(2)),
      () => document.run(folding(3)),
      () => document.run({ ...setSeed(4), joins: true }),
      () => document.undo(),
      () => document.redo(),
      () => document.goTo(null),
      () => document.adopt('Theirs', rename('Theirs').apply(document.scene.peek()!)),
      () => document.begin(),
      () => document.commit(goal(1)),
      () => document.open(crossing()),
    ];
    for (const change of changes) {
      const before = document.committed.peek()!;
      change();
      const after = document.committed.peek()!;
      if (document.trial.peek()) expect(after).toBe(before);
      else expect(after.version).toBeGreaterThan(before.version);
    }
  });

  it('that grows a step gives the step another revision, which undo and redo keep', () => {
    const ref = () => [document.committed.peek()!.step, document.committed.peek()!.revision];
    document.run({ ...setSeed(1), fold: 'seed' });
    document.run({ ...setSeed(2), fold: 'seed' });
    expect(ref()).toEqual([1, 1]);
    document.undo();
    expect(ref()).toEqual([null, undefined]);
    document.redo();
    expect(ref()).toEqual([1, 1]);
  });
});

describe('the trial of a drag', () => {
  it('is shown but not committed, and leaves nothing when it is cancelled', () => {
    const before = document.committed.peek();
    document.begin();
    document.preview(goal(5));
    expect([goalX(), document.committed.peek()]).toEqual([5, before]);
    document.cancel();
    expect([goalX(), document.committed.peek(), steps()]).toEqual([undefined, before, []]);
  });

  it('becomes one step, with the cameras before and after it', () => {
    let cx = 0;
    document.camera = () => ({ cx, cy: 0, z: 8 });
    document.begin();
    for (let x = 0; x < 50; x++) document.preview(goal(x));
    cx = 300;
    const commit = document.commit(goal(50))!;
    expect([car(commit.before).goal.pos, car(commit.after).goal.pos?.[0]]).toEqual([null, 50]);
    expect(steps()).toHaveLength(1);
    const { step } = document.undo()!;
    expect([step.from?.cx, step.to?.cx, goalX()]).toEqual([0, 300, undefined]);
  });

  it('blocks all other commits', () => {
    document.run(setSeed(1));
    document.begin();
    document.preview(goal(5));
    const tries = [
      () => document.run(rename('X')),
      () => document.adopt('Theirs', crossing()),
      () => document.undo(),
      () => document.redo(),
      () => document.goTo(null),
    ];
    for (const commit of tries) expect(commit).toThrow(TrialOpenError);
    document.commit(goal(6));
    expect(steps()).toEqual(['Seed 1', expect.stringMatching(/^Goal of/)]);
    document.undo();
    expect([document.scene.peek()!.seed, document.scene.peek()!.name]).toEqual([1, crossing().name]);
  });

  it('ends when another scene is opened, also for a drag that goes on', () => {
    document.begin();
    document.preview(goal(5));
    document.open(crossing());
    expect(document.preview(goal(6))).toBe(false);
    expect(document.commit(goal(6))).toBeNull();
    expect([goalX(), steps()]).toEqual([undefined, []]);
  });

  it('delays work until its end, but not for a scene that is no longer open', () => {
    const done: string[] = [];
    document.afterTrial(() => done.push('at once'));
    document.begin();
    document.afterTrial(() => done.push('later'));
    expect(done).toEqual(['at once']);
    document.cancel();
    document.settle();
    expect(done).toEqual(['at once', 'later']);
    document.begin();
    document.afterTrial(() => done.push('never'));
    document.open(crossing());
    document.settle();
    expect(done).toEqual(['at once', 'later']);
  });
});
