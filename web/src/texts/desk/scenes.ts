import { plural, table } from '../table';

export const TEXTS = table('scenes', {
  today: (clock: string) => `today ${clock}`,
  yesterday: (clock: string) => `yesterday ${clock}`,
  scenes: 'Scenes',
  findAScene: 'Find a scene',
  dropSceneFiles: 'Drop scene files here',
  chooseFiles: 'choose files',
  whatCanBeRead: 'what can be read?',
  noSceneOfThat: 'No scene of that name.',
  loading: 'Loading …',
  recent: 'Recent',
  mine: 'Mine',
  examples: 'Examples',
  recorded: 'Recorded',
  newName: 'New name',
  roadUsers: (n: number) => plural(n, { one: `${n} road user`, other: `${n} road users` }),
  nobodyYet: 'nobody yet',
  or: 'or ',
  recordedWithin: 'recorded',
  example: 'example',
  own: 'own',
});
