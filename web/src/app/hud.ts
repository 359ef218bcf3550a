// Everything that floats over the picture: rail, layers, status, scale, zoom, hint, toast, banner, hover card.
import { signal } from '@preact/signals-core';
import type { Context } from '../actions/context';
import { HOME_ZOOM } from '../draw/view';
import type { Picture } from '../edit/picture';
import { actionOf } from '../actions/registry';
import { summary } from '../model/events';
import { touched } from '../model/scene';
import { actionButton, iconButton, keyCaps } from './buttons';
import { h, swap, watch, type Child } from './dom';
import { icon } from './icons';

export function hud(c: Context, picture: Picture): HTMLElement {
  const { editor, ui } = c;
  const shift = () => (ui.drawer.value ? 'shift' : '');
  return h(
    'div',
    { class: 'hud' },
    h(
      'nav',
      { class: 'rail', 'aria-label': 'Tools' },
      ['select', 'pan', 'measure'].map((t) =>
        actionButton(c, `tool-${t}`, { size: 20, label: h('em', null, actionOf(`tool-${t}`).keys![0]) }),
      ),
    ),
    h(
      'div',
      { class: 'tr' },
      h(
        'div',
        { class: 'card chipbar', role: 'group', 'aria-label': 'Layers' },
        ['futures', 'log', 'lanes', 'labels'].map((l) => actionButton(c, `layer-${l}`, { icon: 'check', size: 14 })),
      ),
    ),
    h(
      'div',
      { class: () => `bl ${shift()}` },
      h(
        'div',
        { class: 'card status' },
        swap(
          () => statusKey(c),
          () => status(c),
        ),
      ),
      scaleBar(c),
    ),
    swap(
      () => editor.dragging.value,
      () => (editor.drag.peek() ? dragHelp(c) : zoomBar(c)),
    ),
    swap(
      () => coachShown(c),
      () => (coachShown(c) ? coach(c) : null),
    ),
    swap(
      () => editor.notices.toast.value,
      () => toast(c),
    ),
    swap(
      () => bannerKey(c),
      () => banner(c),
    ),
    hoverCard(c, picture),
  );
}

// ---------------------------------------------------------------- status

const statusKey = (c: Context): string => {
  const { editor } = c;
  const s = editor.status.value;
  return JSON.stringify([
    s,
    editor.away.value?.waiting,
    editor.events.value.length,
    editor.selectedEvent.value?.time,
    editor.selection.value,
    editor.draft.value !== null,
    unreachable(c),
    editor.layers.value.log && editor.touchedIds(editor.scene.value).length,
  ]);
};

const unreachable = (c: Context): boolean => {
  const { editor: e } = c;
  const a = e.agent.value;
  if (!a?.goal.pos) return false;
  const live =
    e.liveReach.value?.id === a.id ? e.liveReach.value.reach : e.drag.value ? null : e.motion.value.reach.get(a.id);
  return live ? live.status === 'unreachable' : !!e.localReach.value && e.localReach.value.kind !== 'ok';
};

function status(c: Context): HTMLElement {
  const { editor } = c;
  const s = editor.status.peek();
  const line = (dot: string, text: string) => h('div', { class: 'row' }, h('span', { class: `dot ${dot}` }), text);
  // At an event the chip says what happens in the scene, not what the generator did last.
  if (editor.selectedEvent.peek() && (s.kind === 'settled' || s.kind === 'ready')) return readyLine(c, line);
  switch (s.kind) {
    case 'loading':
      return line('busy', 'Loading the scene …');
    case 'refining':
      return h(
        'div',
        { class: 'row' },
        h(
          'span',
          { class: 'steps' },
          [...Array(s.steps).keys()].map((i) => h('i', { class: i < s.step ? 'd' : '' })),
        ),
        s.part
          ? `Refining ${s.part} · ${s.ms.toFixed(0)} ms`
          : s.step
            ? `Refining, step ${s.step} of ${s.steps} · ${s.ms.toFixed(0)} ms`
            : s.ms
              ? `First guess · ${s.ms.toFixed(0)} ms`
              : 'Working out futures …',
      );
    case 'slow':
      return line(
        'busy',
        `This takes longer than usual (${(s.ms / 1000).toFixed(1)} s).${editor.dragging.peek() ? ' You can keep dragging.' : ''}`,
      );
    case 'refused':
      return line('collision', s.words);
    case 'away': {
      const n = editor.away.peek()?.waiting ?? 0;
      return line('near', `Generator away${n ? ` · ${n} change${n > 1 ? 's' : ''} waiting` : ''}`);
    }
    case 'settled': {
      if (unreachable(c)) return line('near', 'Showing futures to the nearest reachable point');
      const n = editor.futures.peek()?.modes.length ?? 6;
      const ms = s.ms ? ` · ${s.ms.toFixed(0)} ms` : '';
      const adapted =
        s.adapted === null ? '' : s.adapted === 0 ? '' : ` · ${s.adapted} other${s.adapted > 1 ? 's' : ''} adapted`;
      return editor.selection.peek() ? line('', `${n === 6 ? 'Six' : n} futures${ms}${adapted}`) : readyLine(c, line);
    }
    case 'ready':
      return readyLine(c, line);
  }
}

