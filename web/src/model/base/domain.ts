// What the server knows of road users and of itself: the limits of motion, the ranges of what may be asked, and the
// defaults. One file, written from the server's own tables, read at build time.
import domain from '../../../../assets/domain.json';
import type { Agent } from '../document/scene';
import type { AgentType } from './kinds';

/** Hard limits of motion: no answer ever breaks them. `comfort_…` is what people choose, not what is possible. */
export interface Limits {
  readonly accel_mps2: number;
  readonly brake_mps2: number;
  readonly lateral_mps2: number;
  /** Of the tightest circle, 1/m; null on foot. Vehicles longer than a car turn wider still. */
  readonly curvature_per_m: number | null;
  readonly speed_mps: number;
  readonly comfort_lateral_mps2: number;
}

type Range = readonly [min: number, max: number];

/** What may be asked of a road user; anything outside is refused. */
export interface Ranges {
  readonly length_m: Range;
  readonly width_m: Range;
  readonly speed_mps: Range;
}

const LIMITS: Readonly<Record<string, Limits>> = domain.limits;
const RANGES = domain.condition_ranges as unknown as Record<Exclude<AgentType, 'other'>, Ranges>;

export const DEFAULTS = domain.defaults;

/** Version of the program that the page is a part of. */
export const VERSION = domain.version;

/** What counts as an event: the number unless another one is given, and the least and the most that it may be. */
export const THRESHOLDS: Readonly<Record<string, { readonly usual: number; readonly range: readonly number[] }>> =
  domain.thresholds;

/** What places on the way may ask for. */
export const VIAS = domain.via;

/** By type, and for vehicles by what the scene calls them: one without a word of its own is a car. */
export function limitsOf(a: Pick<Agent, 'type' | 'subtype'>): Limits {
  if (a.type === 'pedestrian' || a.type === 'cyclist') return LIMITS[a.type];
  return (a.subtype && a.subtype !== 'other' && LIMITS[a.subtype]) || LIMITS.car;
}

export const rangesOf = (a: Pick<Agent, 'type'>): Ranges => RANGES[a.type === 'other' ? 'vehicle' : a.type];

/** The fastest that may be asked of a road user and that it can go, m/s. */
export const topSpeed = (a: Pick<Agent, 'type' | 'subtype'>): number =>
  Math.min(limitsOf(a).speed_mps, rangesOf(a).speed_mps[1]);
