import type { TEXTS } from '../../panels/map-item';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  kinds: { signal: 'Ampel', 'stop-sign': 'Stoppschild', crosswalk: 'Fußgängerüberweg', lane: 'Spur' },
  lights: { stop: 'Rot', caution: 'Gelb', go: 'Grün', unknown: 'Unbekannt' },
  phases: 'Phasen',
  group: (n) => plural(n, { one: '1 Spur', other: `${n} Spuren` }),
  phasesOfTheSignal: 'Phasen der Ampel',
  from: (time) => `ab ${time} s`,
  beginOf: (light) => `${light} ab`,
  edge: (before, after) => `${before} zu ${after}`,
  atTime: (time) => `bei ${time} s`,
  remove: (light) => `Entfernen: ${light}`,
  add: (light, time) => `${light} ab ${time} s`,
  howToAdd: 'Grenzen auf der Zeitleiste ziehen; ein Doppelklick dort setzt eine neue.',
  close: 'Schließen',
  speedLimit: 'Tempolimit',
  notGiven: 'keine Angabe',
  whoMayUseIt: 'Zugelassen',
  users: {
    motor: 'Kfz und Radverkehr',
    motorAlone: 'nur Kfz',
    bus: 'Busse und Radverkehr',
    bike: 'nur Radverkehr',
  },
  inTheMap: (rule) => `In der Karte: ${rule}`,
  limitChanged: (place) => `Tempolimit geändert: ${place}`,
  usersChanged: (place) => `Nutzung geändert: ${place}`,
  priority: 'Vorrang',
  pedestriansFirst: 'Fußgänger haben Vorrang; Fahrzeuge und Radfahrer warten',
  bySignals: 'Durch die Ampel geregelt; Abbieger lassen Fußgänger vor',
  everyoneStops: 'Alle halten hier und lassen dann den Verkehr der anderen Straße vor',
};
