import type { TEXTS } from '../../panels/events-panel';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  inTheseS: (duration) => `in diesen ${duration} s`,
  events: 'Ereignisse',
  inTheLog: (inLog) => ` · ${inLog} in der Aufzeichnung`,
  where: 'Wo',
  whatYouCanDo: 'Was sich tun lässt',
  change: (name) => `${name} ändern`,
  keepAsAVariant: 'Als Variante behalten',
  thenNothing: 'Dann passiert das nicht',
  thenStill: (what) => `Dann immer noch: ${what}`,
  thenInstead: (who, what) => `Dann ${who}: ${what}`,
};
