// What can be placed: the kinds with their types, names and usual sizes.
import { TEXTS } from '../../texts/scene/kinds';

export type AgentType = 'vehicle' | 'pedestrian' | 'cyclist' | 'other';
export type Kind = 'car' | 'truck' | 'bus' | 'motorcycle' | 'cyclist' | 'pedestrian' | 'other';

/** A size that road users of a kind often have. */
export interface Preset {
  readonly label: string;
  readonly subtype: string;
  /** Metres. */
  readonly length: number;
  readonly width: number;
  /** m/s where no lane says otherwise. */
  readonly speed: number;
}

export type PlacedKind = Exclude<Kind, 'other'>;

export const KIND_NAMES: Record<Kind, string> = {
  car: TEXTS.car,
  truck: TEXTS.truck,
  bus: TEXTS.bus,
  motorcycle: TEXTS.motorcycle,
  cyclist: TEXTS.cyclist,
  pedestrian: TEXTS.pedestrian,
  other: TEXTS.object,
};

/** The same within a sentence. */
export const KIND_WORDS: Readonly<Record<Kind, string>> = TEXTS.one;

const preset = (label: string, subtype: string, length: number, width: number, speed: number): Preset =>
  Object.freeze({ label, subtype, length, width, speed });

const KMH = 1 / 3.6;

/** The first of a kind is its usual size. */
export const PRESETS: Record<PlacedKind, readonly Preset[]> = {
  car: [
    preset(TEXTS.car, 'car', 4.7, 2, 50 * KMH),
    preset(TEXTS.smallCar, 'car', 3.7, 1.7, 50 * KMH),
    preset(TEXTS.van, 'van', 5.6, 2.1, 50 * KMH),
  ],
  truck: [
    preset(TEXTS.truck, 'truck', 8.5, 2.5, 45 * KMH),
    preset(TEXTS.deliveryTruck, 'truck', 6.8, 2.3, 45 * KMH),
    preset(TEXTS.semiTrailer, 'truck', 16.5, 2.55, 45 * KMH),
  ],
  bus: [
    preset(TEXTS.cityBus, 'bus', 12, 2.6, 40 * KMH),
    preset(TEXTS.articulatedBus, 'bus', 18, 2.6, 40 * KMH),
    preset(TEXTS.minibus, 'bus', 7, 2.2, 45 * KMH),
  ],
  motorcycle: [
    preset(TEXTS.motorcycle, 'motorcycle', 2.2, 0.85, 50 * KMH),
    preset(TEXTS.moped, 'motorcycle', 1.8, 0.7, 40 * KMH),
  ],
  cyclist: [
    preset(TEXTS.bicycle, 'bicycle', 1.8, 0.75, 18 * KMH),
    preset(TEXTS.cargoBike, 'bicycle', 2.6, 0.9, 15 * KMH),
    preset(TEXTS.kickScooter, 'scooter', 1.2, 0.6, 18 * KMH),
  ],
  pedestrian: [
    preset(TEXTS.adult, 'adult', 0.85, 0.85, 1.4),
    preset(TEXTS.child, 'child', 0.5, 0.5, 1.2),
    preset(TEXTS.wheelchair, 'wheelchair', 1.1, 0.7, 1),
  ],
};

export const PLACED_KINDS = Object.freeze(Object.keys(PRESETS) as PlacedKind[]);

export const typeOfKind = (kind: PlacedKind): Exclude<AgentType, 'other'> =>
  kind === 'cyclist' || kind === 'pedestrian' ? kind : 'vehicle';

/** The kind by type and subtype; by the size in metres where a vehicle has no known subtype. */
export function kindOf(a: { type: string; subtype?: string; length_m: number; width_m: number }): Kind {
  if (a.type === 'pedestrian' || a.type === 'cyclist') return a.type;
  if (a.type !== 'vehicle') return 'other';
  switch (a.subtype) {
    case 'truck':
    case 'trailer':
      return 'truck';
    case 'bus':
      return 'bus';
    case 'motorcycle':
      return 'motorcycle';
    case 'car':
    case 'van':
    case 'emergency':
      return 'car';
    default:
      break;
  }
  if (a.width_m < 1.2) return 'motorcycle';
  return a.length_m > 11 ? 'bus' : a.length_m > 6.6 ? 'truck' : 'car';
}

/** `10 pedestrians`, `1 bus` */
export function countWords(kind: Kind, n: number): string {
  return TEXTS.count[kind](n);
}

/** `8 pedestrians, 2 cyclists`, most first; all in one word where there are many kinds. */
export function kindsWords(kinds: readonly Kind[]): string {
  const count = new Map<Kind, number>();
  for (const k of kinds) count.set(k, (count.get(k) ?? 0) + 1);
  const rows = [...count].sort((a, b) => b[1] - a[1]).map(([k, n]) => countWords(k, n));
  return rows.length > 3 ? TEXTS.andKindsMore(rows.slice(0, 2).join(', '), rows.length - 2) : rows.join(', ');
}