function readyLine(c: Context, line: (dot: string, text: string) => HTMLElement): HTMLElement {
  const { editor } = c;
  const ev = editor.events.peek();
  if (ev.length) return line(ev.some((e) => e.kind === 'collision') ? 'collision' : 'near', summary(ev));
  const scene = editor.scene.peek();
  if (editor.layers.peek().log && scene) {
    const n = [...scene.agents.values()].filter(touched).length;
    return line('', `Log shown dashed · ${n} of ${scene.agents.size} road users edited`);
  }
  return line('', scene ? `Ready · ${scene.agents.size} road users` : 'Ready');
}

// ---------------------------------------------------------------- view

/** View changes come many times a second; the panels follow once a frame at most. */
const viewTick = signal(0);

export function watchView(c: Context): void {
  let queued = false;
  const old = c.stage.onView;
  c.stage.onView = () => {
    old?.();
    if (queued) return;
    queued = true;
    requestAnimationFrame(() => {
      queued = false;
      viewTick.value++;
      // Lets scripts that drive the page find world points on the screen.
      const { cx, cy, z } = c.stage.view;
      c.stage.element.dataset.view = [cx, cy, z].map((v) => v.toFixed(4)).join(' ');
    });
  };
}

function scaleBar(c: Context): HTMLElement {
  const length = () => {
    void viewTick.value;
    const target = 90 / c.stage.view.z;
    const step = 10 ** Math.floor(Math.log10(target));
    return [5, 2, 1].map((k) => k * step).find((v) => v <= target) ?? step;
  };
  return h(
    'div',
    { class: 'card scale', 'aria-hidden': 'true' },
    h('i', { css: { width: () => `${length() * c.stage.view.z}px` } }),
    h('span', null, () => `${length()} m`),
  );
}

function zoomBar(c: Context): HTMLElement {
  return h(
    'div',
    { class: 'br' },
    h(
      'div',
      { class: 'card chipbar zoom', role: 'group', 'aria-label': 'Zoom' },
      iconButton(c, 'zoom-out', { size: 16 }),
      h(
        'span',
        { class: 'zoomnum' },
        () => (void viewTick.value, `${Math.round((c.stage.view.z / HOME_ZOOM) * 100)}%`),
      ),
      iconButton(c, 'zoom-in', { size: 16 }),
      iconButton(c, 'fit', { size: 16 }),
    ),
  );
}

function dragHelp(c: Context): HTMLElement {
  const grip = c.editor.drag.peek()!.grip;
  const tip = (key: string, text: string): Child => h('span', null, keyCaps(key), text);
  const others = c.editor.scene.peek()?.others === 'react' ? 'Others react when you let go' : 'Let go to work it out';
  const tips = {
    body: [tip('Alt', 'no snapping'), tip('Shift', 'along the lane')],
    heading: [tip('Shift', '15° steps'), tip('Alt', 'fine')],
    speed: [tip('Shift', '10 km/h steps'), tip('Alt', 'fine')],
    time: [tip('Shift', 'whole seconds')],
  }[grip.handle];
  return h(
    'div',
    { class: 'card helpbar' },
    h('span', { class: 'mut' }, others),
    h('div', { class: 'sep' }),
    tips,
    tip('Esc', 'put back'),
  );
}

// ---------------------------------------------------------------- messages

const coachShown = (c: Context): boolean =>
  c.ui.coach.value > 0 && !c.editor.dragging.value && !c.editor.notices.toast.value && c.editor.scene.value !== null;

