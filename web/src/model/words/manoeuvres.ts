// The manoeuvre of a future: as the generator says, else by its shape.
import { JUDGING } from '../base/domain';
import { wrapAngle, type Pose } from '../base/geometry';
import { endPose, pathLength, type Motion } from '../base/motion';
import type { FutureFacts, Manoeuvre } from '../document/future-facts';

/** What a manoeuvre depends on. */
export interface MovingFuture {
  readonly motion: Motion;
  readonly about?: FutureFacts | null;
}

/** The kind of road user, and its lanes. */
export interface LaneUser {
  readonly onFoot: boolean;
  /** Is a pose in a lane, clear of its lines? Absent where the lanes are unknown. */
  readonly inLane?: (p: Pose) => boolean;
}

/** A lane change that ends near a line is none to the eye. */
export function manoeuvreOf({ motion, about }: MovingFuture, { onFoot, inLane }: LaneUser): Manoeuvre {
  const m = about?.manoeuvre ?? shapeOf(motion, onFoot);
  const isChange = !onFoot && (m === 'lane_left' || m === 'lane_right');
  return isChange && inLane && !inLane(endPose(motion)) ? 'straight' : m;
}

/** The manoeuvre, from the shape only. */
function shapeOf(m: Motion, onFoot: boolean): Manoeuvre {
  const n = m.x.length - 1;
  if (n < 2 || pathLength(m) < JUDGING.stays_m) return 'stays';
  const turn = totalTurn(m);
  if (Math.abs(turn) > JUDGING.turn_round_rad) return 'turn_round';
  if (Math.abs(turn) > JUDGING.turn_rad) return turn > 0 ? 'left' : 'right';
  // Sideways without a turn; a long road with a slight bend is still straight on.
  const h = m.heading[0] + wrapAngle(m.heading[n] - m.heading[0]) / 2;
  const [dx, dy] = [m.x[n] - m.x[0], m.y[n] - m.y[0]];
  const far = Math.hypot(dx, dy);
  const left = dy * Math.cos(h) - dx * Math.sin(h);
  const limit = onFoot ? Math.max(1, 0.18 * far) : Math.max(2.2, 0.07 * far);
  return Math.abs(left) > limit ? (left > 0 ? 'lane_left' : 'lane_right') : 'straight';
}

/** Change of heading, radians; positive to the left. */
function totalTurn(m: Motion): number {
  let t = 0;
  for (let i = 1; i < m.heading.length; i++) t += wrapAngle(m.heading[i] - m.heading[i - 1]);
  return t;
}
