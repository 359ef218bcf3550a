import { plural, table } from '../table';

export const TEXTS = table('scenes', {
  today: (clock: string) => `today ${clock}`,
  yesterday: (clock: string) => `yesterday ${clock}`,
  scenes: 'Scenes',
  findAScene: 'Find a scene',
  dropSceneFiles: 'Drop scene files here',
  chooseFiles: 'choose files',
  supportedFormats: 'supported formats',
  noSceneOfThat: 'No scene with that name.',
  loading: 'Loading …',
  recent: 'Recent',
  mine: 'Saved',
  examples: 'Examples',
  recorded: 'Recorded',
  newName: 'New name',
  roadUsers: (n: number) => plural(n, { one: `${n} road user`, other: `${n} road users` }),
  noRoadUsers: 'no road users',
  or: 'or ',
  recordedWithin: 'recorded',
  example: 'example',
  own: 'own',
});
