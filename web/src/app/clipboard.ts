// The browser's clipboard. Keys reach it by its own events, which need no permission; menus go by what is allowed.
import type { Vec } from '../model/base/geometry';
import type { Context } from '../actions/context';
import { TEXTS } from '../texts/desk/page';

const isText = (el: EventTarget | null): boolean =>
  el instanceof HTMLInputElement || el instanceof HTMLTextAreaElement || !getSelection()?.isCollapsed;

/** Where something is put: at the menu that it was chosen from, else under the pointer. */
function place({ gestures, stage, ui }: Context): Vec | null {
  const at = ui.contextMenu.peek() ?? gestures.pointer;
  return at && stage.view.from(at.x, at.y);
}

function put(c: Context, text: string, at: Vec | null): void {
  if (c.copying.paste(text, at, c.stage.view.z)) c.reveal(c.editor.selected.peek());
  else c.editor.notices.show({ text: TEXTS.thereAreNoRoad });
}

/** Menus: the page may be forbidden to use the clipboard; then what was copied here last is what there is. */
export const clipboardOf = (c: () => Context): Context['clipboard'] => {
  const take = (text: string | null): void => {
    if (text) void navigator.clipboard?.writeText(text).catch(() => undefined);
  };
  return {
    copy: () => take(c().copying.copy()),
    cut: () => take(c().copying.cut()),
    paste: () => {
      const at = place(c());
      const own = c().copying.last;
      const read = navigator.clipboard?.readText?.() ?? Promise.reject(new Error('no clipboard'));
      void read.catch(() => own ?? '').then((text) => put(c(), text, at));
    },
  };
};

export function listenToClipboard(c: Context): void {
  const onText = (what: 'copy' | 'cut') => (e: ClipboardEvent) => {
    if (isText(e.target) || c.ui.dialog.peek()) return;
    const text = c.copying[what]();
    if (!text) return;
    e.clipboardData?.setData('text/plain', text);
    e.preventDefault();
  };
  addEventListener('copy', onText('copy'));
  addEventListener('cut', onText('cut'));
  addEventListener('paste', (e) => {
    if (isText(e.target) || c.ui.dialog.peek() || !c.editor.scene.peek()) return;
    e.preventDefault();
    put(c, e.clipboardData?.getData('text/plain') ?? '', place(c));
  });
}
