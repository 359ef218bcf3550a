// Speed over time of the selected user, with a lane of events above. Curves are rebuilt when they change; the
// playhead only moves.
import type { Context } from '../actions/context';
import { smoothSpeed, type Motion } from '../model/motion';
import { startPose, touched } from '../model/scene';
import { num, toUnit, type SpeedUnit } from '../model/units';
import { isSettled } from '../model/futures';
import { modeStyle } from '../draw/strokes';
import { h, svg, watch } from './dom';
import { goTo } from './scenepanel';

const X0 = 52,
  RIGHT = 22,
  LANE = 24,
  BOTTOM = 20;

interface Axes {
  x: (t: number) => number;
  y: (v: number) => number;
  x1: number;
  y0: number;
  y1: number;
  height: number;
  top: number;
  duration: number;
}

export function plot(c: Context): HTMLElement {
  const { editor } = c;
  const root = svg('svg', { role: 'img', 'aria-label': 'Speed over time' });
  const curves = svg('g'),
    badges = svg('g');
  const head = svg('g', { class: 'head' });
  root.append(curves, badges, head);
  const box = h(
    'div',
    {
      class: 'plot',
      role: 'slider',
      tabindex: '0',
      'aria-label': 'Playhead',
      'aria-valuemin': '0',
      'aria-valuemax': () => String(editor.scene.value?.duration ?? 9),
      'aria-valuenow': () => editor.time.value.toFixed(1),
      'aria-valuetext': () => `${editor.time.value.toFixed(1)} seconds`,
    },
    root,
  );
  let size = { w: 900, h: 110 };
  const axes = (): Axes => {
    const duration = editor.scene.peek()?.duration ?? 9;
    const x1 = size.w - RIGHT,
      y0 = LANE + 6,
      y1 = size.h - BOTTOM,
      top = topSpeed(c);
    return {
      x: (t) => X0 + ((x1 - X0) * t) / duration,
      y: (v) => y1 - ((y1 - y0) * Math.min(top, Math.max(0, v))) / top,
      x1,
      y0,
      y1,
      height: size.h,
      top,
      duration,
    };
  };
  let queued = false;
  const redraw = () => {
    if (queued) return;
    queued = true;
    requestAnimationFrame(() => {
      queued = false;
      paint(c, curves, badges, axes());
      movePlayhead();
    });
  };
  const movePlayhead = () => {
    const a = axes(),
      x = a.x(editor.time.peek());
    head.replaceChildren(
      svg('line', { x1: x, x2: x, y1: 1, y2: a.y1, stroke: 'var(--ink)', 'stroke-width': 1.5 }),
      svg('path', {
        d: `M${x - 6} 0h12v6l-6 6-6-6z`,
        fill: 'var(--ink)',
        stroke: 'var(--surface)',
        'stroke-width': 1.5,
      }),
    );
  };
  watch(() => {
    void [
      editor.agent.value,
      editor.futures.value,
      editor.chosen.value,
      editor.motion.value,
      editor.events.value,
      editor.layers.value.log,
      editor.scene.value,
      editor.speedUnit.value,
      editor.selectedEvent.value,
      editor.hoverFuture.value,
    ];
    redraw();
  });
  watch(() => {
    void editor.time.value;
    movePlayhead();
  });
  new ResizeObserver(() => {
    size = { w: box.clientWidth, h: box.clientHeight };
    redraw();
  }).observe(box);
  seekable(c, box, () => axes());
  return box;
}

function seekable(c: Context, box: HTMLElement, axes: () => Axes): void {
  let on = false;
  const seek = (e: PointerEvent) => {
    const a = axes();
    const x = e.clientX - box.getBoundingClientRect().left;
    c.editor.setTime(Math.round(((x - X0) / (a.x1 - X0)) * a.duration * 10) / 10);
  };
  box.addEventListener('pointerdown', (e) => {
    if ((e.target as Element).closest('.badge')) return;
    on = true;
    box.setPointerCapture(e.pointerId);
    c.editor.playhead.pause();
    seek(e);
  });
  box.addEventListener('pointermove', (e) => {
    if (on) seek(e);
  });
  box.addEventListener('pointerup', () => {
    on = false;
  });
  box.addEventListener('keydown', (e) => {
    if (e.key !== 'ArrowLeft' && e.key !== 'ArrowRight') return;
    e.preventDefault();
    e.stopPropagation();
    c.editor.playhead.pause();
    c.editor.setTime(
      Math.round((c.editor.time.peek() + (e.key === 'ArrowLeft' ? -1 : 1) * (e.shiftKey ? 1 : 0.1)) * 10) / 10,
    );
  });
}

