// Top bar: scene name and saving, undo, seed, diversity, generate, export, help.
import type { Context } from '../actions/context';
import { rename, setDiversity, setSeed } from '../model/commands';
import { DEFAULTS } from '../model/domain';
import { isRecorded } from '../model/scene';
import { actionButton, iconButton } from './buttons';
import { h, svg, swap } from './dom';
import { icon } from './icons';
import type { SaveState } from '../edit/saving';

const SAVED: Record<SaveState, string> = {
  example: 'Example',
  saved: 'Saved',
  saving: 'Saving …',
  local: 'Saved on this computer',
  conflict: 'Changed elsewhere',
  full: 'No room to save',
};

export function topBar(c: Context): HTMLElement {
  const { editor, saving, ui } = c;
  return h(
    'header',
    { class: 'top', 'data-group': 'top' },
    h(
      'div',
      { class: 'logo', 'aria-hidden': 'true' },
      svg(
        'svg',
        { viewBox: '0 0 18 18', width: 18, height: 18 },
        svg('path', { d: 'M4 15C4 9 5 7 13 5M13 5l-3-2.200M13 5l-2 3.200' }),
        svg('circle', { cx: 4, cy: 15, r: 1.3, fill: 'currentColor' }),
      ),
    ),
    menuButton(c, 'file', 'menu', 'File and settings'),
    iconButton(c, 'scenes'),
    h(
      'div',
      { class: 'title' },
      swap(
        () => editor.scene.value?.id,
        () => nameField(c),
      ),
      h('small', null, () =>
        editor.drag.value
          ? 'Dragging'
          : editor.scene.value
            ? isRecorded(editor.scene.value.source) && saving.state.value === 'example'
              ? 'Recorded scene'
              : SAVED[saving.state.value]
            : '',
      ),
    ),
    swap(
      () => editor.scene.value !== null,
      () =>
        editor.scene.peek()
          ? h('div', { class: 'swap' }, h('div', { class: 'sep' }), iconButton(c, 'undo'), iconButton(c, 'redo'))
          : null,
    ),
    h('div', { class: 'grow' }),
    swap(
      () => editor.scene.value !== null,
      () => (editor.scene.peek() ? controls(c) : null),
    ),
    h('div', { class: 'grow' }),
    swap(
      () => editor.scene.value !== null,
      () =>
        editor.scene.peek()
          ? h(
              'div',
              { class: 'swap' },
              actionButton(c, 'palette', { key: true, size: 16, label: h('span', { class: 'mut' }, 'Actions') }),
              exportButton(c),
            )
          : null,
    ),
    iconButton(c, 'theme'),
    iconButton(c, 'shortcuts'),
    swap(
      () => ui.menu.value,
      () => (ui.menu.peek() ? menu(c, ui.menu.peek()!) : null),
    ),
  );
}

function nameField(c: Context): HTMLElement {
  const { editor } = c;
  if (!editor.scene.peek()) return h('span', null, 'DragTraffic');
  const input = h('input', {
    type: 'text',
    'aria-label': 'Name of the scene',
    maxlength: '80',
    spellcheck: 'false',
    value: () => editor.scene.value?.name ?? '',
    onchange: () => {
      const v = input.value.trim();
      if (v && v !== editor.scene.peek()?.name) editor.run(rename(v));
    },
    onkeydown: (e: KeyboardEvent) => {
      if (e.key === 'Enter') input.blur();
      if (e.key === 'Escape') {
        input.value = editor.scene.peek()?.name ?? '';
        input.blur();
        e.stopPropagation();
      }
    },
  });
  return input;
}

