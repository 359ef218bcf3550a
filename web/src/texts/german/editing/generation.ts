import type { TEXTS } from '../../editing/generation';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  generatorAway: 'Generator weg. Nichts ist verloren.',
  change: 'Änderung',
  undone: 'Rückgängig gemacht',
  doneAgain: 'Wiederholt',
  backToTheBeginning: 'Zurück am Anfang',
  nowAt: (name: string) => `Jetzt bei: ${name}.`,
  putBack: 'Zurückgelegt.',
  selected: (name: string) => `${name} ausgewählt.`,
  roadUsersSelected: (n: number) => `${n} Verkehrsteilnehmer ausgewählt.`,
  sceneOpened: 'Szene geöffnet',
  changesWorked: (waiting) =>
    plural(waiting, { one: ` ${waiting} Änderung berechnet.`, other: ` ${waiting} Änderungen berechnet.` }),
  theGenerator: (done) => `Der Generator ist wieder da.${done}`,
  waitingChanges: 'Wartende Änderungen',
  thisTakesLonger: 'Das dauert länger als sonst.',
  sixFuturesMost: (best: string, likely: number) =>
    `Sechs Zukünfte. Am wahrscheinlichsten: ${best}, ${likely} Prozent.`,
  aValueIsOutside: (min, max) => `Ein Wert liegt nicht zwischen ${min} und ${max}.`,
  toS: (window, min) => `${window} bis ${min} s`,
  keepItsCurve: 'Tempokurve behalten',
  itsCurveIsOff: 'Seine Tempokurve gilt nicht mehr.',
  itHitsAt: (other, time) => ` Zusammenstoß mit ${other} bei ${time}.`,
  othersChanged: (n, step) =>
    plural(n, { one: `${step}. ${n} anderer änderte sich.`, other: `${step}. ${n} andere änderten sich.` }),
  nobodyElseHad: ' Sonst musste sich niemand ändern.',
  othersChangedAndHit: (n, step, hit) =>
    plural(n, { one: `${step}. ${n} anderer änderte sich.${hit}`, other: `${step}. ${n} andere änderten sich.${hit}` }),
  collisionAnd: (name, name2, time) => `Zusammenstoß, ${name} und ${name2}, ${time} Sekunden.`,
  asBefore: 'wie zuvor',
  theSearchDid: 'Die Suche wurde nicht geladen. Noch einmal versuchen, wenn das Netz wieder da ist.',
};
