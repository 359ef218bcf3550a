// The points of the speed curve: dragged up and down for speed, sideways for time; at zero they stick, and further down
// they extend a stop. Each is a slider for keys.
import { useRef } from 'preact/hooks';
import { fromUnit, inTenths, num, speedLabel, toUnit } from '../../model/base/units';
import type { SpeedPoint } from '../../model/document/profile';
import { useApp } from '../parts/app-context';
import type { Axes } from './axes';
import { TEXTS } from '../../texts/panels/timeline';

/** Above zero a point sticks to it, below zero the drag extends a stop, pixels. */
const STICK_PX = 6;
const HOLD_FROM_PX = 12;
/** Initial duration of a stop, seconds. */
const FIRST_HOLD_S = 1;
/** Grab distance of a point, pixels; larger for fingers. */
const REACH_PX = 11;
const REACH_FINGER_PX = 22;

interface PointGrip {
  readonly i: number;
  /** The point, the end of its hold, or the whole hold. */
  readonly what: 'point' | 'end' | 'hold';
  /** Time between the point and the grab, seconds. */
  readonly after: number;
  readonly moved: boolean;
}

export function SpeedPoints({ axes }: { axes: Axes }) {
  const { editor, form, curve } = useApp();
  const agent = editor.agent.value;
  const points = curve.points.value;
  const grip = useRef<PointGrip | null>(null);
  if (!agent || !points.length || agent.locked) return null;
  const speedAt = (y: number): number => {
    const a = axes;
    const v = ((a.y1 - y) / (a.y1 - a.y0)) * a.top;
    return y > a.y1 - STICK_PX ? 0 : Math.max(0, fromUnit(v, a.unit));
  };
  const timeAt = (x: number): number => ((x - axes.x(0)) / (axes.x1 - axes.x(0))) * axes.duration;
  const down = (i: number, what: PointGrip['what']) => (e: PointerEvent & { currentTarget: SVGElement }) => {
    if (e.button !== 0) return;
    e.stopPropagation();
    e.currentTarget.setPointerCapture(e.pointerId);
    const r = e.currentTarget.ownerSVGElement!.getBoundingClientRect();
    grip.current = { i, what, after: timeAt(e.clientX - r.left) - points[i].t, moved: false };
    curve.take(i);
  };
  const move = (e: PointerEvent & { currentTarget: SVGElement }) => {
    const g = grip.current;
    if (!g) return;
    e.stopPropagation();
    const r = e.currentTarget.ownerSVGElement!.getBoundingClientRect();
    const [x, y] = [e.clientX - r.left, e.clientY - r.top];
    const p = points[g.i];
    grip.current = { ...g, moved: true };
    if (g.what === 'hold') {
      curve.drag(g.i, { t: Math.round((timeAt(x) - g.after) * 10) / 10 });
      return;
    }
    if (g.what === 'end') {
      const step = e.shiftKey ? 1 : 0.1;
      curve.drag(g.i, { hold: Math.round((timeAt(x) - p.t) / step) * step });
      return;
    }
    const v = speedAt(y);
    const holds = v === 0 && (e.altKey || y > axes.y1 + HOLD_FROM_PX);
    const hold = v > 0 ? 0 : holds ? Math.max(p.hold, FIRST_HOLD_S) : p.hold;
    curve.drag(g.i, { v, hold, t: Math.round(timeAt(x) * 10) / 10 });
  };
  const up = (e: PointerEvent) => {
    const g = grip.current;
    if (!g) return;
    e.stopPropagation();
    grip.current = null;
    if (g.moved) curve.release();
  };
  const lost = () => {
    grip.current = null;
    curve.cancel();
  };
  const hear = { onPointerMove: move, onPointerUp: up, onPointerCancel: lost };
  const key = (i: number) => (e: KeyboardEvent) => {
    const p = points[i];
    const step = fromUnit(inTenths(axes.unit) ? 0.1 : 1, axes.unit) * (e.shiftKey ? 10 : 1);
    const dt = e.shiftKey ? 1 : 0.1;
    const to: Partial<SpeedPoint> | null =
      e.key === 'ArrowUp'
        ? { v: p.v + step, hold: 0 }
        : e.key === 'ArrowDown'
          ? { v: Math.max(0, p.v - step) }
          : e.key === 'ArrowRight'
            ? { t: p.t + dt }
            : e.key === 'ArrowLeft'
              ? { t: p.t - dt }
              : null;
    if (to) curve.set(i, to);
    else if (e.key === 'Delete' || e.key === 'Backspace') curve.remove(i);
    else if (e.key === 'Enter') curve.take(i);
    else if (!(e.key === 'Escape' && curve.cancel())) return;
    e.preventDefault();
    e.stopPropagation();
  };
  const reach = form.touch.value ? REACH_FINGER_PX : REACH_PX;
  return (
    <g class="points">
      {points.map((p, i) => {
        const x = axes.x(p.t);
        const y = axes.y(toUnit(p.v, axes.unit));
        const at = curve.point.value === i;
        const last = i === points.length - 1;
        const xe = axes.x(Math.min(axes.duration, p.t + p.hold));
        return (
          <g key={i}>
            {p.hold > 0 ? (
              <g class="hold" onPointerDown={down(i, 'hold')} {...hear}>
                <rect class="held" x={x} y={axes.y0} width={Math.max(0, xe - x)} height={axes.y1 - axes.y0} />
                <rect x={x} y={y - reach} width={Math.max(0, xe - x)} height={2 * reach} fill="transparent" />
                <line class="holdline" x1={x} y1={y} x2={xe} y2={y} />
              </g>
            ) : null}
            {p.hold > 0 ? (
              <g class="holdend" onPointerDown={down(i, 'end')} {...hear}>
                <rect x={xe - reach} y={axes.y1 - 26} width={2 * reach} height={30} fill="transparent" />
                <rect class="holdbar" x={xe - 3} y={y - 9} width={6} height={18} rx={3} />
                <text class="back" x={(x + xe) / 2} y={y - 12} text-anchor="middle">
                  {TEXTS.holdsS(num(p.hold, 1))}
                </text>
              </g>
            ) : null}
            <g
              class={`point ${i ? (last ? 'goal' : 'own') : 'start'} ${at ? 'on' : ''}`}
              role="slider"
              tabindex={0}
              aria-label={i ? (last ? TEXTS.speedAtTheEnd : TEXTS.speedPoint(i)) : TEXTS.speedAtTheStart}
              aria-valuemin={0}
              aria-valuemax={Math.round(toUnit(60, axes.unit))}
              aria-valuenow={Math.round(toUnit(p.v, axes.unit))}
              aria-valuetext={wordsOf(p, axes)}
              onPointerDown={down(i, 'point')}
              onKeyDown={key(i)}
              onFocus={() => curve.take(i)}
              {...hear}
            >
              <circle cx={x} cy={y} r={reach} fill="transparent" />
              <circle class="dot" cx={x} cy={y} r={at ? 6 : 5} />
            </g>
          </g>
        );
      })}
    </g>
  );
}

const wordsOf = (p: SpeedPoint, axes: Axes): string =>
  p.hold
    ? TEXTS.forSAtS(speedLabel(p.v, axes.unit), num(p.hold, 1), num(p.t, 1))
    : TEXTS.atS(speedLabel(p.v, axes.unit), num(p.t, 1));
