import type { TEXTS } from '../../editing/driving';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  toStart: (name) => `${name} ist bereit. W, A, S, D oder eine Pfeiltaste startet.`,
  pressToStart: 'Eine Taste startet',
  pressToGoOn: 'Angehalten. Eine Taste setzt fort',
  secondsOf: (time, most) => `${time} von ${most} s`,
  faster: 'schneller',
  brake: 'bremsen',
  brakeHard: 'stark bremsen',
  steer: 'lenken',
  keep: 'Behalten',
  cancel: 'Abbrechen',
  controls: 'Steuerung mit der Tastatur',
  reacts: (name) => `${name} reagiert`,
  hits: (name, other) => `${name} kollidiert mit ${other}`,
  cancelled: 'Fahrt abgebrochen. Die Szene ist unverändert.',
  didNotStart: (why) => `Die Fahrt hat nicht begonnen. ${why}`,
};
