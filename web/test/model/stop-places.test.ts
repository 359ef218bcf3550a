// Stop places on a path, and names of lanes at a junction.
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { armLane } from '../../src/model/words/arm-names';
import { pointAt } from '../../src/model/base/geometry';
import { turnOf, type Lane } from '../../src/model/document/lanemap';
import type { Path } from '../../src/model/document/profile';
import type { SceneJson } from '../../src/model/document/scene-json';
import { readScene } from '../../src/model/document/scene-reader';
import { startPose } from '../../src/model/document/scene';
import { stopPlaces } from '../../src/model/physics/stop-places';
import { car, crossing } from '../helpers';

const scene = crossing();
const lanes = [...scene.map.lanes.values()];

const example = (id: string): SceneJson =>
  JSON.parse(readFileSync(new URL(`../../../assets/scenes/${id}.json`, import.meta.url), 'utf8')) as SceneJson;

/** Along a lane and on over the junction. */
function wayOver(lane: Lane): Path {
  const over = lane.next.map((id) => scene.map.lanes.get(id)!).find((l) => l.inside)!;
  const pts = [...lane.line.pts, ...over.line.pts.slice(1)];
  return { x: pts.map((p) => p[0]), y: pts.map((p) => p[1]), heading: pts.map(() => 0) };
}

const lit = lanes.filter(
  (l) =>
    l.kind === 'road' &&
    !l.inside &&
    l.next.some((id) => scene.map.lanes.get(id)?.inside) &&
    scene.signals.some((g) => g.lane === l.id || l.next.includes(g.lane)),
);

describe('stop places', () => {
  it('are the stop lines of a path, just before the end of the lane', () => {
    expect(lit.length).toBeGreaterThan(0);
    for (const lane of lit) {
      const all = stopPlaces(scene, car(scene), wayOver(lane));
      const line = all.find((p) => p.words === 'at the stop line');
      expect(line?.s).toBeCloseTo(lane.line.length - 0.3, 0);
    }
  });

  it('are 2 m behind a road user that stands in the way', () => {
    const [lane] = lit;
    const p = pointAt(lane.line, lane.line.length - 20);
    const me = car(scene);
    const b = [...scene.agents.values()].find((a) => a.type === 'vehicle' && a.id !== me.id && startPose(a))!;
    const stood = { ...b, parked: false, start: { pos: [p.x, p.y] as const, heading: p.heading, speed: 0 } };
    const agents = new Map(scene.agents).set(b.id, stood);
    const found = stopPlaces({ ...scene, agents }, me, wayOver(lane)).find((q) => q.words === `behind ${b.name}`);
    expect(found?.s).toBeCloseTo(lane.line.length - 20 - b.length / 2 - 2, 0);
  });
});

describe('lanes at the only junction', () => {
  it('are named by their arm, and by their direction where there is only one', () => {
    for (const lane of lit) {
      const words = armLane(scene.map, lane)!.name;
      const end = pointAt(lane.line, lane.line.length);
      // The lane leads to the centre: its arm is on the other side.
      const back = ['W', 'SW', 'S', 'SE', 'E', 'NE', 'N', 'NW'][
        ((Math.round((end.heading * 4) / Math.PI) % 8) + 8) % 8
      ];
      expect(words).toMatch(new RegExp(`^${back} arm, (inbound|left-turn|right-turn) lane$`));
      const turns = lane.next.map((id) => turnOf(scene.map.lanes.get(id)!.line));
      if (turns.every((t) => t > 0.35)) expect(words).toMatch(/left-turn/);
    }
    const out = lanes.find(
      (l) => !l.inside && l.kind === 'road' && l.prev.some((id) => scene.map.lanes.get(id)?.inside),
    )!;
    expect(armLane(scene.map, out)?.name).toMatch(/^[NESW]+ arm, outbound lane$/);
  });

  it('are outbound where they lead away from a roundabout, also towards another junction', () => {
    const { map } = readScene(example('demo-roundabout'));
    const away = [...map.lanes.values()].filter((l) => {
      const [start, end] = [pointAt(l.line, 0), pointAt(l.line, l.line.length)];
      return !l.inside && l.kind === 'road' && Math.hypot(end.x, end.y) > Math.hypot(start.x, start.y) + 10;
    });
    const words = away.flatMap((l) => armLane(map, l)?.name ?? []);
    expect(words.length).toBeGreaterThan(2);
    expect(words.filter((w) => !/outbound lane$|bus lane$/.test(w))).toEqual([]);
    // A vehicle that enters may leave by any arm, and a part of the ring is on none.
    const all = [...map.lanes.values()].filter((l) => !l.inside).map((l) => armLane(map, l)?.name);
    expect(all.filter((w) => w && /turn lane$|^(NE|NW|SE|SW)/.test(w))).toEqual([]);
    expect(all.filter((w) => w?.endsWith('inbound lane')).length).toBeGreaterThan(3);
  });
});
