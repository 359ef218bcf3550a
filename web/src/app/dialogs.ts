// Palette, shortcut sheet, import report.
import { signal } from '@preact/signals-core';
import type { Context } from '../actions/context';
import { ACTIONS, perform, possible } from '../actions/registry';
import type { Action, Group } from '../actions/action';
import type { FileVerdict as Verdict } from '../edit/importing';
import { keyCaps } from './buttons';
import { h, swap, type Child } from './dom';
import { icon } from './icons';

export function dialogs(c: Context): Node {
  return h(
    'div',
    { class: 'swap' },
    swap(
      () => c.ui.dialog.value,
      () => (c.ui.dialog.peek() === 'palette' ? palette(c) : c.ui.dialog.peek() === 'shortcuts' ? shortcuts(c) : null),
    ),
    swap(
      () => c.ui.deleting.value,
      () => (c.ui.deleting.peek() ? confirmDelete(c, c.ui.deleting.peek()!) : null),
    ),
    swap(
      () => c.importing.verdicts.value,
      () => (c.importing.verdicts.peek() ? importReport(c, c.importing.verdicts.peek()!) : null),
    ),
  );
}

/** A dialog keeps the focus inside and gives it back. */
function modal(label: string, className: string, close: () => void, ...children: Child[]): HTMLElement {
  const back = document.activeElement as HTMLElement | null;
  const box = h(
    'div',
    { class: `dlg ${className}`, role: 'dialog', 'aria-modal': 'true', 'aria-label': label },
    ...children,
  );
  const scrim = h(
    'div',
    {
      class: 'scrim',
      onpointerdown: (e: Event) => {
        if (e.target === scrim) close();
      },
    },
    box,
  );
  const inside = () =>
    [...box.querySelectorAll<HTMLElement>('button, input, [tabindex="0"]')].filter((e) => e.offsetParent);
  scrim.addEventListener('keydown', (e) => {
    if (e.key === 'Escape') {
      e.stopPropagation();
      close();
      back?.focus?.();
    }
    if (e.key !== 'Tab') return;
    const items = inside(),
      i = items.indexOf(document.activeElement as HTMLElement);
    e.preventDefault();
    e.stopPropagation();
    items[(i + (e.shiftKey ? -1 : 1) + items.length) % items.length]?.focus();
  });
  queueMicrotask(() => (box.querySelector<HTMLElement>('[data-first]') ?? inside()[0])?.focus());
  return scrim;
}

// ---------------------------------------------------------------- palette

interface Entry {
  label: string;
  note: string;
  group: string;
  icon: string;
  keys: readonly string[];
  off: boolean;
  run: () => void;
}

function palette(c: Context): HTMLElement {
  const query = signal(''),
    at = signal(0);
  const close = () => {
    c.ui.closeDialog();
  };
  const entries = (): Entry[] => find(c, query.value);
  const go = (e: Entry | undefined) => {
    if (!e || e.off) return;
    close();
    e.run();
  };
  const input = h('input', {
    type: 'text',
    placeholder: 'Do anything',
    'aria-label': 'Find an action',
    'data-first': '',
    spellcheck: 'false',
    role: 'combobox',
    'aria-expanded': 'true',
    oninput: () => {
      query.value = input.value;
      at.value = 0;
    },
    onkeydown: (e: KeyboardEvent) => {
      const n = entries().length;
      if (e.key === 'ArrowDown' || e.key === 'ArrowUp') {
        e.preventDefault();
        at.value = (at.value + (e.key === 'ArrowDown' ? 1 : -1) + n) % Math.max(1, n);
        document.querySelector(`[data-at="${at.value}"]`)?.scrollIntoView({ block: 'nearest' });
      }
      if (e.key === 'Enter') {
        e.preventDefault();
        go(entries()[at.value]);
      }
    },
  });
  const results = swap(
    () => query.value,
    () => {
      const list = entries();
      let group = '';
      return h(
        'div',
        { role: 'listbox', 'aria-label': 'Actions' },
        list.length
          ? list.flatMap((e, i) => {
              const head = e.group !== group ? h('div', { class: 'g' }, (group = e.group)) : null;
              return [
                head,
                h(
                  'button',
                  {
                    type: 'button',
                    class: `it ${e.off ? 'off' : ''}`,
                    role: 'option',
                    tabindex: '-1',
                    'data-at': String(i),
                    'aria-selected': () => String(at.value === i),
                    onclick: () => go(e),
                    onpointermove: () => {
                      at.value = i;
                    },
                  },
                  icon(e.icon),
                  h('span', { class: 'lb' }, marked(e.label, query.peek())),
                  h('small', null, e.note),
                  h('span', { class: 'k' }, e.keys[0] ? keyCaps(e.keys[0]) : null),
                ),
              ];
            })
          : h('div', { class: 'g' }, 'Nothing of that name'),
      );
    },
  );
  return modal(
    'Actions',
    'pal',
    close,
    h('div', { class: 'in' }, icon('search'), input, h('kbd', null, 'Esc')),
    h('div', { class: 'list' }, results),
    h(
      'div',
      { class: 'ft' },
      h('span', null, h('kbd', null, '↑'), h('kbd', null, '↓'), 'choose'),
      h('span', null, h('kbd', null, '↵'), 'do it'),
      h('span', null, 'Type a number to find a road user, a time like 4.2 to jump to it'),
    ),
  );
}

