// Collisions and near misses above the plot; where they crowd, as signs without words.
import type { TrafficEvent } from '../../model/events';
import { goToEvent } from '../inspector/event-list';
import { useApp } from '../parts/app-context';
import { sideBySide, X0, type Axes } from './axes';

const SIGN_PX = 20;
/** Estimated width of a badge: its letters and the sign before them. */
const fullWidth = (e: TrafficEvent): number => e.label.length * 5.9 + 26;
/** Beyond this share of the lane the words are left out. */
const CROWDED = 0.8;

export function EventBadges({ axes: a }: { axes: Axes }) {
  const { editor } = useApp();
  const events = editor.events.peek();
  const crowded = events.reduce((sum, e) => sum + fullWidth(e) + 3, 0) > (a.x1 - X0) * CROWDED;
  const widths = events.map((e) => (crowded ? SIGN_PX : fullWidth(e)));
  const places = sideBySide(
    events.map((e, i) => ({ at: a.x(e.time), w: widths[i] })),
    X0 + 2,
    a.x1 - 2,
  );
  return (
    <>
      {events.map((e, i) => (
        <Badge key={i} event={e} x={places[i]} width={widths[i]} words={!crowded} />
      ))}
    </>
  );
}

function Badge({ event: e, x, width, words }: { event: TrafficEvent; x: number; width: number; words: boolean }) {
  const c = useApp();
  const picked = c.editor.selectedEvent.peek() === e;
  const label = `${e.label}: ${e.title}`;
  return (
    <g class="badge" role="button" aria-label={label} onClick={() => goToEvent(c, e)}>
      <title>{label}</title>
      <rect
        x={x}
        y={3}
        width={width}
        height={18}
        rx={9}
        fill={`var(--${e.kind})`}
        stroke={picked ? 'var(--ink)' : 'none'}
        stroke-width={2}
      />
      {e.kind === 'collision' ? (
        <path
          d={`M${x + 7} 9l6 6M${x + 13} 9l-6 6`}
          stroke="var(--on-collision)"
          stroke-width={2}
          stroke-linecap="round"
        />
      ) : (
        <path d={`M${x + 10} 7.500l4.200 8h-8.400z`} fill="var(--on-near)" />
      )}
      {words ? (
        <text x={x + 20} y={15.5} style={{ fill: `var(--on-${e.kind})` }}>
          {e.label}
        </text>
      ) : null}
    </g>
  );
}
