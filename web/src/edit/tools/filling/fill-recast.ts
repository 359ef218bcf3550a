// Assigns vehicle kinds according to a mix.
import { PRESETS, type PlacedKind, type Preset } from '../../../model/base/kinds';
import type { Newcomer } from '../../../model/document/newcomer';
import { topSpeed } from '../../../model/base/domain';
import type { Footprint } from '../../../model/physics/boxes';
import { shareOf, type FillKind, type Mix } from './fill-mix';
import { inTheWay } from '../../moves/room';

const groupOf = (kind: PlacedKind): FillKind => (kind === 'truck' || kind === 'bus' ? 'heavy' : kind);

/** One in this many heavy vehicles is a bus. */
const BUS_EVERY = 3;

/**
 * The same places with the requested kinds. A road user of the right kind stays; a longer one is used only where it
 * overlaps none.
 */
export function recast(all: readonly Newcomer[], mix: Mix, taken: readonly Footprint[]): Newcomer[] {
  const out = [...all];
  // Late arrivals and parked ones stay: their motion fits their size.
  const drives = (n: Newcomer): boolean => n.kind !== 'cyclist' && n.kind !== 'pedestrian' && !n.motion;
  const driving = all.flatMap((n, i) => (drives(n) ? [i] : []));
  const vehicles = shareOf(mix, 'car') + shareOf(mix, 'heavy') + shareOf(mix, 'motorcycle');
  if (!driving.length || !vehicles) return out;
  const wanted = (kind: FillKind): number => Math.round((shareOf(mix, kind) / vehicles) * driving.length);
  const of = (kind: FillKind): number[] => driving.filter((i) => groupOf(out[i].kind) === kind);
  const put = (i: number, kind: PlacedKind): boolean => {
    const next = as(out[i], kind, PRESETS[kind][0]);
    const others = out.filter((_, j) => j !== i);
    if (next.length > out[i].length && (inTheWay(next, taken) ?? inTheWay(next, others))) return false;
    out[i] = next;
    return true;
  };
  for (const kind of ['heavy', 'motorcycle'] as const) {
    const surplus = of(kind).slice(wanted(kind));
    for (const i of surplus) put(i, 'car');
  }
  for (const kind of ['heavy', 'motorcycle'] as const) {
    let missing = wanted(kind) - of(kind).length;
    // Spread over the area: every n-th car.
    for (const i of spread(of('car'))) {
      if (missing <= 0) break;
      const which = kind === 'heavy' ? (missing % BUS_EVERY ? 'truck' : 'bus') : 'motorcycle';
      if (put(i, which)) missing--;
    }
  }
  return out;
}

const as = (n: Newcomer, kind: PlacedKind, size: Preset): Newcomer => ({
  ...n,
  kind,
  subtype: size.subtype,
  length: size.length,
  width: size.width,
  pose: { ...n.pose, speed: Math.min(n.pose.speed, topSpeed({ type: 'vehicle', subtype: size.subtype })) },
});

/** Order in which neighbours do not follow each other: every third, then those between. */
const spread = (list: readonly number[]): number[] =>
  [0, 1, 2].flatMap((from) => list.filter((_, i) => i % 3 === from));

/** At most this many, evenly out of all. */
export function thinned<T>(all: readonly T[], most: number): T[] {
  return all.filter((_, i) => Math.floor(((i + 1) * most) / all.length) > Math.floor((i * most) / all.length));
}
