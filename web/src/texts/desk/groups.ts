// Groups of actions, as titled in the shortcut sheet and the palette.
import { table } from '../table';

export const GROUP_TITLES = table('groups', {
  place: 'Add road users',
  select: 'Select road users',
  look: 'Move the view, show layers',
  edit: 'Copy, lock and delete',
  move: 'Move and turn',
  goal: 'Set goals, choose futures',
  rounds: 'Keep or reject futures',
  time: 'Play and step through time',
  variants: 'Make and compare variants',
  scene: 'Open, save and share',
  everything: 'Undo, find, get help',
  cases: 'Find cases',
});
