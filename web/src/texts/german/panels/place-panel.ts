import type { TEXTS } from '../../panels/place-panel';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  one: 'Einer',
  clickWhereIt: 'Dorthin klicken, wo er starten soll, ziehen zum Drehen',
  alongALine: 'Linie',
  dragALineThey: 'Eine Linie ziehen: sie stehen darauf',
  overAnArea: 'Fläche',
  dragOverTheGround: 'Über den Grund ziehen: sie verteilen sich darauf',
  placeA: (kind_name) => `Einsetzen: ${kind_name}`,
  donePlacing: 'Einsetzen beenden',
  size: 'Größe',
  ownSize: 'Eigene Größe',
  howMany: 'Wie viele',
  howManyRoadUsers: 'Wie viele Verkehrsteilnehmer',
  sizes: { length: 'Länge', width: 'Breite' },
  letters: { length: 'L', width: 'B' },
  ownIn: (name, unit) => `Eigene ${name} in ${unit}`,
};
