// Kerbs: road edges that separate, and whether the road still leads to the other side.
import { longestRoute, PLANNING } from '../base/domain';
import type { Point, Pose, Vec } from '../base/geometry';
import { findRoute } from './lane-routes';
import { lanesFromStart, nearestLanes, type Lane, type LaneMap } from '../document/lanemap';

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

/** View only: a lane leads to places within this distance without a kerb between, metres. */
const BESIDE_LANE_M = 8;

/** Does a lane lead from a start to a place, without a large detour? */
export function laneLeadsTo(map: LaneMap, start: Pose, to: Point, fits: (l: Lane) => boolean): boolean {
  const ends = nearestLanes(map, to.x, to.y, null, BESIDE_LANE_M, fits)
    .filter((hit) => !firstKerb(map, [to.x, to.y], [hit.x, hit.y]))
    .slice(0, 4);
  if (!ends.length) return false;
  const from = lanesFromStart(map, start, fits).slice(0, PLANNING.most_starts);
  const longest = longestRoute(Math.hypot(to.x - start.x, to.y - start.y));
  return ends.some((end) => from.some((hit) => (findRoute(map, hit, end)?.length ?? Infinity) <= longest));
}
