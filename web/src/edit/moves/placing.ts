// Pose of a new road user: snapped to the lane under the pointer, with its heading and its speed.
import {
  insidePolygon,
  makeLine,
  pointAt,
  project,
  wrapAngle,
  type Pose,
  type Quad,
  type Vec,
} from '../../model/base/geometry';
import { drivingSide } from '../../model/physics/driving-side';
import { PLANNING, topSpeed } from '../../model/base/domain';
import { PRESETS, typeOfKind, type PlacedKind, type Preset } from '../../model/base/kinds';
import { nearestLanes, type Lane, type LaneMap } from '../../model/document/lanemap';
import { newcomer, type Newcomer } from '../../model/document/newcomer';
import { startPose, type Scene } from '../../model/document/scene';
import { areaText, lengthText } from '../../model/base/units';
import type { Footprint } from '../../model/physics/boxes';
import { inTheWay, standing, stopping } from './room';
import { laneWords, lanesFor, snapToLane } from './snap';

/** A road user about to be placed. */
export interface Ghost {
  readonly who: Newcomer;
  /** Is it free of overlaps? */
  readonly fits: boolean;
}

/** The shown ghosts, and a word beside the last one. */
export interface Ghosts {
  readonly all: readonly Ghost[];
  readonly words: string;
  readonly lane: string | null;
}

/** How one gesture spreads road users. */
export type Spread = 'one' | 'line' | 'area';

export interface PlacingChoice {
  readonly kind: PlacedKind;
  readonly size: Preset;
  readonly spread: Spread;
  readonly count: number;
}

export const LEAST_COUNT = 2;
export const MOST_COUNT = 100;

export const firstChoice = (kind: PlacedKind): PlacingChoice => ({
  kind,
  size: PRESETS[kind][0],
  spread: 'one',
  count: 20,
});

/** Snapping distance when placing, larger than when dragging, metres. */
const SNAP_M = 4;
const SNAP_PX = 14;

/** Nearest lane, its heading, and the speed driven there. */
export function snapNewcomer(
  scene: Scene,
  n: Pick<Newcomer, 'kind' | 'pose'>,
  zoom: number,
): { x: number; y: number; heading: number; lane: Lane | null } {
  const { x, y, heading } = n.pose;
  const s = snapToLane(
    scene.map,
    { type: typeOfKind(n.kind) } as never,
    x,
    y,
    null,
    Math.min(zoom, SNAP_PX / SNAP_M),
    null,
  );
  return { x: s.x, y: s.y, heading: s.laneHeading ?? heading, lane: s.lane };
}

/** A lane has its limit; cyclists and pedestrians keep their own speed. */
function speedOn(lane: Lane | null, { kind, size }: PlacingChoice): number {
  const own = size.speed;
  const on = typeOfKind(kind) === 'vehicle' ? (lane?.limit ?? own) : own;
  return Math.min(on, topSpeed({ type: typeOfKind(kind), subtype: size.subtype }));
}

/** The speed behind another road user allows a stop in time with this deceleration, m/s². */
const EASY_BRAKING = 3;
/** Range of the search for road users ahead, metres. */
const AHEAD_M = 60;

/** The speed without a collision with the road user ahead on the lane. */
function behindOthers(scene: Scene, { x, y, heading, speed }: Pose, length: number): number {
  const c = Math.cos(heading),
    s = Math.sin(heading);
  let v = speed;
  for (const a of scene.agents.values()) {
    const p = startPose(a);
    if (!p) continue;
    const [dx, dy] = [p.x - x, p.y - y];
    const gap = dx * c + dy * s - (length + a.length) / 2;
    if (gap < 0 || gap > AHEAD_M || Math.abs(dy * c - dx * s) > PLANNING.in_the_way_m) continue;
    const same = Math.max(0, p.speed * Math.cos(p.heading - heading));
    v = Math.min(v, Math.sqrt(same * same + 2 * EASY_BRAKING * gap));
  }
  return v;
}

interface GhostOptions {
  readonly zoom: number;
  /** Set by the user. */
  readonly heading?: number | null;
  /** Disables snapping to lanes. */
  readonly free?: boolean;
}

/** The road user to be placed at a position. */
export function ghostAt(
  scene: Scene,
  choice: PlacingChoice,
  [x, y]: Vec,
  wish: GhostOptions,
): Newcomer & { lane: Lane | null } {
  const raw: Pose = { x, y, heading: wish.heading ?? 0, speed: 0 };
  const plain = { ...raw, lane: null as Lane | null };
  const s =
    wish.free || !lanesFor({ type: typeOfKind(choice.kind) })
      ? plain
      : snapNewcomer(scene, { kind: choice.kind, pose: raw }, wish.zoom);
  const own = wish.heading ?? (s.lane ? s.heading : onFootHeading(scene.map, choice.kind, s.x, s.y));
  const wished = { x: s.x, y: s.y, heading: wrapAngle(own), speed: speedOn(s.lane, choice) };
  const pose = s.lane ? { ...wished, speed: behindOthers(scene, wished, choice.size.length) } : wished;
  return { ...newcomer(choice.kind, choice.size, pose), lane: s.lane };
}

/** Within this distance of a crosswalk a pedestrian walks over it, metres. */
const NEAR_CROSSWALK_M = 4;

