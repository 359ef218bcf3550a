// Everything: undo, the palette, help, and the page itself.
import { inGroup } from './action';
import { nextSpeedUnit } from '../model/base/units';
import type { Cases } from '../edit/tools/cases/cases';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';
import { LANGUAGES, nextLanguage, speak } from '../texts/language';

/** A map being made has its own undo steps. */
const canUndo = ({ editor, layouts }: Context): boolean =>
  layouts.isOpen.value ? layouts.canUndo.value : editor.document.undoName.value !== null;
const canRedo = ({ editor, layouts }: Context): boolean =>
  layouts.isOpen.value ? layouts.canRedo.value : editor.document.redoName.value !== null;

/** Esc: closes the nearest thing first, one with each press. */
function letGo({ editor, gestures, importing, maker, rounds, searching, ui, variants, layouts }: Context): void {
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
  } else if (layouts.way.value) layouts.pickWay(null);
  else if (layouts.isOpen.value) maker.leave();
  else if (rounds.isOpen.value) rounds.close();
  else if (searching.open.value) closeSearch(searching.open.value);
  else if (editor.tool.value !== 'select') editor.chooseTool('select');
  else if (variants.comparing.pair.value || variants.comparing.picked.value !== null) variants.comparing.end();
  else editor.select(null);
}

/** One press does not close everything: first the shown case, then the search, then the panel. */
function closeSearch(cases: Cases): void {
  if (cases.shown.value !== null) cases.show(null);
  else if (cases.state.value === 'running' && cases.found.value.length) cases.stop();
  else cases.close();
}

export const everything = inGroup('everything', [
  {
    id: 'deselect',
    label: TEXTS.cancelCloseDeselect,
    keys: ['Esc'],
    help: 'cancelsADrag',
    context: 'always',
    run: letGo,
  },
  {
    id: 'palette',
    label: TEXTS.actions,
    // The keys for finding and for commands in other programs.
    keys: ['Ctrl+K', 'Ctrl+F', '/', 'Ctrl+P', 'Ctrl+Shift+P'],
    icon: 'search',
    help: 'runsAnyAction',
    context: 'always',
    run: ({ ui }) => (ui.dialog.value === 'palette' ? ui.closeDialog() : ui.openDialog('palette')),
  },
  {
    id: 'undo',
    label: TEXTS.undo,
    keys: ['Ctrl+Z'],
    icon: 'undo',
    help: 'undoesTheLastStep',
    when: (c) => (canUndo(c) ? true : TEXTS.nothingToUndo),
    run: ({ editor, layouts }) => (layouts.isOpen.peek() ? layouts.undo() : editor.commits.undo()),
  },
  {
    id: 'redo',
    label: TEXTS.redo,
    keys: ['Ctrl+Shift+Z', 'Ctrl+Y'],
    icon: 'redo',
    help: 'redoesTheLastStep',
    when: (c) => (canRedo(c) ? true : TEXTS.nothingToRedo),
    run: ({ editor, layouts }) => (layouts.isOpen.peek() ? layouts.redo() : editor.commits.redo()),
  },
  {
    id: 'shortcuts',
    label: TEXTS.shortcuts,
    keys: ['?', 'F1'],
    icon: 'help',
    help: 'thisList',
    run: (c) => c.ui.openDialog('shortcuts'),
  },
  {
    id: 'theme',
    label: TEXTS.lightOrDark,
    keys: ['Shift+D'],
    icon: 'moon',
    help: 'coloursOfThe',
    run: (c) => c.ui.setTheme(c.ui.theme.value === 'dark' ? 'light' : 'dark'),
  },
  {
    id: 'next-group',
    label: TEXTS.nextPartOfThe,
    keys: ['F6'],
    help: 'topBarScenes',
    context: 'always',
    run: (c) => c.focusGroup(1),
  },
  {
    id: 'previous-group',
    label: TEXTS.previousPart,
    keys: ['Shift+F6'],
    help: 'inReverseOrder',
    context: 'always',
    run: (c) => c.focusGroup(-1),
  },
  {
    id: 'coach',
    label: TEXTS.showTheFirst,
    icon: 'help',
    help: 'theThreeStep',
    run: (c) => c.ui.coachTo(1),
  },
  {
    id: 'unit',
    label: TEXTS.units,
    keys: ['U'],
    icon: 'ruler',
    help: 'unitsOfSpeed',
    run: (c) => c.editor.view.setUnit(nextSpeedUnit(c.editor.view.speedUnit.value)),
  },
  {
    id: 'language',
    icon: 'note',
    label: TEXTS.language(LANGUAGES[nextLanguage]),
    help: 'theLanguageOf',
    run: () => speak(nextLanguage),
  },
]);
