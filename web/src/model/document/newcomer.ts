// A new road user in a scene: placed, pasted or duplicated. It has no recording.
import type { Pose, Vec } from '../base/geometry';
import { KIND_NAMES, PLACED_KINDS, typeOfKind, type PlacedKind, type Preset } from '../base/kinds';
import { MOST_AGENTS, rangesOf } from '../base/domain';
import { motionFrom, poseAtStep, type Motion, trackJson } from '../base/motion';
import { freeGoal, logStartSpec, type Agent, type GoalSpec, type Others } from './scene';
import { readVias, shiftedVias } from './vias';

export interface Newcomer {
  readonly kind: PlacedKind;
  readonly subtype: string | null;
  readonly length: number;
  readonly width: number;
  readonly pose: Pose;
  readonly goal: GoalSpec | null;
  readonly note: string;
  readonly does: Others | null;
  /** Its fixed motion: late arrival or parked; null if the generator drives it from the start. */
  readonly motion: Motion | null;
  /** Part of the street: stands throughout the scene. */
  readonly parked: boolean;
}

/** Arrives after the start. */
export const comesLater = (n: Newcomer): boolean => n.motion !== null && n.motion.first > 0;

export const newcomer = (kind: PlacedKind, size: Preset, pose: Pose): Newcomer => ({
  kind,
  subtype: size.subtype,
  length: size.length,
  width: size.width,
  pose,
  goal: null,
  note: '',
  does: null,
  motion: null,
  parked: false,
});

/** The resulting road user. */
export function settle(n: Newcomer, id: string): Agent {
  const { x, y, heading, speed } = n.pose;
  const [vx, vy] = [speed * Math.cos(heading), speed * Math.sin(heading)];
  const { motion } = n;
  const log = motion ?? motionFrom({ x_m: [x], y_m: [y], heading_rad: [heading], vx_mps: [vx], vy_mps: [vy] });
  const type = typeOfKind(n.kind);
  const logStart = motion ? poseAtStep(motion, 0) : { x, y, heading, speed };
  const source = motion && {
    id,
    type,
    ...(n.subtype ? { subtype: n.subtype } : {}),
    length_m: n.length,
    width_m: n.width,
    track: trackJson(motion),
  };
  return Object.freeze({
    id,
    type,
    kind: n.kind,
    subtype: n.subtype,
    name: `${KIND_NAMES[n.kind]} ${id}`,
    called: null,
    note: n.note,
    locked: false,
    does: n.does,
    length: n.length,
    width: n.width,
    logSize: [n.length, n.width] as const,
    logType: type,
    logSubtype: n.subtype,
    placed: motion === null,
    source,
    log,
    logStart: logStart && Object.freeze(logStart),
    parked: n.parked,
    ego: false,
    start: motion ? logStartSpec(logStart) : Object.freeze({ pos: Object.freeze([x, y] as const), heading, speed }),
    goal: n.goal ?? freeGoal(),
    chosen: null,
    profile: null,
    dealt: null,
    pins: Object.freeze([]),
    feedback: null,
  });
}

/** A road user as a new one; null for a read-only one. */
export function copyOf(a: Agent, pose: Pose): Newcomer | null {
  if (a.kind === 'other') return null;
  const { kind, subtype, length, width, goal, note, does } = a;
  return { kind, subtype, length, width, pose, goal, note, does, motion: null, parked: false };
}

/** The same shifted by this many metres, its goal too. */
export function shifted(n: Newcomer, dx: number, dy: number): Newcomer {
  const { pose, goal } = n;
  const pos = goal?.pos ? (Object.freeze([goal.pos[0] + dx, goal.pos[1] + dy]) as Vec) : null;
  return {
    ...n,
    pose: { ...pose, x: pose.x + dx, y: pose.y + dy },
    goal:
      goal &&
      Object.freeze({
        ...goal,
        pos: goal.pos ? pos : null,
        via: shiftedVias(goal.via, (x, y) => [x + dx, y + dy]),
      }),
  };
}

