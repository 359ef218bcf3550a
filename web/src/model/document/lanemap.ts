// The lane map as the editor uses it: lines with running lengths, a search grid, and rules of its lanes.
import {
  isMapRef,
  type AreaJson,
  type LaneRule,
  type LineJson,
  type MapJson,
  type PointJson,
  type SceneJson,
} from './scene-json';
import {
  boxOf,
  emptyBox,
  growBox,
  makeLine,
  project,
  wrapAngle,
  type Box,
  type Line,
  type Pose,
  type Projection,
  type Vec,
} from '../base/geometry';

export type LaneKind = 'road' | 'bike' | 'walk' | 'other';

export interface Lane {
  readonly id: string;
  readonly kind: LaneKind;
  readonly type: LaneRule['type'];
  readonly line: Line;
  readonly width: number;
  readonly limit: number | null;
  readonly next: readonly string[];
  readonly prev: readonly string[];
  readonly inside: boolean;
  /** Its rule in the map, where the scene has another one. */
  readonly was: LaneRule | null;
}
export interface MapLine {
  readonly id: string;
  readonly type: string;
  readonly line: Line;
}
export interface LaneMap {
  readonly lanes: ReadonlyMap<string, Lane>;
  readonly lines: readonly MapLine[];
  readonly edges: readonly MapLine[];
  readonly crosswalks: readonly (readonly Vec[])[];
  readonly driveways: readonly (readonly Vec[])[];
  readonly bumps: readonly (readonly Vec[])[];
  readonly drivable: readonly { outer: readonly Vec[]; holes: readonly (readonly Vec[])[] }[];
  readonly stopSigns: readonly Vec[];
  readonly box: Box;
  readonly grid: Grid;
  /** Rules that differ from those of the map as it was read. */
  readonly rules: LaneRules;
}

/** View only: a stop sign belongs to the lane that ends this near, metres. The document names lanes of few signs. */
export const SIGN_M = 4;

/** Road users may be this far beyond the map, metres: recordings and goals sometimes end there. */
const BEYOND_M = 200;

/** Allowed range of positions along an axis, metres. */
export const placesAlong = ({ box }: LaneMap, axis: 0 | 1): readonly [number, number] =>
  axis ? [box.y0 - BEYOND_M, box.y1 + BEYOND_M] : [box.x0 - BEYOND_M, box.x1 + BEYOND_M];

const WIDTH: Record<LaneKind, number> = { road: 3.5, bike: 1.8, walk: 2, other: 3 };
const flat = (pts: readonly PointJson[] | undefined): Vec[] => (pts ?? []).map((p): Vec => [p[0], p[1]]);

function laneKind(type: string | undefined): LaneKind {
  switch (type) {
    case 'bike_lane':
      return 'bike';
    case 'sidewalk':
      return 'walk';
    case 'parking':
      return 'other';
    default:
      return 'road';
  }
}

export function buildMap(json: MapJson): LaneMap {
  const lanes = new Map<string, Lane>();
  for (const l of json.lanes ?? []) {
    const kind = laneKind(l.type);
    const line = makeLine(flat(l.points_m));
    if (line.pts.length < 2) continue;
    // A lane inside a junction turns, or is short and joins two others; it has no markings.
    const inside =
      !!l.interpolating ||
      (line.length < 45 && (l.predecessors?.length ?? 0) > 0 && (l.successors?.length ?? 0) > 0 && bend(line) > 0.6);
    lanes.set(l.id, {
      id: l.id,
      kind,
      type: l.type ?? 'undefined',
      line,
      width: l.width_m ?? WIDTH[kind],
      limit: l.speed_limit_mps ?? null,
      next: l.successors ?? [],
      prev: l.predecessors ?? [],
      inside,
      was: null,
    });
  }
  const lines = (list: LineJson[] | undefined): MapLine[] =>
    (list ?? [])
      .map((l) => ({ id: l.id ?? '', type: l.type ?? '', line: makeLine(flat(l.points_m)) }))
      .filter((l) => l.line.pts.length > 1);
  const areas = (list: AreaJson[] | undefined) =>
    (list ?? []).map((a) => flat(a.polygon_m)).filter((p) => p.length > 2);
  const box = emptyBox();
  for (const l of lanes.values()) for (const p of l.line.pts) growBox(box, p[0], p[1]);
  const drivable = (json.drivable ?? []).map((a) => ({ outer: flat(a.polygon_m), holes: (a.holes_m ?? []).map(flat) }));
  for (const a of drivable) for (const p of a.outer) growBox(box, p[0], p[1]);
  if (!Number.isFinite(box.x0)) {
    box.x0 = box.y0 = -50;
    box.x1 = box.y1 = 50;
  }
  return {
    lanes,
    lines: lines(json.road_lines),
    edges: lines(json.road_edges),
    crosswalks: areas(json.crosswalks),
    driveways: areas(json.driveways),
    bumps: areas(json.speed_bumps),
    drivable,
    stopSigns: (json.stop_signs ?? []).map((s): Vec => [s.position_m[0], s.position_m[1]]),
    box,
    grid: new Grid(lanes.values()),
    rules: {},
  };
}

// -------------------------------------------------------------- rules that a scene changes

/** By the ids of changed lanes, always in the same order. */
export type LaneRules = Readonly<Record<string, LaneRule>>;

export const rulesOf = (all: [id: string, LaneRule][]): LaneRules => Object.freeze(Object.fromEntries(all.sort()));

export const isEmptyRules = (rules: LaneRules): boolean => !Object.keys(rules).length;

