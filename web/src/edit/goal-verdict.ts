// Can the goal of a road user be reached? The generator's verdict where it is known, the quick one while it is not.
import { markOf } from '../model/document/future-facts';
import type { Point } from '../model/base/geometry';
import { isBlocked, type Reach } from '../model/document/futures';
import { reachWords } from '../model/words/reach-words';
import { nameIn, type Agent } from '../model/document/scene';
import { metres } from '../model/base/units';
import type { Editor } from './editor';
import { TEXTS } from '../texts/editing/picture';

/** Why a goal cannot be reached, and the nearest place that can. */
export interface OutOfReach {
  readonly title: string;
  readonly words: string;
  readonly nearest: (Point & { readonly heading: number }) | null;
  /** Something worse is to be said first. */
  readonly outranked?: boolean;
}

/** What the generator said of the goal as it is now; during a drag, of the goal as it is dragged. */
export function knownReach(e: Editor, a: Agent): Reach | null {
  const live = e.liveReach.value;
  if (live?.id === a.id && !live.moved) return live.reach;
  const m = e.motion.value;
  return e.dragging.value || m.stale ? null : (m.reach.get(a.id) ?? null);
}

/** Are the futures on screen an answer to the document as it is? In a drag those from before it are none. */
export const verdictsHold = (e: Editor): boolean =>
  !e.outdated.value &&
  !e.futures.value?.sketch &&
  !e.futures.value?.unjudged &&
  (!e.dragging.value || e.draft.value !== null);

/** Does the shown future run into somebody? That says more than that somebody is in the way. */
function collides(e: Editor): boolean {
  const about = verdictsHold(e) ? e.futures.value?.modes[e.chosen.value]?.about : null;
  return !!about && markOf(about) === 'collision';
}

/** Whom the shown future stands to first: who is in the way, where the verdict on the goal does not say. */
const waitsFor = (e: Editor): string | null =>
  verdictsHold(e) ? (e.futures.value?.modes[e.chosen.value]?.about?.relations[0]?.with ?? null) : null;

/** Null when the goal can be reached, as far as anybody knows. */
export function outOfReach(e: Editor, a: Agent): OutOfReach | null {
  const known = knownReach(e, a);
  if (known) {
    if (known.status !== 'unreachable') return null;
    const words = reachWords({ ...known, with: known.with ?? waitsFor(e) }, a.goal, nameIn(e.scene.value!));
    return { ...words, nearest: known.nearest, outranked: isBlocked(known) && collides(e) };
  }
  const local = e.localReach.value;
  return local && local.kind !== 'ok' ? local : null;
}

/** The nearest goal by the road, and where it lies from the one that is set. */
export interface RoadGoal extends Point {
  readonly heading: number;
  readonly words: string;
}

/** Less than this beside the goal is no other goal, metres. */
const LEAST_M = 1;

export function roadGoal(e: Editor, a: Agent): RoadGoal | null {
  // The road stays where it is: what was said a moment ago holds until the next answer.
  const live = e.liveReach.value;
  const to = (live?.id === a.id ? live.reach : knownReach(e, a))?.byRoad;
  if (!to || !a.goal.pos) return null;
  const dx = to.x - a.goal.pos[0],
    dy = to.y - a.goal.pos[1];
  // In a drag the goal has moved on since the answer.
  const distance = Math.hypot(dx, dy);
  // That near it is the goal itself.
  if (distance < LEAST_M) return null;
  const ahead = dx * Math.cos(to.heading) + dy * Math.sin(to.heading);
  const where = ahead > distance / 2 ? TEXTS.furtherOn : ahead < -distance / 2 ? TEXTS.beforeIt : TEXTS.besideIt;
  return { x: to.x, y: to.y, heading: to.heading, words: TEXTS.byTheRoad(metres(distance, 0), where) };
}
