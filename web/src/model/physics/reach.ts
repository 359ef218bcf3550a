// Local reachability during a drag: no network, a fraction of a millisecond. The generator's verdict replaces it on
// arrival.
import {
  curveBetween,
  makeLine,
  pointAt,
  sliceLine,
  wrapAngle,
  type Line,
  type Pose,
  type Vec,
} from '../base/geometry';
import type { DrivenRoute } from './driving-time';
import { findRoute, tightestRadius } from './lane-routes';
import { nearestLanes, type Lane, type LaneMap } from '../document/lanemap';
import { JUDGING, limitsOf, longestRoute, PLANNING, THRESHOLDS, type Limits } from '../base/domain';
import type { Agent, GoalSpec } from '../document/scene';

/** Furthest distance in `t` seconds from speed `v`: at full acceleration, then at top speed. */
export function furthestReach(l: Limits, v: number, t: number): number {
  const { accel_mps2: accel, speed_mps: top } = l;
  if (v >= top) return v * t;
  const t1 = (top - v) / accel;
  return t <= t1 ? v * t + (accel * t * t) / 2 : v * t1 + (accel * t1 * t1) / 2 + top * (t - t1);
}

/** Shortest distance in `t` seconds: at full braking. */
export function leastReach(l: Limits, v: number, t: number): number {
  const { brake_mps2: brake } = l;
  const ts = v / brake;
  return t <= ts ? v * t - (brake * t * t) / 2 : (v * v) / (2 * brake);
}

export type ReachKind = 'ok' | 'far' | 'near' | 'sharp';

export interface GoalReach {
  readonly kind: ReachKind;
  readonly path: Line;
  readonly onLanes: boolean;
  readonly along: number;
  readonly max: number;
  readonly min: number;
  readonly nearest: Pose | null;
  /** Start speed that would make it reachable, m/s. */
  readonly speed: number | null;
}

// View only, down to BEND_SHARE: a check while a goal is dragged, before the server's verdict arrives. The limits of
// motion and of routes are the server's; these numbers decide how the path is measured.

/** A path along lanes may be shorter than the driven one by this, metres. */
const SLACK_M = 1;
/** Nobody brakes on a shorter path, metres. */
const SHORTEST_M = 0.5;
/** In a bend it drives at this share of its mean speed. */
const BEND_SHARE = 0.6;

const fitsAgent =
  (a: Pick<Agent, 'type'>) =>
  (l: Lane): boolean =>
    a.type === 'cyclist' ? l.kind === 'bike' || l.kind === 'road' : l.kind === 'road';

/** The path to the goal: along the lanes when both ends are on connected lanes, else a plain curve. */
export function pathTo(
  map: LaneMap,
  a: Pick<Agent, 'type'>,
  start: Pose,
  goal: { x: number; y: number; heading: number },
): DrivenRoute {
  if (a.type !== 'pedestrian') {
    const fit = fitsAgent(a);
    const apart = Math.hypot(goal.x - start.x, goal.y - start.y);
    const { most_starts, goal_lane_m, most_goal_lanes } = PLANNING;
    const from = nearestLanes(map, start.x, start.y, start.heading, JUDGING.on_lane_m, fit).slice(0, most_starts);
    const to = nearestLanes(map, goal.x, goal.y, goal.heading, goal_lane_m, fit).slice(0, most_goal_lanes);
    for (const b of to)
      for (const f of from) {
        const r = findRoute(map, f, b);
        if (r && r.line.pts.length > 1 && r.length < longestRoute(apart)) return r;
      }
  }
  const straight: Vec[] = [
    [start.x, start.y],
    [goal.x, goal.y],
  ];
  return { line: makeLine(a.type === 'pedestrian' ? straight : curveBetween(start, goal)), lanes: [], ends: [] };
}

