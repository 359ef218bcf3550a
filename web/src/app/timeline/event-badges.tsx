// Events above the plot, each sign at its time. Events of the recording are small and grey and take no room.
import { goToEvent } from '../../actions/time';
import { counted } from '../../model/physics/events';
import type { TrafficEvent } from '../../model/words/event-words';
import { useApp } from '../parts/app-context';
import { eventsShown, placeSigns, SIGN, X0, type Axes, type PlacedSign } from './axes';
import { TEXTS } from '../../texts/panels/timeline';

const RANK = { collision: 0, rule: 1, near: 2, short: 3 } as const;
const FILL = { collision: '--collision', rule: '--near', near: '--near', short: '--surface-3' } as const;
const INK = { collision: '--on-collision', rule: '--on-near', near: '--on-near', short: '--ink-2' } as const;

/** Estimated width of a sign's words, with the space after them. */
const wordsWidth = (text: string): number => text.length * 5.4 + 8;

export function EventBadges({ axes: a }: { axes: Axes }) {
  const all = eventsShown(useApp());
  const events = counted(all);
  const signs = events.map((e) => ({ at: a.x(e.time), w: wordsWidth(e.label), rank: RANK[e.kind] }));
  const placed = placeSigns(signs, X0 + 2, a.x1 + SIGN);
  return (
    <>
      {all
        .filter((e) => e.inLog)
        .map((e, i) => (
          <LogSign key={`log${i}`} event={e} x={a.x(e.time)} />
        ))}
      {placed.map((p, i) => (
        <Badge key={i} events={p.items.map((k) => events[k])} shown={events[p.item]} placed={p} />
      ))}
    </>
  );
}

function LogSign({ event: e, x }: { event: TrafficEvent; x: number }) {
  const c = useApp();
  const label = TEXTS.inTheLog(e.label, e.title);
  return (
    <g class="badge log" role="button" aria-label={label} onClick={() => goToEvent(c, e)}>
      <title>{label}</title>
      <circle cx={x} cy={12} r={4.5} fill="var(--surface)" stroke="var(--line-strong)" stroke-width={1.5} />
    </g>
  );
}

interface BadgeProps {
  /** All that share the place, by time. */
  events: readonly TrafficEvent[];
  shown: TrafficEvent;
  placed: PlacedSign;
}

function Badge({ events, shown: e, placed: p }: BadgeProps) {
  const c = useApp();
  const picked = c.editor.selectedEvent.peek();
  const more = events.length - 1;
  const label = `${e.label}: ${e.title}${more ? TEXTS.andMore(more) : ''}`;
  // A second click goes to the next one that shares the place.
  const turn = events.indexOf(picked!) < 0 ? events.indexOf(e) : events.indexOf(picked!) + 1;
  const to = events[turn % events.length];
  // Events of a case or a variant are not events of the current scene.
  const elsewhere = () => c.editor.view.beside.peek()?.meeting ?? c.variants.comparing.compared.peek();
  const go = () => (elsewhere() ? c.editor.playhead.moveTo(to.time) : goToEvent(c, to));
  const w = p.words ? wordsWidth(e.label) : 0;
  const x = p.x - SIGN - (p.words === 'left' ? w : 0);
  const ink = `var(${INK[e.kind]})`;
  return (
    <g class="badge" role="button" aria-label={label} onClick={go}>
      <title>{label}</title>
      <rect
        x={x}
        y={3}
        width={2 * SIGN + w}
        height={18}
        rx={9}
        fill={`var(${FILL[e.kind]})`}
        stroke={picked && events.includes(picked) ? 'var(--ink)' : 'none'}
        stroke-width={2}
      />
      <g transform={`translate(${p.x} 12)`}>
        <SignPath kind={e.kind} ink={ink} />
      </g>
      {p.words ? (
        <text
          x={p.words === 'right' ? p.x + SIGN - 1 : p.x - SIGN + 1}
          y={15.5}
          text-anchor={p.words === 'right' ? 'start' : 'end'}
          style={{ fill: ink }}
        >
          {e.label}
        </text>
      ) : null}
      {more ? <More x={p.x + (p.words === 'left' ? SIGN - 1 : 1 - SIGN)} count={more + 1} /> : null}
    </g>
  );
}

/** Number that share the place, at the outer edge of the sign. */
function More({ x, count }: { x: number; count: number }) {
  return (
    <>
      <circle cx={x} cy={5} r={5.5} fill="var(--ink)" stroke="var(--surface)" stroke-width={1} />
      <text class="more" x={x} y={8} text-anchor="middle">
        {count}
      </text>
    </>
  );
}

function SignPath({ kind, ink }: { kind: TrafficEvent['kind']; ink: string }) {
  const line = { fill: 'none', stroke: ink, 'stroke-width': 1.7, 'stroke-linecap': 'round' } as const;
  switch (kind) {
    case 'collision':
      return <path d="M-3 -3l6 6M3 -3l-6 6" {...line} stroke-width={2} />;
    case 'rule':
      return <path d="M0 -4.200a4.200 4.200 0 1 0 .01 0zM-2.900 2.900l5.800 -5.800" {...line} />;
    case 'near':
      return <path d="M0 -4.500l4.200 8h-8.400z" fill={ink} />;
    case 'short':
      return <path d="M-3 4.500v-9l7.500 1.700 -2 2 2 2 -7.500 -.2" {...line} stroke-dasharray="2.200 2.400" />;
  }
}
