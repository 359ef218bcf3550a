import type { TEXTS } from '../../editing/rounds';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  cardOfARound: (letter) => `Vorschlag ${letter} einer Runde für alle übernommen`,
  theGenerator: 'Der Generator antwortet nicht.',
  theWholeScene: 'die ganze Szene',
  roundsOf: (name) => `Runden: ${name}.`,
  keepOrReject: 'Erst einen Vorschlag behalten oder verwerfen oder einen Wunsch angeben.',
  noCardsCame: 'Keine Vorschläge erhalten.',
  roundA: (round, count, name) =>
    plural(count, {
      one: `Runde ${round}: ${count} Zukunft. A: ${name}.`,
      other: `Runde ${round}: ${count} Zukünfte. A: ${name}.`,
    }),
  all: 'alle',
  sceneNumber: (n) => `Szene ${n}`,
};
