// Keys, clicks and files that are not meant for one panel.
import type { Context } from '../actions/context';
import { keyOf } from '../actions/keys';
import { walkEnds } from '../actions/look';
import { actionForKey, perform } from '../actions/registry';
import type { Action } from '../actions/action';
import { TEXTS } from '../texts/desk/page';

export function listenToPage(c: Context): void {
  let space: { panned: number } | null = null;
  addEventListener('keydown', (e) => {
    const now = { dragging: c.editor.dragging.peek(), offers: (a: Action) => a.onOffer!(c) };
    const a = e.defaultPrevented ? undefined : actionForKey(keyOf(e), now);
    if (!a || a.native || belongsToPage(c, e, a)) return;
    e.preventDefault();
    // With Space held the picture is moved; only where it was not is playback meant.
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

/** Is the key for the element that has the focus, and not for the action it is bound to? */
function belongsToPage(c: Context, e: KeyboardEvent, a: Action): boolean {
  const { editor, ui } = c;
  const target = e.target as HTMLElement;
  const input = target instanceof HTMLInputElement ? target : null;
  if (target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement) return a.context !== 'always';
  if (input && input.type !== 'range' && a.context !== 'always' && !leavesField(input, e, a)) return true;
  if (ui.dialog.peek() && a.context !== 'always') return true;
  // Tab walks through road users from the picture, once; elsewhere, and at its end, it is the browser's.
  const inList = target.closest('[data-group="users"]') !== null;
  if (/^(Shift\+)?Tab$/.test(a.keys![0]) && target !== document.body)
    if (!inList || ui.drawer.peek() === 'users' || walkEnds(c, e.shiftKey ? -1 : 1)) return true;
  if (target instanceof HTMLButtonElement && pressesButton(target, e, editor.selection.peek())) return true;
  if (input?.type === 'range' && e.key.startsWith('Arrow')) return true;
  return editor.dragging.peek() && a.id !== 'deselect' && !a.whileDragging && !a.onOffer;
}

/** A number field keeps undo and Space only while it holds typed text that is not yet applied. */
const leavesField = (input: HTMLInputElement, e: KeyboardEvent, a: Action): boolean =>
  (a.id === 'undo' || a.id === 'redo' || (a.id === 'play' && e.key === ' ')) &&
  !!input.dataset.field &&
  !('typed' in input.dataset);

/** A button's own keys. In the list of road users they select, and after that Enter goes on to the inspector. */
function pressesButton(button: HTMLButtonElement, e: KeyboardEvent, selected: string | null): boolean {
  if ((e.key !== ' ' && e.key !== 'Enter') || e.ctrlKey) return false;
  // Pictures that move are started by Space, taken by Enter.
  if (e.key === ' ' && 'plays' in button.dataset) return false;
  return !button.dataset.agent || button.dataset.agent !== selected;
}

/**
 * A click with the mouse leaves no focus on a button: the Space that follows is meant to play. Keys keep theirs, and
 * so do dialogs and menus, which hand the focus back themselves.
 */
function leaveButton(e: MouseEvent): void {
  const button = e.detail > 0 && e.target instanceof Element ? e.target.closest('button') : null;
  if (button && button === document.activeElement && !button.closest('.dlg, .menu')) button.blur();
}

/** Files may be dropped anywhere; a veil says so while they are over the page. */
function takeDrops({ importing, stage, ui }: Context): void {
  const veil = document.createElement('div');
  veil.className = 'dropping';
  veil.textContent = TEXTS.dropToImport;
  /** How many elements the files are over: entering a child comes before leaving its parent. */
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
