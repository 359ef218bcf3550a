import type { TEXTS } from '../../panels/place-panel';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  one: 'Einer',
  clickWhereIt: 'Auf den Startort klicken, ziehen zum Drehen',
  alongALine: 'Linie',
  dragALineThey: 'Eine Linie ziehen setzt eine Reihe ein',
  overAnArea: 'Fläche',
  dragOverTheGround: 'Eine Fläche ziehen setzt eine Gruppe ein',
  placeA: (kind_name) => `Einsetzen: ${kind_name}`,
  donePlacing: 'Einsetzen beenden',
  size: 'Größe',
  ownSize: 'Eigene Größe',
  howMany: 'Anzahl',
  howManyRoadUsers: 'Anzahl der Verkehrsteilnehmer',
  sizes: { length: 'Länge', width: 'Breite' },
  letters: { length: 'L', width: 'B' },
  ownIn: (name, unit) => `Eigene ${name} in ${unit}`,
};
