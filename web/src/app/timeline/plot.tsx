// Speed over time of the selected road user, with a lane of events above. Curves are redrawn when they change, at most
// once a frame; the playhead only moves.
import { useLayoutEffect, useMemo, useRef } from 'preact/hooks';
import { useComputed, useSignal, type ReadonlySignal } from '@preact/signals';
import type { Context } from '../../actions/context';
import { canMove } from '../../model/document/scene';
import { fromUnit, num } from '../../model/base/units';
import { addViaAt } from '../../edit/moves/vias';
import { useApp } from '../parts/app-context';
import { Later } from '../later';
import { useFrameTick } from '../parts/hooks';
import { axesOf, X0, type Axes, type PlotSize } from './axes';
import { Curves } from './curves';
import { EventBadges } from './event-badges';
import { EventTimes, Grid } from './grid';
import { TEXTS } from '../../texts/panels/timeline';

/** All inputs of curves, grid and badges. */
const shown = ({ editor, variants, layouts, curve }: Context): unknown => [
  layouts.isNew.value,
  variants.comparing.compared.value,
  variants.comparing.followed.value,
  editor.agent.value,
  editor.selected.value,
  editor.selected.value.length > 1 && editor.hover.value,
  editor.reading.futures.value,
  editor.reading.bold.value,
  editor.reading.replays.value,
  editor.answers.motion.value,
  editor.reading.shownEvents.value,
  editor.view.beside.value,
  editor.drag.active.value,
  editor.view.layers.value.log,
  editor.scene.value,
  editor.view.speedUnit.value,
  editor.selectedEvent.value,
  editor.hoverFuture.value,
  curve.points.value,
  curve.before.value,
];

export function Plot() {
  const c = useApp();
  const { editor, curve } = c;
  const box = useRef<HTMLDivElement>(null);
  const size = useSignal<PlotSize>({ w: 900, h: 110 });
  const tick = useFrameTick(() => [editor.reading.throttle.read(() => shown(c)), size.value]);
  const now = useComputed(() => editor.playhead.time.value.toFixed(1));
  const end = useComputed(() => String(editor.resting.value?.duration ?? 9));
  useLayoutEffect(() => {
    const el = box.current!;
    const watch = new ResizeObserver(() => {
      // A plot without a height is invisible, and has no axes.
      if (el.clientHeight) size.value = { w: el.clientWidth, h: el.clientHeight };
    });
    watch.observe(el);
    return () => watch.disconnect();
  }, [size]);
  /** Computed once for all drawings. */
  const axes = useComputed((): Axes => (void tick.value, axesOf(c, size.peek())));
  const seek = useSeek(c, size);
  const pointed = useComputed(() => curve.point.value !== null).value;
  return (
    <div ref={box} class="plot">
      <div
        class="seek"
        role="slider"
        tabindex={0}
        aria-label={TEXTS.playhead}
        aria-valuemin={0}
        aria-valuemax={end as never}
        aria-valuenow={now as never}
        aria-valuetext={useComputed(() => TEXTS.seconds(num(editor.playhead.time.value, 1)))}
        {...seek}
      >
        <svg role="img" aria-label={TEXTS.speedOverTime}>
          <Drawing tick={tick} axes={axes} />
          <Playhead axes={axes} />
          <Badges tick={tick} axes={axes} />
        </svg>
      </div>
      <svg class="pts" role="group" aria-label={TEXTS.pointsOfTheSpeed}>
        <Points tick={tick} axes={axes} />
        <Phases tick={tick} axes={axes} />
      </svg>
      {pointed ? <Later part="points" /> : null}
    </div>
  );
}

interface DrawingProps {
  tick: ReadonlySignal<number>;
  axes: ReadonlySignal<Axes>;
}

function Drawing({ tick, axes: all }: DrawingProps) {
  void tick.value;
  const now = all.value;
  // While a goal is dragged the curves change and the axes rarely do: the grid is not redrawn.
  const axes = useMemo(() => now, [now.x1, now.height, now.top, now.unit, now.duration]);
  const grid = useMemo(() => <Grid axes={axes} />, [axes]);
  return (
    <g>
      {grid}
      <EventTimes axes={axes} />
      <Curves axes={axes} />
    </g>
  );
}

/** Above the playhead, which would cover their words. */
function Badges({ tick, axes }: DrawingProps) {
  void tick.value;
  return (
    <g>
      <EventBadges axes={axes.value} />
    </g>
  );
}

