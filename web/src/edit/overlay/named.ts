// Names at the road users that the panel names besides the selected one, which has an outline and is the panel's title.
import type { Pen } from '../../draw/pen';
import { counted } from '../../model/physics/events';
import type { Pose } from '../../model/base/geometry';
import type { Agent } from '../../model/document/scene';
import { pill, type Labels } from '../../draw/labels';
import { boxOnScreen, sizeOnScreen } from '../../draw/sprites';
import type { View } from '../../draw/view';
import { verdictsHold } from '../moves/goal-verdict';
import type { Editor } from '../session/editor';
import { labelledChanges, namesAll } from './picture';

/** More names would cover the road users; the panel is complete. */
const MOST_NAMES = 6;
/** Number of events whose road users are named while nothing is selected. */
const MOST_EVENTS = 3;

export type NamedIn = Pick<
  Editor,
  'agent' | 'answers' | 'drag' | 'hover' | 'playhead' | 'reading' | 'scene' | 'selected' | 'selectedEvent' | 'view'
>;

/** Ids of the road users that the panel names now, in the order of its texts. */
export function namedNow(e: NamedIn): string[] {
  const picked = e.selectedEvent.value;
  const a = e.agent.value;
  const changes = e.drag.active.value
    ? e.view.showPreviewed.value
      ? (e.answers.previewed.value ?? [])
      : []
    : e.answers.changes.value;
  const met = a && verdictsHold(e) && !e.reading.replays.value ? (e.reading.futures.value?.modes ?? []) : [];
  const events = e.selected.value.length ? [] : counted(e.reading.events.value).slice(0, MOST_EVENTS);
  const all = [
    ...(a ? [a.id, e.reading.named.value ?? a.id] : []),
    ...[...(picked ? [picked] : []), ...events].flatMap((ev) => [ev.a.id, ...(ev.b ? [ev.b.id] : [])]),
    ...changes.map((c) => c.id),
    ...met.flatMap((m) => m.about?.faults[0]?.with ?? []),
  ];
  return [...new Set(all)].filter((id) => e.scene.value?.agents.has(id)).slice(0, MOST_NAMES);
}

export class NamesOverlay {
  constructor(
    private readonly editor: NamedIn,
    private readonly labels: Labels,
    private readonly poseNow: (a: Agent) => Pose | null,
  ) {}

  /** `but`: ids of those that another label names. */
  paint(g: Pen, v: View, but: readonly string[]): void {
    const { editor: e } = this;
    const reacting = labelledChanges(e).map((c) => c.id);
    const spoken = e.reading.named.value;
    for (const id of namedNow(e)) {
      const a = e.scene.value!.agents.get(id)!;
      const p = this.poseNow(a);
      const isNamed = id !== spoken && namesAll(e, v) && !a.parked && !reacting.includes(id);
      if (!p || id === e.agent.value?.id || but.includes(id) || isNamed) continue;
      const half = boxOnScreen(v, a, p).h / 2;
      const [l] = sizeOnScreen(a, v.z);
      pill(g, this.labels, ...v.to(p.x, p.y), a.name, {
        weight: 500,
        must: id === spoken,
        tries: [
          [-24, -half - 26],
          [-24, half + 6],
          [l / 2 + 8, -10],
          [-l / 2 - 60, -10],
          [-24, -half - 46],
          [-24, half + 26],
        ],
      });
    }
  }
}
