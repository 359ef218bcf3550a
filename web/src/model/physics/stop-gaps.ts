// View only: how near to a line, a sign and a queue a stop is offered, for a goal and for a speed curve. Any other
// place is accepted too.

/** Distance of the front before a line, metres. */
export const BEFORE_LINE_M = 0.3;
/** Distance of the front behind a standing road user, metres. */
export const QUEUE_GAP_M = 2;
/** A standing road user is on a path when its centre is this near, metres. */
export const IN_WAY_M = 1.2;
/** A stop sign belongs to the lane that ends this near, metres. */
export const SIGN_M = 4;
