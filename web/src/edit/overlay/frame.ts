// The frame around several selected road users, and poses at the playhead.
import type { Pose, Vec } from '../../model/base/geometry';
import { poseAt } from '../../model/base/motion';
import { startPose, type Agent } from '../../model/document/scene';
import type { Rect } from '../../draw/labels';
import { boxOnScreen } from '../../draw/sprites';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';

/** Pose of a road user at the playhead. */
export function poseShown(e: Pick<Editor, 'chosenOnes' | 'playhead' | 'reading' | 'selected'>, a: Agent): Pose | null {
  const t = e.playhead.time.value;
  return (t < 0.05 ? startPose(a) : null) ?? poseAt(e.reading.motionFor(a), t);
}

/** The frame around several, in pixels. */
export interface Frame {
  readonly box: Rect;
  readonly corners: readonly Vec[];
  /** Turns them. */
  readonly knob: Vec;
}

const MARGIN_PX = 10;
const STALK_PX = 26;
/** Null where fewer than two selected ones are visible. */
export function frameAround(
  e: Pick<Editor, 'chosenOnes' | 'playhead' | 'reading' | 'selected'>,
  v: View,
): Frame | null {
  if (e.selected.value.length < 2) return null;
  let x0 = Infinity,
    y0 = Infinity,
    x1 = -Infinity,
    y1 = -Infinity;
  for (const a of e.chosenOnes) {
    const p = poseShown(e, a);
    if (!p) continue;
    const b = boxOnScreen(v, a, p);
    x0 = Math.min(x0, b.x);
    y0 = Math.min(y0, b.y);
    x1 = Math.max(x1, b.x + b.w);
    y1 = Math.max(y1, b.y + b.h);
  }
  if (x1 < x0) return null;
  const box = { x: x0 - MARGIN_PX, y: y0 - MARGIN_PX, w: x1 - x0 + 2 * MARGIN_PX, h: y1 - y0 + 2 * MARGIN_PX };
  const { x, y, w, h } = box;
  return {
    box,
    corners: [
      [x, y],
      [x + w, y],
      [x + w, y + h],
      [x, y + h],
    ],
    knob: [x + w / 2, y - STALK_PX],
  };
}