function marked(text: string, query: string): Child {
  const i = query ? text.toLowerCase().indexOf(query.toLowerCase()) : -1;
  return i < 0
    ? text
    : [text.slice(0, i), h('mark', null, text.slice(i, i + query.length)), text.slice(i + query.length)];
}

function find(c: Context, raw: string): Entry[] {
  const q = raw.trim().toLowerCase();
  const out: Entry[] = [];
  const agent = c.editor.agent.peek();
  const forAgent: Group[] = ['Goal and futures', 'Move'];
  for (const a of ACTIONS) {
    if (a.id === 'palette' || (!q && a.group === 'Move')) continue;
    if (q && !(a.group === 'Move' ? a.label : `${a.label} ${a.help}`).toLowerCase().includes(q)) continue;
    const can = possible(c, a);
    out.push({
      label: a.label,
      note: can === true ? a.help : can,
      group: agent && forAgent.includes(a.group) ? `For ${agent.name}` : a.group,
      icon: a.icon ?? 'key',
      keys: a.keys ?? [],
      off: can !== true,
      run: () => perform(c, a.id),
    });
  }
  const rank = (e: Entry): number => (q && e.label.toLowerCase().includes(q) ? 0 : 1);
  out.sort(
    (x, y) =>
      Number(x.off) - Number(y.off) ||
      Number(!x.group.startsWith('For')) - Number(!y.group.startsWith('For')) ||
      x.group.localeCompare(y.group) ||
      rank(x) - rank(y),
  );
  if (q) out.push(...roadUsers(c, q), ...scenes(c, q), ...jump(c, q));
  return out.slice(0, 60);
}

const roadUsers = (c: Context, q: string): Entry[] =>
  [...(c.editor.scene.peek()?.agents.values() ?? [])]
    .filter((a) => a.name.toLowerCase().includes(q) || a.id === q)
    .slice(0, 8)
    .map((a) => ({
      label: a.name,
      note: a.parked ? 'parked' : a.type,
      group: 'Road users',
      icon: a.kind,
      keys: [],
      off: false,
      run: () => {
        c.editor.select(a.id);
        const p = a.logStart;
        if (p) {
          c.stage.view.centre(p.x, p.y);
          c.stage.viewChanged();
        }
      },
    }));
const scenes = (c: Context, q: string): Entry[] =>
  c.scenes.list
    .peek()
    .filter((s) => s.name.toLowerCase().includes(q))
    .slice(0, 6)
    .map((s) => ({
      label: s.name,
      note: 'open',
      group: 'Scenes',
      icon: 'list',
      keys: [],
      off: false,
      run: () => void c.library.open(s.id),
    }));
const jump = (c: Context, q: string): Entry[] =>
  /^\d(\.\d)?$/.test(q)
    ? [
        {
          label: `Go to ${q} s`,
          note: 'playhead',
          group: 'Time',
          icon: 'clock',
          keys: [],
          off: false,
          run: () => {
            c.editor.playhead.pause();
            c.editor.setTime(Number(q));
          },
        },
      ]
    : [];

// ---------------------------------------------------------------- shortcuts

