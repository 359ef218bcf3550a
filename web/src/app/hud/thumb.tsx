// On a small page what the rail has stands behind a + at the thumb.
import { useComputed } from '@preact/signals';
import { TOOLS } from '../../edit/gestures/tools';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { MenuList } from '../parts/menu-list';
import { TEXTS } from '../../texts/desk/hud';

/** In the menu of the +: what is placed most, then the other tools; these two are the hand itself. */
const FIRST = ['place-car', 'place-cyclist', 'place-pedestrian'];
const NOT_LISTED = ['select', 'pan'];
const REST = TOOLS.map((t): string => t.name).filter((name) => ![...FIRST, ...NOT_LISTED].includes(name));
const MENU = 'add';

/** The + while nothing is placed; else what ends that. */
export function Thumb() {
  const { editor, ui } = useApp();
  const busy = useComputed(() => editor.tool.value !== 'select').value;
  const open = useComputed(() => ui.menu.value === MENU).value;
  if (busy)
    return (
      <button type="button" class="thumb done" onClick={() => editor.chooseTool('select')}>
        <Icon name="check" size={20} />
        {TEXTS.done}
      </button>
    );
  return (
    <>
      <button
        type="button"
        class="thumb"
        data-menu={MENU}
        aria-label={TEXTS.add}
        aria-haspopup="menu"
        aria-expanded={open}
        onClick={() => (open ? ui.closeMenu() : ui.openMenu(MENU))}
      >
        <Icon name="plus" size={24} />
      </button>
      {open ? <AddMenu /> : null}
    </>
  );
}

function AddMenu() {
  return (
    <MenuList label={TEXTS.add} class="adding">
      {FIRST.map((name) => (
        <ActionButton key={name} id={`tool-${name}`} size={20} />
      ))}
      <hr />
      {REST.map((name) => (
        <ActionButton key={name} id={`tool-${name}`} size={20} />
      ))}
    </MenuList>
  );
}
