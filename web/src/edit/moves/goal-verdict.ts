// Is the goal of a road user reachable? The generator's verdict where known, otherwise a quick estimate.
import { markOf } from '../../model/document/future-facts';
import type { Point } from '../../model/base/geometry';
import { isBlocked, type Reach } from '../../model/document/futures';
import { reachWords } from '../../model/words/reach-words';
import { nameIn, type Agent } from '../../model/document/scene';
import { metres } from '../../model/base/units';
import type { Editor } from '../session/editor';
import { TEXTS } from '../../texts/editing/picture';

/** Why a goal is unreachable, and the nearest reachable place. */
export interface OutOfReach {
  readonly title: string;
  readonly words: string;
  readonly nearest: (Point & { readonly heading: number }) | null;
  /** A more serious fault is reported first. */
  readonly outranked?: boolean;
}

/** The generator's verdict on the current goal; during a drag, on the dragged goal. */
export function knownReach(e: Pick<Editor, 'answers' | 'drag' | 'reading' | 'scene'>, a: Agent): Reach | null {
  const live = e.answers.liveReach.value;
  if (live?.id === a.id && !live.moved) return live.reach;
  const m = e.answers.motion.value;
  return e.drag.active.value || m.stale ? null : (m.reach.get(a.id) ?? null);
}

/** Do the shown futures answer the current document? During a drag, futures from before it do not. */
export const verdictsHold = (e: Pick<Editor, 'answers' | 'drag' | 'reading' | 'scene'>): boolean =>
  !e.reading.outdated.value &&
  !e.reading.futures.value?.sketch &&
  !e.reading.futures.value?.unjudged &&
  (!e.drag.active.value || e.answers.draft.value !== null);

/** Does the shown future collide? That is more specific than a blocked goal. */
function collides(e: Pick<Editor, 'answers' | 'drag' | 'reading' | 'scene'>): boolean {
  const about = verdictsHold(e) ? e.reading.futures.value?.modes[e.reading.chosen.value]?.about : null;
  return !!about && markOf(about) === 'collision';
}

/** The road user that the shown future yields to; used where the verdict on the goal does not name the blocking one. */
const waitsFor = (e: Pick<Editor, 'answers' | 'drag' | 'reading' | 'scene'>): string | null =>
  verdictsHold(e) ? (e.reading.futures.value?.modes[e.reading.chosen.value]?.about?.relations[0]?.with ?? null) : null;

/** Null when the goal is reachable or nothing is known. */
export function outOfReach(e: Pick<Editor, 'answers' | 'drag' | 'reading' | 'scene'>, a: Agent): OutOfReach | null {
  const known = knownReach(e, a);
  if (known) {
    if (known.status !== 'unreachable') return null;
    const words = reachWords({ ...known, with: known.with ?? waitsFor(e) }, a.goal, nameIn(e.scene.value!));
    return { ...words, nearest: known.nearest, outranked: isBlocked(known) && collides(e) };
  }
  const local = e.reading.localReach.value;
  return local && local.kind !== 'ok' ? local : null;
}

/** The nearest goal by the road, and its offset from the set one. */
export interface RoadGoal extends Point {
  readonly heading: number;
  readonly words: string;
}

/** An offset below this is the same goal, metres. */
const LEAST_M = 1;

export function roadGoal(e: Pick<Editor, 'answers' | 'drag' | 'reading' | 'scene'>, a: Agent): RoadGoal | null {
  // The road does not move: the last verdict holds until the next answer.
  const live = e.answers.liveReach.value;
  const to = (live?.id === a.id ? live.reach : knownReach(e, a))?.byRoad;
  if (!to || !a.goal.pos) return null;
  const dx = to.x - a.goal.pos[0],
    dy = to.y - a.goal.pos[1];
  // During a drag the goal has moved since the answer.
  const distance = Math.hypot(dx, dy);
  // Within this distance it is the goal itself.
  if (distance < LEAST_M) return null;
  const ahead = dx * Math.cos(to.heading) + dy * Math.sin(to.heading);
  const side = ahead < -distance / 2 ? TEXTS.beforeTheGoal : TEXTS.besideTheGoal;
  const where = ahead > distance / 2 ? TEXTS.pastTheGoal : side;
  return { x: to.x, y: to.y, heading: to.heading, words: TEXTS.byRoad(metres(distance, 0), where) };
}
