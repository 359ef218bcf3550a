import type { TEXTS } from '../../desk/parts';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  noSeed: (typed) => `„${typed}“ ist kein Startwert: das ist eine ganze Zahl.`,
  seed: 'Startwert',
  diversity: 'Vielfalt',
  waiting: 'Wartet …',
  generate: 'Berechnen',
  howFarTheSix: 'Wie verschieden die sechs sein dürfen',
  react: 'Reagieren',
  replayLog: 'Wiedergabe',
  goOn: 'Weiter',
  holdStill: 'Stehen',
  everybodyYou: 'Alle passen sich beim Loslassen an; wer ein Ziel hat, erreicht es weiterhin.',
  theyDoWhatWas: 'Sie tun, was aufgezeichnet wurde; wer eingesetzt wurde, fährt weiter wie bisher.',
  theyStayWhere: 'Sie bleiben, wo sie beginnen, und niemand kommt hinzu.',
};
