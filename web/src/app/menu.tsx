// The buttons of menus, and the open menu.
import type { ComponentChildren } from 'preact';
import { useComputed } from '@preact/signals';
import { useApp } from './parts/app-context';
import { Later } from './later';
import { Icon } from './parts/icons';

/** Opens its menu, or closes it when it is open. */
function useMenu(name: string) {
  const { ui } = useApp();
  return {
    open: useComputed(() => ui.menu.value === name),
    toggle: () => (ui.menu.peek() === name ? ui.closeMenu() : ui.openMenu(name)),
  };
}

interface MenuButtonProps {
  readonly name: string;
  readonly icon: string;
  readonly label: string;
  readonly class?: string;
  /** Words before the icon. */
  readonly children?: ComponentChildren;
}

export function MenuButton({ name, icon, label, class: className = '', children }: MenuButtonProps) {
  const { open, toggle } = useMenu(name);
  return (
    <button
      type="button"
      class={`btn ${children ? 'drops' : 'i'} ${className} ${open.value ? 'on' : ''}`}
      data-menu={name}
      aria-label={label}
      title={label}
      aria-haspopup="menu"
      aria-expanded={open.value}
      onClick={toggle}
    >
      {children}
      <Icon name={icon} size={children ? 12 : 18} />
    </button>
  );
}

export function OpenMenu() {
  const { ui } = useApp();
  return ui.menu.value === null ? null : <Later part="menu" />;
}
