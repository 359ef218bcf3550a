import type { TEXTS } from '../../panels/thresholds-section';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  thresholds: 'Schwellwerte',
  isDefault: 'Standard',
  changedHere: 'in dieser Szene geändert',
  gap: 'Beinahe-Unfall: Abstand unter',
  time: 'Beinahe-Unfall: TTC unter',
  braking: 'Starkes Bremsen über',
  steering: 'Starkes Lenken über',
  defaultIs: (value) => `Standard ${value}`,
  whatANearMissIs:
    'Ein Beinahe-Unfall braucht zwei Verkehrsteilnehmer, die sich einander nähern und bei gleichem Tempo und gleicher Drehrate zusammenstoßen würden. Zwei Fußgänger zählen nie.',
  resetToDefault: 'Auf Standard zurücksetzen',
};
