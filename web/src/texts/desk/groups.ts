// Groups of actions, as the shortcut sheet and the palette title them.
import { table } from '../table';

export const GROUP_TITLES = table('groups', {
  look: 'Select and look',
  place: 'Place',
  edit: 'Edit',
  move: 'Move',
  goal: 'Goal and futures',
  rounds: 'Rounds',
  time: 'Time',
  variants: 'Variants',
  scene: 'Scene',
  everything: 'Everything',
  cases: 'Cases',
});
