// Keys, clicks and files that belong to no single panel.
import type { Context } from '../actions/context';
import { keyOf } from '../actions/keys';
import { walkEnds } from '../actions/look';
import { actionForKey, offeredElsewhere, perform } from '../actions/registry';
import type { Action } from '../actions/action';
import { TEXTS as ACTION_TEXTS } from '../texts/desk/actions';
import { TEXTS } from '../texts/desk/page';

/** Keys without an action that are answered: signs that do nothing in a browser, and the keys of grouping elsewhere. */
const SAID = /^(Ctrl\+(Shift\+)?G|(Shift\+)?[A-Z\d])$/;

/** Keys that edit no text: in a text field the browser would open its own history or bookmarks. */
const CHORD = /^Ctrl\+(Shift\+[A-Y]|[BD-UW])$/;

export function listenToPage(c: Context): void {
  let space: { panned: number } | null = null;
  addEventListener('keydown', (e) => {
    const now = { dragging: c.editor.drag.active.peek(), offers: (a: Action) => a.onOffer!(c) };
    if (e.defaultPrevented) return;
    const key = keyOf(e);
    const a = actionForKey(key, now);
    const unused = SAID.test(key) && { id: '', label: key.replaceAll('+', ' ') };
    const meant = a ?? offeredElsewhere(key) ?? unused;
    if (!meant || a?.native || belongsToPage(c, e, meant)) return;
    e.preventDefault();
    if (!a) return c.editor.notices.refuse(ACTION_TEXTS.notHere(meant.label));
    // Typed text is applied first.
    if (CHORD.test(key) && a.context !== 'always') (e.target as HTMLElement).blur();
    // With Space held the picture is panned; only without a pan it means playback.
    if (a.id === 'play' && e.key === ' ') space = e.repeat ? space : { panned: c.gestures.pannedWithSpace };
    else perform(c, a.id);
  });
  addEventListener('keyup', (e) => {
    if (e.key !== ' ' || !space) return;
    if (space.panned === c.gestures.pannedWithSpace) perform(c, 'play');
    space = null;
  });
  addEventListener('click', leaveButton);
  takeDrops(c);
}

/** Is the key for the focused element, and not for its action? */
function belongsToPage(c: Context, e: KeyboardEvent, a: Pick<Action, 'id'> & Partial<Action>): boolean {
  const { editor, ui } = c;
  if (CHORD.test(keyOf(e)) && !ui.dialog.peek()) return editor.drag.active.peek();
  const target = e.target as HTMLElement;
  const input = target instanceof HTMLInputElement ? target : null;
  // A typed character is text.
  const typed = e.key.length === 1 && !e.ctrlKey && !e.metaKey && !e.altKey;
  if (typed && (target instanceof HTMLTextAreaElement || (input && !['range', 'radio'].includes(input.type)))) {
    if (!input || !leavesField(input, e, a)) return true;
  }
  if (target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement) return a.context !== 'always';
  if (input && input.type !== 'range' && a.context !== 'always' && !leavesField(input, e, a)) return true;
  if (ui.dialog.peek() && a.context !== 'always') return true;
  // Tab walks through road users from the picture, once; elsewhere, and at the end, it is the browser's.
  const inList = target.closest('[data-group="users"]') !== null;
  if (['Tab', 'Shift+Tab'].includes(a.keys?.[0] ?? '') && target !== document.body)
    if (!inList || ui.drawer.peek() === 'users' || walkEnds(c, e.shiftKey ? -1 : 1)) return true;
  if (target instanceof HTMLButtonElement && pressesButton(target, e, editor.selection.peek())) return true;
  if (input?.type === 'range' && e.key.startsWith('Arrow')) return true;
  return editor.drag.active.peek() && a.id !== 'deselect' && !a.whileDragging && !a.onOffer;
}

/** A number field keeps undo and Space only while it holds typed text that is not yet applied. */
const leavesField = (input: HTMLInputElement, e: KeyboardEvent, a: Pick<Action, 'id'>): boolean =>
  (a.id === 'undo' || a.id === 'redo' || (a.id === 'play' && e.key === ' ')) &&
  !!input.dataset.field &&
  !('typed' in input.dataset);

/** A button's own keys. In the list of road users they select; a further Enter moves on to the inspector. */
function pressesButton(button: HTMLButtonElement, e: KeyboardEvent, selected: string | null): boolean {
  if ((e.key !== ' ' && e.key !== 'Enter') || e.ctrlKey) return false;
  // Animated pictures start with Space and are taken with Enter.
  if (e.key === ' ' && 'plays' in button.dataset) return false;
  return !button.dataset.agent || button.dataset.agent !== selected;
}

/**
 * A mouse click leaves no focus on a button: the Space that follows is for playback. Keyboard focus stays, and so do
 * dialogs and menus, which return the focus themselves.
 */
function leaveButton(e: MouseEvent): void {
  const button = e.detail > 0 && e.target instanceof Element ? e.target.closest('button') : null;
  if (button && button === document.activeElement && !button.closest('.dlg, .menu')) button.blur();
}

/** Files may be dropped anywhere; an overlay shows it while they are over the page. */
function takeDrops({ importing, stage, ui }: Context): void {
  const veil = document.createElement('div');
  veil.className = 'dropping';
  veil.textContent = TEXTS.dropToImport;
  /** Number of entered elements: a child is entered before its parent is left. */
  let depth = 0;
  const gone = () => {
    veil.remove();
    depth = 0;
  };
  addEventListener('dragenter', (e) => {
    if (!e.dataTransfer?.types.includes('Files')) return;
    depth++;
    stage.element.append(veil);
  });
  addEventListener('dragleave', () => {
    if (--depth <= 0) gone();
  });
  addEventListener('dragover', (e) => e.preventDefault());
  addEventListener('drop', (e) => {
    e.preventDefault();
    gone();
    const files = [...(e.dataTransfer?.files ?? [])];
    if (!files.length) return;
    if (ui.dialog.peek() === 'import') ui.closeDialog();
    void importing.files(files);
  });
}
