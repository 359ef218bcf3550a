// The verdict on a road user's goal in words: whether it is reachable, whether it was reached.
import type { Context } from '../../actions/context';
import { markOf, type Mark } from '../../model/document/future-facts';
import { comparedWithLog } from '../../model/words/change-words';
import { counted, worstOf } from '../../model/physics/events';
import type { TrafficEvent } from '../../model/words/event-words';
import { isJudged, isSettled, LETTERS, type Futures } from '../../model/document/futures';
import { nearestLanes } from '../../model/document/lanemap';
import { distances, endPose, endsBefore, hardestBraking, poseAt, STEP_S, type Motion } from '../../model/base/motion';
import { goalTimeOf, isPlaced, nameIn, type Agent } from '../../model/document/scene';
import { stopsOf } from '../../model/physics/speed-profile';
import { acceleration, metres, seconds, speedLabel } from '../../model/base/units';
import { headline } from '../../model/words/verdict-words';
import { walkWords } from '../../model/words/reach-words';
import type { Editor } from '../../edit/session/editor';
import { outOfReach, verdictsHold } from '../../edit/moves/goal-verdict';
import { TEXTS } from '../../texts/panels/agent';
import { isGoalOfLog } from '../../edit/moves/moves';
import type { LiveAgent } from './use-agent';

export interface AgentVerdict {
  readonly kind: 'ok' | 'near' | 'collision' | 'plain';
  readonly icon: string;
  readonly title: string;
  readonly words: string;
  /** Playhead time for a click on the title, seconds. */
  readonly at?: number | null;
  /** Are there remedies to offer? */
  readonly remedies?: boolean;
  /** Is "snap to the nearest lane" offered? */
  readonly snap?: boolean;
}

/** A future that ends within this distance has reached the goal, in metres. */
const REACHED_M = 2;
/** A road user below this speed after a stop has not started again, m/s. */
const CREEPS_MPS = 0.5;
/** A goal further than this from all lanes is beside the road, in metres. */
const NO_LANE_M = 4;

/** At the panels' rate: in a drag only at intervals. */
export const verdictOn = (c: Context, agent: LiveAgent): AgentVerdict | null =>
  c.editor.reading.throttle.read(() => verdictNow(c, agent.value));

function verdictNow(c: Context, a: Agent): AgentVerdict | null {
  const { editor: e } = c;
  if (e.answers.away.value && e.answers.motion.value.stale) return OUTDATED;
  const bad = isPlaced(a.goal) ? outOfReach(e, a) : null;
  if (bad && !bad.outranked) return { kind: 'near', icon: 'warn', title: bad.title, words: bad.words, remedies: true };
  const judged = onFaults(c, a);
  if (bad && judged) return { ...judged, remedies: true };
  if (judged && judged.kind !== 'ok') {
    const log = againstLog(c, a);
    return log ? { ...judged, words: `${judged.words} ${log.words}` } : judged;
  }
  if (e.drag.active.value) return judged ?? onQuickReach(c, a);
  if (offLanes(c, a)) return NO_LANE;
  const log = againstLog(c, a);
  if (log && judged?.title === AS_RECORDED.title) return { ...judged, words: log.words };
  return log ?? onCurve(c, a) ?? judged ?? onFutures(c, a);
}

const OUTDATED: AgentVerdict = {
  kind: 'near',
  icon: 'warn',
  title: TEXTS.futuresAreOut,
  words: TEXTS.computedAgainLater,
};

const NO_LANE: AgentVerdict = {
  kind: 'plain',
  icon: 'warn',
  title: TEXTS.thereIsNoLane,
  words: TEXTS.lessAccurateHere,
  snap: true,
};

/** `16 m in 9.0 s: 1.8 m/s, a brisk walk.` */
function paceWords(e: Editor, a: Agent): string {
  const way = wayUntil(e.reading.motionFor(a), a.goal.time);
  const v = way / a.goal.time;
  const how = a.type === 'pedestrian' && v > 0.2 ? walkWords(v) : '.';
  return TEXTS.pace(metres(way, 0), seconds(a.goal.time), speedLabel(v, e.view.unitOf(a)), how);
}

/** Length of a motion up to a time, metres. */
function wayUntil(m: Motion, time: number): number {
  const s = distances(m);
  return s[Math.min(s.length - 1, Math.max(0, Math.round(time * 10) - m.first))] ?? 0;
}

const AS_RECORDED: AgentVerdict = {
  kind: 'ok',
  icon: 'check',
  title: TEXTS.goalAsRecorded,
  words: TEXTS.dragTheFlag,
};

/** During a drag, until the generator's verdict arrives, the local estimate is shown even when positive. */
function onQuickReach({ editor: e }: Context, a: Agent): AgentVerdict | null {
  const local = a.goal.pos ? e.reading.localReach.value : null;
  return local && { kind: 'plain', icon: 'flag', title: local.title, words: local.words };
}

const KINDS: Readonly<Record<Mark, AgentVerdict['kind']>> = {
  collision: 'collision',
  rule: 'near',
  near: 'near',
  short: 'plain',
  ok: 'ok',
};

/** Faults of the shown future, from the generator. */
function onFaults({ editor: e }: Context, a: Agent): AgentVerdict | null {
  const f = e.reading.futures.value;
  if (!f || !verdictsHold(e)) return null;
  const who = { type: a.type, nameOf: nameIn(e.scene.value!) };
  const said = headline(f, e.reading.chosen.value, goalTimeOf(a), who);
  if (!said) return null;
  const { mark, title, words, at } = said;
  if (mark === 'ok' && isGoalOfLog(a)) return AS_RECORDED;
  if (mark === 'ok' && !words) return { kind: 'ok', icon: 'check', title, words: paceWords(e, a), at };
  return { kind: KINDS[mark], icon: `mark-${mark}`, title, words, at };
}

