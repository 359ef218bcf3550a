import { table } from './table';

export const TEXTS = table('events-panel', {
  inTheseS: (duration: string) => `in these ${duration} s`,
  events: 'Events',
  inTheLog: (inLog: number) => ` · ${inLog} in the log`,
  where: 'Where',
  countsAsANear: 'Counts as a near miss below 1.5 s or 1.0 m.',
  whatYouCanDo: 'What you can do',
  change: (name: string) => `Change ${name}`,
  keepAsAVariant: 'Keep as a variant',
});
