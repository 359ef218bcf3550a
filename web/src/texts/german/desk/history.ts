import type { TEXTS } from '../../desk/history';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  history: 'Verlauf',
  ofSteps: (at: number, all: number) => `${at} von ${all} Schritten`,
  noStepsYet: 'noch keine Schritte',
  olderSteps: (count) => plural(count, { one: `${count} älterer Schritt`, other: `${count} ältere Schritte` }),
  oneBack: 'einen Schritt zurück',
  keptOnThisComputer: 'Auf diesem Rechner gesichert',
  initialState: 'Anfangszustand',
  beforeTheFirst: 'vor dem ersten Schritt',
  goBackToThis: 'zurück zu diesem Schritt',
  branch: 'Zweig',
  named: 'benannt',
  nameThisStep: 'Diesen Schritt benennen',
  nameTheStep: (step) => `Schritt benennen: ${step}`,
  nameOfTheStep: 'Name des Schritts',
  now: 'jetzt',
};
