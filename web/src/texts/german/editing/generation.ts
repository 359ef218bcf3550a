import type { TEXTS } from '../../editing/generation';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  generatorAway: 'Der Generator antwortet nicht. Nichts geht verloren.',
  change: 'Änderung',
  undone: 'Rückgängig gemacht',
  redone: 'Wiederholt',
  backToTheBeginning: 'Zurück am Anfang',
  nowAt: (name: string) => `Jetzt bei: ${name}.`,
  restored: 'Wiederhergestellt.',
  selected: (name: string) => `${name} ausgewählt.`,
  roadUsersSelected: (n: number) => `${n} Verkehrsteilnehmer ausgewählt.`,
  sceneOpened: 'Szene geöffnet',
  changesComputed: (waiting) =>
    plural(waiting, { one: ` ${waiting} Änderung berechnet.`, other: ` ${waiting} Änderungen berechnet.` }),
  theGenerator: (done) => `Der Generator ist wieder da.${done}`,
  waitingChanges: 'Wartende Änderungen',
  thisTakesLonger: 'Das dauert länger als sonst.',
  sixFutures: (shown, rank) => `Sechs Zukünfte. Gezeigt: ${shown}, Rang ${rank}.`,
  aValueIsOutside: (min, max) => `Ein Wert liegt nicht zwischen ${min} und ${max}.`,
  toS: (window, min) => `${window} bis ${min} s`,
  keepCurve: 'Tempokurve behalten',
  curveIsOff: 'Die Tempokurve gilt nicht mehr.',
  collisionWith: (other, time) => ` Zusammenstoß mit ${other} bei ${time}.`,
  noOtherAffected: ' Kein anderer Verkehrsteilnehmer ist betroffen.',
  othersChangedAndHit: (n, step, hit) =>
    plural(n, { one: `${step}. ${n} weiterer betroffen.${hit}`, other: `${step}. ${n} weitere betroffen.${hit}` }),
  collisionAnd: (name, name2, time) => `Zusammenstoß, ${name} und ${name2}, ${time} Sekunden.`,
  asBefore: 'wie zuvor',
  importDidNotLoad: 'Der Import wurde nicht geladen. Noch einmal versuchen, sobald das Netz wieder da ist.',
  theSearchDid: 'Die Suche wurde nicht geladen. Noch einmal versuchen, sobald das Netz wieder da ist.',
};
