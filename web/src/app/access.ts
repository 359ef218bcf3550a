// For those who do not see the canvas: the road users as a list, and a voice for what happens.
import type { Context } from '../actions/context';
import { canChange, hasGoal, startPose, type Agent } from '../model/scene';
import { speedLabel } from '../model/units';
import { laneWords } from '../edit/snap';
import { h, swap, watch } from './dom';

export function roadUserList(c: Context): HTMLElement {
  const { editor } = c;
  return h('nav', { class: 'sr', 'aria-label': () => `Road users, ${editor.scene.value?.agents.size ?? 0}`, 'data-group': 'users' },
    swap(() => `${editor.scene.value?.id}:${editor.events.value.length}`, () => {
      const scene = editor.scene.peek();
      if (!scene) return null;
      return h('ul', null, [...scene.agents.values()].filter(canChange).map((a) => h('li', null, h('button', {
        type: 'button', 'data-agent': a.id, tabindex: () => (editor.selection.value === a.id || (!editor.selection.value && isFirst(c, a)) ? '0' : '-1'), 'aria-pressed': () => String(editor.selection.value === a.id),
        onclick: () => editor.select(a.id),
      }, () => words(c, editor.scene.value?.agents.get(a.id) ?? a)))));
    }));
}

const isFirst = (c: Context, a: Agent): boolean => [...(c.editor.scene.peek()?.agents.values() ?? [])].find(canChange)?.id === a.id;

function words(c: Context, a: Agent): string {
  const p = startPose(a);
  if (!p) return a.name;
  const next = c.editor.events.peek().find((e) => e.a.id === a.id || e.b.id === a.id);
  return [a.name, speedLabel(p.speed, c.editor.unitOf(a)), a.parked ? 'parked' : laneWords(c.editor.scene.peek()!.map, a, p.x, p.y, p.heading), hasGoal(a.goal) ? 'goal set' : '', next ? next.label.toLowerCase() : ''].filter(Boolean).join(', ');
}

/** Polite, at most one message a second; the newest wins. Collisions and a missing generator are said at once. */
export function liveRegion(c: Context): HTMLElement {
  const polite = h('div', { class: 'sr', role: 'status', 'aria-live': 'polite' });
  const urgent = h('div', { class: 'sr', role: 'alert', 'aria-live': 'assertive' });
  let last = 0, timer = 0;
  watch(() => {
    const m = c.editor.spoken.value;
    if (!m.text) return;
    if (m.urgent) { urgent.textContent = m.text; return; }
    clearTimeout(timer);
    const wait = Math.max(0, last + 1000 - performance.now());
    timer = window.setTimeout(() => { last = performance.now(); polite.textContent = m.text; }, wait);
  });
  return h('div', { class: 'swap' }, polite, urgent);
}
