// List of scenes with search and pictures; the place to drop files.
import { signal } from '@preact/signals-core';
import type { Context } from '../actions/context';
import type { SceneListItem } from '../net/types';
import { isRecorded } from '../model/scene';
import { iconButton } from './buttons';
import { h, swap } from './dom';
import { icon } from './icons';
import { thumbnail } from './thumbs';

export function drawer(c: Context): HTMLElement {
  const { scenes } = c;
  const query = signal('');
  const search = h('input', {
    type: 'search',
    placeholder: 'Find a scene',
    'aria-label': 'Find a scene',
    oninput: () => {
      query.value = search.value;
    },
    onkeydown: (e: KeyboardEvent) => {
      if (e.key === 'Escape') {
        search.blur();
      }
    },
  });
  const shown = () => {
    const q = query.value.trim().toLowerCase();
    return scenes.list.value.filter((s) => !q || `${s.name} ${s.source ?? ''} ${s.id}`.toLowerCase().includes(q));
  };
  return h(
    'section',
    { class: 'drawer card', 'aria-label': 'Scenes', 'data-group': 'scenes' },
    h('h2', null, 'Scenes', h('span', { class: 'grow' }), iconButton(c, 'scenes', { icon: 'x', size: 16, class: '' })),
    h('label', { class: 'field search' }, icon('search', 14), search),
    h(
      'div',
      { class: 'scns' },
      swap(shownKey(shown), () => list(c, shown())),
    ),
    dropBox(c),
  );
}

const shownKey = (shown: () => SceneListItem[]) => (): string =>
  shown()
    .map((s) => `${s.id}:${s.etag ?? ''}:${s.name}`)
    .join('|');

function list(c: Context, items: SceneListItem[]): HTMLElement {
  if (!items.length)
    return h('p', { class: 'mut drop' }, () => (c.scenes.listed.value ? 'No scene of that name.' : 'Loading …'));
  return h(
    'div',
    null,
    items.map((s) =>
      h(
        'button',
        {
          type: 'button',
          class: 'scn',
          'data-scene': s.id,
          'aria-current': () => String(c.editor.scene.value?.id === s.id),
          onclick: () => void c.library.open(s.id),
        },
        thumbnail(c, s, 64, 46),
        h(
          'div',
          { class: 'who' },
          h('b', { title: s.name }, () => (c.editor.scene.value?.id === s.id ? c.editor.scene.value.name : s.name)),
          h('small', null, about(s)),
        ),
      ),
    ),
  );
}

export function countAll(s: SceneListItem): number {
  return Object.values(s.counts ?? {}).reduce((a: number, b) => a + (b ?? 0), 0);
}

export function about(s: SceneListItem): string {
  const n = countAll(s);
  const kind = s.source && isRecorded(s.source) ? 'recorded' : s.readonly ? 'example' : 'own';
  return [n ? `${n} road users` : '', kind].filter(Boolean).join(' · ');
}

export function dropBox(c: Context): HTMLElement {
  return h(
    'div',
    { class: 'drop' },
    h('b', null, 'Drop scene files here'),
    'or ',
    h('button', { type: 'button', 'data-action': 'choose-files', onclick: () => c.chooseFiles() }, 'choose files'),
  );
}
