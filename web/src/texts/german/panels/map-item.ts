import type { TEXTS } from '../../panels/map-item';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  kinds: { signal: 'Signal', 'stop-sign': 'Stoppschild', crosswalk: 'Fußgängerüberweg', lane: 'Fahrstreifen' },
  lights: { stop: 'Rot', caution: 'Gelb', go: 'Grün', unknown: 'Unbekannt' },
  phases: 'Phasen',
  group: (n) => plural(n, { one: '1 Fahrstreifen', other: `${n} Fahrstreifen` }),
  phasesOfTheSignal: 'Phasen des Signals',
  from: (time) => `ab ${time} s`,
  beginOf: (light) => `${light} ab`,
  edge: (before, after) => `${before} zu ${after}`,
  atTime: (time) => `bei ${time} s`,
  remove: (light) => `Entfernen: ${light}`,
  add: (light, time) => `${light} ab ${time} s`,
  howToAdd: 'Grenzen auf der Zeitleiste ziehen; ein Doppelklick dort setzt eine neue.',
  close: 'Schließen',
  speedLimit: 'Zulässig',
  notGiven: 'keine Angabe',
  whoMayUseIt: 'Wer ihn nutzen darf',
  users: {
    motor: 'Kraftfahrzeuge und Radverkehr',
    motorAlone: 'Kraftfahrzeuge',
    bus: 'Busse und Radverkehr',
    bike: 'Radverkehr',
  },
  inTheMap: (rule) => `In der Karte: ${rule}`,
  limitChanged: (place) => `Tempolimit geändert: ${place}`,
  usersChanged: (place) => `Nutzung geändert: ${place}`,
  priority: 'Vorrang',
  pedestriansFirst: 'Zu Fuß Gehende zuerst; Fahrzeuge warten',
  bySignals: 'Nach den Signalen; Abbiegende lassen zu Fuß Gehende durch',
  everyoneStops: 'Alle halten hier und lassen dann den Querverkehr durch',
};
