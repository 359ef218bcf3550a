import type { TEXTS } from '../../panels/thresholds';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  thresholds: 'Schwellwerte',
  actionLabel: 'Schwellwerte',
  isDefault: 'Standard',
  changedHere: 'in dieser Szene geändert',
  gap: 'Beinahe-Unfall: Abstand unter',
  time: 'Beinahe-Unfall: TTC unter',
  braking: 'Starkes Bremsen über',
  steering: 'Starkes Lenken über',
  defaultIs: (value) => `Standard ${value}`,
  whatANearMissIs:
    'Ein Beinahe-Unfall braucht zwei Verkehrsteilnehmer, die sich nähern und bei gleichem Tempo und gleicher Drehrate zusammenstießen. Zwei Fußgänger zählen nie.',
  resetToDefault: 'Auf Standard setzen',
  reset: 'Schwellwerte auf Standard gesetzt',
  gapNow: (value) => `Abstand für Beinahe-Unfälle auf ${value} m gesetzt`,
  timeNow: (value) => `TTC für Beinahe-Unfälle auf ${value} s gesetzt`,
  brakingNow: (value) => `Starkes Bremsen auf ${value} m/s² gesetzt`,
  steeringNow: (value) => `Starkes Lenken auf ${value} m/s² gesetzt`,
  nearMissBelow: (time, gap) => `Beinahe-Unfall: TTC unter ${time} oder Abstand unter ${gap}, auf Kollisionskurs.`,
};
