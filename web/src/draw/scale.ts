// How long a round length is on the picture.
import { fromLength, lengthUnit, roundBelow, toLength } from '../model/base/units';
import type { View } from './view';

/** The longest the scale gets, in pixels. */
const LONGEST_PX = 90;

/** The longest round length that has room, in words and in pixels. */
export function scaleOf({ z }: Pick<View, 'z'>): { readonly words: string; readonly px: number } {
  const length = roundBelow(toLength(LONGEST_PX / z));
  return { words: `${length} ${lengthUnit()}`, px: fromLength(length) * z };
}
