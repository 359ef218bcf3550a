// Everything: undo, the palette, help, and the page itself.
import { inGroup } from './action';
import { nextSpeedUnit } from '../model/units';
import type { Cases } from '../edit/cases/cases';
import type { Context } from './context';

/** Steps of a map that is being made are its own. */
const canUndo = ({ editor: { layouts, undoName } }: Context): boolean =>
  layouts.isOpen.value ? layouts.canUndo.value : undoName.value !== null;
const canRedo = ({ editor: { layouts, redoName } }: Context): boolean =>
  layouts.isOpen.value ? layouts.canRedo.value : redoName.value !== null;

/** Esc: what is nearest goes first, one thing a press. */
function letGo({ editor, gestures, importing, rounds, searching, ui, variants }: Context): void {
  if (gestures.cancel()) return;
  if (ui.dialog.value || ui.menu.value || ui.contextMenu.value) {
    ui.closeContextMenu();
    ui.closeDialog();
    ui.closeMenu();
  } else if (ui.drawer.value === 'history' || ui.drawer.value === 'users') ui.showDrawer(null);
  else if (importing.verdicts.value) importing.close();
  else if (ui.eventsPanel.value) {
    ui.showEvents(false);
    editor.pickEvent(null);
  } else if (editor.layouts.way.value) editor.layouts.pickWay(null);
  else if (editor.layouts.isOpen.value) editor.layouts.close();
  else if (rounds.isOpen.value) rounds.close();
  else if (searching.open.value) closeSearch(searching.open.value);
  else if (editor.tool.value !== 'select') editor.chooseTool('select');
  else if (variants.pair.value || variants.picked.value !== null) variants.endCompare();
  else editor.select(null);
}

/** Nothing that was found goes with one press: first the case that is shown, then the search, then the panel. */
function closeSearch(cases: Cases): void {
  if (cases.shown.value !== null) cases.show(null);
  else if (cases.state.value === 'running' && cases.found.value.length) cases.stop();
  else cases.close();
}

export const everything = inGroup('Everything', [
  {
    id: 'deselect',
    label: 'Let go, close, put back',
    keys: ['Esc'],
    help: 'Cancels a drag, then closes what is open, then selects nothing',
    context: 'always',
    run: letGo,
  },
  {
    id: 'palette',
    label: 'Actions',
    keys: ['Ctrl+K'],
    icon: 'search',
    help: 'Find and do anything',
    context: 'always',
    run: ({ ui }) => (ui.dialog.value === 'palette' ? ui.closeDialog() : ui.openDialog('palette')),
  },
  {
    id: 'undo',
    label: 'Undo',
    keys: ['Ctrl+Z'],
    icon: 'undo',
    help: 'One step back',
    when: (c) => (canUndo(c) ? true : 'Nothing to undo.'),
    run: ({ editor }) => (editor.layouts.isOpen.peek() ? editor.layouts.undo() : editor.undo()),
  },
  {
    id: 'redo',
    label: 'Redo',
    keys: ['Ctrl+Shift+Z', 'Ctrl+Y'],
    icon: 'redo',
    help: 'One step on again',
    when: (c) => (canRedo(c) ? true : 'Nothing to redo.'),
    run: ({ editor }) => (editor.layouts.isOpen.peek() ? editor.layouts.redo() : editor.redo()),
  },
  {
    id: 'shortcuts',
    label: 'Shortcuts',
    keys: ['?'],
    icon: 'help',
    help: 'This list',
    run: (c) => c.ui.openDialog('shortcuts'),
  },
  {
    id: 'theme',
    label: 'Light or dark',
    keys: ['Shift+D'],
    icon: 'moon',
    help: 'Colours of the page',
    run: (c) => c.ui.setTheme(c.ui.theme.value === 'dark' ? 'light' : 'dark'),
  },
  {
    id: 'next-group',
    label: 'Next part of the page',
    keys: ['F6'],
    help: 'Top bar, scenes, road users, inspector, timeline',
    context: 'always',
    run: (c) => c.focusGroup(1),
  },
  {
    id: 'previous-group',
    label: 'Previous part of the page',
    keys: ['Shift+F6'],
    help: 'The way back',
    context: 'always',
    run: (c) => c.focusGroup(-1),
  },
  {
    id: 'coach',
    label: 'Show the first steps',
    icon: 'help',
    help: 'The three-step hint',
    run: (c) => c.ui.coachTo(1),
  },
  {
    id: 'unit',
    label: 'km/h, mph or m/s',
    keys: ['U'],
    icon: 'ruler',
    help: 'The unit in which speeds of vehicles are shown and typed',
    run: (c) => c.editor.setUnit(nextSpeedUnit(c.editor.speedUnit.value)),
  },
]);
