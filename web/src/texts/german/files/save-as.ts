import type { TEXTS } from '../../files/save-as';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  saveAs: 'Sichern als',
  name: 'Name',
  yourOwnScene: 'Eine eigene Szene, die automatisch gesichert wird. Diese bleibt unverändert.',
  cancel: 'Abbrechen',
  save: 'Sichern',
};