const unitNow = (c: Context): SpeedUnit => {
  const a = c.editor.agent.peek();
  return a ? c.editor.unitOf(a) : c.editor.speedUnit.peek();
};

/** A round figure above everything shown. */
function topSpeed(c: Context): number {
  const a = c.editor.agent.peek(),
    f = c.editor.futures.peek();
  const unit = unitNow(c);
  let max = 0;
  const take = (m: Motion) => {
    for (const v of m.speed) max = Math.max(max, toUnit(Math.abs(v), unit));
  };
  if (a) take(a.log);
  f?.modes.forEach((m) => take(m.motion));
  const steps = unit === 'm/s' ? [2, 4, 8, 16] : [20, 40, 60, 80, 120, 160, 220];
  return steps.find((s) => s >= max * 1.02) ?? steps[steps.length - 1];
}

function paint(c: Context, curves: SVGElement, badges: SVGElement, a: Axes): void {
  const { editor } = c;
  const agent = editor.agent.peek();
  const unit = unitNow(c);
  const parts: SVGElement[] = [
    svg('rect', { x: X0, y: 2, width: Math.max(0, a.x1 - X0), height: LANE - 4, rx: 4, fill: 'var(--surface-2)' }),
    svg('text', { x: X0 - 8, y: 16, 'text-anchor': 'end' }, 'Events'),
  ];
  for (let k = 0; k <= 2; k++) {
    const v = (a.top * k) / 2,
      y = Math.round(a.y(v)) + 0.5;
    parts.push(
      svg('line', { class: 'grid', x1: X0, x2: a.x1, y1: y, y2: y }),
      svg('text', { x: X0 - 8, y: y + 3.5, 'text-anchor': 'end' }, num(v, Number.isInteger(v) ? 0 : 1)),
    );
  }
  for (let t = 0; t <= a.duration + 1e-6; t++) {
    const x = Math.round(a.x(t)) + 0.5,
      last = t + 1 > a.duration + 1e-6;
    parts.push(
      svg('line', { class: 'grid', x1: x, x2: x, y1: a.y0, y2: a.y1, opacity: t ? 0.6 : 1 }),
      svg(
        'text',
        { x, y: a.height - 5, 'text-anchor': last ? 'end' : t ? 'middle' : 'start' },
        `${t}${last ? ' s' : ''}`,
      ),
    );
  }
  for (const ev of editor.events.peek()) {
    const w = ev.kind === 'collision' ? 0.3 : 0.8;
    parts.push(
      svg('rect', {
        x: a.x(Math.max(0, ev.time - w / 2)),
        y: a.y0,
        width: a.x(w) - a.x(0),
        height: a.y1 - a.y0,
        fill: `var(--${ev.kind})`,
        opacity: 0.16,
      }),
    );
  }
  if (agent) parts.push(...agentCurves(c, a, unit));
  else
    parts.push(
      svg(
        'text',
        { class: 'big back', x: (X0 + a.x1) / 2, y: (a.y0 + a.y1) / 2 + 4, 'text-anchor': 'middle' },
        editor.scene.peek() ? 'Select a road user to see its speed' : 'Nothing to play yet',
      ),
    );
  const name = agent ? ` · ${agent.name}${editor.layers.peek().log ? ', dashed: log' : ''}` : '';
  parts.push(svg('text', { class: 'back', x: X0 + 6, y: a.y0 + 11 }, `${unit}${name}`));
  curves.replaceChildren(...parts);
  badges.replaceChildren(...eventBadges(c, a));
}

