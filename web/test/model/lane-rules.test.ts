// Rules of lanes that a scene changes: in the document, in its map, and in the file beside what the lanes were.
import { describe, expect, it } from 'vitest';
import { setLaneRule } from '../../src/edit/tools/map-items/lane-rule';
import { formerRules, mapWith, ruleOf } from '../../src/model/document/lanemap';
import type { Scene } from '../../src/model/document/scene';
import { applyDiff, diffOf, stateOf, withState } from '../../src/model/document/scene-diff';
import type { MapJson, SceneJson } from '../../src/model/document/scene-json';
import { readScene } from '../../src/model/document/scene-reader';
import { writeScene } from '../../src/model/document/scene-writer';
import { crossingJson } from '../helpers';

const json = crossingJson();
const map = json.map as MapJson;
const { id } = map.lanes!.find((l) => l.type === 'surface_street' && l.speed_limit_mps)!;
const scene = readScene(json);
const lane = (s: Scene) => s.map.lanes.get(id)!;
const rule = { speed_limit_mps: 25 / 3.6, type: 'bus_lane' } as const;
const inMap = { limit: rule.speed_limit_mps, type: rule.type };
const changed = setLaneRule(scene, lane(scene), rule, 'changed').apply(scene);
const written = (s: Scene): SceneJson => writeScene(json, s, null, mapWith(map, s.laneRules));

describe('a rule of a lane', () => {
  it('is in the map of the document, on that lane alone', () => {
    expect(lane(changed)).toMatchObject(inMap);
    expect(changed.map.grid.near(...lane(scene).line.pts[0], 1)).toContain(lane(changed));
    for (const [other, was] of scene.map.lanes) if (other !== id) expect(changed.map.lanes.get(other)).toBe(was);
    const cyclists = setLaneRule(scene, lane(scene), { ...rule, type: 'bike_lane' }, '').apply(scene);
    expect([lane(scene).kind, lane(changed).kind, lane(cyclists).kind]).toEqual(['road', 'road', 'bike']);
  });

  it('is undone by its inverse and by a stored step, and gone when it is as in the map', () => {
    const back = [
      setLaneRule(scene, lane(scene), rule, 'changed').invert(scene).apply(changed),
      applyDiff(changed, diffOf(scene, changed), 'back'),
      setLaneRule(changed, lane(changed), ruleOf(lane(scene)), '').apply(changed),
    ];
    for (const s of back) {
      expect(s.laneRules).toEqual({});
      expect(lane(s)).toEqual(lane(scene));
    }
    expect(lane(applyDiff(scene, diffOf(scene, changed), 'forth'))).toMatchObject(inMap);
    expect(lane(withState(scene, structuredClone(stateOf(changed))))).toMatchObject(inMap);
  });

  it('is in the map of a file, which keeps what the lane was', () => {
    const file = structuredClone(written(changed));
    const there = (file.map as MapJson).lanes!.find((l) => l.id === id)!;
    expect([there.speed_limit_mps, there.type]).toEqual([rule.speed_limit_mps, rule.type]);
    expect(formerRules(file)).toEqual({ [id]: ruleOf(lane(scene)) });
    const again = readScene(file);
    expect(again.laneRules).toEqual(changed.laneRules);
    expect(lane(again)).toEqual(lane(changed));
    // The order of changes does not matter: equal rules, equal texts.
    const [first, last] = ['a', 'b'].map((name) => ({ ...lane(scene), id: name }));
    const both = (...all: (typeof first)[]) =>
      all.reduce((s, l) => ({ ...s, laneRules: setLaneRule(s, l, rule, '').apply(s).laneRules }), scene);
    expect(JSON.stringify(both(first, last).laneRules)).toBe(JSON.stringify(both(last, first).laneRules));
    // The step back leads to the rule of the map, in the document and in a file.
    const back = applyDiff(again, diffOf(scene, changed), 'back');
    expect(lane(back)).toEqual(lane(scene));
    expect(written(back)).toEqual(written(scene));
  });
});
