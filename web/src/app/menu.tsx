// The menus of buttons: lists of actions.
import { useComputed } from '@preact/signals';
import { LAYER_NAMES } from '../edit/session/view-settings';
import { useApp } from './parts/app-context';
import { ActionButton } from './parts/buttons';
import { Icon } from './parts/icons';
import { MenuList } from './parts/menu-list';

const LAYER_ACTIONS = LAYER_NAMES.map((l) => `layer-${l}`);

/** Ids of actions; null is a separator. */
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
    'language',
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
    ...LAYER_ACTIONS,
    'fit',
    'align-road',
    'north-up',
    null,
    'palette',
    'theme',
  ],
  layers: [...LAYER_ACTIONS, null, 'align-road', 'north-up'],
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

/** Menus with several settings, which stay open. */
const STAY = ['layers'];

/** The open one, if it is one of these. */
export function OpenMenu() {
  const name = useApp().ui.menu.value;
  return name !== null && name in MENUS ? <Menu key={name} name={name} /> : null;
}

function Menu({ name }: { name: string }) {
  return (
    <MenuList style={placeUnder(name)} stays={STAY.includes(name)}>
      {MENUS[name].map((id, i) => (id === null ? <hr key={i} /> : <ActionButton key={id} id={id} withKey />))}
    </MenuList>
  );
}