/** On a crosswalk and at its ends pedestrians walk across the road, else along the pavement where there is one. */
function onFootHeading(map: LaneMap, kind: PlacedKind, x: number, y: number): number {
  if (kind !== 'pedestrian') return 0;
  const near = map.crosswalks
    .map((p) => ({ p, d: insidePolygon(x, y, p) ? 0 : project(makeLine([...p, p[0]]), x, y).d }))
    .sort((m, n) => m.d - n.d)[0];
  if (near && near.d < NEAR_CROSSWALK_M) return longSide(near.p);
  return nearestLanes(map, x, y, null, NEAR_CROSSWALK_M, (l) => l.kind === 'walk')[0]?.heading ?? 0;
}

function longSide(poly: readonly Vec[]): number {
  let best = 0,
    heading = 0;
  poly.forEach(([x, y], i) => {
    const [nx, ny] = poly[(i + 1) % poly.length];
    const d = Math.hypot(nx - x, ny - y);
    if (d > best) {
      best = d;
      heading = Math.atan2(ny - y, nx - x);
    }
  });
  return heading;
}

/** `4.7 × 2.0 m · westbound lane` */
export const placeWords = (scene: Scene, n: Newcomer): string => {
  const { x, y, heading } = n.pose;
  const where = laneWords(scene.map, { type: typeOfKind(n.kind) }, x, y, heading);
  return `${areaText(n.length, n.width, (m) => lengthText(m, 1))} · ${where}`;
};

/** Marks each that overlaps a present one or one before it in the list. */
function fitted(there: readonly Footprint[], all: readonly Newcomer[]): Ghost[] {
  const taken: Footprint[] = [...there];
  return all.map((who) => {
    const fits = !inTheWay(who, taken);
    if (fits) taken.push(who);
    return { who, fits };
  });
}

export function ghostsFor(scene: Scene, all: readonly Newcomer[], words: string, lane: string | null = null): Ghosts {
  return { all: fitted(standing(scene), all), words, lane };
}

// -------------------------------------------------------------- several at once

/** Spacing of candidate places along a line without room for all, metres. */
const LOOK_M = 0.4;

/** Evenly along a line; where not all fit, as many as fit. */
export function alongLine(scene: Scene, choice: PlacingChoice, a: Vec, b: Vec, zoom: number): Newcomer[] {
  const line = makeLine([a, b]);
  const way = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const at = (along: number): Newcomer => {
    const p = pointAt(line, along);
    const on = ghostAt(scene, choice, [p.x, p.y], { zoom });
    return turned(on, on.lane || choice.kind === 'pedestrian' ? on.pose.heading || way : way);
  };
  const even = Array.from({ length: choice.count }, (_, i) => at((line.length * i) / Math.max(1, choice.count - 1)));
  const taken = stopping(scene);
  if (fitted(taken, even).every((g) => g.fits)) return even;
  const out: Newcomer[] = [];
  const full: Footprint[] = [...taken];
  for (let along = 0; along <= line.length && out.length < choice.count; along += LOOK_M) {
    const who = at(along);
    if (inTheWay(who, full)) continue;
    full.push(who);
    out.push(who);
  }
  return out;
}

/** Spread over a rectangle, deterministically. */
export function overArea(scene: Scene, choice: PlacingChoice, area: Quad, zoom: number): Newcomer[] {
  const [[x, y], [ax, ay], , [bx, by]] = area;
  /** A point of it, from 0 to 1 along each of its sides. */
  const at = (u: number, w: number): Vec => [x + (ax - x) * u + (bx - x) * w, y + (ay - y) * u + (by - y) * w];
  const middle = at(0.5, 0.5);
  const taken = stopping(scene);
  const out: Newcomer[] = [];
  // Halton points keep clear of each other better than random ones; occupied ones are skipped.
  for (let k = 1; out.length < choice.count && k < choice.count * TRIES; k++) {
    const on = ghostAt(scene, choice, at(radicalInverse(k, 2), radicalInverse(k, 3)), { zoom });
    if (!insidePolygon(on.pose.x, on.pose.y, area)) continue;
    const who = turned(on, bothWays(scene.map, choice.kind, on.pose, ...middle));
    if (inTheWay(who, taken)) continue;
    taken.push(who);
    out.push(who);
  }
  return out;
}

const TRIES = 12;

/** Digits of a whole number mirrored at the point: evenly spread between 0 and 1. */
function radicalInverse(k: number, base: number): number {
  let v = 0,
    f = 1;
  for (let n = k; n > 0; n = Math.floor(n / base)) {
    f /= base;
    v += f * (n % base);
  }
  return v;
}

/** Pedestrians come from both sides, and pass each other on the driving side. */
function bothWays(map: LaneMap, kind: PlacedKind, { x, y, heading }: Pose, mx: number, my: number): number {
  const left = -(x - mx) * Math.sin(heading) + (y - my) * Math.cos(heading);
  const wrong = drivingSide(map) === 'left-hand' ? left < 0 : left > 0;
  return kind === 'pedestrian' && wrong ? wrapAngle(heading + Math.PI) : heading;
}

const turned = ({ kind, subtype, length, width, pose, goal, note, does }: Newcomer, heading: number): Newcomer => ({
  kind,
  subtype,
  length,
  width,
  pose: { ...pose, heading: wrapAngle(heading) },
  goal,
  note,
  does,
  motion: null,
  parked: false,
});
