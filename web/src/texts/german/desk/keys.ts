import type { KEYS } from '../../desk/keys';
import type { Said } from '../../table';

export const german: Said<typeof KEYS> = {
  Ctrl: 'Strg',
  Shift: '⇧',
  Space: 'Leertaste',
  Home: 'Pos1',
  End: 'Ende',
  Del: 'Entf',
  Backspace: 'Rücktaste',
  PageUp: 'Bild auf',
  PageDown: 'Bild ab',
  Menu: 'Menü',
};
