// Motions that are sent for scoring: the server knows those of all others.
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { setGoal } from '../../src/model/document/commands';
import { withAgents } from '../../src/model/document/scene';
import { scoreOf } from '../../src/edit/asking/scoring';
import { SceneFile } from '../../src/edit/document/scene-file';
import { finalWith, json, late, Session } from './session';

describe('a score', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it('is requested with the motions of late arrivals that react', async () => {
    const { editor, generator } = new Session();
    const file = new SceneFile(editor);
    file.adopt(json, {} as never, true);
    editor.select('1');
    generator.last.on.final(finalWith({}), 5);
    const a = editor.scene.peek()!.agents.get('1')!;
    editor.commits.run(setGoal(a, { ...a.goal, pos: [10, 10] }));
    vi.advanceTimersByTime(100);
    generator.last.on.final(finalWith({ 2: late('2', 3, '1') }), 5);
    const scene = editor.scene.peek()!;
    const second = scene.agents.get('2')!;
    const later = withAgents(scene, [{ ...second, logStart: null }]);
    await scoreOf(generator, file, later, editor.answers.motion.peek());
    expect(generator.scored.at(-1)!.ids).toContain('2');
    expect(generator.scored.at(-1)!.ids).not.toContain('3');
  });
});