const POINTER_LINES: readonly (readonly [Group, string, readonly string[], string])[] = [
  ['Select and look', 'Pan', ['Space'], 'drag'],
  ['Select and look', 'Zoom', [], 'wheel'],
  ['Move', 'No snapping', ['Alt'], 'drag'],
  ['Move', 'Along the lane only', ['Shift'], 'drag'],
  ['Move', 'Start and goal together', ['Ctrl'], 'drag'],
];

function shortcuts(c: Context): HTMLElement {
  const query = signal('');
  const close = () => {
    c.ui.closeDialog();
  };
  const input = h('input', {
    type: 'search',
    placeholder: 'Find a shortcut',
    'aria-label': 'Find a shortcut',
    'data-first': '',
    oninput: () => {
      query.value = input.value.trim().toLowerCase();
    },
  });
  const groups: Group[] = ['Select and look', 'Move', 'Goal and futures', 'Time', 'Scene', 'Everything'];
  return modal(
    'Shortcuts',
    'keys',
    close,
    h(
      'header',
      null,
      h('h2', null, 'Shortcuts'),
      h('span', { class: 'grow' }),
      h('label', { class: 'field search' }, icon('search', 14), input),
      h('button', { type: 'button', class: 'btn i', 'aria-label': 'Close', onclick: close }, icon('x', 16)),
    ),
    swap(
      () => query.value,
      () =>
        h(
          'div',
          { class: 'cols' },
          groups.map((g) => sheetGroup(g, query.peek())),
        ),
    ),
  );
}

function sheetGroup(group: Group, q: string): HTMLElement | null {
  const line = (label: string, keys: Child): HTMLElement =>
    h('div', { class: 'kr' }, h('span', null, label), h('span', null, keys));
  const fits = (label: string) => !q || label.toLowerCase().includes(q);
  const rows = [
    ...merged(ACTIONS.filter((a) => a.group === group && a.keys?.length))
      .filter(([l]) => fits(l))
      .map(([l, keys]) =>
        line(
          l,
          keys.map((k) => keyCaps(k)),
        ),
      ),
    ...POINTER_LINES.filter(([g, l]) => g === group && fits(l)).map(([, l, keys, how]) =>
      line(l, [keys.map((k) => keyCaps(k)), how]),
    ),
  ];
  return rows.length ? h('section', null, h('h3', null, group), rows) : null;
}

/** Families of keys on one line, as people think of them. */
function merged(actions: readonly Action[]): [string, string[]][] {
  const families: [RegExp, string, string[]][] = [
    [/^nudge-(left|right|up|down)$/, 'Nudge 0.1 m', ['Left', 'Up', 'Down', 'Right']],
    [/^nudge-far-/, 'Nudge 1 m', ['Shift+Left', 'Up', 'Down', 'Right']],
    [/^future-[a-f]$/, 'Choose future A to F', ['Alt+1–6']],
    [/^along-/, 'Along the lane 1 m', ['Ctrl+Up', 'Down']],
    [/^lane-(left|right)$/, 'To the next lane', ['Ctrl+Left', 'Right']],
    [/^turn-(left|right)$/, 'Turn 1°', ['[', ']']],
    [/^turn-(left|right)-far$/, 'Turn 15°', ['Shift+[', ']']],
    [/^(slower|faster)$/, 'Slower, faster', ['-', '+']],
    [/^(slower|faster)-far$/, 'Much slower, faster', ['Shift+-', '+']],
    [/^goal-(earlier|later)$/, 'Goal time 0.1 s', [';', "'"]],
    [/^goal-(earlier|later)-far$/, 'Goal time 1 s', ['Shift+;', "'"]],
    [/^step-(back|on)$/, '0.1 s back, on', [',', '.']],
    [/^to-(start|end)$/, 'To start, to end', ['Home', 'End']],
    [/^(slower|faster)-playback$/, 'Slower, faster playback', ['Shift+,', '.']],
    [/^(next|previous)-agent$/, 'Next, previous road user', ['Tab', 'Shift+Tab']],
    [/^(next|previous)-group$/, 'Next part of the page', ['F6']],
    [/^zoom-(in|out)$/, 'Zoom in, out', ['PageUp', 'PageDown']],
  ];
  const out: [string, string[]][] = [];
  for (const a of actions) {
    const f = families.find(([re]) => re.test(a.id));
    if (!f) out.push([a.label, [a.keys![0]]]);
    else if (!out.some(([l]) => l === f[1])) out.push([f[1], f[2]]);
  }
  return out;
}

// ---------------------------------------------------------------- import

