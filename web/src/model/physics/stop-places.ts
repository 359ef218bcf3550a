// Stop places on a path: at a stop line, before a crosswalk, behind a standing road user.
import { JUDGING, PLANNING } from '../base/domain';
import { insidePolygon, pointAt, project, wrapAngle, type Vec } from '../base/geometry';
import { alongOf, lineOf } from './speed-profile';
import { SIGN_M } from '../document/lanemap';
import type { Path } from '../document/profile';
import { TEXTS } from '../../texts/scene/places';
import { startPose, type Agent, type Scene } from '../document/scene';

/** A place along a path for the front, in metres from its start. */
export interface StopPlace {
  readonly s: number;
  readonly words: string;
}

/** View only: places closer than this are one: the line before the crosswalk counts. */
const APART_M = 1;

export function stopPlaces(scene: Scene, a: Agent, path: Path): StopPlace[] {
  if (path.x.length < 2) return [];
  const all = [...stopLines(scene, path), ...queueEnds(scene, a, path), ...crosswalks(scene, path)];
  return all.filter((p, i) => p.s > 0 && !all.slice(0, i).some((q) => Math.abs(q.s - p.s) < APART_M));
}

function stopLines({ map, signals }: Scene, path: Path): StopPlace[] {
  const line = lineOf(path);
  const lit = new Set(signals.map((g) => g.lane));
  const out: StopPlace[] = [];
  for (const lane of map.lanes.values()) {
    const end = pointAt(lane.line, lane.line.length);
    const signed = map.stopSigns.some(([x, y]) => Math.hypot(x - end.x, y - end.y) < SIGN_M);
    if (lane.inside || !(signed || lit.has(lane.id) || lane.next.some((id) => lit.has(id)))) continue;
    const on = project(line, end.x, end.y);
    const along = Math.abs(wrapAngle(pointAt(line, on.s).heading - end.heading)) < PLANNING.stop_line_turned_rad;
    if (on.d < PLANNING.stop_line_beside_m && along)
      out.push({ s: on.s - PLANNING.stop_line_gap_m, words: TEXTS.atTheStopLine });
  }
  return out;
}

function crosswalks({ map }: Scene, path: Path): StopPlace[] {
  const along = alongOf(path);
  return map.crosswalks.flatMap((area) => {
    const on = path.x.map((x, i) => insidePolygon(x, path.y[i], area));
    const i = on.findIndex((inside, k) => inside && k > 0 && !on[k - 1]);
    return i < 0
      ? []
      : [{ s: edgeOf(path, along, i, area) - PLANNING.stop_line_gap_m, words: TEXTS.beforeTheCrosswalk }];
  });
}

/** The point between two places of a path where an area begins. */
function edgeOf(path: Path, along: readonly number[], i: number, area: readonly Vec[]): number {
  let [out, into] = [0, 1];
  const at = (k: number): Vec => [
    path.x[i - 1] + (path.x[i] - path.x[i - 1]) * k,
    path.y[i - 1] + (path.y[i] - path.y[i - 1]) * k,
  ];
  for (let n = 0; n < 6; n++) {
    const k = (out + into) / 2;
    if (insidePolygon(...at(k), area)) into = k;
    else out = k;
  }
  return along[i - 1] + (along[i] - along[i - 1]) * out;
}

function queueEnds(scene: Scene, a: Agent, path: Path): StopPlace[] {
  const line = lineOf(path);
  const out: StopPlace[] = [];
  for (const b of scene.agents.values()) {
    const p = b.id === a.id || b.type === 'pedestrian' ? null : startPose(b);
    if (!p || b.parked || Math.abs(p.speed) > JUDGING.standing_mps) continue;
    const on = project(line, p.x, p.y);
    if (on.d < PLANNING.in_queue_m && on.s > a.length)
      out.push({ s: on.s - b.length / 2 - PLANNING.queue_gap_m, words: TEXTS.behind(b.name) });
  }
  return out;
}
