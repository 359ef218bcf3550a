import { table } from '../table';

export const TEXTS = table('reading', {
  aColumnIsBroken: 'a column is invalid',
  thisIsNotAScene: 'This is not a scene: it has no list of road users.',
  thisSceneWas: (version: undefined | number) =>
    `This scene was saved by a newer version (${version}). This program reads versions up to 1.`,
  theMapOfThis: 'The map of this scene is missing.',
  untitled: 'Untitled',
  /** Name of a scene in this language: examples have one in each. */
  sceneName: (_id: string, name: string) => name,
});
