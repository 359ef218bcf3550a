// Kinds for filling an area. The server draws by type; `fill-recast` assigns the finer kinds of vehicle.

export const FILL_KINDS = ['car', 'heavy', 'motorcycle', 'cyclist', 'pedestrian'] as const;
/** `heavy`: trucks and buses. */
export type FillKind = (typeof FILL_KINDS)[number];

/** Weights; only their ratios matter. */
export type Mix = Readonly<Record<FillKind, number>>;

/** About the mix of a town's streets. */
export const EVEN_MIX: Mix = Object.freeze({ car: 70, heavy: 8, motorcycle: 4, cyclist: 8, pedestrian: 10 });

export function shareOf(mix: Mix, kind: FillKind): number {
  const sum = FILL_KINDS.reduce((s, k) => s + mix[k], 0);
  return sum > 0 ? mix[kind] / sum : 0;
}

/** Shares by type, as the server takes them; they sum to one. */
export function typesOf(mix: Mix): { vehicle: number; cyclist: number; pedestrian: number } {
  const cyclist = shareOf(mix, 'cyclist'),
    pedestrian = shareOf(mix, 'pedestrian');
  return { vehicle: Math.max(0, 1 - cyclist - pedestrian), cyclist, pedestrian };
}
