import type { TEXTS } from '../../panels/events-panel';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  inTheseS: (duration) => `in diesen ${duration} s`,
  events: 'Ereignisse',
  inTheLog: (inLog) => ` · ${inLog} in der Aufzeichnung`,
  where: 'Wo',
  remedies: 'Abhilfe',
  change: (name) => `${name} ändern`,
  keepAsAVariant: 'Als Variante behalten',
  thenNothing: 'Ereignis vermieden',
  thenStill: (what) => `Weiterhin: ${what}`,
  thenInstead: (who, what) => `Neu: ${who}, ${what}`,
};
