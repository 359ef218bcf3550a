import { table } from '../table';

export const TEXTS = table('parting', {
  events: 'Events',
  smallestGap: 'Smallest gap in time',
  leastTimeToCollision: 'Least time to collision',
  goes: (way: string) => `goes ${way}`,
  standsS: (waits: string) => `stands ${waits} s`,
  waitsS: (waits: string) => `waits ${waits} s`,
  turnsLeft: 'turns left',
  turnsRight: 'turns right',
  notKnown: 'not known',
  goalOf: (name: string) => `Goal of ${name}`,
  meets: (name: string, name2: string) => `${name} meets ${name2}`,
  keepsFurther: (right: string) => `keeps further left in ${right}`,
  keepsFurtherRight: (right: string) => `keeps further right in ${right}`,
  stopsOnlyIn: (slow: string) => `stops, only in ${slow}`,
  slowsOnlyIn: (slow: string) => `slows, only in ${slow}`,
  goesFasterIn: (name: string) => `goes faster in ${name}`,
  none: 'none',
  reached: 'reached',
  missed: 'missed',
});
