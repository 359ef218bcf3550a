import { table } from '../table';

export const TEXTS = table('save-as', {
  saveAs: 'Save as',
  name: 'Name',
  aSceneOfYour: 'A scene of your own, which saves itself. This one stays as it is.',
  cancel: 'Cancel',
  save: 'Save',
});
