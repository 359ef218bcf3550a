// Remedies for an event: a future of one of the two without the conflict, or a slower start.
import { markOf } from '../../model/document/future-facts';
import { choose } from '../../model/document/commands';
import type { TrafficEvent } from '../../model/words/event-words';
import { LETTERS, type Future } from '../../model/document/futures';
import { canMove, startPose, type Agent } from '../../model/document/scene';
import { speedLabel } from '../../model/base/units';
import type { Editor } from '../session/editor';
import { withField } from './moves';
import type { Remedy } from './remedies';
import { TEXTS } from '../../texts/editing/moves';

/** A slower start delays the arrival at the place by this, seconds. */
const LATER_S = 2;
/** A start below this speed is not slowed further, m/s. */
const LEAST_MPS = 1;
/** An event earlier than this is not prevented by a slower start, seconds. */
const SOON_S = 0.5;

export function eventRemedies(e: Editor, ev: TrafficEvent): Remedy[] {
  const scene = e.scene.value;
  const both = [ev.a, ev.b].flatMap((a) => (a && scene?.agents.get(a.id)) ?? []).filter(canMove);
  return both.flatMap((a) => [otherFuture(e, a), slowerStart(e, a, ev)].flatMap((r) => r ?? []));
}

/** Is it without faults other than a missed goal? */
const isFine = ({ about }: Future): boolean => !!about && ['ok', 'short'].includes(markOf(about));

/** The likeliest of its futures without faults. */
function otherFuture(e: Editor, a: Agent): Remedy | null {
  const f = e.answers.motion.value.futures.get(a.id);
  if (!f || f.sketch || e.answers.motion.value.stale) return null;
  const shown = a.chosen ?? f.chosen;
  const good = f.modes.map((m, i) => ({ m, i })).filter(({ m, i }) => i !== shown && isFine(m));
  const best = good.sort((p, q) => q.m.probability - p.m.probability)[0];
  if (!best) return null;
  const letter = LETTERS[best.i];
  return {
    label: `${a.name}: ${best.m.name}`,
    note: TEXTS.future(letter),
    icon: 'check',
    primary: true,
    command: choose(a, best.i, letter),
  };
}

/** The start speed that, held constant, reaches the place later. */
function slowerStart(e: Editor, a: Agent, ev: TrafficEvent): Remedy | null {
  const v = startPose(a)?.speed ?? 0;
  if (v < LEAST_MPS || ev.time < SOON_S) return null;
  const speed = (v * ev.time) / (ev.time + LATER_S);
  return {
    label: TEXTS.startOneSlower(a.name),
    note: speedLabel(speed, e.view.unitOf(a)),
    icon: 'clock',
    primary: false,
    command: withField(a, 'start', { speed }),
  };
}
