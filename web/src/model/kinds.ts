// What can be placed: the kinds with their types, names and usual sizes.
import type { AgentType, Kind } from './scene';

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
  car: 'Car',
  truck: 'Truck',
  bus: 'Bus',
  motorcycle: 'Motorcycle',
  cyclist: 'Cyclist',
  pedestrian: 'Pedestrian',
  other: 'Object',
};

const preset = (label: string, subtype: string, length: number, width: number, speed: number): Preset =>
  Object.freeze({ label, subtype, length, width, speed });

const KMH = 1 / 3.6;

/** The first of a kind is its usual size. */
export const PRESETS: Record<PlacedKind, readonly Preset[]> = {
  car: [
    preset('Car', 'car', 4.7, 2, 50 * KMH),
    preset('Small car', 'car', 3.7, 1.7, 50 * KMH),
    preset('Van', 'van', 5.6, 2.1, 50 * KMH),
  ],
  truck: [
    preset('Truck', 'truck', 8.5, 2.5, 45 * KMH),
    preset('Delivery truck', 'truck', 6.8, 2.3, 45 * KMH),
    preset('Semi-trailer', 'truck', 16.5, 2.55, 45 * KMH),
  ],
  bus: [
    preset('City bus', 'bus', 12, 2.6, 40 * KMH),
    preset('Articulated bus', 'bus', 18, 2.6, 40 * KMH),
    preset('Minibus', 'bus', 7, 2.2, 45 * KMH),
  ],
  motorcycle: [
    preset('Motorcycle', 'motorcycle', 2.2, 0.85, 50 * KMH),
    preset('Moped', 'motorcycle', 1.8, 0.7, 40 * KMH),
  ],
  cyclist: [
    preset('Bicycle', 'bicycle', 1.8, 0.75, 18 * KMH),
    preset('Cargo bike', 'bicycle', 2.6, 0.9, 15 * KMH),
    preset('Kick-scooter', 'scooter', 1.2, 0.6, 18 * KMH),
  ],
  pedestrian: [
    preset('Adult', 'adult', 0.85, 0.85, 1.4),
    preset('Child', 'child', 0.5, 0.5, 1.2),
    preset('Wheelchair', 'wheelchair', 1.1, 0.7, 1),
  ],
};

export const PLACED_KINDS = Object.freeze(Object.keys(PRESETS) as PlacedKind[]);

export const typeOfKind = (kind: PlacedKind): Exclude<AgentType, 'other'> =>
  kind === 'cyclist' || kind === 'pedestrian' ? kind : 'vehicle';

/** `10 pedestrians`, `1 bus` */
export function countWords(kind: Kind, n: number): string {
  const one = KIND_NAMES[kind].toLowerCase();
  return `${n} ${n === 1 ? one : one === 'bus' ? 'buses' : `${one}s`}`;
}

/** `8 pedestrians, 2 cyclists`, most first; all in one word where there are many kinds. */
export function kindsWords(kinds: readonly Kind[]): string {
  const count = new Map<Kind, number>();
  for (const k of kinds) count.set(k, (count.get(k) ?? 0) + 1);
  const rows = [...count].sort((a, b) => b[1] - a[1]).map(([k, n]) => countWords(k, n));
  return rows.length > 3 ? `${rows.slice(0, 2).join(', ')} and ${rows.length - 2} kinds more` : rows.join(', ');
}