function agentCurves(c: Context, a: Axes, unit: SpeedUnit): SVGElement[] {
  const { editor } = c;
  const agent = editor.agent.peek()!;
  const out: SVGElement[] = [];
  const line = (m: Motion, colour: string, width: number, opacity = 1, dash = '', smooth = false) => {
    const speeds = smooth ? smoothSpeed(m) : m.speed;
    let d = '',
      pen = false;
    for (let i = 0; i < speeds.length; i++) {
      const step = m.first + i;
      if (!m.valid.some(([p, q]) => step >= p && step < q)) {
        pen = false;
        continue;
      }
      if (step < 0 || step * 0.1 > a.duration + 1e-6) continue;
      d += `${pen ? 'L' : 'M'}${a.x(step * 0.1).toFixed(1)} ${a.y(toUnit(Math.abs(speeds[i]), unit)).toFixed(1)}`;
      pen = true;
    }
    out.push(
      svg('path', {
        d,
        fill: 'none',
        stroke: colour,
        'stroke-width': width,
        opacity,
        'stroke-dasharray': dash,
        'stroke-linejoin': 'round',
      }),
    );
  };
  const f = editor.futures.peek();
  const chosen = editor.chosen.peek();
  const showLog = editor.layers.peek().log || !f;
  if (showLog) line(agent.log, f ? 'var(--log)' : 'var(--ink)', f ? 1.5 : 2.25, 0.9, f ? '4 3' : '', true);
  if (f) {
    const max = Math.max(...f.modes.map((m) => m.probability));
    const dash = isSettled(f) && !f.sketch ? '' : '3 3';
    f.modes.forEach((m, i) => {
      if (i === chosen) return;
      const hot = editor.hoverFuture.peek() === i;
      line(
        m.motion,
        `var(--mode-${'abcdef'[i]})`,
        hot ? 2.25 : 1.25,
        hot ? 1 : 0.25 + 0.4 * modeStyle(m.probability, max).alpha,
        dash,
      );
    });
    if (f.modes[chosen])
      line(f.modes[chosen].motion, f.sketch ? 'var(--ink-3)' : `var(--mode-${'abcdef'[chosen]})`, 2.5, 1, dash);
  }
  const start = startPose(agent);
  if (start && touched(agent))
    out.push(
      svg('circle', {
        cx: a.x(0),
        cy: a.y(toUnit(start.speed, unit)),
        r: 4.5,
        fill: 'var(--surface)',
        stroke: 'var(--ink)',
        'stroke-width': 2.5,
      }),
    );
  const goal = editor.goalPose(agent);
  if (goal && agent.goal.pos)
    out.push(
      svg('circle', {
        cx: a.x(Math.min(a.duration, agent.goal.time)),
        cy: a.y(toUnit(goal.speed, unit)),
        r: 5,
        fill: agent.goal.speed === null ? 'var(--surface)' : 'var(--goal)',
        stroke: 'var(--goal)',
        'stroke-width': 2,
        'stroke-dasharray': agent.goal.speed === null ? '2.6 2.4' : '',
      }),
    );
  return out;
}

function eventBadges(c: Context, a: Axes): SVGElement[] {
  const { editor } = c;
  const out: SVGElement[] = [];
  const all = editor.events.peek();
  const full = all.map((ev) => ev.label.length * 5.9 + 26);
  const crowded = full.reduce((sum, w) => sum + w + 3, 0) > (a.x1 - X0) * 0.8;
  const places = sideBySide(
    all.map((ev, i) => ({ at: a.x(ev.time), w: crowded ? 20 : full[i] })),
    X0 + 2,
    a.x1 - 2,
  );
  for (const [i, ev] of all.entries()) {
    const w = crowded ? 20 : full[i],
      x = places[i];
    const on = editor.selectedEvent.peek() === ev;
    const hit = ev.kind === 'collision';
    out.push(
      svg(
        'g',
        { class: 'badge', role: 'button', 'aria-label': `${ev.label}: ${ev.title}`, onclick: () => goTo(c, ev) },
        svg('title', null, `${ev.label}: ${ev.title}`),
        svg('rect', {
          x,
          y: 3,
          width: w,
          height: 18,
          rx: 9,
          fill: `var(--${ev.kind})`,
          stroke: on ? 'var(--ink)' : 'none',
          'stroke-width': 2,
        }),
        hit
          ? svg('path', {
              d: `M${x + 7} 9l6 6M${x + 13} 9l-6 6`,
              stroke: 'var(--on-collision)',
              'stroke-width': 2,
              'stroke-linecap': 'round',
            })
          : svg('path', { d: `M${x + 10} 7.500l4.200 8h-8.400z`, fill: 'var(--on-near)' }),
        crowded ? null : svg('text', { x: x + 20, y: 15.5, css: { fill: `var(--on-${ev.kind})` } }, ev.label),
      ),
    );
  }
  return out;
}

/** Left edges of badges near their places, none on top of another: pushed right first, then back from the end. */
export function sideBySide(items: readonly { at: number; w: number }[], from: number, to: number): number[] {
  const x: number[] = [];
  items.forEach(({ at, w }, i) => {
    x[i] = Math.max(at - w / 2, i ? x[i - 1] + items[i - 1].w + 3 : from);
  });
  let limit = to;
  for (let i = items.length - 1; i >= 0; i--) {
    x[i] = Math.max(from, Math.min(x[i], limit - items[i].w));
    limit = x[i] - 3;
  }
  return x;
}
