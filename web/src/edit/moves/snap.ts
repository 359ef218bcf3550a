// Snapping to lanes and angles, with a visible sign; Alt disables it.
import { deg, insidePolygon, pointAt, project, rad, wrapAngle, type Pose } from '../../model/base/geometry';
import { armLane, namedLane, namedPlace, type LaneName } from '../../model/words/arm-names';
import {
  lanesAfter,
  lanesFromStart,
  nearestLanes,
  SIGN_M,
  turnOf,
  type Lane,
  type LaneHit,
  type LaneMap,
} from '../../model/document/lanemap';
import { startPose, type Agent, type Scene } from '../../model/document/scene';
import { JUDGING, PLANNING } from '../../model/base/domain';
import { TEXTS } from '../../texts/editing/picture';

export interface Snapped {
  x: number;
  y: number;
  laneHeading: number | null;
  lane: Lane | null;
}

const RADIUS_M = 1.8;
const RADIUS_PX = 14;
/** The widest lane of a map, metres. */
const WIDEST_M = 8;
const AGAINST = 2.1;
/** A flag on the line still belongs to the lane, metres. */
const MARGIN_M = 0.2;
/** A lane that it cannot or may not drive to is as good as one this much further away, metres. */
const NOT_MINE_M = 1.5;
/** A lane inside a junction turns off if its heading changes by more, and is left at a larger angle, radians. */
const TURNS_RAD = 0.35;
/** Lanes of the start lead this far, metres. */
const AHEAD_M = 400;
/** The current lane is preferred by this much, so that the box does not flicker between two. */
const STAY_BONUS_M = 0.6;

export function lanesFor(a: Pick<Agent, 'type'>): ((l: Lane) => boolean) | null {
  if (a.type === 'vehicle') return (l) => l.kind === 'road';
  if (a.type === 'cyclist') return (l) => l.kind === 'bike' || l.kind === 'road';
  return null;
}

/** Ids of the lanes that a road user can drive to from its start; null where it starts on none. */
export function lanesAhead(map: LaneMap, a: Pick<Agent, 'type'>, start: Pose): ReadonlySet<string> | null {
  const fits = lanesFor(a);
  const mine = fits ? lanesFromStart(map, start, fits) : [];
  return mine.length ? lanesAfter(map, mine, AHEAD_M) : null;
}

/**
 * The best lane under a point: any between its lines, those of `ahead` first, and inside a junction only those.
 * `travel` is the line from the start to a goal: lanes back against it are ignored, or a
 * goal a little beyond the middle line would turn the car round. Alt places it anywhere.
 */
export function snapToLane(
  map: LaneMap,
  a: Agent,
  x: number,
  y: number,
  heading: number | null,
  zoom: number,
  stay: string | null,
  travel: number | null = null,
  ahead: ReadonlySet<string> | null = null,
): Snapped {
  const fits = lanesFor(a);
  const free: Snapped = { x, y, laneHeading: null, lane: null };
  if (!fits) return free;
  const radius = Math.max(RADIUS_M, RADIUS_PX / zoom);
  const hits = nearestLanes(map, x, y, heading, Math.max(radius, WIDEST_M / 2), fits).filter(
    ({ d, lane }) => d <= Math.max(radius, lane.width / 2 + MARGIN_M),
  );
  let best: LaneHit | null = null,
    score = Infinity;
  for (const h of hits) {
    const bike = a.type === 'cyclist' && h.lane.kind === 'bike' ? 0.8 : 0;
    if (travel !== null && Math.abs(wrapAngle(h.heading - travel)) > AGAINST) continue;
    const far = ahead !== null && !ahead.has(h.lane.id);
    // The turn of another arm crosses this place, and leads elsewhere.
    if (far && h.lane.inside) continue;
    const notMine = far || (h.lane.type === 'bus_lane' && a.kind !== 'bus') ? NOT_MINE_M : 0;
    const s = h.score + notMine - (h.lane.id === stay ? STAY_BONUS_M : 0) - bike;
    if (s < score) {
      score = s;
      best = h;
    }
  }
  return best ? { x: best.x, y: best.y, laneHeading: best.heading, lane: best.lane } : free;
}

/** Where traffic stops on a lane: nose at a stop line, and 2 m behind the last of a queue. */
export interface SoftStop {
  readonly s: number;
  readonly x: number;
  readonly y: number;
  readonly heading: number;
}

const CAPTURE_PX = 8;

export function softStop(scene: Scene, lane: Lane, a: Agent, along: number, zoom: number): SoftStop | null {
  const places: number[] = [];
  const stops =
    scene.signals.some((g) => g.lane === lane.id || lane.next.includes(g.lane)) ||
    scene.map.stopSigns.some(([x, y]) => project(lane.line, x, y).d < SIGN_M);
  if (stops && !lane.inside) places.push(lane.line.length - a.length / 2 - PLANNING.stop_line_gap_m);
  for (const b of scene.agents.values()) {
    if (
      b.id === a.id ||
      b.type !== 'vehicle' ||
      Math.abs(b.start.speed ?? b.logStart?.speed ?? 0) > JUDGING.standing_mps
    )
      continue;
    const p = startPose(b);
    if (!p) continue;
    const on = project(lane.line, p.x, p.y);
    if (on.d < PLANNING.in_queue_m) places.push(on.s - b.length / 2 - PLANNING.queue_gap_m - a.length / 2);
  }
  const s = places
    .filter((v) => v > 0 && Math.abs(v - along) * zoom < CAPTURE_PX)
    .sort((p, q) => Math.abs(p - along) - Math.abs(q - along))[0];
  return s === undefined ? null : { s, ...pointAt(lane.line, s) };
}

