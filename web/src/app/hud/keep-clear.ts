// What the user has in hand stays clear of the cards over the picture: the selected road user, its goal and its flag.
import type { Context } from '../../actions/context';
import { FLAG } from '../../draw/handles';
import { poseShown } from '../../edit/overlay/frame';
import { viewTick } from './view-tick';

/** How many of the three a card between these pixels of the picture would cover. */
export type Covered = (x0: number, x1: number, y0: number, y1: number) => number;

/** Half the size of what is around each place, pixels. */
const AROUND_PX = 20;

export function coveredInHand({ editor, stage: { view: v } }: Context): Covered {
  void viewTick.value;
  const a = editor.agent.value;
  const [car, goal] = [a && poseShown(editor, a), a && editor.reading.goalPose(a)].map((p) => p && v.to(p.x, p.y));
  const flag = goal && ([goal[0], goal[1] - FLAG.height * v.grip] as const);
  const places = [car, goal, flag].filter((p) => !!p);
  const beyond = (at: number, from: number, to: number): boolean => at < from - AROUND_PX || at > to + AROUND_PX;
  return (x0, x1, y0, y1) => places.filter(([x, y]) => !beyond(x, x0, x1) && !beyond(y, y0, y1)).length;
}
