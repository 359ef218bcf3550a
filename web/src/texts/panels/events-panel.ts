import { table } from '../table';

export const TEXTS = table('events-panel', {
  inTheseS: (duration: string) => `in these ${duration} s`,
  events: 'Events',
  inTheLog: (inLog: number) => ` · ${inLog} in the recording`,
  where: 'Where',
  remedies: 'Remedies',
  change: (name: string) => `Change ${name}`,
  keepAsAVariant: 'Keep as a variant',
  thenNothing: 'Event avoided',
  thenStill: (what: string) => `Still: ${what}`,
  thenInstead: (who: string, what: string) => `New: ${who}, ${what}`,
});
