// The menus of buttons: lists of actions, and the options of Generate.
import { useRef } from 'preact/hooks';
import { PLACED_KINDS } from '../model/base/kinds';
import { LAYER_NAMES } from '../edit/session/view-settings';
import { useApp } from './parts/app-context';
import { GenerateOptions } from './parts/asking';
import { ActionButton } from './parts/buttons';
import { usePressBeside } from './parts/hooks';
import { MenuList } from './parts/menu-list';
import { TEXTS } from '../texts/desk/page';

const LAYER_ACTIONS = LAYER_NAMES.map((l) => `layer-${l}`);
/** Kinds of road users in the menu that adds them. */
const ADDED = PLACED_KINDS.map((kind) => `tool-place-${kind}`);

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
  layers: [...LAYER_ACTIONS, null, 'zoom-in', 'zoom-out', 'align-road', 'north-up'],
  add: [...ADDED, null, 'tool-fill', 'tool-lasso', 'tool-measure'],
  playback: ['slower-playback', 'faster-playback', 'loop', null, 'to-start', 'to-end', null, 'what-counts'],
  others: ['others-react', 'others-log', 'others-still'],
};

/** Below its button, or above it in the lower half of the page; the menu of a column is beside it. */
function placeUnder(name: string): Record<string, string> {
  const button = document.querySelector(`[data-menu="${name}"]`)?.getBoundingClientRect();
  const left = button?.left ?? 48;
  if (name === 'add' && button) return { top: `${button.top}px`, left: `${button.right + 8}px` };
  if (button && button.top > innerHeight / 2) {
    const bottom = `${innerHeight - button.top + 2}px`;
    return left > innerWidth / 2 ? { bottom, right: `${innerWidth - button.right}px` } : { bottom, left: `${left}px` };
  }
  const top = `${(button?.bottom ?? 44) + 2}px`;
  // A button in the right half has its menu to the left of its right edge.
  if (left > innerWidth / 2) return { top, right: `${innerWidth - button!.right}px` };
  return { top, left: `${left}px` };
}

/** Menus with several settings, which stay open. */
const STAY = ['layers', 'playback'];

/** The open one, if it is one of these. */
export default function OpenedMenu() {
  const { form, ui } = useApp();
  const name = ui.menu.value;
  if (name === 'generate') return <Options />;
  // The phone's menu of road users belongs to its button.
  if (name === 'add' && form.small.value) return null;
  return name !== null && name in MENUS ? <Menu key={name} name={name} /> : null;
}

/** Fields, not actions: it stays open until a press beside it or Esc. */
function Options() {
  const { ui } = useApp();
  const box = useRef<HTMLDivElement>(null);
  usePressBeside(box, () => ui.closeMenu(), 'menu');
  return (
    <div ref={box} class="menu" role="dialog" aria-label={TEXTS.generateOptions} style={placeUnder('generate')}>
      <GenerateOptions />
    </div>
  );
}

function Menu({ name }: { name: string }) {
  return (
    <MenuList style={placeUnder(name)} stays={STAY.includes(name)}>
      {MENUS[name].map((id, i) => (id === null ? <hr key={i} /> : <ActionButton key={id} id={id} withKey />))}
    </MenuList>
  );
}
