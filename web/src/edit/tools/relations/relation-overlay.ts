// A goal relative to another road user: a thin line between the two at the time of the goal, with its numbers.
import type { Labels, Rect } from '../../../draw/labels';
import { pill, tag } from '../../../draw/labels';
import { paintGhost } from '../../../draw/handles';
import type { Pen } from '../../../draw/pen';
import { polyline } from '../../../draw/strokes';
import { colours } from '../../../draw/theme';
import type { View } from '../../../draw/view';
import type { Vec } from '../../../model/base/geometry';
import { poseAt } from '../../../model/base/motion';
import type { Agent } from '../../../model/document/scene';
import type { GoalRelationJson } from '../../../model/document/scene-json';
import { relationWords } from '../../../model/words/relation-words';
import type { Editor } from '../../session/editor';
import type { OfferedGap } from './nearest-gap';

const DASH = [5, 4];
const WIDTH_PX = 1.5;
/** An offer is dimmer than a relation, and its words are high enough for a finger. */
const OFFER_ALPHA = 0.6;
const OFFER_PX = 26;
const OFFER_RADII = [24, 36, 52, 72];
/** Places of the numbers, from the middle of the line. */
const TRIES = [
  [12, 8],
  [12, -30],
  [-140, 8],
  [-140, -30],
] as const;

/** A thin line from a goal to the other road user at that time, dimmed for an offer; its middle in pixels, or null. */
function paintLine(
  g: Pen,
  v: View,
  e: Editor,
  of: Agent,
  relation: Readonly<GoalRelationJson>,
  alpha: number,
): readonly [Vec, Agent] | null {
  const other = e.scene.value!.agents.get(relation.to);
  const goal = e.reading.goalPose(of);
  const at = other && goal && poseAt(e.reading.motionFor(other), goal.time - (relation.after_s ?? 0));
  if (!at) return null;
  const c = colours();
  if (alpha === 1) paintGhost(g, v, other, at, c.goal, null, [4, 3], 1.25);
  const line = [
    [goal.x, goal.y],
    [at.x, at.y],
  ] as const;
  polyline(g, v, line, c.halo, WIDTH_PX + 2, 0.8 * alpha);
  polyline(g, v, line, c.goal, WIDTH_PX, alpha, DASH);
  return [v.to((goal.x + at.x) / 2, (goal.y + at.y) / 2), other];
}

/** The relation of a road user's goal. */
export function paintRelation(g: Pen, v: View, labels: Labels, e: Editor, of: Agent): void {
  const { relation } = of.goal;
  const line = relation && paintLine(g, v, e, of, relation, 1);
  if (!line) return;
  const [middle, other] = line;
  const c = colours();
  const words = relationWords(relation, other.name, null, e.view.unitOf(of));
  tag(g, labels, middle, words, { fg: c['goal-text'], border: c.goal, tries: TRIES });
}

/** The gap that can be held; returns the place of its words, for the pointer. */
export function paintOffer(g: Pen, v: View, labels: Labels, e: Editor, of: Agent, offer: OfferedGap): Rect | null {
  const line = paintLine(g, v, e, of, offer.relation, OFFER_ALPHA);
  if (!line) return null;
  const c = colours();
  const look = { fg: c['goal-text'], border: c.goal, height: OFFER_PX };
  return pill(g, labels, ...line[0], offer.words, { ...look, radii: OFFER_RADII, must: false });
}
