// Keyboard focus on the page.

/** Parts of the page in the order of F6. */
const ORDER = ['top', 'scenes', 'history', 'users', 'tools', 'handles', 'inspector', 'rounds', 'variants', 'timeline'];
/** The element of a part that gets the focus. */
const FIRST = '[aria-pressed="true"][data-agent], button:not([tabindex="-1"]), input, [tabindex="0"]';

export function focusField(part: 'start' | 'goal', field: string): void {
  const el = document.querySelector<HTMLInputElement>(`[data-field="${part}-${field}"]`);
  el?.focus();
  el?.select();
}

export function focusAgent(id: string): void {
  document.querySelector<HTMLElement>(`[data-agent="${CSS.escape(id)}"]`)?.focus();
}

export function focusGroup(step: 1 | -1): void {
  const groups = [...document.querySelectorAll<HTMLElement>('[data-group]')];
  groups.sort((a, b) => ORDER.indexOf(a.dataset.group!) - ORDER.indexOf(b.dataset.group!));
  const at = groups.findIndex((g) => g.contains(document.activeElement));
  // Parts without a focusable element are skipped.
  for (let i = 1; i <= groups.length; i++) {
    const group = groups[(((at + i * step) % groups.length) + groups.length) % groups.length];
    const first = [...group.querySelectorAll<HTMLElement>(FIRST)].find((el) => el.checkVisibility());
    first?.focus();
    if (first && document.activeElement === first) return;
  }
}

export function focusName(): void {
  const name = document.querySelector<HTMLInputElement>('.title input');
  name?.focus();
  name?.select();
}

/** The name or the note of the selected road user; the field may appear with the next frame. */
export function focusText(which: 'name' | 'note'): void {
  requestAnimationFrame(() => {
    const el = document.querySelector<HTMLInputElement>(`[data-text="${which}"]`);
    el?.focus();
    el?.select();
  });
}