function Points({ tick, axes }: DrawingProps) {
  const { editor, curve } = useApp();
  void tick.value;
  // The shown motion then is not the one of these points.
  if (editor.view.beside.peek()?.meeting || editor.drag.active.peek()) return null;
  return curve.points.peek().length ? <Later part="speed points" axes={axes.value} /> : null;
}

function Phases({ tick, axes }: DrawingProps) {
  void tick.value;
  const some = useApp().signalEdges.lanes.value.length > 0;
  return some ? <Later part="phases" axes={axes.value} /> : null;
}

function Playhead({ axes }: { axes: ReadonlySignal<Axes> }) {
  const c = useApp();
  const x = useComputed(() => axes.value.x(c.editor.playhead.time.value));
  return (
    <g class="head">
      <line x1={x} x2={x} y1={1} y2={useComputed(() => axes.value.y1)} stroke="var(--ink)" stroke-width={1.5} />
      <path
        d={useComputed(() => `M${x.value - 6} 0h12v6l-6 6-6-6z`)}
        fill="var(--ink)"
        stroke="var(--surface)"
        stroke-width={1.5}
      />
    </g>
  );
}

/** The playhead follows a press and drag, and keys in steps of 0.1 s. */
function useSeek(c: Context, size: ReadonlySignal<PlotSize>) {
  const on = useRef(false);
  /** Playhead before the last two presses: a double click restores it. */
  const before = useRef<readonly [number, number]>([0, 0]);
  const tenth = (t: number): number => Math.round(t * 10) / 10;
  const timeAt = (e: PointerEvent & { currentTarget: HTMLElement }): number => {
    const a = axesOf(c, size.peek());
    const x = e.clientX - e.currentTarget.getBoundingClientRect().left;
    return tenth(((x - X0) / (a.x1 - X0)) * a.duration);
  };
  const seek = (e: PointerEvent & { currentTarget: HTMLElement }) => {
    c.editor.playhead.moveTo(timeAt(e));
  };
  return {
    onPointerDown: (e: PointerEvent & { currentTarget: HTMLElement }) => {
      if ((e.target as Element).closest('.badge')) return;
      // Shift: a via point at the road user's place then.
      const a = c.editor.agent.peek();
      const added = e.shiftKey && a && canMove(a) ? addViaAt(c.editor, a, timeAt(e)) : null;
      if (added) {
        c.editor.commits.run(added.command);
        c.editor.takeVia(added.index);
        return;
      }
      c.curve.take(null);
      on.current = true;
      before.current = [before.current[1], c.editor.playhead.time.peek()];
      e.currentTarget.setPointerCapture(e.pointerId);
      c.editor.playhead.pause();
      seek(e);
    },
    onPointerMove: (e: PointerEvent & { currentTarget: HTMLElement }) => {
      if (on.current) seek(e);
    },
    onPointerUp: () => {
      on.current = false;
    },
    onDblClick: (e: MouseEvent & { currentTarget: HTMLElement }) => {
      if ((e.target as Element).closest('.badge')) return;
      const a = axesOf(c, size.peek());
      const r = e.currentTarget.getBoundingClientRect();
      const [x, y] = [e.clientX - r.left, e.clientY - r.top];
      if (c.signalEdges.lanes.peek().length) {
        c.editor.playhead.moveTo(before.current[0]);
        c.signalEdges.add(((x - X0) / (a.x1 - X0)) * a.duration);
        return;
      }
      const v = ((a.y1 - y) / (a.y1 - a.y0)) * a.top;
      const why = c.curve.why;
      c.editor.playhead.moveTo(before.current[0]);
      if (why) c.editor.notices.show({ text: why });
      else c.curve.add(((x - X0) / (a.x1 - X0)) * a.duration, Math.max(0, fromUnit(v, a.unit)));
    },
    onKeyDown: (e: KeyboardEvent) => {
      if (e.key !== 'ArrowLeft' && e.key !== 'ArrowRight') return;
      e.preventDefault();
      e.stopPropagation();
      const step = (e.key === 'ArrowLeft' ? -1 : 1) * (e.shiftKey ? 1 : 0.1);
      c.editor.playhead.pause();
      c.editor.playhead.moveTo(tenth(c.editor.playhead.time.peek() + step));
    },
  };
}
