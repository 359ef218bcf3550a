import type { TEXTS } from '../../scene/comparison';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  events: 'Ereignisse',
  minPet: 'Kleinste PET',
  minTtc: 'Kleinste TTC',
  goes: (way) => `legt ${way} zurück`,
  stoppedS: (waits) => `steht ${waits} s`,
  waitsS: (waits) => `wartet ${waits} s`,
  turnsLeft: 'biegt links ab',
  turnsRight: 'biegt rechts ab',
  unknown: 'unbekannt',
  goalOf: (name) => `Ziel von ${name}`,
  hits: (name, name2) => `${name} kollidiert mit ${name2}`,
  keepsFurther: (right) => `hält sich in ${right} weiter links`,
  keepsFurtherRight: (right) => `hält sich in ${right} weiter rechts`,
  stopsOnlyIn: (slow) => `hält nur in ${slow}`,
  slowsOnlyIn: (slow) => `wird nur in ${slow} langsamer`,
  goesFasterIn: (name) => `ist in ${name} schneller`,
  none: 'keine',
  reached: 'erreicht',
  missed: 'verfehlt',
};
