import { table } from './table';

export const TEXTS = table('palette', {
  scenes: 'Scenes',
  for: (agent: string) => `For ${agent}`,
  roadUsers: 'Road users',
  find: (sentenceOf: string) => `Find ${sentenceOf}`,
  triesSpeedsGoal: 'tries speeds, goal times and seeds',
  goToS: (query: string) => `Go to ${query} s`,
  playhead: 'playhead',
  actions: 'Actions',
  doAnything: 'Do anything',
  findAnAction: 'Find an action',
  esc: 'Esc',
  nothingOfThat: 'Nothing of that name',
  choose: 'choose',
  doIt: 'do it',
  typeANumberTo: 'Type a number to find a road user, a time like 4.2 to jump to it',
  /** Beginnings of words that ask for a case. */
  askedForNear: 'near miss close',
  askedForCollision: 'collision crash collide hit',
  askedForFirst: 'first before',
  askedForBraking: 'brak',
  askedForGoal: 'goal reach',
  askedForRed: 'red light signal',
  parked: 'parked',
});
