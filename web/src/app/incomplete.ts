// What is said where a part of the page did not come.

/** The words for a part, and for all of them. */
import { TEXTS } from '../texts/desk/page';

export const NOT_LOADED = TEXTS.thisPartOfThe;
const NOT_COMPLETE = TEXTS.theEditorDid;

/** Without its tools the page can only be loaded again; nothing that waits for them goes on. */
export function sayIncomplete(over: HTMLElement): Promise<never> {
  const toast = document.createElement('div');
  toast.className = 'toast';
  toast.setAttribute('role', 'alert');
  const again = document.createElement('button');
  again.type = 'button';
  again.className = 'btn';
  again.textContent = TEXTS.loadAgain;
  again.addEventListener('click', () => location.reload());
  toast.append(NOT_COMPLETE, again);
  over.append(toast);
  over.setAttribute('aria-busy', 'false');
  return new Promise(() => undefined);
}
