// The phases of the picked signal over time. Each edge is dragged, and is a slider for keys.
import { useRef } from 'preact/hooks';
import { num } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { X0, type Axes } from './axes';
import { TEXTS } from '../../texts/panels/map-item';

/** Height of the strip, and grab distance of an edge, pixels; larger for fingers. */
const STRIP_PX = 18;
const REACH_PX = 8;
const REACH_FINGER_PX = 22;
/** Characters of a phase's words are about this wide, pixels. */
const LETTER_PX = 6;

const FILL = { stop: '--collision', caution: '--near', go: '--ok', unknown: '--surface-3' } as const;
const INK = { stop: '--on-collision', caution: '--on-near', go: '--surface', unknown: '--ink-2' } as const;

export function PhaseStrip({ axes }: { axes: Axes }) {
  const { form, signalEdges } = useApp();
  const phases = signalEdges.phases.value;
  const grip = useRef<number | null>(null);
  if (!phases.length) return null;
  const y = axes.y0;
  const timeAt = (e: PointerEvent & { currentTarget: SVGElement }): number => {
    const x = e.clientX - e.currentTarget.ownerSVGElement!.getBoundingClientRect().left;
    const t = ((x - axes.x(0)) / (axes.x1 - axes.x(0))) * axes.duration;
    return e.shiftKey ? Math.round(t) : t;
  };
  const down = (i: number) => (e: PointerEvent & { currentTarget: SVGElement }) => {
    if (e.button !== 0) return;
    e.stopPropagation();
    e.currentTarget.setPointerCapture(e.pointerId);
    grip.current = i;
  };
  const move = (e: PointerEvent & { currentTarget: SVGElement }) => {
    if (grip.current === null) return;
    e.stopPropagation();
    signalEdges.drag(grip.current, timeAt(e));
  };
  const up = (e: PointerEvent) => {
    if (grip.current === null) return;
    e.stopPropagation();
    grip.current = null;
    signalEdges.release();
  };
  const lost = () => {
    grip.current = null;
    signalEdges.cancel();
  };
  const key = (i: number) => (e: KeyboardEvent) => {
    const step = (e.key === 'ArrowLeft' || e.key === 'ArrowDown' ? -1 : 1) * (e.shiftKey ? 1 : 0.1);
    if (e.key.startsWith('Arrow')) signalEdges.set(i, phases[i].from + step);
    else if (e.key === 'Delete' || e.key === 'Backspace') signalEdges.remove(i);
    else if (!(e.key === 'Escape' && signalEdges.cancel())) return;
    e.preventDefault();
    e.stopPropagation();
  };
  const reach = form.touch.value ? REACH_FINGER_PX : REACH_PX;
  return (
    <g class="phases" role="group" aria-label={TEXTS.phasesOfTheSignal}>
      <text x={X0 - 8} y={y + 13} text-anchor="end">
        {TEXTS.kinds.signal}
      </text>
      {phases.map((p, i) => {
        const [x, w] = [axes.x(p.from), Math.max(0, axes.x(p.to) - axes.x(p.from))];
        const words = TEXTS.lights[p.light];
        return (
          <g key={i} class="phase">
            <rect x={x} y={y} width={w} height={STRIP_PX} fill={`var(${FILL[p.light]})`} />
            {w > words.length * LETTER_PX + 12 ? (
              <text x={x + 8} y={y + 13} style={{ fill: `var(${INK[p.light]})` }}>
                {words}
              </text>
            ) : null}
          </g>
        );
      })}
      {phases.slice(1).map((p, k) => {
        const x = axes.x(p.from);
        return (
          <g
            key={k}
            class="edge"
            role="slider"
            tabindex={0}
            aria-label={TEXTS.edge(TEXTS.lights[phases[k].light], TEXTS.lights[p.light])}
            aria-valuemin={0}
            aria-valuemax={axes.duration}
            aria-valuenow={Number(p.from.toFixed(1))}
            aria-valuetext={TEXTS.atTime(num(p.from, 1))}
            onPointerDown={down(k + 1)}
            onPointerMove={move}
            onPointerUp={up}
            onPointerCancel={lost}
            onKeyDown={key(k + 1)}
          >
            <rect x={x - reach} y={y - 4} width={2 * reach} height={STRIP_PX + 8} fill="transparent" />
            <rect class="bar" x={x - 3} y={y - 3} width={6} height={STRIP_PX + 6} rx={3} />
          </g>
        );
      })}
    </g>
  );
}
