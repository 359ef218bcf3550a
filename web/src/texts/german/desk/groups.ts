import type { GROUP_TITLES } from '../../desk/groups';
import type { Said } from '../../table';

export const german: Said<typeof GROUP_TITLES> = {
  place: 'Verkehrsteilnehmer hinzufügen',
  select: 'Verkehrsteilnehmer auswählen',
  look: 'Ansicht bewegen, Ebenen zeigen',
  edit: 'Kopieren, sperren, löschen',
  move: 'Bewegen und drehen',
  goal: 'Ziele setzen, Zukünfte wählen',
  rounds: 'Zukünfte behalten oder verwerfen',
  time: 'Abspielen, Zeit wählen',
  variants: 'Varianten erzeugen, vergleichen',
  scene: 'Öffnen, sichern, teilen',
  everything: 'Rückgängig, suchen, Hilfe',
  cases: 'Fälle suchen',
};
