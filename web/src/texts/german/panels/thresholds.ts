import type { TEXTS } from '../../panels/thresholds';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  actionLabel: 'Schwellwerte',
  reset: 'Schwellwerte auf Standard gesetzt',
  gapNow: (value) => `Abstand für Beinahe-Unfälle auf ${value} m gesetzt`,
  timeNow: (value) => `TTC für Beinahe-Unfälle auf ${value} s gesetzt`,
  brakingNow: (value) => `Starkes Bremsen auf ${value} m/s² gesetzt`,
  steeringNow: (value) => `Starkes Lenken auf ${value} m/s² gesetzt`,
  nearMissBelow: (time, gap) => `Beinahe-Unfall: TTC unter ${time} oder Abstand unter ${gap}, auf Kollisionskurs.`,
};
