import type { TEXTS } from '../../scene/reactions';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  replanned: 'neu geplant',
  noLongerReacts: (whom) => `reagiert nicht mehr auf ${whom}`,
  differs: 'Weicht von der Aufzeichnung ab.',
  endsTurned: 'Endet in anderer Richtung als aufgezeichnet.',
  travelsLess: (way) => `Kommt ${way} weniger weit als aufgezeichnet.`,
  travelsMore: (way) => `Kommt ${way} weiter als aufgezeichnet.`,
  waits: (long, whom, behind) => `wartet${long} ${behind ? 'hinter' : 'auf'} ${whom}`,
  slowsTo: (speed, whom, behind) => `bremst auf ${speed} ${behind ? 'hinter' : 'wegen'} ${whom}`,
  stopsBriefly: (whom, behind) => `hält kurz ${behind ? 'hinter' : 'wegen'} ${whom}`,
  speedsUpFor: (name) => `beschleunigt vor ${name}`,
  staysOut: (name) => `erscheint nicht: dort ist ${name}`,
  keepsClearOf: (name, behind) => (behind ? `bleibt hinter ${name}` : `hält Abstand zu ${name}`),
};
