// The picture goes with a driven road user.
import type { Context } from '../actions/context';

/** It gets no further from the middle of the picture than this share of its smaller side. */
const FROM_MIDDLE = 0.22;

/** Keeps a driven road user near the middle of the picture. */
export function followDriven({ driving, stage }: Context): void {
  const { view: v } = stage;
  const p = driving.open.peek()?.now;
  if (!p) return;
  const { left, right, top, bottom } = v.inset;
  const [w, h] = [v.w - left - right, v.h - top - bottom];
  const [x, y] = v.to(p.x, p.y);
  const [dx, dy] = [x - left - w / 2, y - top - h / 2];
  const over = 1 - (FROM_MIDDLE * Math.min(w, h)) / Math.hypot(dx, dy);
  if (!(over > 0)) return;
  v.panBy(-dx * over, -dy * over);
  stage.viewChanged();
}
