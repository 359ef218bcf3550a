// On a touch device texts speak of taps instead of clicks.
import type { Words } from './words';

/** Words for clicks with those for taps; the first match applies. */
export type Taps = readonly (readonly [click: string, tap: string])[];

export const ENGLISH: Taps = [
  ['Click', 'Tap'],
  ['click', 'tap'],
];

/** Values, such as names, stay unchanged. */
export function tapping(words: Words, taps: Taps): Words {
  const tapped = (text: string): string => taps.reduce((t, [click, tap]) => t.replaceAll(click, tap), text);
  return Object.fromEntries(
    Object.entries(words).map(([key, w]) => [
      key,
      typeof w === 'string' ? tapped(w) : typeof w === 'object' ? tapping(w, taps) : w,
    ]),
  );
}

/** Is a finger the main pointer when the page loads? */
export const FINGERS = typeof matchMedia !== 'undefined' && matchMedia('(pointer: coarse)').matches;
