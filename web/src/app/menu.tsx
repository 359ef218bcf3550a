// The menus of the top bar: lists of actions.
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { useApp } from './parts/app-context';
import { ActionButton } from './parts/buttons';
import { Icon } from './parts/icons';

/** Ids of actions; null draws a line. */
const MENUS: Record<string, readonly (string | null)[]> = {
  file: [
    'new-scene',
    'new-plain-scene',
    'choose-files',
    null,
    'save-copy',
    'save-as',
    'rename-scene',
    'delete-scene',
    null,
    'share',
    'export',
    'history',
    null,
    'reset-all',
    null,
    'theme',
    'unit',
    'shortcuts',
    'coach',
  ],
  more: [
    'redo',
    'generate',
    'new-seed',
    'variants',
    null,
    'scenes',
    'users',
    'history',
    'export',
    null,
    'layer-futures',
    'layer-log',
    'layer-lanes',
    'layer-labels',
    'fit',
    null,
    'palette',
    'theme',
  ],
};

/** Opens its menu, or closes it when it is open. */
function useMenu(name: string) {
  const { ui } = useApp();
  return {
    open: useComputed(() => ui.menu.value === name),
    toggle: () => (ui.menu.peek() === name ? ui.closeMenu() : ui.openMenu(name)),
  };
}

export function MenuButton({ name, icon, label }: { name: string; icon: string; label: string }) {
  const { open, toggle } = useMenu(name);
  return (
    <button
      type="button"
      class={`btn i ${open.value ? 'on' : ''}`}
      data-menu={name}
      aria-label={label}
      title={label}
      aria-haspopup="menu"
      aria-expanded={open.value}
      onClick={toggle}
    >
      <Icon name={icon} />
    </button>
  );
}

/** Below its button, within the page. */
function placeUnder(name: string): Record<string, string> {
  const button = document.querySelector(`[data-menu="${name}"]`)?.getBoundingClientRect();
  const left = button?.left ?? 48;
  const top = `${(button?.bottom ?? 44) + 2}px`;
  // A button in the right half has its menu to the left of its right edge.
  if (left > innerWidth / 2) return { top, right: `${innerWidth - button!.right}px` };
  return { top, left: `${left}px` };
}

export function Menu({ name }: { name: string }) {
  const { ui } = useApp();
  const box = useRef<HTMLDivElement>(null);
  const items = () => [...box.current!.querySelectorAll<HTMLElement>('button')];

  useLayoutEffect(() => items()[0]?.focus({ preventScroll: true }), []);
  useEffect(() => {
    const away = (e: Event) => {
      const at = e.target as Element;
      if (!box.current?.contains(at) && !at.closest?.('[data-menu]')) ui.closeMenu();
    };
    addEventListener('pointerdown', away, true);
    return () => removeEventListener('pointerdown', away, true);
  }, [ui]);

  const step = (e: KeyboardEvent) => {
    if (e.key !== 'ArrowDown' && e.key !== 'ArrowUp') return;
    e.preventDefault();
    const all = items();
    const at = all.indexOf(document.activeElement as HTMLElement);
    all[(at + (e.key === 'ArrowDown' ? 1 : -1) + all.length) % all.length]?.focus();
  };
  return (
    <div ref={box} class="menu" role="menu" style={placeUnder(name)} onClick={() => ui.closeMenu()} onKeyDown={step}>
      {MENUS[name].map((id, i) => (id === null ? <hr key={i} /> : <ActionButton key={id} id={id} withKey />))}
    </div>
  );
}
