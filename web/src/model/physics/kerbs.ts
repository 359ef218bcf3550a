// Kerbs: road edges that separate, and whether the road still leads to the other side.
import { wrapAngle, type Point, type Pose, type Vec } from '../base/geometry';
import { findRoute, nearestLanes, type Lane, type LaneMap } from '../document/lanemap';

/** Intersection of segment `a`-`b` with `c`-`d`, as a share of `a`-`b`; null where they do not intersect. */
function meets(a: Vec, b: Vec, c: Vec, d: Vec): number | null {
  const rx = b[0] - a[0],
    ry = b[1] - a[1],
    sx = d[0] - c[0],
    sy = d[1] - c[1];
  const cross = rx * sy - ry * sx;
  if (Math.abs(cross) < 1e-12) return null;
  const qx = c[0] - a[0],
    qy = c[1] - a[1];
  const t = (qx * sy - qy * sx) / cross,
    u = (qx * ry - qy * rx) / cross;
  return t >= 0 && t <= 1 && u >= 0 && u <= 1 ? t : null;
}

/** The first intersection of the straight line between two points with a road edge. */
export function firstKerb(map: LaneMap, from: Vec, to: Vec): Vec | null {
  let first = Infinity;
  for (const { line } of map.edges)
    for (let i = 1; i < line.pts.length; i++) {
      const t = meets(from, to, line.pts[i - 1], line.pts[i]);
      if (t !== null && t < first) first = t;
    }
  return first <= 1 ? [from[0] + (to[0] - from[0]) * first, from[1] + (to[1] - from[1]) * first] : null;
}

/** A lane leads to places within this distance without a kerb between, metres. */
const BESIDE_LANE_M = 8;
/** Lanes within this distance of the start can be entered by a lane change, metres. */
const BESIDE_START_M = 8;
const SAME_WAY_RAD = Math.PI / 3;
/** Allowed detour of a route over the straight line: metres, or a share for corners. */
const DETOUR_M = 25;
const DETOUR_SHARE = 1.5;

/** Does a lane lead from a start to a place, without a large detour? */
export function laneLeadsTo(map: LaneMap, start: Pose, to: Point, fits: (l: Lane) => boolean): boolean {
  const ends = nearestLanes(map, to.x, to.y, null, BESIDE_LANE_M, fits)
    .filter((hit) => !firstKerb(map, [to.x, to.y], [hit.x, hit.y]))
    .slice(0, 4);
  if (!ends.length) return false;
  const from = nearestLanes(map, start.x, start.y, start.heading, BESIDE_START_M, fits)
    .filter((hit) => Math.abs(wrapAngle(hit.heading - start.heading)) < SAME_WAY_RAD)
    .slice(0, 4);
  const straight = Math.hypot(to.x - start.x, to.y - start.y);
  const longest = Math.max(straight * DETOUR_SHARE, straight + DETOUR_M);
  return ends.some((end) => from.some((hit) => (findRoute(map, hit, end)?.length ?? Infinity) <= longest));
}
