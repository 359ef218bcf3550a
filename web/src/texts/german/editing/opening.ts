import type { TEXTS } from '../../editing/opening';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  theSceneCould: 'Der Server antwortet nicht.',
  discard: 'Verwerfen',
  lastSessionRestored: 'Die Änderungen der letzten Sitzung sind wiederhergestellt.',
  thisSceneIsOpen: 'Diese Szene ist in einem anderen Tab offen und hier schreibgeschützt.',
  editHere: 'Hier bearbeiten',
  theOtherVersion: 'Andere Version geladen',
  changedElsewhere: 'Anderswo geändert',
};
