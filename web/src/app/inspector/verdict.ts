// What is to be said of the goal of a road user, in words: whether it can be reached, whether it was.
import type { Context } from '../../actions/context';
import { markOf, type Mark } from '../../model/document/future-facts';
import { comparedWithLog } from '../../model/words/change-words';
import { counted, worstOf } from '../../model/physics/events';
import type { TrafficEvent } from '../../model/words/event-words';
import { isJudged, isSettled, LETTERS, type Futures } from '../../model/document/futures';
import { nearestLanes } from '../../model/document/lanemap';
import { distances, endPose, endsBefore, hardestBraking, poseAt, STEP_S, type Motion } from '../../model/base/motion';
import { goalTimeOf, nameIn, type Agent } from '../../model/document/scene';
import { stopsOf } from '../../model/physics/speed-profile';
import { acceleration, metres, seconds, speedLabel } from '../../model/base/units';
import { headline } from '../../model/words/verdict-words';
import type { Editor } from '../../edit/editor';
import { outOfReach, verdictsHold } from '../../edit/goal-verdict';
import { TEXTS } from '../../texts/panels/agent';
import { isGoalOfLog } from '../../edit/moves';
import type { LiveAgent } from './use-agent';

export interface Verdict {
  readonly kind: 'ok' | 'near' | 'collision' | 'plain';
  readonly icon: string;
  readonly title: string;
  readonly words: string;
  /** Where the playhead goes on a click on the title, seconds. */
  readonly at?: number | null;
  /** Are there ways out to offer? */
  readonly remedies?: boolean;
  /** Is "snap to the nearest lane" to be offered? */
  readonly snap?: boolean;
}

/** A future that ends nearer to the goal than this has reached it, in metres. */
const REACHED_M = 2;
/** Who is no faster than this after a stop has not gone on, m/s. */
const CREEPS_MPS = 0.5;
/** A goal further from all lanes than this lies beside the road, in metres. */
const NO_LANE_M = 4;

/** As panels say it: in a drag now and then. */
export const verdictOn = (c: Context, agent: LiveAgent): Verdict | null =>
  c.editor.calm.read(() => verdictNow(c, agent.value));

function verdictNow(c: Context, a: Agent): Verdict | null {
  const { editor: e } = c;
  if (e.away.value && e.motion.value.stale) return OUTDATED;
  const bad = a.goal.pos ? outOfReach(e, a) : null;
  if (bad && !bad.outranked) return { kind: 'near', icon: 'warn', title: bad.title, words: bad.words, remedies: true };
  const judged = onFaults(c, a);
  if (bad && judged) return { ...judged, remedies: true };
  if (judged && judged.kind !== 'ok') {
    const log = againstLog(c, a);
    return log ? { ...judged, words: `${judged.words} ${log.words}` } : judged;
  }
  if (e.dragging.value) return judged ?? onQuickReach(c, a);
  if (offLanes(c, a)) return NO_LANE;
  const log = againstLog(c, a);
  if (log && judged?.title === AS_RECORDED.title) return { ...judged, words: log.words };
  return log ?? onCurve(c, a) ?? judged ?? onFutures(c, a);
}

const OUTDATED: Verdict = {
  kind: 'near',
  icon: 'warn',
  title: TEXTS.futuresAreOut,
  words: TEXTS.theyWillBeWorked,
};

const NO_LANE: Verdict = {
  kind: 'plain',
  icon: 'warn',
  title: TEXTS.thereIsNoLane,
  words: TEXTS.carsMayStill,
  snap: true,
};

/** `16 m in 9.0 s: 1.8 m/s, a brisk walk.` */
function paceWords(e: Editor, a: Agent): string {
  const way = wayUntil(e.motionFor(a), a.goal.time);
  const v = way / a.goal.time;
  const how = a.type === 'pedestrian' && v > 0.2 ? `, ${WALKS.find(([most]) => v < most)![1]}` : '';
  return TEXTS.pace(metres(way, 0), seconds(a.goal.time), speedLabel(v, e.unitOf(a)), how);
}

const WALKS = [
  [0.9, TEXTS.aSlowWalk],
  [1.5, TEXTS.aWalk],
  [2.2, TEXTS.aBriskWalk],
  [3.2, TEXTS.aJog],
  [Infinity, TEXTS.aRun],
] as const;

/** Metres that a motion goes up to a time. */
function wayUntil(m: Motion, time: number): number {
  const s = distances(m);
  return s[Math.min(s.length - 1, Math.max(0, Math.round(time * 10) - m.first))] ?? 0;
}

const AS_RECORDED: Verdict = {
  kind: 'ok',
  icon: 'check',
  title: TEXTS.goalTakenFromLog,
  words: TEXTS.dragTheFlag,
};

/** During a drag, until the generator has judged it, the quick answer stands even when it is yes. */
function onQuickReach({ editor: e }: Context, a: Agent): Verdict | null {
  const local = a.goal.pos ? e.localReach.value : null;
  return local && { kind: 'plain', icon: 'flag', title: local.title, words: local.words };
}

