import type { TEXTS } from '../../desk/number-field';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  less: 'weniger',
  more: 'mehr',
  changeTheUnit: 'Einheit wechseln',
  isNoNumber: (trim) => `„${trim}“ ist keine Zahl`,
  notANumber: 'Keine Zahl',
  to: (text, text2, unit) => `${text} bis ${text2} ${unit}`,
  dragToChange: 'Ziehen zum Ändern',
};
