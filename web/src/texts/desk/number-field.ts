import { table } from '../table';

export const TEXTS = table('number-field', {
  less: 'less',
  more: 'more',
  changeTheUnit: 'Change the unit',
  isNoNumber: (trim: string) => `“${trim}” is no number`,
  notANumber: 'Not a number',
  to: (text: string, text2: string, unit: string) => `${text} to ${text2} ${unit}`,
  dragToChange: 'Drag to change',
});
