// The active part of a scene: for the first view, and for its thumbnail.
import { boxOf, type Box, type Vec } from '../base/geometry';
import { poseAtStep } from '../base/motion';
import { startPose, type Scene } from '../document/scene';

/** The centre of movement: the median, so that one distant queue does not shift it. */
function busyCentre(scene: Scene): [number, number] {
  const at = [...scene.agents.values()]
    .filter((a) => !a.parked && a.type !== 'other')
    .map(startPose)
    .filter((p) => p !== null);
  if (!at.length) return [(scene.map.box.x0 + scene.map.box.x1) / 2, (scene.map.box.y0 + scene.map.box.y1) / 2];
  const median = (v: number[]): number => v.sort((a, b) => a - b)[v.length >> 1];
  return [median(at.map((p) => p.x)), median(at.map((p) => p.y))];
}

/** A road user moves if its recording covers this distance. */
const MOVES_M = 3;

/** Starts, or first poses, of moving road users. */
function movers(scene: Scene): Vec[] {
  const out: Vec[] = [];
  for (const a of scene.agents.values()) {
    const seen = a.log.valid;
    if (a.parked || a.type === 'other' || !seen.length) continue;
    const from = poseAtStep(a.log, seen[0][0]),
      to = poseAtStep(a.log, seen[seen.length - 1][1] - 1);
    if (from && to && Math.hypot(to.x - from.x, to.y - from.y) > MOVES_M) out.push([from.x, from.y]);
  }
  return out;
}

/** A junction stays in view unless this many times as much moves elsewhere. */
const RATHER_THE_JUNCTION = 1.25;

/** The centre of a view of this half size, in metres, with the most movement. */
export function openingCentre(scene: Scene, halfWidth: number, halfHeight: number): [number, number] {
  const junction = sceneCentre(scene);
  const all = movers(scene);
  const near = ([x, y]: Vec): Vec[] =>
    all.filter((p) => Math.abs(p[0] - x) < halfWidth && Math.abs(p[1] - y) < halfHeight);
  let best: readonly Vec[] = [];
  for (const at of all) {
    const round = near(at);
    if (round.length > best.length) best = round;
  }
  if (best.length <= RATHER_THE_JUNCTION * near(junction).length) return junction;
  const middle = (i: 0 | 1): number => best.reduce((sum, p) => sum + p[i], 0) / best.length;
  return [middle(0), middle(1)];
}

const JUNCTION_M = 30;

/**
 * The centre of the junction near the active part; without one, the active centre itself. Without road users, the
 * largest junction, else a place on a road near the map's centre.
 */
export function sceneCentre(scene: Scene): [number, number] {
  const [bx, by] = busyCentre(scene);
  const within = scene.agents.size ? 2 * JUNCTION_M : Infinity;
  const middles = [...scene.map.lanes.values()]
    .filter((l) => l.kind === 'road')
    .map((l) => ({ at: l.line.pts[l.line.pts.length >> 1], inside: l.inside }));
  const away = ([x, y]: Vec): number => Math.hypot(x - bx, y - by);
  const inside = middles.filter((m) => m.inside && away(m.at) < within).map((m) => m.at);
  let best: readonly Vec[] = [],
    score = 0;
  for (const [x, y] of inside) {
    const round = inside.filter((p) => Math.hypot(p[0] - x, p[1] - y) < JUNCTION_M);
    const s = round.length - Math.hypot(x - bx, y - by) / 20;
    if (s > score) {
      score = s;
      best = round;
    }
  }
  if (best.length < 4) {
    if (scene.agents.size || !middles.length) return [bx, by];
    const [x, y] = middles.map((m) => m.at).reduce((a, b) => (away(b) < away(a) ? b : a));
    return [x, y];
  }
  const mean = (i: 0 | 1): number => best.reduce((sum, p) => sum + p[i], 0) / best.length;
  return [mean(0), mean(1)];
}

/** The box of the road users: their middle four fifths, so that a distant one does not shrink the rest. */
export function busyBox(scene: Scene, margin = 8): Box {
  const moving = [...scene.agents.values()].filter((a) => !a.parked && a.type !== 'other');
  const at = moving.map(startPose).filter((p) => p !== null);
  if (at.length < 3) return scene.map.box;
  const cut = (v: number[]): [number, number] => {
    v.sort((a, b) => a - b);
    const n = Math.floor(v.length * 0.1);
    return [v[n], v[v.length - 1 - n]];
  };
  const [x0, x1] = cut(at.map((p) => p.x)),
    [y0, y1] = cut(at.map((p) => p.y));
  const b = boxOf([
    [x0, y0],
    [x1, y1],
  ] as Vec[]);
  return { x0: b.x0 - margin, y0: b.y0 - margin, x1: b.x1 + margin, y1: b.y1 + margin };
}
