// A kerb between a flag and its lane: a road to the east, a divided one to the west, a drive to the south.
import { beforeEach, describe, expect, it } from 'vitest';
import { buildMap } from '../../src/model/document/lanemap';
import { firstKerb, laneLeadsTo } from '../../src/model/physics/kerbs';
import type { Vec } from '../../src/model/base/geometry';
import { readFutures } from '../../src/model/words/named-futures';
import { startPose } from '../../src/model/document/scene';
import { Resistance } from '../../src/edit/gestures/resistance';
import { crossingJson } from '../helpers';
import { sixFutures } from '../standin/futures.mjs';
import { judged, MEDIAN } from '../standin/judged.mjs';
import { Pointer } from './pointer';

const edge = (id: string, type: string, ...points_m: [number, number][]) => ({ id, type, points_m });
const map = buildMap({
  lanes: [
    { id: 'east', points_m: [[0, -2], [50, -2]], successors: ['on', 'drive'] }, // prettier-ignore
    { id: 'on', points_m: [[50, -2], [200, -2]], predecessors: ['east'] }, // prettier-ignore
    { id: 'drive', points_m: [[50, -2], [62, -6], [66, -30]], predecessors: ['east'] }, // prettier-ignore
    { id: 'west', points_m: [[200, 6], [0, 6]] }, // prettier-ignore
  ],
  road_edges: [
    edge('median-south', 'median', [0, 1], [100, 1]),
    edge('median-north', 'median', [0, 3], [100, 3]),
    edge('kerb-west', 'boundary', [0, -4], [56, -4]),
    edge('kerb-east', 'boundary', [64, -4], [200, -4]),
  ],
});
const start = { x: 5, y: -2, heading: 0, speed: 10 };
const fits = () => true;
const ZOOM = 10;
const from = (x: number, y: number) => new Resistance(map, start, fits, { x, y });
const dragged = (r: Resistance, ...places: Vec[]): Vec =>
  places.reduce<Vec>((_, place) => r.to(place, ZOOM).map((v) => Math.round(v * 1e6) / 1e6) as unknown as Vec, [0, 0]);

describe('a kerb', () => {
  it('is met at the first crossing of the straight line', () => {
    expect(firstKerb(map, [40, -2], [40, 8])).toEqual([40, 1]);
    expect(firstKerb(map, [40, 8], [40, -2])).toEqual([40, 3]);
    expect(firstKerb(map, [120, -2], [120, 8])).toBeNull();
  });

  it('does not count where a lane leads to the other side without a detour', () => {
    expect(laneLeadsTo(map, start, { x: 65, y: -12 }, fits)).toBe(true);
    // The opposite lane is near, but does not start here; beyond the kerb there is none.
    expect(laneLeadsTo(map, start, { x: 40, y: 6 }, fits)).toBe(false);
    expect(laneLeadsTo(map, start, { x: 40, y: -7 }, fits)).toBe(false);
  });
});

describe('resistance', () => {
  it('holds the flag at the kerb, then lets it follow 24 px behind', () => {
    const r = from(40, -2);
    expect(dragged(r, [40, 0.9])).toEqual([40, 0.9]);
    expect(r.held).toBe(false);
    expect(dragged(r, [40, 2])).toEqual([40, 1]);
    expect(r.held).toBe(true);
    expect(dragged(r, [40, 6])).toEqual([40, 3.6]);
    expect(dragged(r, [40, 9])).toEqual([40, 6.6]);
  });

  it('ends on the way back, round the end of the median and at Alt', () => {
    const r = from(40, -2);
    expect(dragged(r, [40, 6], [40, 0])).toEqual([40, 0]);
    expect(r.held).toBe(false);
    expect(dragged(from(90, -2), [105, 0], [105, 6], [90, 6])).toEqual([90, 6]);
    dragged(r, [40, 6]);
    r.pass();
    expect(dragged(r, [40, 6])).toEqual([40, 6]);
    // It stays off, however often the kerb is crossed.
    expect(dragged(r, [40, 0], [40, 5])).toEqual([40, 5]);
    expect(r.held).toBe(false);
  });

  it('is none on the way to a drive, nor for a flag that is already behind a kerb', () => {
    expect(dragged(from(45, -2), [65, -12])).toEqual([65, -12]);
    expect(dragged(from(40, 6), [40, 2.5])).toEqual([40, 2.5]);
    expect(dragged(from(40, 6), [40, -2])).toEqual([40, -2]);
  });

  it('applies again for a flag that has returned to its road', () => {
    expect(dragged(from(40, 6), [40, -2], [40, 6])).toEqual([40, 3.6]);
  });
});

