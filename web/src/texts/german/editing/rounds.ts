import type { TEXTS } from '../../editing/rounds';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  cardOfARound: (letter) => `Vorschlag ${letter} einer Runde für alle gewählt`,
  theGenerator: 'Der Generator antwortet nicht.',
  theWholeScene: 'die ganze Szene',
  roundsOf: (name) => `Runden: ${name}.`,
  keepOrReject: 'Erst einen behalten oder verwerfen oder einen Wunsch angeben.',
  noCardsCame: 'Keine Vorschläge erhalten.',
  roundA: (round, count, many, name) => `Runde ${round}: ${count} ${many}. A: ${name}.`,
  all: 'alle',
  outcomes: 'Verläufe',
  futures: 'Zukünfte',
};
