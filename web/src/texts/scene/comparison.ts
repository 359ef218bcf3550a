import { table } from '../table';

export const TEXTS = table('comparison', {
  events: 'Events',
  minPet: 'Minimum PET',
  minTtc: 'Minimum TTC',
  goes: (way: string) => `covers ${way}`,
  stoppedS: (waits: string) => `stopped ${waits} s`,
  waitsS: (waits: string) => `waits ${waits} s`,
  turnsLeft: 'turns left',
  turnsRight: 'turns right',
  unknown: 'unknown',
  goalOf: (name: string) => `Goal of ${name}`,
  hits: (name: string, name2: string) => `${name} hits ${name2}`,
  keepsFurther: (right: string) => `keeps further left in ${right}`,
  keepsFurtherRight: (right: string) => `keeps further right in ${right}`,
  stopsOnlyIn: (slow: string) => `stops only in ${slow}`,
  slowsOnlyIn: (slow: string) => `slows only in ${slow}`,
  goesFasterIn: (name: string) => `goes faster in ${name}`,
  none: 'none',
  reached: 'reached',
  missed: 'missed',
});
