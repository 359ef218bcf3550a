// The first screen when there is no scene to open.
import type { Context } from '../actions/context';
import { about } from './drawer';
import { h, swap } from './dom';
import { thumbnail } from './thumbs';

export function emptyState(c: Context): Node {
  const { editor, library, scenes } = c;
  return swap(
    () => (editor.scene.value === null && scenes.listed.value ? scenes.list.value : null),
    () => {
      if (editor.scene.peek() || !scenes.listed.peek()) return null;
      const cards = scenes.list.peek().slice(0, 3);
      return h(
        'div',
        { class: 'empty' },
        h(
          'div',
          { class: 'in' },
          h('h1', null, cards.length ? 'Start with a crossing' : 'Bring a scene'),
          h(
            'p',
            null,
            cards.length
              ? 'Open an example and drag a car. Or bring your own scene.'
              : editor.away.peek()
                ? 'The server is not answering. Scenes appear here when it does.'
                : 'There are no examples here. Drop a scenario record or a saved scene.',
          ),
          cards.length
            ? h(
                'div',
                { class: 'cards' },
                cards.map((s) =>
                  h(
                    'button',
                    { type: 'button', class: 'crd', onclick: () => void library.open(s.id) },
                    thumbnail(c, s, 220, 132),
                    h('div', null, h('b', null, s.name), h('small', null, about(s))),
                  ),
                ),
              )
            : null,
          h(
            'div',
            { class: 'drop' },
            h('b', null, 'Drop scene files anywhere'),
            'Scenario records, lane maps or saved scenes · or ',
            h(
              'button',
              { type: 'button', 'data-action': 'choose-files', onclick: () => c.chooseFiles() },
              'choose files',
            ),
          ),
        ),
      );
    },
  );
}
