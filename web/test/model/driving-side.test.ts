// Driving side: inferred from the lanes, or stored in the map's layout.
import { describe, expect, it } from 'vitest';
import type { MapJson, PointJson, SceneJson } from '../../src/model/document/scene-json';
import { drivingSide } from '../../src/model/physics/driving-side';
import { readScene } from '../../src/model/document/scene-reader';
import { View } from '../../src/draw/view';
import { overArea } from '../../src/edit/moves/placing';
import { PRESETS } from '../../src/model/base/kinds';
import { Layouts } from '../../src/edit/tools/layouts/layouts';
import { crossing, crossingJson } from '../helpers';

/** All lanes of a scene mirrored at the x axis: right-hand driving becomes left-hand. */
function mirrored(json: SceneJson): SceneJson {
  const over = ([x, y, ...z]: PointJson): PointJson => [x, -y, ...z] as unknown as PointJson;
  const map = json.map as MapJson;
  return {
    ...json,
    map: {
      ...map,
      lanes: map.lanes!.map((l) => ({ ...l, points_m: l.points_m.map(over) })),
      crosswalks: map.crosswalks?.map((a) => ({ ...a, polygon_m: a.polygon_m.map(over) })),
    },
  };
}
const leftHand = () => readScene(mirrored(crossingJson())).map;

describe('the side of the road', () => {
  it('is opposite to the lanes of the other direction', () => {
    expect(drivingSide(crossing().map)).toBe('right-hand');
    expect(drivingSide(leftHand())).toBe('left-hand');
  });

  it('is unknown for a map with only one direction, or with equal evidence for both', () => {
    const one = crossingJson();
    const map = one.map as MapJson;
    map.lanes = map.lanes!.filter((l) => l.id.startsWith('in'));
    expect(drivingSide(readScene(one).map)).toBeNull();
    const both = crossingJson();
    const far = mirrored(crossingJson()).map as MapJson;
    const away = (p: PointJson): PointJson => [p[0] + 1000, ...p.slice(1)] as unknown as PointJson;
    (both.map as MapJson).lanes!.push(
      ...far.lanes!.map((l) => ({
        ...l,
        id: `far ${l.id}`,
        points_m: l.points_m.map(away),
        predecessors: [],
        successors: [],
      })),
    );
    expect(drivingSide(readScene(both).map)).toBeNull();
  });

  it("is the one in a map's layout, whatever its lanes", () => {
    const { map } = crossing();
    expect(drivingSide(map, { template: 'merge', parameters: { traffic: 'left-hand' } })).toBe('left-hand');
    expect(drivingSide(map, { template: 'merge', parameters: { traffic: 'both' } })).toBe('right-hand');
    expect(drivingSide(map, null)).toBe('right-hand');
  });
});

describe('uses of the driving side', () => {
  it('pedestrians in an area keep to it', () => {
    const right = crossing();
    const left = { ...right, map: leftHand() };
    const choice = { kind: 'pedestrian', size: PRESETS.pedestrian[0], spread: 'area', count: 12 } as const;
    // Off the road all face along x or against it.
    const sides = (scene: typeof right) =>
      overArea(scene, choice, new View().frame([40, 40], [60, 60]), 10).map((n) =>
        Math.sign((n.pose.y - 50) * Math.cos(n.pose.heading)),
      );
    expect(new Set(sides(right))).toEqual(new Set([-1]));
    expect(new Set(sides(left))).toEqual(new Set([1]));
  });

  it('a new map has it until the user chooses another one', () => {
    const layouts = new Layouts();
    layouts.choose('four-arms', 'left-hand');
    expect(layouts.wish.value).toEqual({ template: 'four-arms', parameters: null, traffic: 'left-hand' });
  });
});
