import type { TEXTS } from '../../panels/thresholds';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  whatCounts: 'Was zählt',
  whatCountsAsEvent: 'Was als Ereignis zählt',
  asUsual: 'wie üblich',
  changedHere: 'in dieser Szene geändert',
  gap: 'Beinahe-Unfall, Abstand unter',
  time: 'Beinahe-Unfall, Zeit unter',
  braking: 'Starkes Bremsen über',
  steering: 'Starkes Lenken über',
  usually: (value) => `üblich ${value}`,
  timeMeans:
    'Es zählt, wer sich näher kommt und träfe, wenn beide so weitermachten. Wer auf eigener Linie daneben vorbeifährt, zählt nicht, auch nicht Leute zu Fuß untereinander.',
  resetAll: 'Wieder wie üblich',
  reset: 'Es zählt wieder, was üblich ist',
  gapNow: (value) => `Beinahe-Unfälle zählen unter ${value} m`,
  timeNow: (value) => `Beinahe-Unfälle zählen unter ${value} s`,
  brakingNow: (value) => `Bremsen zählt über ${value} m/s²`,
  steeringNow: (value) => `Lenken zählt über ${value} m/s²`,
  countsBelow: (time, gap) => `Zählt als Beinahe-Unfall unter ${time} oder ${gap}, wenn sich beide sonst träfen.`,
};
