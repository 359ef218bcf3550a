import { table } from '../table';

export const TEXTS = table('save-as', {
  saveAs: 'Save as',
  name: 'Name',
  yourOwnScene: 'A scene of your own, saved automatically. This one is not changed.',
  cancel: 'Cancel',
  save: 'Save',
});
