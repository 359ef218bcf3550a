// The inspector with nothing selected: who is here, what happens, what the map holds; and the list of events.
import type { Context } from '../actions/context';
import type { Agent, Scene } from '../model/scene';
import type { TrafficEvent } from '../model/events';
import { num, seconds } from '../model/units';
import { iconButton, segments } from './buttons';
import { h, swap } from './dom';
import { icon } from './icons';
import { actionOf } from '../actions/registry';

export const OTHERS: readonly (readonly [string, string])[] = [
  ['others-react', 'React'],
  ['others-log', 'Replay log'],
  ['others-still', 'Hold still'],
];

export function scenePanel(c: Context): HTMLElement {
  const { editor } = c;
  const scene = editor.scene.peek();
  if (!scene) return emptyPanel();
  return h(
    'div',
    { class: 'swap' },
    h(
      'div',
      { class: 'ih' },
      h('div', { class: 'ag t-ink' }, icon('layers', 20)),
      h('div', { class: 'grow' }, h('h2', null, 'Scene'), h('p', null, 'Nothing selected')),
    ),
    h(
      'section',
      { class: 'sect' },
      h('h3', null, 'In this scene', h('small', null, `${scene.agents.size} road users`)),
      counts(scene).map(([name, label, n, colour]) =>
        h(
          'div',
          { class: 'kindrow' },
          h('span', { class: `t-${colour}` }, icon(name)),
          h('span', { class: 'sec' }, label),
          h('span', { class: 'grow' }),
          h('b', null, String(n)),
        ),
      ),
    ),
    h(
      'section',
      { class: 'sect' },
      h('h3', null, 'Events', h('small', null, `next ${num(scene.duration, 0)} s`)),
      swap(
        () => editor.events.value,
        () => eventList(c, editor.events.peek().slice(0, 6)),
      ),
    ),
    h(
      'section',
      { class: 'sect' },
      h('h3', null, 'Others'),
      segments(c, 'What the others do', OTHERS),
      h('p', { class: 'note' }, () => actionOf(`others-${editor.scene.value?.others ?? 'react'}`).help + '.'),
    ),
    h(
      'section',
      { class: 'sect last lines' },
      h('h3', null, 'Map'),
      mapLines(scene).map((l) => h('p', null, l)),
    ),
  );
}

function emptyPanel(): HTMLElement {
  return h(
    'div',
    { class: 'swap' },
    h(
      'div',
      { class: 'ih' },
      h('div', { class: 'ag t-ink' }, icon('layers', 20)),
      h('div', { class: 'grow' }, h('h2', null, 'Scene'), h('p', null, 'Opens with the first scene')),
    ),
    h(
      'div',
      { class: 'sect last' },
      h(
        'p',
        { class: 'sec' },
        'Here you will see who is in the scene and, for a selected road user, its start, its goal and its six futures.',
      ),
    ),
  );
}

function counts(scene: Scene): [string, string, number, string][] {
  const n = (f: (a: Agent) => boolean): number => [...scene.agents.values()].filter(f).length;
  const rows: [string, string, number, string][] = [
    ['car', 'Cars, moving', n((a) => a.kind === 'car' && !a.parked), 'vehicle'],
    ['car', 'Cars, parked', n((a) => a.parked), 'parked'],
    ['truck', 'Trucks and buses', n((a) => (a.kind === 'truck' || a.kind === 'bus') && !a.parked), 'vehicle'],
    ['motorcycle', 'Motorcycles', n((a) => a.kind === 'motorcycle' && !a.parked), 'vehicle'],
    ['cyclist', 'Cyclists', n((a) => a.kind === 'cyclist'), 'cyclist'],
    ['pedestrian', 'Pedestrians', n((a) => a.kind === 'pedestrian'), 'pedestrian'],
    ['other', 'Other objects', n((a) => a.kind === 'other'), 'other'],
  ];
  return rows.filter((r) => r[2] > 0);
}