function coach(c: Context): HTMLElement {
  const step = (n: number, text: string) =>
    h('div', { class: () => `st ${c.ui.coach.value === n ? 'now' : ''}` }, h('span', { class: 'n' }, String(n)), text);
  return h(
    'div',
    { class: () => `card coach ${c.ui.drawer.value ? 'shift' : ''}` },
    step(1, 'Click a car'),
    step(2, 'Drag its flag to where it should be in 9 s'),
    step(3, 'Let go: the others react'),
    h(
      'button',
      { type: 'button', class: 'btn i', 'aria-label': 'Close the hint', onclick: () => c.ui.endCoach() },
      icon('x', 16),
    ),
  );
}

function toast(c: Context): HTMLElement | null {
  const t = c.editor.notices.toast.peek();
  if (!t) return null;
  const button = t.undo
    ? h(
        'button',
        {
          type: 'button',
          class: 'btn',
          'data-action': 'undo',
          onclick: () => {
            c.editor.undo();
          },
        },
        'Undo',
        keyCaps('Ctrl+Z'),
      )
    : t.action
      ? h(
          'button',
          {
            type: 'button',
            class: 'btn',
            onclick: () => {
              c.editor.notices.hide();
              t.action!.run();
            },
          },
          t.action.label,
        )
      : null;
  return h(
    'div',
    { class: () => `toast ${button ? '' : 'plain'} ${c.ui.drawer.value ? 'shift' : ''}` },
    h('span', null, t.text),
    button,
  );
}

const bannerKey = (c: Context): string => {
  const { editor, library, saving } = c;
  return editor.notices.crash.value
    ? 'crash'
    : editor.away.value
      ? `away${editor.away.value.waiting}`
      : saving.conflict.value
        ? 'conflict'
        : (library.openError.value ?? '');
};

function banner(c: Context): HTMLElement | null {
  const { editor, library, saving } = c;
  const box = (ic: string, title: string, words: Child, buttons: Child): HTMLElement =>
    h(
      'div',
      { class: 'banner', role: 'alert' },
      icon(ic, 20),
      h('div', null, h('b', null, title), h('span', { class: 'sub' }, words)),
      buttons,
    );
  if (editor.notices.crash.peek())
    return box('warn', 'Something broke in the editor. The scene is safe.', 'Reload the page to go on.', [
      h('button', { type: 'button', class: 'btn', onclick: () => location.reload() }, 'Reload'),
      h(
        'button',
        {
          type: 'button',
          class: 'btn',
          onclick: () => void navigator.clipboard?.writeText(editor.notices.crash.peek()!),
        },
        'Copy details',
      ),
    ]);
  if (editor.away.peek()) {
    const n = editor.away.peek()!.waiting;
    const words = n
      ? `Keep editing: ${n} change${n > 1 ? 's are' : ' is'} waiting and saved on this computer.`
      : 'Keep editing: changes will wait and are saved on this computer.';
    return box(
      'cloud',
      'The generator is not answering. Nothing is lost.',
      [words, ' Trying again in ', () => editor.away.value?.retryIn ?? 0, ' s.'],
      h('button', { type: 'button', class: 'btn', onclick: () => void c.generation.tryNow() }, 'Try now'),
    );
  }
  if (saving.conflict.peek())
    return box('warn', 'This scene was changed elsewhere.', 'Nothing is overwritten until you choose.', [
      h('button', { type: 'button', class: 'btn', onclick: () => void saving.keepMine() }, 'Keep this version'),
      h('button', { type: 'button', class: 'btn', onclick: () => void library.takeTheirs() }, 'Open the other one'),
    ]);
  if (library.openError.peek())
    return box(
      'warn',
      'The scene could not be opened.',
      library.openError.peek(),
      h(
        'button',
        {
          type: 'button',
          class: 'btn',
          onclick: () => {
            library.dismissError();
          },
        },
        'Close',
      ),
    );
  return null;
}

// ---------------------------------------------------------------- hover card

function hoverCard(c: Context, picture: Picture): HTMLElement {
  const title = h('b'),
    line = h('span', { class: 'mut' });
  const el = h('div', { class: 'card tip', 'aria-hidden': 'true' }, title, line);
  el.hidden = true;
  watch(() => {
    void [c.editor.hover.value, c.editor.drag.value, c.editor.selection.value];
    const words = picture.hoverWords();
    const p = c.gestures.pointer;
    el.hidden = !words || !p;
    if (!words || !p) return;
    title.textContent = words.title;
    line.textContent = words.line;
    const v = c.stage.view;
    const w = el.offsetWidth || 220;
    el.style.transform = `translate(${Math.min(v.w - w - 8, p.x + 14)}px, ${p.y + 70 > v.h ? p.y - 58 : p.y + 18}px)`;
  });
  return el;
}
