import type { TEXTS } from '../thresholds';
import type { Said } from '../table';

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
  timeMeans: 'Die Zeit ist die bis zum Zusammenstoß, wenn beide so weitermachen.',
  resetAll: 'Wieder wie üblich',
  reset: 'Es zählt wieder, was üblich ist',
  gapNow: (value) => `Beinahe-Unfälle zählen unter ${value} m`,
  timeNow: (value) => `Beinahe-Unfälle zählen unter ${value} s`,
  brakingNow: (value) => `Bremsen zählt über ${value} m/s²`,
  steeringNow: (value) => `Lenken zählt über ${value} m/s²`,
  countsBelow: (time, gap) => `Zählt als Beinahe-Unfall unter ${time} oder ${gap}.`,
};
