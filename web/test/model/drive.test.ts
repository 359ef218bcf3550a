// A drive as a step of the document: its tracks become the recordings, and undo restores everything.
import { describe, expect, it } from 'vitest';
import type { Columns } from '../../src/model/base/motion';
import { setGoal } from '../../src/model/document/commands';
import { recordDrive } from '../../src/model/document/drive';
import { History } from '../../src/model/document/history';
import { freeGoal, hasGoal, sceneKey, touchedIn } from '../../src/model/document/scene';
import { applyDiff, diffOf, stateOf, withState } from '../../src/model/document/scene-diff';
import { readScene } from '../../src/model/document/scene-reader';
import { timedJson, writeScene } from '../../src/model/document/scene-writer';
import { motionOf } from '../../src/model/physics/playback';
import { emptyMotion } from '../../src/model/document/futures';
import { car, crossing, crossingJson } from '../helpers';

const STEPS = 31;

/** A straight motion from a place, from a step on. */
const line = (x: number, y: number, first = 0): Columns => {
  const n = STEPS - first;
  const of = (v: (i: number) => number): number[] => Array.from({ length: n }, (_, i) => v(i));
  return {
    first_step: first,
    x_m: of((i) => x + 0.5 * i),
    y_m: of(() => y),
    heading_rad: of(() => 0),
    vx_mps: of(() => 5),
    vy_mps: of(() => 0),
  };
};

const json = crossingJson();
const before = setGoal(car(crossing()), { ...freeGoal(), pos: [10, 10] }).apply(crossing());
const ids = [...before.agents.keys()];
/** Everybody drives but the last, who is not there yet. */
const tracks = new Map(ids.slice(0, -1).map((id, i) => [id, line(i * 10, -50, i === 1 ? 4 : 0)] as const));
const late = before.agents.get(ids[ids.length - 1])!;
const scene = { ...before, agents: new Map(before.agents).set(late.id, { ...late, log: { ...late.log, first: 60 } }) };
const command = recordDrive(scene, car(scene), tracks, STEPS);
const after = command.apply(scene);

describe('a recorded drive', () => {
  it('is what all road users replay, and asks nothing of the generator', () => {
    for (const [id, track] of tracks) {
      const a = after.agents.get(id)!;
      expect(Array.from(motionOf(after, emptyMotion(''), a).x)).toEqual(track.x_m);
      expect(a.log.first).toBe(track.first_step);
    }
    expect(touchedIn(after)).toEqual([]);
    expect(after.agents.has(late.id)).toBe(false);
    expect([after.steps, after.duration, after.length]).toEqual([STEPS, 3, 9]);
  });

  it('differs from the scene before, and from another drive, for everything that is known by its document', () => {
    const other = recordDrive(scene, car(scene), new Map([...tracks, [car(scene).id, line(1, 1)]]), STEPS);
    const keys = [scene, after, other.apply(scene)].map(sceneKey);
    expect(new Set(keys).size).toBe(3);
  });

  it('is undone exactly', () => {
    const history = new History(scene);
    history.run(command);
    history.undo();
    expect(history.scene).toEqual(scene);
    expect(hasGoal(car(scene).goal)).toBe(true);
    expect(applyDiff(after, diffOf(scene, after), 'back')).toEqual(scene);
    expect(applyDiff(scene, diffOf(scene, after), 'forth')).toEqual(after);
  });

  it('is kept by the browser without the file, and in the file', () => {
    expect(withState(crossing(), stateOf(after))).toEqual(after);
    const written = writeScene(json, after, null);
    expect(written.time?.steps).toBe(STEPS);
    expect(timedJson(json, scene).time).toBeUndefined();
    const again = readScene(structuredClone(written), json.map as never);
    expect(again.steps).toBe(STEPS);
    expect(sceneKey(again)).toBe(sceneKey(after));
    for (const [id, track] of tracks) expect(Array.from(again.agents.get(id)!.log.x)).toEqual(track.x_m);
  });
});
