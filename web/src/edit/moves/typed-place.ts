// A place typed as a distance from the start, along the lane: "100 m ahead".
import { pointAt, type Pose } from '../../model/base/geometry';
import { metres as lengths, parseTyped } from '../../model/base/units';
import { nearestLanes, turnOf, type Lane } from '../../model/document/lanemap';
import { startPose, type Agent, type GoalSpec } from '../../model/document/scene';
import type { Editor } from '../session/editor';
import { lanesFor } from './snap';
import { TEXTS } from '../../texts/editing/relation';

/** How far from the lane a start counts as on it, metres. */
const ON_LANE_M = 4;
/** Longest typed distance, metres: lanes that end in each other lead on for ever. */
const FARTHEST_M = 10_000;

/** Where a typed text leads; why nowhere; null for a text of another form. */
export function typedPlace(e: Editor, a: Agent, text: string): Pick<GoalSpec, 'pos' | 'heading'> | string | null {
  const [, figure, word] = /^(.*\d.*?)\s+(\p{L}+)$/u.exec(text.trim().toLowerCase()) ?? [];
  const side = TEXTS.onward.split('|').includes(word) ? 1 : TEXTS.back.split('|').includes(word) ? -1 : 0;
  const metres = side && parseTyped(figure, 'place');
  const start = startPose(a);
  return metres && start && Math.abs(metres) <= FARTHEST_M ? along(e, a, start, side * metres) : null;
}

/** Along the lanes that turn least; straight by its heading for a road user without a lane. */
function along(e: Editor, a: Agent, start: Pose, metres: number) {
  const { x, y, heading } = start;
  const { map } = e.scene.peek()!;
  const fits = lanesFor(a);
  const hit = fits && nearestLanes(map, x, y, heading, ON_LANE_M, fits)[0];
  if (!hit) {
    const pos = Object.freeze([x + Math.cos(heading) * metres, y + Math.sin(heading) * metres] as const);
    return { pos, heading };
  }
  const bend = (l: Lane): number => Math.abs(turnOf(l.line));
  let { lane, s } = hit;
  s += metres;
  while (s < 0 || s > lane.line.length) {
    const ids = s < 0 ? lane.prev : lane.next;
    const on = ids.flatMap((id) => map.lanes.get(id) ?? []).filter(fits);
    const [best] = on.sort((p, q) => bend(p) - bend(q));
    if (!best) return TEXTS.laneEnds(lengths(Math.abs(metres) - (s < 0 ? -s : s - lane.line.length)));
    s += s < 0 ? best.line.length : -lane.line.length;
    lane = best;
  }
  const at = pointAt(lane.line, s);
  return { pos: Object.freeze([at.x, at.y] as const), heading: at.heading };
}
