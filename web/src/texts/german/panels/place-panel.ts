import type { TEXTS } from '../../panels/place-panel';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  one: 'Einzeln',
  clickTheStartPosition: 'Auf den Startort klicken, ziehen zum Drehen',
  alongALine: 'Linie',
  dragALine: 'Eine Linie ziehen setzt eine Reihe ein',
  overAnArea: 'Fläche',
  dragOverTheGround: 'Eine Fläche ziehen setzt eine Gruppe ein',
  placeA: (kind_name) => `Einsetzen: ${kind_name}`,
  donePlacing: 'Einsetzen beenden',
  size: 'Größe',
  customSize: 'Eigene Größe',
  count: 'Anzahl',
  numberOfRoadUsers: 'Anzahl der Verkehrsteilnehmer',
  sizes: { length: 'Länge', width: 'Breite' },
  letters: { length: 'L', width: 'B' },
  customIn: (name, unit) => `Eigene ${name} in ${unit}`,
};
