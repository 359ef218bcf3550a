// Flags dropped anywhere between the lines of a lane, on the five examples.
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { deg, pointAt, project, wrapAngle } from '../../src/model/base/geometry';
import { readScene } from '../../src/model/document/scene-reader';
import { startPose } from '../../src/model/document/scene';
import { lanesAhead, laneWords, snapToLane } from '../../src/edit/moves/snap';

const FOLDER = join(__dirname, '../../../assets/scenes');
const DROPS = 120;
const ZOOM = 9;

/** Pseudo-random numbers from 0 to 1, the same in every run. */
function random(): () => number {
  let state = 7;
  return () => (state = (state * 16807) % 2147483647) / 2147483647;
}

const scenes = readdirSync(FOLDER)
  .filter((name) => name.endsWith('.json'))
  .map((name) => readScene(JSON.parse(readFileSync(join(FOLDER, name), 'utf8'))));

describe('a flag dropped between the lines of a lane', () => {
  it.each(scenes.map((s) => [s.name, s] as const))('is in a lane that a car may use, along it: %s', (_, scene) => {
    const next = random();
    const pick = <T>(all: readonly T[]): T => all[Math.floor(next() * all.length)];
    const cars = [...scene.agents.values()].filter((a) => a.kind === 'car' && (startPose(a)?.speed ?? 0) > 1);
    const roads = [...scene.map.lanes.values()].filter((l) => l.kind === 'road');
    let mine = 0;
    for (let i = 0; i < DROPS; i++) {
      const a = pick(cars);
      const start = startPose(a)!;
      const ahead = lanesAhead(scene.map, a, start);
      const lane = pick(roads);
      const on = pointAt(lane.line, next() * lane.line.length);
      const aside = (next() - 0.5) * (lane.width - 0.2);
      const [x, y] = [on.x - Math.sin(on.heading) * aside, on.y + Math.cos(on.heading) * aside];
      const travel = Math.atan2(y - start.y, x - start.x);
      const s = snapToLane(scene.map, a, x, y, travel, ZOOM, null, travel, ahead);
      if (!s.lane) continue;
      expect(s.lane.kind).toBe('road');
      expect(s.lane.inside && ahead !== null && !ahead.has(s.lane.id), `${a.name} in ${s.lane.id}`).toBe(false);
      const along = project(s.lane.line, x, y).heading;
      expect(Math.abs(deg(wrapAngle(s.laneHeading! - along)))).toBeLessThan(5);
      if (ahead?.has(s.lane.id)) mine++;
    }
    expect(mine).toBeGreaterThan(5);
  });

  it('is called turning only along the turn', () => {
    const { map } = scenes.find((s) => s.id === 'demo-crossing')!;
    const car = { type: 'vehicle' } as const;
    for (const across of [Math.PI, null]) expect(laneWords(map, car, -12, 9, across)).toBe('inside the junction');
    expect(laneWords(map, car, -10, 9, -2.5)).toBe('in the junction, turning right');
  });

  it('takes the heading of the lane from a metre and a half beside its middle', () => {
    const scene = scenes.find((s) => s.id === 'demo-motorway')!;
    const a = [...scene.agents.values()].find((one) => one.kind === 'car' && (startPose(one)?.speed ?? 0) > 5)!;
    const start = startPose(a)!;
    const ahead = lanesAhead(scene.map, a, start)!;
    const lane = [...ahead].map((id) => scene.map.lanes.get(id)!).find((l) => l.line.length > 40)!;
    const on = pointAt(lane.line, lane.line.length - 5);
    for (const aside of [-1.5, -1, 0, 1, 1.5]) {
      const [x, y] = [on.x - Math.sin(on.heading) * aside, on.y + Math.cos(on.heading) * aside];
      const s = snapToLane(scene.map, a, x, y, on.heading, 40, null, null, ahead);
      expect(s.lane).not.toBeNull();
      expect(Math.abs(wrapAngle(s.laneHeading! - on.heading))).toBeLessThan(0.05);
    }
  });
});
