import { table } from './table';

export const TEXTS = table('reactions', {
  workedOutAnew: 'worked out anew',
  movesDifferently: 'Moves differently from the log.',
  endsFacingAnother: 'Ends facing another way than in the log.',
  getsLessFar: (way: string) => `Gets ${way} less far than in the log.`,
  getsFurther: (way: string) => `Gets ${way} further than in the log.`,
  waits: (long: string, whom: string) => `waits${long} ${whom}`,
  slowsTo: (speed: string, unit: string, whom: string) => `slows to ${speed} ${unit} ${whom}`,
  stopsBriefly: (whom: string) => `stops briefly ${whom}`,
  makesWayFor: (name: string) => `makes way for ${name}`,
  takesAnother: (name: string) => `takes another line for ${name}`,
  behind: 'behind',
  for: 'for',
});
