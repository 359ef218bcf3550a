// How German speaks of taps in place of clicks.
import type { Taps } from '../tapping';

export const taps: Taps = [
  ['Doppelklick', 'Doppeltippen'],
  ['klicken', 'tippen'],
  ['Klicken', 'Tippen'],
  ['Klick', 'Tippen'],
  ['klick', 'tipp'],
];
