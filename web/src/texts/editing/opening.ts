import { table } from '../table';

export const TEXTS = table('opening', {
  theSceneCould: 'The server is not answering.',
  discard: 'Discard',
  lastSessionRestored: 'The changes of your last session are restored.',
  thisSceneIsOpen: 'This scene is open in another tab and read-only here.',
  editHere: 'Edit here',
  theOtherVersion: 'Other version loaded',
  changedElsewhere: 'Changed elsewhere',
});
