import type { GROUP_TITLES } from '../../desk/groups';
import type { Said } from '../../table';

export const german: Said<typeof GROUP_TITLES> = {
  look: 'Auswählen und ansehen',
  place: 'Einsetzen',
  edit: 'Bearbeiten',
  move: 'Bewegen',
  goal: 'Ziel und Zukünfte',
  rounds: 'Runden',
  time: 'Zeit',
  variants: 'Varianten',
  scene: 'Szene',
  everything: 'Alles',
  cases: 'Fälle',
};