const KINDS: Readonly<Record<Mark, Verdict['kind']>> = {
  collision: 'collision',
  rule: 'near',
  near: 'near',
  short: 'plain',
  ok: 'ok',
};

/** What the generator says is wrong with the future that is shown. */
function onFaults({ editor: e }: Context, a: Agent): Verdict | null {
  const f = e.futures.value;
  if (!f || !verdictsHold(e)) return null;
  const who = { type: a.type, nameOf: nameIn(e.scene.value!) };
  const said = headline(f, e.chosen.value, goalTimeOf(a), who);
  if (!said) return null;
  const { mark, title, words, at } = said;
  if (mark === 'ok' && isGoalOfLog(a)) return AS_RECORDED;
  if (mark === 'ok' && !words) return { kind: 'ok', icon: 'check', title, words: paceWords(e, a), at };
  return { kind: KINDS[mark], icon: `mark-${mark}`, title, words, at };
}

/** Of a speed that was drawn by hand, where nothing is wrong with it: what it does. */
function onCurve({ editor: e }: Context, a: Agent): Verdict | null {
  const f = e.futures.value;
  const mode = f?.modes[e.chosen.value];
  if (!f || !mode?.about || !e.curve.profile.value || e.chosen.value !== a.chosen) return null;
  const holds = isSettled(f) && !e.motion.value.stale && verdictsHold(e);
  if (!holds || markOf(mode.about) !== 'ok' || happening(e, a)) return null;
  const { motion } = mode;
  const [stop] = stopsOf(motion, e.curve.profile.value.points);
  const after = stop ? Math.round((stop.from + stop.lasts) / STEP_S) - motion.first : 0;
  const goesOn = motion.speed.slice(after).some((v) => v > CREEPS_MPS);
  const title = !stop
    ? TEXTS.goesAtYourSpeed
    : goesOn
      ? TEXTS.stopsFor(seconds(stop.lasts))
      : TEXTS.stopsAndStays(seconds(stop.from));
  const words = [TEXTS.brakesAtMost(acceleration(hardestBraking(motion)))];
  if (a.goal.pos) words.push(TEXTS.reachesTheGoal(seconds(a.goal.time)));
  return { kind: 'ok', icon: 'check', title, words: words.join(' '), at: stop?.from ?? null };
}

function offLanes({ editor }: Context, a: Agent): boolean {
  if (!a.goal.pos || a.type !== 'vehicle') return false;
  const [x, y] = a.goal.pos;
  const { map } = editor.scene.value!;
  return !nearestLanes(map, x, y, null, NO_LANE_M, (l) => l.kind === 'road' || l.kind === 'other').length;
}

function againstLog({ editor: e }: Context, a: Agent): Verdict | null {
  const log = e.layers.value.log ? comparedWithLog(a, e.motionFor(a), e.scene.value!.duration) : null;
  if (!log) return null;
  const words = TEXTS.furthestApart(log.words, metres(log.d, 1), seconds(log.t));
  return { kind: 'plain', icon: 'eye', title: TEXTS.comparedWith, words };
}

function onFutures({ editor: e }: Context, a: Agent): Verdict | null {
  const f = e.futures.value;
  if (!a.goal.pos || !f || !isSettled(f) || f.sketch || e.motion.value.stale || isJudged(f)) return null;
  // Nobody has judged them one by one; what is known to happen is said all the same.
  return happening(e, a) ?? goalReached(a, f, a.goal.pos);
}

const HAPPENS: Readonly<Record<TrafficEvent['kind'], string>> = {
  collision: TEXTS.withACollision,
  rule: TEXTS.againstTheRules,
  near: TEXTS.withANearMiss,
  short: TEXTS.shortOfIt,
};

/** The worst that happens to it on the way it is shown on; null where nothing does. */
function happening(e: Editor, a: Agent): Verdict | null {
  const own = counted(e.events.value).filter((ev) => ev.a.id === a.id || ev.b?.id === a.id);
  const kind = worstOf(own);
  const worst = own.find((ev) => ev.kind === kind);
  if (!worst || !kind) return null;
  const title =
    kind === 'short'
      ? TEXTS.endsAt(HAPPENS[kind], seconds(worst.time))
      : TEXTS.reachedAt(HAPPENS[kind], seconds(worst.time));
  return { kind: KINDS[kind], icon: `mark-${kind}`, title, words: `${worst.title}: ${worst.words}.`, at: worst.time };
}

/** Which of the futures reach the goal, and how closely: for futures that nobody has judged. */
function goalReached(a: Agent, f: Futures, goal: readonly [number, number]): Verdict {
  const misses = f.modes.flatMap(({ motion }, i) => {
    const p = poseAt(motion, a.goal.time) ?? endPose(motion);
    // Of a goal later than 9 s only the future that goes on can say anything.
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
