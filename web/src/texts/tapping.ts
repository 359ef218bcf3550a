// Who touches the page clicks nothing. The texts speak of clicks; where fingers are the hand they speak of taps.
import type { Words } from './words';

/** Words of clicking, each with that of tapping; the first that fits. */
export type Taps = readonly (readonly [click: string, tap: string])[];

export const ENGLISH: Taps = [
  ['Click', 'Tap'],
  ['click', 'tap'],
];

/** What values bring with them, such as names, stays as it is. */
export function tapping(words: Words, taps: Taps): Words {
  const tapped = (text: string): string => taps.reduce((t, [click, tap]) => t.replaceAll(click, tap), text);
  return Object.fromEntries(
    Object.entries(words).map(([key, w]) => [
      key,
      typeof w === 'string' ? tapped(w) : typeof w === 'object' ? tapping(w, taps) : w,
    ]),
  );
}

/** Is a finger what one mostly points with, as the page begins? */
export const FINGERS = typeof matchMedia !== 'undefined' && matchMedia('(pointer: coarse)').matches;