function mapLines(scene: Scene): string[] {
  const { map } = scene;
  const lanes = [...map.lanes.values()];
  const bike = lanes.filter((l) => l.kind === 'bike').length,
    road = lanes.filter((l) => l.kind === 'road').length;
  const parts = [
    `${road} lanes`,
    map.crosswalks.length ? `${map.crosswalks.length} crosswalks` : '',
    bike ? `${bike} bike lanes` : '',
  ]
    .filter(Boolean)
    .join(' · ');
  const size = `${num(map.box.x1 - map.box.x0, 0)} m × ${num(map.box.y1 - map.box.y0, 0)} m`;
  const kind = scene.signals.length ? 'Signals' : map.stopSigns.length ? 'Stop signs' : 'No signals';
  const out = [parts, `${size} · ${kind.toLowerCase()}`];
  if (scene.licence) out.push(`Licence: ${scene.licence}`);
  return out;
}

export function eventList(c: Context, events: readonly TrafficEvent[]): HTMLElement {
  const { editor } = c;
  if (!events.length)
    return h(
      'div',
      { class: 'kindrow' },
      h('span', { class: () => `dot ${editor.motion.value.score ? '' : 'busy'}` }),
      h('span', { class: 'sec' }, () =>
        editor.motion.value.score
          ? 'No collisions, no near misses'
          : editor.away.value
            ? 'Not known while the generator is away'
            : 'Not worked out yet',
      ),
    );
  return h(
    'div',
    null,
    events.map((ev) =>
      h(
        'button',
        {
          type: 'button',
          class: 'evrow',
          'aria-current': () => String(editor.selectedEvent.value === ev),
          onclick: () => goTo(c, ev),
        },
        h('span', { class: `tag ${ev.kind}` }, ev.kind === 'collision' ? 'Collision' : 'Near miss'),
        h('b', null, ev.title),
        h('span', { class: 't' }, seconds(ev.time)),
      ),
    ),
  );
}

export function goTo(c: Context, ev: TrafficEvent): void {
  const { editor, stage } = c;
  editor.playhead.pause();
  editor.setTime(ev.time);
  editor.pickEvent(ev);
  c.ui.showEvents(true);
  const v = stage.view;
  const [x, y] = v.to(ev.at[0], ev.at[1]);
  if (x < v.inset.left + 60 || x > v.w - 60 || y < 60 || y > v.h - 60) {
    v.centre(ev.at[0], ev.at[1]);
    stage.viewChanged();
  }
}

export function eventsPanel(c: Context): HTMLElement {
  const { editor } = c;
  return h(
    'div',
    { class: 'swap' },
    h(
      'div',
      { class: 'ih' },
      h(
        'div',
        { class: () => `ag t-${editor.events.value.some((e) => e.kind === 'collision') ? 'collision' : 'near'}` },
        icon('warn', 20),
      ),
      h(
        'div',
        { class: 'grow' },
        h('h2', null, 'Events'),
        h('p', null, () => `${editor.events.value.length} in these ${num(editor.scene.value?.duration ?? 9, 0)} s`),
      ),
      iconButton(c, 'deselect', { icon: 'x', size: 16 }),
    ),
    h(
      'section',
      { class: 'sect' },
      swap(
        () => editor.events.value,
        () => eventList(c, editor.events.peek()),
      ),
    ),
    swap(
      () => editor.selectedEvent.value,
      () => {
        const ev = editor.selectedEvent.peek();
        if (!ev) return null;
        return h(
          'div',
          { class: 'swap' },
          h(
            'section',
            { class: 'sect' },
            h('h3', null, ev.label.replace(/ (?=\d)/, ' at ')),
            h(
              'dl',
              { class: 'wh' },
              ev.facts.flatMap(([k, v]) => [h('dt', null, k), h('dd', null, v)]),
            ),
            ev.kind === 'near' ? h('p', { class: 'note' }, 'Counts as a near miss below 1.5 s or 1.0 m.') : null,
          ),
          h(
            'section',
            { class: 'sect last' },
            h('h3', null, 'What you can do'),
            h(
              'div',
              { class: 'stack' },
              [ev.a, ev.b]
                .filter((a) => a.type !== 'other' && a.logStart)
                .map((a) =>
                  h(
                    'button',
                    {
                      type: 'button',
                      class: 'opt',
                      onclick: () => {
                        editor.setTime(0);
                        c.ui.showEvents(false);
                        editor.select(a.id);
                      },
                    },
                    icon('select', 15),
                    `Change ${a.name}`,
                  ),
                ),
            ),
          ),
        );
      },
    ),
  );
}
