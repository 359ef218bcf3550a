import { plural, table } from '../table';

export const TEXTS = table('rounds', {
  cardOfARound: (letter: string) => `Card ${letter} of a round used for all road users`,
  theGenerator: 'The generator is not answering.',
  theWholeScene: 'the whole scene',
  roundsOf: (name: string) => `Rounds of ${name}.`,
  keepOrReject: 'Keep or reject a card first, or add a preference.',
  noCardsCame: 'No cards received.',
  roundA: (round: number, count: number, name: string) =>
    plural(count, {
      one: `Round ${round}: ${count} future. A: ${name}.`,
      other: `Round ${round}: ${count} futures. A: ${name}.`,
    }),
  all: 'all',
  /** A whole-scene card that differs from the others in nothing that has a name. */
  sceneNumber: (n: number) => `Scene ${n}`,
});
