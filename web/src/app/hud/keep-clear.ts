// What the user has in hand stays clear of the cards over the picture: the selected road user, its goal and its flag.
import type { Context } from '../../actions/context';
import { FLAG } from '../../draw/handles';
import { poseShown } from '../../edit/overlay/frame';
import { viewTick } from './view-tick';

/** Would a card between these pixels of the picture cover it? */
export type Covers = (x0: number, x1: number, y0: number, y1: number) => boolean;

export function coversHand({ editor, stage: { view: v } }: Context): Covers {
  void viewTick.value;
  const a = editor.agent.value;
  const [car, goal] = [a && poseShown(editor, a), a && editor.reading.goalPose(a)].map((p) => p && v.to(p.x, p.y));
  const flag = goal && ([goal[0], goal[1] - FLAG.height * v.grip] as const);
  return (x0, x1, y0, y1) => [car, goal, flag].some((p) => !!p && p[0] > x0 && p[0] < x1 && p[1] > y0 && p[1] < y1);
}
