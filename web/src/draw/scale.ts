// Scale bar: the length of a round number of metres.
import { fromLength, lengthUnit, roundBelow, toLength } from '../model/base/units';
import type { View } from './view';

/** Longest scale bar, in pixels. */
const LONGEST_PX = 90;

/** The longest round length that fits, in words and in pixels. */
export function scaleOf({ z }: Pick<View, 'z'>): { readonly words: string; readonly px: number } {
  const length = roundBelow(toLength(LONGEST_PX / z));
  return { words: `${length} ${lengthUnit()}`, px: fromLength(length) * z };
}
