import type { TEXTS } from '../../scene/reactions';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  workedOutAnew: 'neu berechnet',
  noLongerAnswers: (whom) => `muss nicht mehr auf ${whom} achten`,
  movesDifferently: 'Bewegt sich anders als aufgezeichnet.',
  endsFacingAnother: 'Endet in anderer Richtung als aufgezeichnet.',
  getsLessFar: (way) => `Kommt ${way} weniger weit als aufgezeichnet.`,
  getsFurther: (way) => `Kommt ${way} weiter als aufgezeichnet.`,
  waits: (long, whom, behind) => `wartet${long} ${behind ? 'hinter' : 'auf'} ${whom}`,
  slowsTo: (speed, whom, behind) => `bremst auf ${speed} ${behind ? 'hinter' : 'für'} ${whom}`,
  stopsBriefly: (whom, behind) => `hält kurz ${behind ? 'hinter' : 'für'} ${whom}`,
  makesWayFor: (name) => `macht ${name} Platz`,
  takesAnother: (name) => `weicht ${name} aus`,
};