/** What the changed lanes of a file were. */
export const formerRules = (json: SceneJson): LaneRules => json.x_editor?.lanes_were ?? {};

/** The rules in force on those lanes. */
export const rulesIn = (map: SceneJson['map'], of: LaneRules): LaneRules =>
  rulesOf(
    (isMapRef(map) ? [] : (map.lanes ?? []))
      .filter((l) => of[l.id])
      .map(({ id, speed_limit_mps = null, type = 'undefined' }) => [id, { speed_limit_mps, type }]),
  );

/** A map with these rules on its lanes. */
export const mapWith = (map: MapJson, rules: LaneRules): MapJson =>
  isEmptyRules(rules) ? map : { ...map, lanes: map.lanes?.map((l) => ({ ...l, ...rules[l.id] })) };

/** The map with other rules on its lanes. */
export function withRules(map: LaneMap, rules: LaneRules): LaneMap {
  if (map.rules === rules || (isEmptyRules(map.rules) && isEmptyRules(rules))) return map;
  const lanes = new Map(map.lanes);
  for (const id of Object.keys({ ...map.rules, ...rules })) {
    const lane = lanes.get(id);
    if (!lane) continue;
    const [was, rule] = [ruleOf(lane), rules[id]];
    const { speed_limit_mps: limit, type } = rule ?? was;
    lanes.set(id, { ...lane, limit, type, kind: laneKind(type), was: rule ? was : null });
  }
  return { ...map, lanes, rules, grid: new Grid(lanes.values()) };
}

/** The rule of a lane in its map. */
export const ruleOf = ({ was, limit, type }: Lane): LaneRule => was ?? { speed_limit_mps: limit, type };

/** Change of direction over a lane, in radians; positive to the left. */
export function turnOf(line: Line): number {
  const p = line.pts,
    n = p.length;
  const a = Math.atan2(p[1][1] - p[0][1], p[1][0] - p[0][0]);
  const b = Math.atan2(p[n - 1][1] - p[n - 2][1], p[n - 1][0] - p[n - 2][0]);
  return wrapAngle(b - a);
}
const bend = (line: Line): number => Math.abs(turnOf(line));

/** Lanes by 16 m cells, so that a drag tests only the few near the pointer. */
export class Grid {
  private readonly cells = new Map<string, Set<Lane>>();
  private static readonly SIZE = 16;

  constructor(lanes: Iterable<Lane>) {
    for (const lane of lanes) {
      const { pts } = lane.line;
      for (let i = 1; i < pts.length; i++) {
        const b = boxOf([pts[i - 1], pts[i]]);
        this.each(b, (key) => {
          const cell = this.cells.get(key);
          if (cell) cell.add(lane);
          else this.cells.set(key, new Set([lane]));
        });
      }
    }
  }

  near(x: number, y: number, radius: number): Set<Lane> {
    const out = new Set<Lane>();
    this.each({ x0: x - radius, y0: y - radius, x1: x + radius, y1: y + radius }, (key) => {
      for (const lane of this.cells.get(key) ?? []) out.add(lane);
    });
    return out;
  }

  private each(b: Box, visit: (key: string) => void): void {
    const k = Grid.SIZE;
    for (let i = Math.floor(b.x0 / k); i <= Math.floor(b.x1 / k); i++)
      for (let j = Math.floor(b.y0 / k); j <= Math.floor(b.y1 / k); j++) visit(`${i},${j}`);
  }
}

export interface LaneHit extends Projection {
  lane: Lane;
  score: number;
}

/** Lanes near a pose, best first: distance plus 2 m for a right angle of difference. */
export function nearestLanes(
  map: LaneMap,
  x: number,
  y: number,
  heading: number | null,
  radius: number,
  fits: (l: Lane) => boolean,
): LaneHit[] {
  const hits: LaneHit[] = [];
  for (const lane of map.grid.near(x, y, radius)) {
    if (!fits(lane)) continue;
    const p = project(lane.line, x, y);
    if (p.d > radius) continue;
    const turn = heading === null ? 0 : Math.abs(wrapAngle(heading - p.heading));
    hits.push({ ...p, lane, score: p.d + (2 * turn) / (Math.PI / 2) });
  }
  return hits.sort((a, b) => a.score - b.score);
}

/**
 * View only: lanes within this distance of the start, metres, and within this angle can be entered by a lane change.
 * The server follows the lanes beside each other, which the document need not name.
 */
const BESIDE_START_M = 8;
const ENTERED_RAD = Math.PI / 3;

/** The lanes that a road user can drive on from its start, the nearest first. */
export const lanesFromStart = (map: LaneMap, start: Pose, fits: (l: Lane) => boolean): LaneHit[] =>
  nearestLanes(map, start.x, start.y, start.heading, BESIDE_START_M, fits).filter(
    (hit) => Math.abs(wrapAngle(hit.heading - start.heading)) < ENTERED_RAD,
  );

/** Ids of the lanes that follow from these within a distance, themselves included, metres. */
export function lanesAfter(map: LaneMap, from: readonly LaneHit[], far: number): ReadonlySet<string> {
  const left = new Map<string, number>();
  const open = from.map(({ lane, s }) => ({ lane, rest: far + s }));
  for (let node = open.pop(); node; node = open.pop()) {
    const { lane, rest } = node;
    if (rest <= (left.get(lane.id) ?? 0)) continue;
    left.set(lane.id, rest);
    for (const id of lane.next) {
      const next = map.lanes.get(id);
      if (next) open.push({ lane: next, rest: rest - lane.line.length });
    }
  }
  return new Set(left.keys());
}
