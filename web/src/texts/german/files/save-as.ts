import type { TEXTS } from '../../files/save-as';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  saveAs: 'Sichern als',
  name: 'Name',
  aSceneOfYour: 'Eine eigene Szene, die sich selbst sichert. Diese bleibt, wie sie ist.',
  cancel: 'Abbrechen',
  save: 'Sichern',
};
