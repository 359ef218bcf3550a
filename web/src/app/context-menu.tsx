// The menu at the pointer: actions for a road user, for several, for a goal, for the ground.
import { useLayoutEffect, useRef } from 'preact/hooks';
import { useSignal } from '@preact/signals';
import { PLACED_KINDS } from '../model/base/kinds';
import type { MenuOn } from '../edit/gestures/chart';
import type { ContextMenu as Open } from '../actions/ui';
import { useApp } from './parts/app-context';
import { ActionButton } from './parts/buttons';
import { usePressBeside } from './parts/hooks';
import { Icon } from './parts/icons';
import { TEXTS } from '../texts/desk/context-menu';

/** Ids of actions; null is a separator, a list with a name is a submenu. */
type MenuEntry = string | null | { readonly name: string; readonly icon: string; readonly items: readonly string[] };

const KINDS: MenuEntry = { name: TEXTS.type, icon: 'pencil', items: PLACED_KINDS.map((k) => `kind-${k}`) };
const DOES = ['does-react', 'does-log', 'does-still'];
const COPIES = ['copy', 'cut', 'duplicate', 'delete'];

const MENUS: Record<MenuOn, readonly MenuEntry[]> = {
  'road-user': [
    ...COPIES,
    null,
    'lock',
    'name',
    'note',
    KINDS,
    null,
    ...DOES,
    null,
    'set-goal',
    'goal-from-log',
    'drive',
    'add-via',
    'clear-goal',
    'reset-agent',
    null,
    'select-kind',
    'select-lane',
    'find-case',
    'zoom-selection',
    'follow',
    'align-road',
  ],
  several: [
    ...COPIES,
    null,
    'lock',
    'mirror',
    'swap',
    KINDS,
    null,
    ...DOES,
    null,
    'clear-goal',
    null,
    'select-kind',
    'select-lane',
    'select-conflicts',
    'find-case',
    'zoom-selection',
  ],
  future: ['future-choose', 'future-play', 'future-compare', 'future-pin', null, 'add-via', 'future-best', 'set-goal'],
  goal: ['clear-goal', 'toggle-goal-speed', null, 'remove-via', null, 'zoom-selection', 'reset-agent'],
  ground: [
    'paste',
    null,
    'tool-place-car',
    'tool-place-cyclist',
    'tool-place-pedestrian',
    'tool-fill',
    null,
    'select-all',
    'fit',
    'align-road',
    'north-up',
  ],
};

const ABOUT: Record<MenuOn, string> = {
  'road-user': TEXTS.actionsForThis,
  several: TEXTS.actionsForThese,
  future: TEXTS.actionsForThisFuture,
  goal: TEXTS.actionsForThisGoal,
  ground: TEXTS.actionsForThisPlace,
};

const EDGE_PX = 6;

export function ContextMenu() {
  const { ui, editor } = useApp();
  const menu = ui.contextMenu.value;
  // A change of the scene under the menu closes it.
  void editor.scene.value?.id;
  return menu ? <Box key={`${menu.x},${menu.y},${menu.on}`} menu={menu} /> : null;
}

function Box({ menu }: { menu: Open }) {
  const { stage, ui } = useApp();
  const box = useRef<HTMLDivElement>(null);
  const before = useRef(document.activeElement);
  const picture = stage.element.getBoundingClientRect();
  const [x, y] = [menu.x + picture.left, menu.y + picture.top];
  const at = useSignal<{ left: string; top: string }>({ left: `${x}px`, top: `${y}px` });
  const items = (): HTMLElement[] => [
    ...box.current!.querySelectorAll<HTMLElement>(':scope > button, :scope > .more > button'),
  ];

  useLayoutEffect(() => {
    const el = box.current!;
    // Beside the pointer where there is room, else on its other side; never outside the window.
    const left = x + el.offsetWidth + EDGE_PX > innerWidth ? Math.max(EDGE_PX, x - el.offsetWidth) : x + 2;
    const lowest = innerHeight - el.offsetHeight - EDGE_PX;
    at.value = { left: `${left}px`, top: `${Math.max(EDGE_PX, Math.min(y, lowest))}px` };
    items()[0]?.focus({ preventScroll: true });
  }, []);
  usePressBeside(box, () => ui.closeContextMenu());

  const close = () => {
    ui.closeContextMenu();
    if (before.current instanceof HTMLElement && before.current !== document.body) before.current.focus();
  };
  const key = (e: KeyboardEvent) => {
    const sub = (e.target as HTMLElement).closest('.submenu');
    const all = sub ? [...sub.querySelectorAll<HTMLElement>('button')] : items();
    const i = all.indexOf(document.activeElement as HTMLElement);
    const go = (n: number) => all[(n + all.length) % all.length]?.focus();
    if (e.key === 'ArrowDown') go(i + 1);
    else if (e.key === 'ArrowUp') go(i - 1);
    else if (e.key === 'Home') go(0);
    else if (e.key === 'End') go(-1);
    else if (e.key === 'ArrowRight') openSub(e.target as HTMLElement);
    else if (e.key === 'ArrowLeft' && sub) (sub.parentElement!.querySelector('button') as HTMLElement).focus();
    else if (e.key === 'Escape' || e.key === 'Tab') close();
    else if (/^[a-z]$/i.test(e.key) && !e.ctrlKey && !e.metaKey) {
      const starts = (el: HTMLElement) => el.textContent!.trim().toLowerCase().startsWith(e.key.toLowerCase());
      const next = [...all.slice(i + 1), ...all.slice(0, i + 1)].find(starts);
      next?.focus();
    } else return;
    e.preventDefault();
    e.stopPropagation();
  };
  return (
    <div
      ref={box}
      class="menu ctx"
      role="menu"
      aria-label={ABOUT[menu.on]}
      style={at.value}
      onClick={(e) => {
        if ((e.target as Element).closest('[data-action]')) ui.closeContextMenu();
      }}
      onContextMenu={(e) => e.preventDefault()}
      onKeyDown={key}
    >
      {MENUS[menu.on].map((entry, i) =>
        entry === null ? (
          <hr key={i} />
        ) : typeof entry === 'string' ? (
          <ActionButton key={entry} id={entry} size={16} withKey />
        ) : (
          <Sub key={entry.name} {...entry} />
        ),
      )}
    </div>
  );
}

function openSub(button: HTMLElement): void {
  const sub = button.parentElement?.querySelector<HTMLElement>('.submenu button');
  if (!sub) return;
  button.parentElement!.dataset.open = '';
  sub.focus({ preventScroll: true });
}

/** Opens on hover, click and right arrow, and stays while it has the focus. */
function Sub({ name, icon, items }: Exclude<MenuEntry, string | null>) {
  return (
    <div
      class="more"
      onFocusOut={(e) => {
        if (!e.currentTarget.contains(e.relatedTarget as Node | null)) delete e.currentTarget.dataset.open;
      }}
    >
      <button type="button" class="btn" aria-haspopup="menu" onClick={(e) => openSub(e.currentTarget)}>
        <Icon name={icon} size={16} />
        {name}
        <span class="arrow" aria-hidden="true">
          ›
        </span>
      </button>
      <div class="menu submenu" role="menu" aria-label={name}>
        {items.map((id) => (
          <ActionButton key={id} id={id} size={16} />
        ))}
      </div>
    </div>
  );
}