/** For a drawn speed profile without faults: its result. */
function onCurve({ editor: e, curve }: Context, a: Agent): AgentVerdict | null {
  const f = e.reading.futures.value;
  const mode = f?.modes[e.reading.chosen.value];
  if (!f || !mode?.about || !curve.profile.value || e.reading.chosen.value !== a.chosen) return null;
  const holds = isSettled(f) && !e.answers.motion.value.stale && verdictsHold(e);
  if (!holds || markOf(mode.about) !== 'ok' || happening(e, a)) return null;
  const { motion } = mode;
  const [stop] = stopsOf(motion, curve.profile.value.points);
  const after = stop ? Math.round((stop.from + stop.lasts) / STEP_S) - motion.first : 0;
  const goesOn = motion.speed.slice(after).some((v) => v > CREEPS_MPS);
  const title = !stop
    ? TEXTS.goesAtYourSpeed
    : goesOn
      ? TEXTS.stopsFor(seconds(stop.lasts))
      : TEXTS.stopsUntilTheEnd(seconds(stop.from));
  const words = [TEXTS.brakesAtUpTo(acceleration(hardestBraking(motion)))];
  if (a.goal.pos) words.push(TEXTS.reachesTheGoal(seconds(a.goal.time)));
  return { kind: 'ok', icon: 'check', title, words: words.join(' '), at: stop?.from ?? null };
}

function offLanes({ editor }: Context, a: Agent): boolean {
  if (!a.goal.pos || a.type !== 'vehicle') return false;
  const [x, y] = a.goal.pos;
  const { map } = editor.scene.value!;
  return !nearestLanes(map, x, y, null, NO_LANE_M, (l) => l.kind === 'road' || l.kind === 'other').length;
}

function againstLog({ editor: e }: Context, a: Agent): AgentVerdict | null {
  const log = e.view.layers.value.log ? comparedWithLog(a, e.reading.motionFor(a), e.scene.value!.duration) : null;
  if (!log) return null;
  const words = TEXTS.largestDistance(log.words, metres(log.d, 1), seconds(log.t));
  return { kind: 'plain', icon: 'eye', title: TEXTS.comparedWith, words };
}

function onFutures({ editor: e }: Context, a: Agent): AgentVerdict | null {
  const f = e.reading.futures.value;
  if (!a.goal.pos || !f || !isSettled(f) || f.sketch || e.answers.motion.value.stale || isJudged(f)) return null;
  // The futures are not judged individually; known events are reported all the same.
  return happening(e, a) ?? goalReached(a, f, a.goal.pos);
}

const HAPPENS: Readonly<Record<TrafficEvent['kind'], string>> = {
  collision: TEXTS.happenedCollision,
  rule: TEXTS.happenedRule,
  near: TEXTS.happenedNearMiss,
  short: TEXTS.shortOfIt,
};

/** The worst event on its shown path; null without one. */
function happening(e: Editor, a: Agent): AgentVerdict | null {
  const own = counted(e.reading.events.value).filter((ev) => ev.a.id === a.id || ev.b?.id === a.id);
  const kind = worstOf(own);
  const worst = own.find((ev) => ev.kind === kind);
  if (!worst || !kind) return null;
  const title =
    kind === 'short'
      ? TEXTS.endsAt(HAPPENS[kind], seconds(worst.time))
      : TEXTS.reachedAt(HAPPENS[kind], seconds(worst.time));
  return { kind: KINDS[kind], icon: `mark-${kind}`, title, words: `${worst.title}: ${worst.words}.`, at: worst.time };
}

/** Futures that reach the goal, and how closely: for unjudged futures. */
function goalReached(a: Agent, f: Futures, goal: readonly [number, number]): AgentVerdict {
  const misses = f.modes.flatMap(({ motion }, i) => {
    const p = poseAt(motion, a.goal.time) ?? endPose(motion);
    // For a goal later than 9 s only a future of that length counts.
    if (endsBefore(motion, a.goal.time)) return [];
    return [{ letter: LETTERS[i], d: Math.hypot(p.x - goal[0], p.y - goal[1]) }];
  });
  const good = misses.filter((m) => m.d <= REACHED_M);
  const bad = misses.filter((m) => m.d > REACHED_M);
  const furthest = (of: typeof misses, atLeast = 0): string => metres(Math.max(atLeast, ...of.map((m) => m.d)), 1);
  if (!good.length) {
    const [closest] = bad.sort((p, q) => p.d - q.d);
    const words = TEXTS.theClosestEnds(closest.letter, metres(closest.d, 1));
    return { kind: 'near', icon: 'warn', title: TEXTS.noFutureReaches, words };
  }
  const letters = (of: typeof misses): string => of.map((m) => m.letter).join(', ');
  const words = !bad.length
    ? TEXTS.allWithinAt(misses.length, furthest(misses, 0.1), seconds(a.goal.time))
    : TEXTS.endUpToAway(bad.length, bad[0].letter, furthest(bad), letters(bad));
  const all = !bad.length && misses.length > 1;
  const title = all
    ? TEXTS.goalReachedIn(misses.length === 6 ? TEXTS.six : misses.length)
    : TEXTS.goalReachedInSome(letters(good));
  return { kind: 'ok', icon: 'check', title, words };
}