/** Along one lane only: its nearest point, however far the pointer strays. */
export function alongLane(map: LaneMap, laneId: string | null, x: number, y: number): Snapped | null {
  const lane = laneId ? map.lanes.get(laneId) : undefined;
  if (!lane) return null;
  const hit = nearestLanes(
    map,
    x,
    y,
    null,
    60,
    (l) => l === lane || lane.next.includes(l.id) || lane.prev.includes(l.id),
  ).sort((p, q) => p.d - q.d)[0];
  return hit ? { x: hit.x, y: hit.y, laneHeading: hit.heading, lane: hit.lane } : null;
}

/** Heading under the tiller: lane tangent and normal within 4 degrees, else whole degrees; Shift gives 15. */
export function snapHeading(
  map: LaneMap,
  a: Agent,
  x: number,
  y: number,
  heading: number,
  mode: 'fine' | 'steps' | 'lane',
): number {
  if (mode === 'fine') return rad(Math.round(deg(heading) * 10) / 10);
  if (mode === 'steps') return wrapAngle(rad(Math.round(deg(heading) / 15) * 15));
  const fits = lanesFor(a);
  const lane = fits ? nearestLanes(map, x, y, heading, 3, fits)[0] : undefined;
  if (lane) {
    for (const turn of [0, Math.PI / 2, -Math.PI / 2, Math.PI]) {
      const target = wrapAngle(lane.heading + turn);
      if (Math.abs(wrapAngle(heading - target)) < rad(4)) return target;
    }
  }
  return wrapAngle(rad(Math.round(deg(heading))));
}

/** Cached words for places of a map: several parts of the page need the same few. */
const said = new WeakMap<LaneMap, Map<string, LaneName>>();
const MOST_SAID = 64;

/** Words for the lane under a point. */
export const laneWords = (...at: Parameters<typeof laneNameAt>): string => laneNameAt(...at).name;

/** The same with and without a preposition. */
export function laneNameAt(
  map: LaneMap,
  a: Pick<Agent, 'type'>,
  x: number,
  y: number,
  heading: number | null,
): LaneName {
  let known = said.get(map);
  if (!known || known.size >= MOST_SAID) said.set(map, (known = new Map()));
  const key = `${a.type} ${x} ${y} ${heading}`;
  let words = known.get(key);
  if (words === undefined) known.set(key, (words = nameAt(map, a, x, y, heading)));
  return words;
}

function nameAt(map: LaneMap, a: Pick<Agent, 'type'>, x: number, y: number, heading: number | null): LaneName {
  if (a.type === 'pedestrian') return namedPlace(onFoot(map, x, y));
  const hits = nearestLanes(map, x, y, heading, 2.6, () => true);
  const fits = lanesFor(a);
  const hit = (fits && hits.find((h) => fits(h.lane))) ?? hits[0];
  if (!hit) return namedPlace(TEXTS.offTheLanes);
  if (hit.lane.kind === 'walk') return namedPlace(TEXTS.besideTheRoad);
  const turns = hit.lane.inside && Math.abs(turnOf(hit.lane.line)) > TURNS_RAD;
  // Who crosses a turn does not turn.
  if (turns && Math.abs(wrapAngle((heading ?? hit.heading + Math.PI) - hit.heading)) > TURNS_RAD)
    return namedPlace(TEXTS.insideTheJunction);
  const arm = armLane(map, hit.lane);
  if (arm) return arm;
  const way = compass(hit.heading);
  if (turns) {
    // A bike lane through the junction keeps its name.
    if (hit.lane.kind === 'bike') return namedLane(TEXTS.bound(TEXTS.bikeLane, way));
    return namedPlace(TEXTS.bound(TEXTS.insideTheJunction, way));
  }
  return namedLane(TEXTS.wayBound(way, kindWords(hit.lane)));
}

function kindWords({ kind, type }: Lane): string {
  if (kind === 'bike') return TEXTS.bikeLane;
  return type === 'freeway' ? TEXTS.motorwayLane : type === 'bus_lane' ? TEXTS.busLane : TEXTS.lane;
}

function onFoot(map: LaneMap, x: number, y: number): string {
  if (map.crosswalks.some((p) => insidePolygon(x, y, p))) return TEXTS.onACrosswalk;
  const lane = nearestLanes(map, x, y, null, 1.9, () => true)[0];
  return !lane || lane.lane.kind === 'walk'
    ? TEXTS.besideTheRoad
    : lane.lane.kind === 'bike'
      ? TEXTS.onABikeLane
      : TEXTS.onTheRoad;
}

function compass(heading: number): string {
  const names = [
    TEXTS.east,
    TEXTS.northEast,
    TEXTS.north,
    TEXTS.northWest,
    TEXTS.west,
    TEXTS.southWest,
    TEXTS.south,
    TEXTS.southEast,
  ];
  return names[((Math.round(deg(heading) / 45) % 8) + 8) % 8];
}
