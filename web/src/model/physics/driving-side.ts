// On which side of the road one drives: as the scene was made, else as its lanes lie.
import { pointAt, wrapAngle } from '../base/geometry';
import { nearestLanes, type Lane, type LaneMap } from '../document/lanemap';

export type DrivingSide = 'right-hand' | 'left-hand';

/** Lanes of the other direction lie beside each other within so many metres. */
const BESIDE_M = 10;
/** Nearer than this it is one lane that is driven both ways, metres. */
const SAME_M = 1;
/** From so much of a half turn on a lane leads the other way, radians. */
const OPPOSITE_RAD = 2.6;
/** So much of what speaks for a side has to agree. */
const AGREED = 0.65;
/** On a large map so many lanes say enough. */
const MOST_LANES = 400;

const known = new WeakMap<LaneMap, DrivingSide | null>();

/** The side of a map; `layout` is what it was made from here, where it was. Null where nothing says. */
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

/** How far to the left of a lane the nearest one of the other direction lies, metres; 0 where there is none. */
function otherWayAt(map: LaneMap, lane: Lane, s: number): number {
  const { x, y, heading } = pointAt(lane.line, s);
  const [other] = nearestLanes(map, x, y, null, BESIDE_M, isRoad)
    .filter((h) => Math.abs(wrapAngle(h.heading - heading)) > OPPOSITE_RAD)
    .sort((a, b) => a.d - b.d);
  return !other || other.d < SAME_M ? 0 : -(other.x - x) * Math.sin(heading) + (other.y - y) * Math.cos(heading);
}