describe('a flag at a kerb', () => {
  let p: Pointer;
  let lane: Vec;
  beforeEach(() => {
    p = new Pointer();
    p.view.z = ZOOM;
    p.editor.select('1');
    p.hit = { kind: 'grip', grip: { part: 'goal', handle: 'body' } };
    const at = startPose(p.editor.agent.peek()!)!;
    // The goal of a car without futures: ahead in its lane, with the kerb at y = -8.8 on its right.
    lane = [at.x + 20, at.y];
  });
  const goal = () => p.editor.agent.peek()!.goal.pos!;
  const over = (mods = {}) => p.move(p.at(lane[0], -12), mods);
  const take = (touch = false) => p.down(p.at(...lane), { touch });

  it('hangs on a line to the pointer, and stays where it hangs', () => {
    take();
    p.move(p.at(lane[0], -6));
    expect(p.editor.drag.info.peek()!.lag).toBeNull();
    over();
    expect(goal()[1]).toBeCloseTo(-9.6);
    const { from, to } = p.editor.drag.info.peek()!.lag!;
    expect([to[1], to[1] - from[1]].map((v) => Math.round(v * 10) / 10)).toEqual([-12, -2.4]);
    p.up(p.at(lane[0], -12));
    expect(goal()[1]).toBeCloseTo(-9.6);
  });

  it('is released by Alt until the end of the drag, also when Alt is released first', () => {
    take();
    over();
    over({ alt: true });
    expect(goal()[1]).toBeCloseTo(-12);
    p.move(p.at(lane[0], -13));
    expect([goal()[1], p.editor.drag.info.peek()!.lag]).toEqual([expect.closeTo(-13), null]);
    p.up(p.at(lane[0], -13));
    p.hit = { kind: 'grip', grip: { part: 'goal', handle: 'body' } };
    p.editor.commits.undo();
    take();
    over();
    expect(p.editor.drag.info.peek()!.lag).not.toBeNull();
  });

  it('may cross what the shown future crosses, as long as Alt is held past a kerb', () => {
    const futures = readFutures(
      { chosen: 0, modes: judged(sixFutures(crossingJson().agents[0], {}, 5, 5), ['2', '17']) },
      startPose(p.editor.agent.peek()!)!,
      5,
      5,
      false,
    );
    const mayCross = () => p.editor.agent.peek()!.goal.mayCross;
    take();
    p.move(p.at(lane[0], -6), { alt: true });
    p.editor.answers.showDraft('1', futures);
    p.move(p.at(lane[0], -7), { alt: true });
    // On this side of the kerb Alt only disables lanes.
    expect(mayCross()).toEqual([]);
    over({ alt: true });
    expect(mayCross()).toEqual([MEDIAN]);
    over();
    expect(mayCross()).toEqual([]);
    over({ alt: true });
    p.up(p.at(lane[0], -12));
    expect(mayCross()).toEqual([MEDIAN]);
    p.editor.commits.undo();
    expect([p.editor.agent.peek()!.goal.pos, mayCross()]).toEqual([null, []]);
  });

  it('holds back a finger, which passes when it rests', () => {
    take(true);
    over();
    expect(p.ticked).toBe(1);
    expect(p.editor.drag.info.peek()!.lag!.touch).toBe(true);
    const rest = (frames: number) => {
      for (let i = 0; i < frames; i++) p.frame(0.05);
    };
    rest(5);
    // A moving finger has not rested.
    p.move(p.at(lane[0], -14));
    rest(6);
    expect(goal()[1]).toBeCloseTo(-11.6);
    rest(3);
    expect([goal()[1], p.ticked]).toEqual([expect.closeTo(-14), 1]);
  });

  it('does not hold back a dragged start', () => {
    p.hit = { kind: 'grip', grip: { part: 'start', handle: 'body' } };
    const at = startPose(p.editor.agent.peek()!)!;
    p.down(p.at(at.x, at.y));
    p.move(p.at(at.x, -12));
    expect(p.editor.drag.info.peek()!.lag).toBeNull();
    expect(p.editor.agent.peek()!.start.pos![1]).toBeCloseTo(-12);
  });
});
