// The grid of the plot with its figures, and the lane of events.
import { Fragment } from 'preact';
import { counted } from '../../model/physics/events';
import { num } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { eventsShown, hasCurves, LANE, markedSpan, X0, type Axes } from './axes';
import { TEXTS } from '../../texts/panels/timeline';

/** Least marked seconds behind the curves. */
const MARKED_S = { collision: 0.3, rule: 0.3, near: 0.8 } as const;
const COLOURS = { collision: '--collision', rule: '--near', near: '--near' } as const;

export function Grid({ axes: a }: { axes: Axes }) {
  return (
    <>
      <rect x={X0} y={2} width={Math.max(0, a.x1 - X0)} height={LANE - 4} rx={4} fill="var(--surface-2)" />
      <text x={X0 - 8} y={16} text-anchor="end">
        {TEXTS.events}
      </text>
      {hasCurves(a) ? <SpeedLines axes={a} /> : null}
      <SecondLines axes={a} />
    </>
  );
}

function SpeedLines({ axes: a }: { axes: Axes }) {
  return (
    <>
      {[0, 0.5, 1].map((share) => {
        const v = a.top * share;
        const y = Math.round(a.y(v)) + 0.5;
        return (
          <Fragment key={share}>
            <line class="grid" x1={X0} x2={a.x1} y1={y} y2={y} />
            <text x={X0 - 8} y={y + 3.5} text-anchor="end">
              {num(v, Number.isInteger(v) ? 0 : 1)}
            </text>
          </Fragment>
        );
      })}
    </>
  );
}

function SecondLines({ axes: a }: { axes: Axes }) {
  const last = Math.floor(a.duration + 1e-6);
  return (
    <>
      {Array.from({ length: last + 1 }, (_, t) => {
        const x = Math.round(a.x(t)) + 0.5;
        return (
          <Fragment key={t}>
            <line class="grid" x1={x} x2={x} y1={a.y0} y2={a.y1} opacity={t ? 0.6 : 1} />
            <text x={x} y={a.height - 5} text-anchor={t === last ? 'end' : t ? 'middle' : 'start'}>
              {t === last ? `${t} s` : t}
            </text>
          </Fragment>
        );
      })}
    </>
  );
}

/** Times of events of the road user with the curves, marked behind them; without one, of all. */
export function EventTimes({ axes: a }: { axes: Axes }) {
  const c = useApp();
  const id = c.variants.comparing.compared.peek() ? null : c.editor.selection.peek();
  return (
    <>
      {counted(eventsShown(c)).map((e, i) => {
        if (e.kind === 'short' || (id !== null && e.a.id !== id && e.b?.id !== id)) return null;
        const [from, to] = markedSpan(e.time, e.until, MARKED_S[e.kind], a.duration);
        return (
          <rect
            key={i}
            x={a.x(from)}
            y={a.y0}
            width={Math.max(0, a.x(to) - a.x(from))}
            height={a.y1 - a.y0}
            fill={`var(${COLOURS[e.kind]})`}
            opacity={0.16}
          />
        );
      })}
    </>
  );
}
