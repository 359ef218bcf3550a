// Facts of the server: motion limits by type, accepted ranges, and defaults. One file, generated from the server's own
// tables and read at build time.
import domain from '../../../../assets/domain.json';
import type { AgentType } from './kinds';

/** The fields that limits depend on. */
export interface Typed {
  readonly type: AgentType;
  readonly subtype: string | null;
}

/** Acceleration limits of a driving style. */
interface Manner {
  readonly accel_mps2: number;
  readonly brake_mps2: number;
  readonly lateral_mps2: number;
}

/** Hard limits of motion: every answer respects them. A future keeps the manners where it can. */
export interface Limits {
  readonly accel_mps2: number;
  readonly brake_mps2: number;
  readonly lateral_mps2: number;
  /** Of the tightest circle, 1/m; null for pedestrians. Vehicles longer than a car turn wider still. */
  readonly curvature_per_m: number | null;
  readonly speed_mps: number;
  readonly comfortable: Manner;
  readonly hurried: Manner;
}

type Range = readonly [min: number, max: number];

/** Accepted ranges of conditions; the server refuses values outside. */
export interface Ranges {
  readonly length_m: Range;
  readonly width_m: Range;
  readonly speed_mps: Range;
}

const LIMITS: Readonly<Record<string, Limits>> = domain.limits;
const RANGES = domain.condition_ranges as unknown as Record<Exclude<AgentType, 'other'>, Ranges>;

export const DEFAULTS = domain.defaults;

/** Maximum number of road users in a scene. */
export const MOST_AGENTS = domain.most_agents;

/** Version of DragTraffic, page included. */
export const VERSION = domain.version;

/** Thresholds of events: usual value and accepted range. */
export const THRESHOLDS: Readonly<Record<string, { readonly usual: number; readonly range: readonly number[] }>> =
  domain.thresholds;

/** Constants of the server for events and verdicts. */
export const JUDGING = domain.judging;

/** Constants of planning, for places and ways that are shown before an answer. */
export const PLANNING = domain.planning;

/** A longer route from one place to another is a detour, metres; `straight`: their distance. */
export const longestRoute = (straight: number): number =>
  PLANNING.longest_route[0] * straight + PLANNING.longest_route[1];

/** Accepted ranges of via points. */
export const VIAS = domain.via;

/** Accepted ranges of goals relative to another road user. */
export const RELATION = domain.relation;

/** By type, and for vehicles by subtype: an unknown subtype counts as a car. */
export function limitsOf(a: Typed): Limits {
  if (a.type === 'pedestrian' || a.type === 'cyclist') return LIMITS[a.type];
  return (a.subtype && a.subtype !== 'other' && LIMITS[a.subtype]) || LIMITS.car;
}

export const rangesOf = (a: Pick<Typed, 'type'>): Ranges => RANGES[a.type === 'other' ? 'vehicle' : a.type];

/** Highest speed that a road user can be given and can reach, m/s. */
export const topSpeed = (a: Typed): number => Math.min(limitsOf(a).speed_mps, rangesOf(a).speed_mps[1]);
