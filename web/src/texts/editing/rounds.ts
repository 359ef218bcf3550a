import { table } from '../table';

export const TEXTS = table('rounds', {
  cardOfARound: (letter: string) => `Card ${letter} of a round taken for everybody`,
  theGenerator: 'The generator is not answering.',
  theWholeScene: 'the whole scene',
  roundsOf: (name: string) => `Rounds of ${name}.`,
  keepOrReject: 'Keep or reject one first, or add a wish.',
  noCardsCame: 'No cards came.',
  roundA: (round: number, count: number, many: string, name: string) => `Round ${round}: ${count} ${many}. A: ${name}.`,
  allWishes: 'All wishes',
  ways: 'ways',
  futures: 'futures',
});
