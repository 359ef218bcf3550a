// Whose motions are sent to be scored: of all others it is known what they do.
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { setGoal } from '../../src/model/document/commands';
import { withAgents } from '../../src/model/document/scene';
import { scoreOf } from '../../src/edit/asking/scoring';
import { SceneFile } from '../../src/edit/document/scene-file';
import { finalWith, json, late, Session } from './session';

describe('a score', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it('is asked with what those do who come in later and answer somebody', async () => {
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
