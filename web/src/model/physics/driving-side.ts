// Driving side: as stored in the layout, otherwise inferred from the lanes.
import { pointAt, wrapAngle } from '../base/geometry';
import { nearestLanes, type Lane, type LaneMap } from '../document/lanemap';

export type DrivingSide = 'right-hand' | 'left-hand';

/** Lanes of opposite directions are within this distance of each other, metres. */
const BESIDE_M = 10;
/** Closer than this they are one two-way lane, metres. */
const SAME_M = 1;
/** A lane turned by more than this leads the other way, radians. */
const OPPOSITE_RAD = 2.6;
/** Share of the evidence that must agree. */
const AGREED = 0.65;
/** Number of sampled lanes on a large map. */
const MOST_LANES = 400;

const known = new WeakMap<LaneMap, DrivingSide | null>();

/** The side of a map; `layout`: its source, where it was made here. Null where undecided. */
export function drivingSide(map: LaneMap, layout?: unknown): DrivingSide | null {
  const said = (layout as { parameters?: { traffic?: unknown } } | null | undefined)?.parameters?.traffic;
  if (said === 'right-hand' || said === 'left-hand') return said;
  let side = known.get(map);
  if (side === undefined) known.set(map, (side = asLanesLie(map)));
  return side;
}

function asLanesLie(map: LaneMap): DrivingSide | null {
  const all = [...map.lanes.values()].filter(isRoad);
  const every = Math.ceil(all.length / MOST_LANES);
  let right = 0,
    left = 0;
  for (let i = 0; i < all.length; i += every) {
    for (const share of [0.25, 0.5, 0.75]) {
      const beside = otherWayAt(map, all[i], all[i].line.length * share);
      if (beside > 0) right += all[i].line.length;
      else if (beside < 0) left += all[i].line.length;
    }
  }
  if (!right && !left) return null;
  if (Math.max(right, left) < AGREED * (right + left)) return null;
  return right > left ? 'right-hand' : 'left-hand';
}

const isRoad = (l: Lane): boolean => l.kind === 'road' && !l.inside;

/**
 * Lateral distance to the nearest lane of the opposite direction, metres, positive to the left; 0 where there is none.
 */
function otherWayAt(map: LaneMap, lane: Lane, s: number): number {
  const { x, y, heading } = pointAt(lane.line, s);
  const [other] = nearestLanes(map, x, y, null, BESIDE_M, isRoad)
    .filter((h) => Math.abs(wrapAngle(h.heading - heading)) > OPPOSITE_RAD)
    .sort((a, b) => a.d - b.d);
  return !other || other.d < SAME_M ? 0 : -(other.x - x) * Math.sin(heading) + (other.y - y) * Math.cos(heading);
}
