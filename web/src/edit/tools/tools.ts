// The features of the page, those of the rail in its order. A new feature is a folder and a line here; buttons, keys,
// palette entries, shortcut lines, overlay and pointer behaviour follow from that.
import type { RailEntry } from '../gestures/chart';
import { CASES } from './cases/feature';
import { DRIVING } from './driving/feature';
import type { FeatureParts, Supplies } from './feature';
import { FILLING } from './filling/feature';
import { LAYOUTS } from './layouts/feature';
import { MAP_ITEMS } from './map-items/feature';
import { PLACING } from './placing/feature';
import { POINTING } from './pointing/feature';
import { RELATIONS } from './relations/feature';
import { REMEDIES } from './remedies/feature';
import { ROUNDS } from './rounds/feature';
import { SPEED_CURVE } from './speed-curve/feature';
import { VARIANTS } from './variants/feature';

const FEATURES = [
  POINTING,
  PLACING,
  FILLING,
  LAYOUTS,
  SPEED_CURVE,
  ROUNDS,
  VARIANTS,
  CASES,
  RELATIONS,
  DRIVING,
  MAP_ITEMS,
  REMEDIES,
] as const;

export const RAIL: readonly RailEntry[] = FEATURES.flatMap((f): readonly RailEntry[] => ('rail' in f ? f.rail : []));

type NamedParts<F> = F extends { make(...of: never[]): { named: infer N } } ? (named: N) => void : never;

/** All parts of features by their names. */
export type Tools = NamedParts<(typeof FEATURES)[number]> extends (named: infer All) => void ? All : never;

export function makeTools(of: Supplies): { readonly named: Tools; readonly made: readonly FeatureParts[] } {
  const made: readonly FeatureParts[] = FEATURES.map((f) => f.make(of));
  return { named: Object.assign({}, ...made.map((m) => m.named)) as Tools, made };
}
