// A goal relative to another road user: a thin line between the two at the time of the goal, with its numbers.
import type { Labels } from '../../../draw/labels';
import { tag } from '../../../draw/labels';
import { paintGhost } from '../../../draw/handles';
import type { Pen } from '../../../draw/pen';
import { polyline } from '../../../draw/strokes';
import { colours } from '../../../draw/theme';
import type { View } from '../../../draw/view';
import { poseAt } from '../../../model/base/motion';
import type { Agent } from '../../../model/document/scene';
import { relationWords } from '../../../model/words/relation-words';
import type { Editor } from '../../session/editor';

const DASH = [5, 4];
const WIDTH_PX = 1.5;
/** Places of the numbers, from the middle of the line. */
const TRIES = [
  [12, 8],
  [12, -30],
  [-140, 8],
  [-140, -30],
] as const;

/** The relation of a road user's goal. */
export function paintRelation(g: Pen, v: View, labels: Labels, e: Editor, of: Agent): void {
  const { relation } = of.goal;
  const other = relation && e.scene.value!.agents.get(relation.to);
  const goal = e.reading.goalPose(of);
  if (!relation || !other || !goal) return;
  const at = poseAt(e.reading.motionFor(other), goal.time - (relation.after_s ?? 0));
  if (!at) return;
  const c = colours();
  paintGhost(g, v, other, at, c.goal, null, [4, 3], 1.25);
  const line = [
    [goal.x, goal.y],
    [at.x, at.y],
  ] as const;
  polyline(g, v, line, c.halo, WIDTH_PX + 2, 0.8);
  polyline(g, v, line, c.goal, WIDTH_PX, 1, DASH);
  const words = relationWords(relation, other.name, null, e.view.unitOf(of));
  const middle = v.to((goal.x + at.x) / 2, (goal.y + at.y) / 2);
  tag(g, labels, middle, words, { fg: c['goal-text'], border: c.goal, tries: TRIES });
}
