import type { TEXTS } from '../../editing/rounds';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  cardOfARound: (letter) => `Vorschlag ${letter} einer Runde für alle genommen`,
  theGenerator: 'Der Generator antwortet nicht.',
  theWholeScene: 'die ganze Szene',
  roundsOf: (name) => `Runden: ${name}.`,
  keepOrReject: 'Erst einen behalten oder verwerfen, oder einen Wunsch angeben.',
  noCardsCame: 'Es kamen keine Vorschläge.',
  roundA: (round, count, many, name) => `Runde ${round}: ${count} ${many}. A: ${name}.`,
  allWishes: 'Alle Wünsche',
  ways: 'Verläufe',
  futures: 'Zukünfte',
};
