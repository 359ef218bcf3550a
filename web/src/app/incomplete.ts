// Notices for a part of the page that failed to load.

/** Texts for one part, and for all of them. */
import { TEXTS } from '../texts/desk/page';

export const NOT_LOADED = TEXTS.thisPartOfThe;
const NOT_COMPLETE = TEXTS.theEditorDid;

/** Without its tools the page can only be reloaded; the returned promise never resolves. */
export function sayIncomplete(over: HTMLElement): Promise<never> {
  const toast = document.createElement('div');
  toast.className = 'toast';
  toast.setAttribute('role', 'alert');
  const again = document.createElement('button');
  again.type = 'button';
  again.className = 'btn';
  again.textContent = TEXTS.reload;
  again.addEventListener('click', () => location.reload());
  toast.append(NOT_COMPLETE, again);
  over.append(toast);
  over.setAttribute('aria-busy', 'false');
  return new Promise(() => undefined);
}
