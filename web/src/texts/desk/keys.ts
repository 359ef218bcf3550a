// What stands on keys, where it differs by language.
import { table } from '../table';

export const KEYS = table('keys', {
  Ctrl: 'Ctrl',
  Shift: 'Shift',
  Space: 'Space',
  Home: 'Home',
  End: 'End',
  Del: 'Del',
  Backspace: 'Backspace',
  PageUp: 'PageUp',
  PageDown: 'PageDown',
  Menu: 'Menu',
});