// -------------------------------------------------------------- as text

const MARK = 'dragtraffic road users';
/** Longer text is ignored: the largest scene has a tenth of this. */
const MOST_CHARACTERS = 4_000_000;

/** Road users as clipboard text, for other tabs. */
export function copiesText(all: readonly Newcomer[]): string {
  const road_users = all.map(({ kind, subtype, note, does, pose, goal, length, width }) => ({
    kind,
    subtype,
    note,
    does,
    length_m: length,
    width_m: width,
    x_m: pose.x,
    y_m: pose.y,
    heading_rad: pose.heading,
    speed_mps: pose.speed,
    ...(goal ? { goal } : {}),
  }));
  return JSON.stringify({ kind: MARK, version: 1, road_users });
}

/** Copied road users from the clipboard; null where it holds something else. */
export function readCopies(text: string): Newcomer[] | null {
  if (text.length > MOST_CHARACTERS) return null;
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    return null;
  }
  const doc = json as { kind?: unknown; road_users?: unknown } | null;
  if (typeof doc !== 'object' || doc?.kind !== MARK || !Array.isArray(doc.road_users)) return null;
  const all = doc.road_users.slice(0, MOST_AGENTS).flatMap((v) => readOne(v) ?? []);
  return all.length ? all : null;
}

const FAR_M = 10_000;
const finite = (v: unknown, min: number, max: number): number | null =>
  typeof v === 'number' && v >= min && v <= max ? v : null;

function readOne(v: unknown): Newcomer | null {
  if (typeof v !== 'object' || v === null) return null;
  const o = v as Record<string, unknown>;
  const kind = PLACED_KINDS.find((k) => k === o.kind);
  if (!kind) return null;
  const range = rangesOf({ type: typeOfKind(kind) });
  const length = finite(o.length_m, ...range.length_m),
    width = finite(o.width_m, ...range.width_m),
    x = finite(o.x_m, -FAR_M, FAR_M),
    y = finite(o.y_m, -FAR_M, FAR_M),
    heading = finite(o.heading_rad, -10, 10),
    speed = finite(o.speed_mps, ...range.speed_mps);
  if (length === null || width === null || x === null || y === null || heading === null || speed === null) return null;
  const does = (['react', 'log', 'still'] as const).find((d) => d === o.does) ?? null;
  return {
    kind,
    subtype: typeof o.subtype === 'string' ? o.subtype.slice(0, 40) : null,
    length,
    width,
    pose: { x, y, heading, speed },
    goal: readGoal(o.goal),
    note: typeof o.note === 'string' ? o.note.slice(0, 2000) : '',
    does,
    motion: null,
    parked: false,
  };
}

/** A via point from the clipboard, in file form. */
function asJson(v: unknown): unknown {
  const o = (v ?? {}) as Record<string, unknown>;
  const p = Array.isArray(o.pos) ? o.pos : [];
  return { x_m: p[0], y_m: p[1], tolerance_m: o.tolerance, time_s: o.time };
}

function readGoal(v: unknown): GoalSpec | null {
  if (typeof v !== 'object' || v === null) return null;
  const o = v as Record<string, unknown>;
  const p = Array.isArray(o.pos) ? o.pos : [];
  const x = finite(p[0], -FAR_M, FAR_M),
    y = finite(p[1], -FAR_M, FAR_M);
  return Object.freeze({
    pos: x !== null && y !== null ? (Object.freeze([x, y]) as Vec) : null,
    heading: finite(o.heading, -10, 10),
    speed: finite(o.speed, 0, 60),
    time: finite(o.time, 0.5, 20) ?? freeGoal().time,
    // Edges belong to one map, and this may be another.
    mayCross: freeGoal().mayCross,
    via: readVias(Array.isArray(o.via) ? o.via.map(asJson) : null),
  });
}