/** Is a goal reachable in its time by the limits of motion only? Null without a goal position. */
export function goalReach(map: LaneMap, a: Agent, start: Pose, goal: GoalSpec): GoalReach | null {
  if (!goal.pos) return null;
  const l = limitsOf(a),
    t = goal.time,
    v = start.speed;
  const heading = goal.heading ?? Math.atan2(goal.pos[1] - start.y, goal.pos[0] - start.x);
  const target: Pose = { x: goal.pos[0], y: goal.pos[1], heading, speed: goal.speed ?? v };
  const { line, lanes } = pathTo(map, a, start, target);
  const along = line.length;
  const max = furthestReach(l, v, t),
    min = leastReach(l, v, t);
  const base = { path: line, onLanes: lanes.length > 0, along, max, min, speed: null, nearest: null };
  const at = (s: number, speed: number): Pose => ({ ...pointAt(line, s), speed });
  // No path is shorter than the straight line: only beyond it the goal is certainly too far.
  const straight = Math.hypot(goal.pos[0] - start.x, goal.pos[1] - start.y);
  if (straight > max + THRESHOLDS.goal_position_m.usual) {
    return {
      ...base,
      kind: 'far',
      nearest: at(max, Math.min(l.speed_mps, v + l.accel_mps2 * t)),
      speed: speedFor(l, t, along),
    };
  }
  if (along < min - SLACK_M && along > SHORTEST_M) {
    return {
      ...base,
      kind: 'near',
      nearest: {
        x: start.x + Math.cos(start.heading) * min,
        y: start.y + Math.sin(start.heading) * min,
        heading: start.heading,
        speed: 0,
      },
      speed: Math.sqrt(Math.max(0, 2 * l.brake_mps2 * along)),
    };
  }
  const radius = a.type === 'pedestrian' ? Infinity : tightestRadius(line);
  const needed = Math.max(0, (along / t) * BEND_SHARE);
  if (radius < Infinity && needed * needed > l.lateral_mps2 * radius) {
    const ok = Math.sqrt(l.lateral_mps2 * radius);
    return {
      ...base,
      kind: 'sharp',
      speed: ok,
    };
  }
  return { ...base, kind: 'ok' };
}

/**
 * Reached and missing distance, from the source of the verdict: the generator measures straight from the start, the
 * local check along the path. The two are never mixed, or numbers on one screen would contradict each other.
 */
export function shortfall(
  start: Pose,
  goal: readonly [number, number],
  nearest: { x: number; y: number } | null,
  local: GoalReach | null,
): { gets: number; beyond: number } | null {
  if (nearest && nearest !== local?.nearest) {
    const gets = Math.hypot(nearest.x - start.x, nearest.y - start.y);
    return { gets, beyond: Math.hypot(goal[0] - start.x, goal[1] - start.y) - gets };
  }
  return local?.kind === 'far' ? { gets: local.max, beyond: local.along - local.max } : null;
}

function speedFor(l: Limits, t: number, d: number): number | null {
  for (let v = 0; v <= l.speed_mps; v += 0.1) if (furthestReach(l, v, t) >= d) return v;
  return null;
}

// -------------------------------------------------------------- reachable lanes

/** A stretch of lane, with the lane's width in metres. */
export interface LaneStretch {
  readonly pts: readonly Vec[];
  readonly width: number;
}

// View only: which lanes are tinted. The server finds the way itself and may use others.

/** Limit of followed lanes. */
const MOST_LANES = 400;

/** Least and greatest distance by a time, metres. */
export const reachBetween = (a: Agent, start: Pose, t: number): readonly [number, number] => [
  leastReach(limitsOf(a), start.speed, t),
  furthestReach(limitsOf(a), start.speed, t),
];

/** Reachable stretches at a time, along the lanes under or beside it; none for pedestrians. */
export function reachableWays(map: LaneMap, a: Agent, start: Pose, t: number): LaneStretch[] {
  if (a.type === 'pedestrian') return [];
  const [least, most] = reachBetween(a, start, t);
  const turned = (heading: number): number => Math.abs(wrapAngle(heading - start.heading));
  const open = nearestLanes(map, start.x, start.y, start.heading, PLANNING.start_lane_m, fitsAgent(a))
    .filter((h) => turned(h.heading) <= PLANNING.start_turn_rad)
    .map((h) => ({ lane: h.lane, at: -h.s }));
  const seen = new Set<string>();
  const out: LaneStretch[] = [];
  // The shortest way to a lane comes first, so a lane met again adds nothing.
  for (let n = 0; open.length && n < MOST_LANES; n++) {
    open.sort((p, q) => q.at - p.at);
    const { lane, at } = open.pop()!;
    if (seen.has(lane.id)) continue;
    seen.add(lane.id);
    const [from, to] = [Math.max(0, least - at, -at), Math.min(lane.line.length, most - at)];
    if (to > from + 0.1) out.push({ pts: sliceLine(lane.line, from, to), width: lane.width });
    const end = at + lane.line.length;
    for (const id of end < most ? lane.next : []) {
      const next = map.lanes.get(id);
      if (next && !seen.has(id)) open.push({ lane: next, at: end });
    }
  }
  return out;
}
