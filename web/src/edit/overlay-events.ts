// Events on the overlay: rings around those in one at the playhead, and a label at the one that is picked.
import type { Pen } from '../draw/pen';
import type { TrafficEvent } from '../model/words/event-words';
import type { Pose } from '../model/base/geometry';
import { poseAt } from '../model/base/motion';
import type { Agent } from '../model/document/scene';
import { seconds } from '../model/base/units';
import { paintIcon, tag, type Labels, type PillStyle } from '../draw/labels';
import { paintGhost, paintRing } from '../draw/handles';
import { colourKey, stamp } from '../draw/sprites';
import { trail } from '../draw/strokes';
import { colours } from '../draw/theme';
import type { View } from '../draw/view';
import type { Editor } from './editor';
import { TEXTS } from '../texts/editing/picture';

/** An event is shown this long before and after it. */
const NEAR_S = 0.45;
/** So many events of another time are shown beside the one that is picked. */
const MOST_ELSEWHERE = 3;

const isNow = (ev: TrafficEvent, t: number): boolean =>
  t >= ev.time - NEAR_S && t <= Math.max(ev.time, ev.until) + NEAR_S;

export class EventsOverlay {
  constructor(
    private readonly editor: Editor,
    private readonly labels: Labels,
    private readonly poseNow: (a: Agent) => Pose | null,
  ) {}

  paint(g: Pen, v: View): void {
    const { editor: e } = this;
    const picked = e.selectedEvent.value;
    const t = e.time.value;
    const pose = (a: Agent): Pose | null => this.poseNow(this.now(a));
    if (picked) this.paintPicked(g, v, picked);
    for (const ev of e.events.value) {
      // What is in the log shows itself only when somebody asks.
      if (ev !== picked && (ev.inLog || !isNow(ev, t))) continue;
      paintMarks(g, v, this.labels, ev, isNow(ev, t) ? pose : null);
      if (!this.saidOnLine(ev)) paintLabel(g, v, this.labels, ev);
    }
  }

  private now(a: Agent): Agent {
    return this.editor.scene.value!.agents.get(a.id) ?? a;
  }

  /** How those in the picked event come to it and go on, and who is in others, where they are then. */
  private paintPicked(g: Pen, v: View, picked: TrafficEvent): void {
    const { editor: e } = this;
    for (const [who, width] of [
      [picked.b, 1.6],
      [picked.a, 2.5],
    ] as const) {
      // The futures of who is selected are there already.
      if (!who || (who.id === e.selection.value && e.layers.value.futures)) continue;
      const a = this.now(who);
      trail(g, v, e.motionFor(a), { colour: colours()[colourKey(a)], width, halo: true, dots: width > 2 });
      const now = this.poseNow(a);
      if (now) stamp(g, v, a, now, true);
      g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    }
    const elsewhere = e.events.value.filter((ev) => ev !== picked && !ev.inLog && !isNow(ev, e.time.value));
    for (const ev of elsewhere.slice(0, MOST_ELSEWHERE)) {
      for (const who of [ev.a, ev.b]) {
        const then = who && poseAt(e.motionFor(this.now(who)), ev.time);
        if (then) paintGhost(g, v, who, then, colourOf(ev), ev.kind === 'near' ? colours()['near-soft'] : null, [5, 3]);
      }
      paintLabel(g, v, this.labels, ev);
    }
  }

  /** The words stand on the line of the selected road user already. */
  private saidOnLine(ev: TrafficEvent): boolean {
    const { editor: e } = this;
    if (!e.layers.value.futures || (ev.a.id !== e.selection.value && ev.b?.id !== e.selection.value)) return false;
    const faults = e.futures.value?.modes[e.chosen.value]?.about?.faults ?? [];
    return faults.some((f) => f.kind === ev.what && Math.abs(f.time - ev.time) < NEAR_S);
  }
}

/** What happens at a time, with its words. */
export function paintEventsAt(
  g: Pen,
  v: View,
  labels: Labels,
  events: readonly TrafficEvent[],
  time: number,
  poseOf: (a: Agent) => Pose | null,
): void {
  for (const ev of events) {
    if (ev.inLog || !isNow(ev, time)) continue;
    paintMarks(g, v, labels, ev, poseOf);
    paintLabel(g, v, labels, ev);
  }
}

/** Rings around those in it, and a cross where they meet. */
function paintMarks(
  g: Pen,
  v: View,
  labels: Labels,
  ev: TrafficEvent,
  poseOf: ((a: Agent) => Pose | null) | null,
): void {
  for (const a of poseOf ? [ev.a, ev.b] : []) {
    const p = a && poseOf?.(a);
    if (p) paintRing(g, v, a, p, colourOf(ev), 2, 3);
  }
  if (ev.kind !== 'collision' || ev.inLog) return;
  const c = colours();
  const [x, y] = v.to(ev.at[0], ev.at[1]);
  g.beginPath();
  g.arc(x, y, 10, 0, Math.PI * 2);
  g.fillStyle = c.collision;
  g.strokeStyle = c.halo;
  g.lineWidth = 2.5;
  g.stroke();
  g.fill();
  paintIcon(g, 'cross', x, y, c['on-collision']);
  labels.block(x - 12, y - 12, 24, 24);
}

function paintLabel(g: Pen, v: View, labels: Labels, ev: TrafficEvent): void {
  const text =
    ev.kind === 'collision'
      ? TEXTS.collision(ev.title)
      : ev.b
        ? `${seconds(ev.time)} · ${ev.short}`
        : `${seconds(ev.time)} · ${ev.title}, ${ev.short}`;
  tag(g, labels, v.to(ev.at[0], ev.at[1]), ev.inLog ? TEXTS.inTheLog(text) : text, {
    ...styleOf(ev),
    radii: [44, 60, 84],
    height: 22,
  });
}

function colourOf(ev: TrafficEvent): string {
  const c = colours();
  if (ev.inLog || ev.kind === 'short') return c.log;
  return ev.kind === 'collision' ? c.collision : c['near-edge'];
}

const ICONS = { collision: 'cross', near: 'triangle', rule: 'bar', short: 'flag' } as const;

function styleOf(ev: TrafficEvent): PillStyle {
  const c = colours();
  const icon = ICONS[ev.kind];
  if (ev.inLog || ev.kind === 'short') return { fg: c['ink-2'], leader: c.log, icon };
  return ev.kind === 'collision'
    ? { bg: c.collision, fg: c['on-collision'], leader: c.collision, icon }
    : { bg: c.near, fg: c['on-near'], leader: c['near-text'], icon };
}
