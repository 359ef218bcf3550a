import type { TEXTS } from '../../desk/history';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  history: 'Verlauf',
  ofSteps: (at: number, all: number) => `${at} von ${all} Schritten`,
  nothingDoneYet: 'noch nichts getan',
  olderSteps: (count) => `${count} ältere Schritte`,
  oneBack: 'einen zurück',
  keptOnThisComputer: 'Auf diesem Rechner behalten',
  howItWas: 'Wie es war',
  beforeTheFirst: 'vor dem ersten Schritt',
  goBackToThis: 'hierher zurück',
  branch: 'Zweig',
  named: 'benannt',
  nameThisStep: 'Diesen Schritt benennen',
  nameTheStep: (step) => `Schritt benennen: ${step}`,
  nameOfTheStep: 'Name des Schritts',
  now: 'jetzt',
};
