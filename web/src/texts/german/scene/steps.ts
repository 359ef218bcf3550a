import type { TEXTS } from '../../scene/steps';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  start: 'Start',
  ofChanged: (what, name) => `${what} von ${name} geändert`,
  goal: 'Ziel',
  ofMoved: (what, name) => `${what} von ${name} verschoben`,
  moved: (name) => `${name} verschoben`,
  sizeOfChanged: (name) => `Größe von ${name} geändert`,
  backToTheMost: (name) => `${name} zurück zur wahrscheinlichsten Zukunft`,
  futureChosen: (letter, name) => `Zukunft ${letter} für ${name} gewählt`,
  futureOfARound: (letter, name) => `Zukunft ${letter} einer Runde für ${name} genommen`,
  speedCurveOf: (name) => `Tempokurve von ${name} entfernt`,
  speedCurveOfChanged: (name) => `Tempokurve von ${name} geändert`,
  goalOfCleared: (name) => `Ziel von ${name} entfernt`,
  backToTheLog: (name) => `${name} zurück zur Aufzeichnung`,
  everybodyBack: 'Alle zurück zur Aufzeichnung',
  seed: (seed) => `Startwert ${seed}`,
  diversity: (diversity) => `Vielfalt ${diversity} %`,
  othersReact: 'Andere reagieren',
  othersReplay: 'Andere wie aufgezeichnet',
  othersHoldStill: 'Andere bleiben stehen',
  plannedAnewEach: (replan) => `Alle ${replan} s neu geplant`,
  everybodyWorked: 'Alle neu berechnet',
  sWorkedOut: (length) => `${length} s berechnet`,
  renamedTo: (name) => `Umbenannt in ${name}`,
};
