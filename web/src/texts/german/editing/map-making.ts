import type { TEXTS } from '../../editing/map-making';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  theServerIsNot: 'Der Server antwortet nicht.',
  mapClosed: 'Karte geschlossen.',
  keepEditing: 'Weiter bearbeiten',
  noLongerOnALane: (count, lost) =>
    plural(count, {
      one: `${count} Verkehrsteilnehmer steht nicht mehr auf einer Spur: ${lost}.`,
      other: `${count} Verkehrsteilnehmer stehen nicht mehr auf einer Spur: ${lost}.`,
    }),
  otherMap: (base) => `${base}, andere Karte`,
  theHandlesOf: 'Die Griffe der Karte wurden nicht geladen. Die Karte neu öffnen, sobald das Netz wieder da ist.',
};
