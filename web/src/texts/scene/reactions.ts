import { table } from '../table';

export const TEXTS = table('reactions', {
  workedOutAnew: 'worked out anew',
  noLongerAnswers: (whom: string) => `no longer reacts to ${whom}`,
  movesDifferently: 'Moves differently from the log.',
  endsFacingAnother: 'Ends facing another way than in the log.',
  getsLessFar: (way: string) => `Gets ${way} less far than in the log.`,
  getsFurther: (way: string) => `Gets ${way} further than in the log.`,
  waits: (long: string, whom: string, behind: boolean) => `waits${long} ${behind ? 'behind' : 'for'} ${whom}`,
  slowsTo: (speed: string, whom: string, behind: boolean) => `slows to ${speed} ${behind ? 'behind' : 'for'} ${whom}`,
  stopsBriefly: (whom: string, behind: boolean) => `stops briefly ${behind ? 'behind' : 'for'} ${whom}`,
  makesWayFor: (name: string) => `makes way for ${name}`,
  takesAnother: (name: string) => `takes another line for ${name}`,
});
