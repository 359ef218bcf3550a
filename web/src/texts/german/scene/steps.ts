import type { TEXTS } from '../../scene/steps';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  start: 'Start',
  ofChanged: (what, name) => `${what} von ${name} geändert`,
  goal: 'Ziel',
  ofMoved: (what, name) => `${what} von ${name} verschoben`,
  moved: (name) => `${name} verschoben`,
  sizeOfChanged: (name) => `Größe von ${name} geändert`,
  mostLikelyRestored: (name) => `Wahrscheinlichste Zukunft für ${name} wiederhergestellt`,
  futureChosen: (letter, name) => `Zukunft ${letter} für ${name} gewählt`,
  futureOfARound: (letter, name) => `Zukunft ${letter} einer Runde für ${name} übernommen`,
  speedCurveOf: (name) => `Tempokurve von ${name} entfernt`,
  speedCurveOfChanged: (name) => `Tempokurve von ${name} geändert`,
  goalOfCleared: (name) => `Ziel von ${name} entfernt`,
  resetToLog: (name) => `${name} auf Aufzeichnung zurückgesetzt`,
  allReset: 'Alle auf Aufzeichnung zurückgesetzt',
  seed: (seed) => `Startwert ${seed}`,
  diversity: (diversity) => `Vielfalt ${diversity} %`,
  othersReact: 'Andere reagieren',
  othersReplay: 'Andere wie aufgezeichnet',
  othersHoldStill: 'Andere bleiben stehen',
  replanEvery: (replan) => `Alle ${replan} s neu planen`,
  signalPhasesChanged: 'Signalphasen geändert',
  allGeneratedAgain: 'Alle Verkehrsteilnehmer neu erzeugt',
  length: (length) => `Dauer ${length} s`,
  renamedTo: (name) => `Umbenannt in ${name}`,
};
