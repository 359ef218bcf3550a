import type { TEXTS } from '../../editing/filling';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  theGenerator: 'Der Generator antwortet nicht.',
  generatorComputes: (most_at_once) =>
    `Der Generator berechnet höchstens ${most_at_once} Verkehrsteilnehmer auf einmal. Für mehr eine Fläche nach der anderen füllen.`,
  thereIsNoRoom: 'Hier ist kein Platz.',
  roadUsersPlaced: (count, reason) => `${count} Verkehrsteilnehmer eingesetzt. ${reason}`,
};
