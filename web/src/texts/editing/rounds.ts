import { table } from '../table';

export const TEXTS = table('rounds', {
  cardOfARound: (letter: string) => `Card ${letter} of a round chosen for all road users`,
  theGenerator: 'The generator is not answering.',
  theWholeScene: 'the whole scene',
  roundsOf: (name: string) => `Rounds of ${name}.`,
  keepOrReject: 'Keep or reject one first, or add a preference.',
  noCardsCame: 'No cards received.',
  roundA: (round: number, count: number, many: string, name: string) => `Round ${round}: ${count} ${many}. A: ${name}.`,
  all: 'all',
  outcomes: 'outcomes',
  futures: 'futures',
});