function controls(c: Context): HTMLElement {
  const { editor } = c;
  const percent = () => Math.round((editor.scene.value?.diversity ?? DEFAULTS.diversity) * 100);
  const seed = h('input', {
    type: 'text',
    inputmode: 'numeric',
    'aria-label': 'Seed',
    maxlength: '16',
    value: () => String(editor.scene.value?.seed ?? 0),
    onchange: () => {
      const v = Number(seed.value.replace(/\D/g, ''));
      if (Number.isSafeInteger(v) && v !== editor.scene.peek()?.seed) editor.run(setSeed(v));
      seed.value = String(editor.scene.peek()?.seed ?? 0);
    },
    onkeydown: (e: KeyboardEvent) => {
      if (e.key === 'Enter') seed.blur();
    },
  });
  const slider = h('input', {
    type: 'range',
    min: '0',
    max: '200',
    step: '10',
    'aria-label': 'Diversity',
    title: 'How far the six may differ',
    value: () => String(percent()),
    css: { '--fill': () => `${percent() / 2}%` },
    oninput: () => {
      const v = Number(slider.value) / 100;
      if (v !== editor.scene.peek()?.diversity) editor.run(setDiversity(v));
    },
  });
  return h(
    'div',
    { class: 'swap' },
    h('span', { class: 'fieldlab' }, 'Seed'),
    h('label', { class: 'field seed' }, seed),
    iconButton(c, 'new-seed'),
    h('span', { class: 'gap' }),
    h('span', { class: 'fieldlab' }, 'Diversity'),
    slider,
    h('span', { class: 'pct' }, () => `${percent()}%`),
    swap(
      () => editor.away.value !== null,
      () =>
        actionButton(c, 'generate', {
          class: 'pri',
          icon: '',
          key: true,
          label: editor.away.peek() ? 'Waiting …' : 'Generate',
        }),
    ),
  );
}

function menuButton(c: Context, name: string, ic: string, label: string): HTMLElement {
  return h(
    'button',
    {
      type: 'button',
      class: () => `btn i ${c.ui.menu.value === name ? 'on' : ''}`,
      'data-menu': name,
      'aria-label': label,
      title: label,
      'aria-haspopup': 'menu',
      'aria-expanded': () => String(c.ui.menu.value === name),
      onclick: () => {
        if (c.ui.menu.peek() === name) c.ui.closeMenu();
        else c.ui.openMenu(name);
      },
    },
    icon(ic),
  );
}

function exportButton(c: Context): HTMLElement {
  return h(
    'button',
    {
      type: 'button',
      class: 'btn line',
      'data-menu': 'export',
      'aria-haspopup': 'menu',
      'aria-expanded': () => String(c.ui.menu.value === 'export'),
      onclick: () => {
        if (c.ui.menu.peek() === 'export') c.ui.closeMenu();
        else c.ui.openMenu('export');
      },
    },
    icon('export'),
    'Export',
  );
}

const MENUS: Record<string, readonly (string | null)[]> = {
  file: [
    'choose-files',
    'save-copy',
    'export-json',
    'export-womd',
    null,
    'reset-all',
    'delete-scene',
    null,
    'theme',
    'unit',
    'shortcuts',
    'coach',
  ],
  export: ['export-json', 'export-womd'],
};

export const MENU_ACTIONS: readonly string[] = Object.values(MENUS)
  .flat()
  .filter((id): id is string => id !== null);

function menu(c: Context, name: string): HTMLElement {
  const { ui } = c;
  const from = document.querySelector<HTMLElement>(`[data-menu="${name}"]`)?.getBoundingClientRect();
  const right = name === 'export';
  const el = h(
    'div',
    {
      class: 'menu',
      role: 'menu',
      css: {
        top: '44px',
        ...(right
          ? { right: `${Math.max(8, innerWidth - (from?.right ?? innerWidth))}px` }
          : { left: `${from?.left ?? 48}px` }),
      },
    },
    MENUS[name].map((id) => (id === null ? h('hr') : actionButton(c, id, { key: true }))),
  );
  el.addEventListener('click', () => {
    ui.closeMenu();
  });
  el.addEventListener('keydown', (e) => {
    const items = [...el.querySelectorAll<HTMLElement>('button')];
    const i = items.indexOf(document.activeElement as HTMLElement);
    if (e.key === 'ArrowDown' || e.key === 'ArrowUp') {
      e.preventDefault();
      items[(i + (e.key === 'ArrowDown' ? 1 : -1) + items.length) % items.length]?.focus();
    }
  });
  const away = (e: Event) => {
    if (!el.contains(e.target as Node) && !(e.target as Element).closest?.('[data-menu]')) ui.closeMenu();
    if (ui.menu.peek() !== name) removeEventListener('pointerdown', away, true);
  };
  addEventListener('pointerdown', away, true);
  queueMicrotask(() => el.querySelector<HTMLElement>('button')?.focus({ preventScroll: true }));
  return el;
}
