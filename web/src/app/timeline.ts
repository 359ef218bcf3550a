// Transport controls, what the others do, and the speed plot.
import type { Context } from '../actions/context';
import { num } from '../model/units';
import { iconButton, segments } from './buttons';
import { h } from './dom';
import { icon } from './icons';
import { plot } from './plot';
import { OTHERS } from './scenepanel';
import { LENGTHS, REPLANS } from '../model/scene';

export function timeline(c: Context): HTMLElement {
  const { editor } = c;
  return h(
    'footer',
    { class: 'time', 'aria-label': 'Timeline', 'data-group': 'timeline' },
    h(
      'div',
      { class: 'tb' },
      iconButton(c, 'to-start'),
      playButton(c),
      iconButton(c, 'to-end'),
      h(
        'span',
        { class: 'tm' },
        () => `${num(editor.time.value, 1)} s `,
        h('small', null, () => `/ ${num(editor.scene.value?.duration ?? 9, 1)} s`),
      ),
      h(
        'button',
        {
          type: 'button',
          class: 'btn rate',
          title: 'Playback speed (Shift < >)',
          'aria-label': () => `Playback speed ${editor.playhead.rate.value} times`,
          onclick: (e: MouseEvent) => cycle(c, e.shiftKey ? -1 : 1),
        },
        () => `${editor.playhead.rate.value}×`,
      ),
      iconButton(c, 'loop'),
      iconButton(c, 'next-event'),
      h('span', { class: 'grow' }),
      h('span', { class: 'fieldlab' }, 'Length'),
      segments(c, 'How much is worked out', withUnit('length', LENGTHS)),
      h('span', { class: 'fieldlab' }, 'Plan anew'),
      segments(c, 'How often everybody plans anew', withUnit('replan', REPLANS)),
      h('span', { class: 'fieldlab' }, 'Others'),
      segments(c, 'What the others do', OTHERS),
    ),
    plot(c),
  );
}

/** Seconds side by side; the unit stands once, at the end. */
const withUnit = (action: string, all: readonly number[]): (readonly [string, string])[] =>
  all.map((s, i) => [`${action}-${s}`, i === all.length - 1 ? `${s} s` : `${s}`]);

/** One button with two pictures: were it built anew, the focus would be lost at every press. */
function playButton(c: Context): HTMLElement {
  const button = iconButton(c, 'play', { class: 'playing' });
  button.append(icon('pause', 18));
  return button;
}

function cycle(c: Context, d: 1 | -1): void {
  c.editor.playhead.changeRate(d, true);
}