function importReport(c: Context, verdicts: readonly Verdict[]): HTMLElement {
  const close = () => {
    c.importing.close();
  };
  const bad = verdicts.filter((v) => !v.ok),
    good = verdicts.length - bad.length;
  const title = !bad.length
    ? verdicts.length === 1
      ? `${verdicts[0].scenes.length} scenes imported`
      : `All ${verdicts.length} files are in`
    : good
      ? `${good} of ${verdicts.length} files are in, ${bad.length} could not be read`
      : bad.length === 1
        ? 'This file could not be read'
        : `None of the ${bad.length} files could be read`;
  const open = (id: string) => {
    close();
    void c.library.open(id);
  };
  const first = bad[0];
  return modal(
    'Import',
    'import',
    close,
    h(
      'header',
      null,
      h('span', { class: bad.length ? 't-collision' : '' }, icon(bad.length ? 'warn' : 'check', 22)),
      h('h2', null, title),
    ),
    h(
      'div',
      { class: 'body' },
      verdicts.map((v) => fileRow(v, open)),
      first ? explanation(first) : null,
    ),
    h(
      'footer',
      null,
      first?.details
        ? h(
            'button',
            { type: 'button', class: 'btn line', onclick: () => void navigator.clipboard?.writeText(first.details!) },
            'Copy details',
          )
        : null,
      h('span', { class: 'grow' }),
      h(
        'button',
        {
          type: 'button',
          class: `btn ${bad.length && !good ? 'line' : 'pri'}`,
          'data-first': bad.length && !good ? null : '',
          onclick: close,
        },
        'Close',
      ),
      bad.length
        ? h(
            'button',
            {
              type: 'button',
              class: `btn ${good ? 'line' : 'pri'}`,
              'data-action': 'choose-files',
              'data-first': good ? null : '',
              onclick: () => {
                close();
                c.chooseFiles();
              },
            },
            'Choose another file',
          )
        : null,
    ),
  );
}

function fileRow(v: Verdict, open: (id: string) => void): Child {
  const n = v.scenes.length;
  const tag = !v.ok
    ? h('span', { class: 'tag collision' }, 'Not imported')
    : h(
        'span',
        { class: 'tag ok' },
        n > 1 ? `${n} scenes` : v.scenes[0]?.count ? `Imported, ${v.scenes[0].count} road users` : 'Imported',
      );
  return [
    h('div', { class: 'filerow' }, icon('file'), v.file, tag),
    v.ok && v.wrong ? h('p', { class: 'note' }, v.wrong) : null,
    n > 1
      ? v.scenes.map((s) =>
          h(
            'div',
            { class: 'filerow' },
            h('button', { type: 'button', class: 'btn', onclick: () => open(s.id) }, s.name),
            s.count ? h('small', { class: 'mut' }, `${s.count} road users`) : null,
          ),
        )
      : null,
  ];
}

function explanation(v: Verdict): HTMLElement {
  const rows: [string, Child][] = [
    ['What is wrong', h('b', null, v.wrong ?? '')],
    ['Where', v.where ?? ''],
    ['What to do', v.todo ?? ''],
  ];
  return h(
    'dl',
    { class: 'wh' },
    rows.filter(([, t]) => t).flatMap(([k, t]) => [h('dt', null, k), h('dd', null, t)]),
  );
}

// ---------------------------------------------------------------- deletion

function confirmDelete(c: Context, id: string): HTMLElement {
  const close = () => {
    c.ui.askToDelete(null);
  };
  const name = c.scenes.list.peek().find((s) => s.id === id)?.name ?? c.editor.scene.peek()?.name ?? id;
  return modal(
    'Delete the scene',
    'import',
    close,
    h('header', null, h('span', { class: 't-collision' }, icon('trash', 22)), h('h2', null, `Delete “${name}”?`)),
    h(
      'div',
      { class: 'body' },
      h('p', { class: 'sec' }, 'The scene and its futures are removed from this server. This cannot be undone.'),
    ),
    h(
      'footer',
      null,
      h('span', { class: 'grow' }),
      h('button', { type: 'button', class: 'btn line', 'data-first': '', onclick: close }, 'Keep it'),
      h(
        'button',
        {
          type: 'button',
          class: 'btn danger line',
          onclick: () => {
            close();
            void c.library.remove(id);
          },
        },
        'Delete',
      ),
    ),
  );
}
