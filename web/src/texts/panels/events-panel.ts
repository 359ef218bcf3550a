import { table } from '../table';

export const TEXTS = table('events-panel', {
  inTheseS: (duration: string) => `in these ${duration} s`,
  events: 'Events',
  inTheLog: (inLog: number) => ` · ${inLog} in the log`,
  where: 'Where',
  whatYouCanDo: 'What you can do',
  change: (name: string) => `Change ${name}`,
  keepAsAVariant: 'Keep as a variant',
  thenNothing: 'Then it does not happen',
  thenStill: (what: string) => `Then still: ${what}`,
  thenInstead: (who: string, what: string) => `Then ${who}: ${what}`,
});
