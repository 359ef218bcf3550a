import { plural, table } from '../table';

export const TEXTS = table('filling', {
  theGenerator: 'The generator is not answering.',
  generatorComputes: (most_at_once: number) =>
    `The generator computes at most ${most_at_once} road users at once. For more, fill one area after another.`,
  thereIsNoRoom: 'No room here.',
  roadUsersPlaced: (count: number, reason: string) =>
    plural(count, { one: `${count} road user placed. ${reason}`, other: `${count} road users placed. ${reason}` }),
});
