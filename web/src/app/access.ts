// For those who do not see the canvas: the road users as a list, and a voice for what happens.
import type { Context } from '../actions/context';
import { canChange, hasGoal, startPose, type Agent } from '../model/scene';
import { deg } from '../model/geometry';
import { num, speedLabel } from '../model/units';
import type { Command } from '../model/commands';
import * as moves from '../edit/moves';
import type { Part } from '../edit/editor';
import { laneWords } from '../edit/snap';
import { h, swap, watch } from './dom';

export function roadUserList(c: Context): HTMLElement {
  const { editor } = c;
  return h(
    'nav',
    { class: 'sr', 'aria-label': () => `Road users, ${editor.scene.value?.agents.size ?? 0}`, 'data-group': 'users' },
    swap(
      () => editor.scene.value?.id,
      () => {
        const scene = editor.scene.peek();
        if (!scene) return null;
        return h(
          'ul',
          null,
          [...scene.agents.values()].filter(canChange).map((a) =>
            h(
              'li',
              null,
              h(
                'button',
                {
                  type: 'button',
                  'data-agent': a.id,
                  tabindex: () =>
                    editor.selection.value === a.id || (!editor.selection.value && isFirst(c, a)) ? '0' : '-1',
                  'aria-pressed': () => String(editor.selection.value === a.id),
                  onclick: () => editor.select(a.id),
                },
                wordsOf(c, a),
              ),
            ),
          ),
        );
      },
    ),
  );
}

/** The words of one button. The buttons stay while events come and go, or the focus would fall off the page. */
function wordsOf(c: Context, first: Agent): () => string {
  let of: unknown[] = [];
  let text = '';
  return () => {
    const a = c.editor.scene.value?.agents.get(first.id) ?? first;
    const next = c.editor.events.value.find((e) => e.a.id === a.id || e.b.id === a.id)?.label ?? '';
    const now = [a, next, c.editor.unitOf(a)];
    // A drag changes the scene sixty times a second, and one road user at a time.
    if (now.some((v, i) => v !== of[i])) {
      of = now;
      text = words(c, a, next);
    }
    return text;
  };
}

const isFirst = (c: Context, a: Agent): boolean =>
  [...(c.editor.scene.peek()?.agents.values() ?? [])].find(canChange)?.id === a.id;

function words(c: Context, a: Agent, next: string): string {
  const p = startPose(a);
  if (!p) return a.name;
  return [
    a.name,
    speedLabel(p.speed, c.editor.unitOf(a)),
    a.parked ? 'parked' : laneWords(c.editor.scene.peek()!.map, a, p.x, p.y, p.heading),
    hasGoal(a.goal) ? 'goal set' : '',
    next.toLowerCase(),
  ]
    .filter(Boolean)
    .join(', ');
}

/** The handles of the selected road user, for keys and screen readers. They have no picture of their own. */
export function handleSliders(c: Context): HTMLElement {
  const { editor } = c;
  return h(
    'div',
    { class: 'sr', role: 'group', 'aria-label': 'Handles', 'data-group': 'handles' },
    swap(
      () => (editor.agent.value && canChange(editor.agent.value) ? editor.selection.value : null),
      () => {
        const id = editor.selection.peek();
        if (!id || !editor.agent.peek()) return null;
        const agent = () => editor.scene.value?.agents.get(id) ?? editor.agent.peek()!;
        const make = (
          part: Part,
          what: string,
          now: () => number,
          text: () => string,
          move: (key: string, far: boolean) => Command | null,
        ) =>
          h('div', {
            role: 'slider',
            tabindex: '0',
            'aria-label': `${part === 'start' ? 'Start' : 'Goal'} ${what}`,
            'aria-valuenow': () => now().toFixed(1),
            'aria-valuetext': text,
            'aria-valuemin': '-10000',
            'aria-valuemax': '10000',
            onfocus: () => {
              editor.activate(part);
            },
            onkeydown: (e: KeyboardEvent) => {
              if (!e.key.startsWith('Arrow') || e.ctrlKey || e.altKey) return;
              e.preventDefault();
              e.stopPropagation();
              const command = move(e.key, e.shiftKey);
              if (command) editor.run(command);
            },
          });
        const sign = (key: string) => (key === 'ArrowUp' || key === 'ArrowRight' ? 1 : -1);
        const parts = (part: Part) => {
          const pose = () => moves.shownPose(editor, agent(), part);
          const free = (f: 'pos' | 'heading' | 'speed') =>
            (part === 'goal' ? agent().goal : agent().start)[f] === null ? ', free' : ', fixed';
          return [
            make(
              part,
              'position',
              () => pose()?.x ?? 0,
              () => {
                const p = pose();
                return p
                  ? `${num(p.x, 1)}, ${num(p.y, 1)} metres, ${laneWords(editor.scene.value!.map, agent(), p.x, p.y, p.heading)}${free('pos')}`
                  : 'not known';
              },
              (key, far) =>
                moves.nudge(
                  editor,
                  agent(),
                  part,
                  (key === 'ArrowLeft' ? -1 : key === 'ArrowRight' ? 1 : 0) * (far ? 1 : 0.1),
                  (key === 'ArrowDown' ? -1 : key === 'ArrowUp' ? 1 : 0) * (far ? 1 : 0.1),
                ),
            ),
            make(
              part,
              'heading',
              () => deg(pose()?.heading ?? 0),
              () => `${Math.round(deg(pose()?.heading ?? 0))} degrees${free('heading')}`,
              (key, far) => moves.turn(editor, agent(), part, sign(key) * (far ? 15 : 1)),
            ),
            make(
              part,
              'speed',
              () => pose()?.speed ?? 0,
              () => `${speedLabel(pose()?.speed ?? 0, editor.unitOf(agent()))}${free('speed')}`,
              (key, far) => moves.faster(editor, agent(), part, sign(key) * (far ? 10 : 1)),
            ),
          ];
        };
        return h(
          'div',
          null,
          parts('start'),
          parts('goal'),
          make(
            'goal',
            'time',
            () => agent().goal.time,
            () => `${num(agent().goal.time, 1)} seconds`,
            (key, far) => moves.later(c.editor, agent(), sign(key) * (far ? 1 : 0.1)),
          ),
        );
      },
    ),
  );
}

/** Polite, at most one message a second; the newest wins. Collisions and a missing generator are said at once. */
export function liveRegion(c: Context): HTMLElement {
  const polite = h('div', { class: 'sr', role: 'status', 'aria-live': 'polite' });
  const urgent = h('div', { class: 'sr', role: 'alert', 'aria-live': 'assertive' });
  let last = 0,
    timer = 0;
  watch(() => {
    const m = c.editor.notices.spoken.value;
    if (!m.text) return;
    if (m.urgent) {
      urgent.textContent = m.text;
      return;
    }
    clearTimeout(timer);
    const wait = Math.max(0, last + 1000 - performance.now());
    timer = window.setTimeout(() => {
      last = performance.now();
      polite.textContent = m.text;
    }, wait);
  });
  return h('div', { class: 'swap' }, polite, urgent);
}
