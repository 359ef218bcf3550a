// Thresholds of events: stored with the scene, sent in requests, and changed without another motion.
import { describe, expect, it } from 'vitest';
import { choose, setSeed } from '../../src/model/document/commands';
import { readScene } from '../../src/model/document/scene-reader';
import { resultCode } from '../../src/model/document/result-code';
import type { Futures } from '../../src/model/document/futures';
import { NO_THRESHOLDS, sceneKey } from '../../src/model/document/scene';
import { readThresholds, resetThresholds, setThreshold, threshold } from '../../src/model/document/thresholds';
import { writeScene } from '../../src/model/document/scene-writer';
import { finalOf, json, Session } from './session';

const ID = '1';

describe('thresholds', () => {
  it('are the usual ones by default, and are stored in the file', () => {
    const t = new Session();
    const before = t.editor.scene.peek()!;
    expect([threshold(before, 'gap_m'), threshold(before, 'ttc_s')]).toEqual([1, 1.5]);
    t.editor.commits.run(setThreshold(before, 'gap_m', 2));
    const scene = t.editor.scene.peek()!;
    expect(scene.thresholds).toEqual({ gap_m: 2 });
    const file = writeScene(json, scene, null);
    expect(readScene(file).thresholds).toEqual({ gap_m: 2 });
    expect(sceneKey(readScene(file))).toBe(sceneKey(scene));
    // The usual value is not stored; invalid ones are dropped.
    expect(setThreshold(scene, 'gap_m', 1).apply(scene).thresholds).toBe(NO_THRESHOLDS);
    expect(readThresholds({ gap_m: -1, ttc_s: 'x', harsh_brake_mps2: 2, toString: 3 })).toEqual({
      harsh_brake_mps2: 2,
    });
    t.editor.commits.run(resetThresholds());
    expect(sceneKey(t.editor.scene.peek()!)).toBe(sceneKey(before));
    t.editor.commits.undo();
    expect(t.editor.scene.peek()!.thresholds).toEqual({ gap_m: 2 });
  });

  it('change no motion: followed futures are scored again, and selections requested again with them', () => {
    const t = new Session();
    t.editor.select(ID);
    t.generator.last.on.final(finalOf(ID), 10);
    t.editor.commits.run(choose(t.editor.agent.peek()!, 1, 'B'));
    t.editor.answers.settle(t.editor.scene.peek()!, { ...t.editor.answers.motion.peek(), key: '', stale: false }, null);
    const driving = t.editor.answers.motion.peek().futures.get(ID);
    const asked = t.generator.asked.length;
    t.editor.commits.run(setThreshold(t.editor.scene.peek()!, 'harsh_brake_mps2', 2));
    expect(t.editor.answers.motion.peek().futures.get(ID)).toBe(driving);
    expect([t.editor.answers.motion.peek().stale, t.generator.scored.length]).toEqual([false, 1]);
    expect(t.generator.asked.length).toBe(asked);
    t.editor.select('2');
    expect(t.generator.last.options.thresholds).toEqual({ harsh_brake_mps2: 2 });
  });
});

describe('the code of a result', () => {
  it('is equal for equal scenes with any name, and differs with any condition', () => {
    const t = new Session();
    const [scene, set] = [t.editor.scene.peek()!, t.editor.answers.motion.peek()];
    const code = resultCode(scene, set);
    expect(code).toMatch(/^[0-9A-HJKMNP-TV-Z]{6}$/);
    expect(resultCode(readScene({ ...json, id: 'other', name: 'Other' }), set)).toBe(code);
    const a = scene.agents.get(ID)!;
    const others = [
      setSeed(7).apply(scene),
      setThreshold(scene, 'ttc_s', 2).apply(scene),
      choose(a, 2, 'C').apply(scene),
      readScene({ ...json, agents: json.agents.slice(1) }),
    ];
    const codes = new Set([code, ...others.map((s) => resultCode(s, set))]);
    const engine = resultCode(others[2], { ...set, head: { weights: { car: 'x' } } });
    expect(codes.add(engine).size).toBe(others.length + 2);
  });

  it('differs with the motions that are followed', () => {
    const t = new Session();
    const scene = t.editor.scene.peek()!;
    const code = (first: number) => {
      const motion = { ...scene.agents.get(ID)!.log, first };
      const futures = new Map([[ID, { modes: [{ motion }], chosen: 0, step: 5, steps: 5 } as unknown as Futures]]);
      return resultCode(scene, { ...t.editor.answers.motion.peek(), futures, driving: new Set([ID]) });
    };
    expect(code(1)).toBe(code(1));
    expect(code(2)).not.toBe(code(1));
  });
});
