// Faults of futures in words: one at the place, one in a headline, and a summary by letter.
import {
  faultMark,
  leavesRoad,
  markOf,
  type FutureFacts,
  type Fault,
  type FaultKind,
  type Mark,
} from '../document/future-facts';
import { THRESHOLDS } from '../base/domain';
import { LETTERS, type Futures } from '../document/futures';
import type { NameOf } from '../document/scene';
import { endPose, endsBefore, lastStep, STEP_S } from '../base/motion';
import type { AgentType } from '../base/kinds';
import { acceleration, degrees, metres, seconds, speedInUse } from '../base/units';
import { capitalised } from '../../texts/language';
import { TEXTS } from '../../texts/scene/verdicts';

/** A gap that rounds to 0.0 m is not written as that. */
const TOUCH_M = 0.05;

const somebody = (f: Fault, nameOf: NameOf): string => (f.with !== null && nameOf(f.with)) || TEXTS.aRoadUser;

/** The word at the place of a fault on the picture. */
export function placeWord(f: Fault, nameOf: NameOf): string {
  switch (f.kind) {
    case 'collision':
      return TEXTS.hits(somebody(f, nameOf));
    case 'red_light':
      return TEXTS.redLight;
    case 'wrong_way':
      return TEXTS.wrongWay;
    case 'over_median':
      return TEXTS.overTheMedian;
    case 'off_road':
      return TEXTS.offTheRoad;
    case 'off_map':
      return TEXTS.offTheMap;
    case 'on_carriageway':
      return TEXTS.onTheCarriageway;
    case 'speeding':
      return f.extent === null ? TEXTS.speeds : TEXTS.overTheLimit(speedInUse(f.extent, false));
    case 'running':
      return f.extent === null ? TEXTS.running : TEXTS.runsAt(speedInUse(f.extent, true));
    case 'askew':
      return f.extent === null ? TEXTS.askew : TEXTS.askewBy(degrees(f.extent));
    case 'harsh_braking':
      return f.extent === null ? TEXTS.brakesHard : TEXTS.brakes(acceleration(f.extent));
    case 'harsh_steering':
      return f.extent === null ? TEXTS.steersHard : TEXTS.steers(acceleration(f.extent));
    case 'fails_to_yield':
      return TEXTS.failsToYield(somebody(f, nameOf));
    case 'forces_braking':
      return f.extent === null
        ? TEXTS.forcesBraking(somebody(f, nameOf))
        : TEXTS.forcesBrakingOf(somebody(f, nameOf), acceleration(f.extent));
    case 'near_miss':
      if (f.extent !== null && f.extent < TOUCH_M) return TEXTS.touchingly(somebody(f, nameOf));
      // Far apart, but at such a closing speed that the time was short.
      return f.extent === null || f.extent > THRESHOLDS.gap_m.usual
        ? TEXTS.nearMissWith(somebody(f, nameOf))
        : TEXTS.to(metres(f.extent, 1), somebody(f, nameOf));
    case 'via_missed':
      return f.extent === null ? TEXTS.pastTheVia : TEXTS.fromTheVia(metres(f.extent, 1));
    case 'goal_missed':
      return f.extent === null ? TEXTS.shortWord : TEXTS.short(metres(f.extent));
  }
}

export interface Headline {
  readonly mark: Mark;
  readonly title: string;
  /** The summary by letter. */
  readonly words: string;
  /** Scene time of the titled fault, seconds; null where there is none. */
  readonly at: number | null;
}

const SIX = ['', TEXTS.one, TEXTS.two, TEXTS.three, TEXTS.four, TEXTS.five, TEXTS.six];

/**
 * The headline on the futures of one road user, of which `chosen` is shown; null where none is needed. `goalTime`:
 * seconds; null without a goal position.
 */
export function headline(f: Futures, chosen: number, goalTime: number | null, who: Walker): Headline | null {
  const hasGoal = goalTime !== null;
  const about = f.modes[chosen]?.about;
  if (!about) return null;
  const mark = markOf(about);
  const words = whoDoesWhat(f, chosen, hasGoal, who);
  const isOpen = (i: number): boolean => hasGoal && endsBefore(f.modes[i].motion, goalTime);
  if (mark === 'ok') {
    if (!hasGoal || isOpen(chosen)) return null;
    const open = good(f).filter(isOpen);
    const all = open.length ? [words, openWords(f, open)].filter(Boolean).join(' ') : words;
    return { mark, title: reachedBy(f, open), words: all, at: null };
  }
  const [worst] = about.faults;
  const word = placeWord(worst, who.nameOf);
  const at = TEXTS.at(seconds(worst.time));
  const missed = about.faults.find((x) => x.kind === 'goal_missed');
  const toGoal = hasGoal && !missed && !isOpen(chosen);
  if (worst.kind === 'goal_missed') return { mark, title: TEXTS.ofTheGoal(capitalised(word)), words, at: worst.time };
  const all = f.modes.length > 1 && f.modes.every((m) => m.about?.faults[0]?.kind === worst.kind);
  const only = ONLY[worst.kind];
  const title =
    toGoal && all && only
      ? only(seconds(worst.time))
      : toGoal
        ? TEXTS.butReached(doesWhat(worst, who.nameOf), at)
        : `${capitalised(word)}${at}${missed && hasGoal ? `, ${placeWord(missed, who.nameOf)}` : ''}`;
  return { mark, title, words, at: worst.time };
}

/** Kinds of faults that a goal requires when all futures have them. */
const ONLY: Partial<Record<FaultKind, (time: string) => string>> = TEXTS.onlyBy;

/** Type of the road user, and names of the others. */
export interface Walker {
  readonly type: AgentType;
  readonly nameOf: NameOf;
}

/** Those without faults. */
const good = (f: Futures): number[] => f.modes.flatMap((m, i) => (m.about && markOf(m.about) === 'ok' ? [i] : []));

/** Those of them that reach the goal; for `open` ones that is not known yet. */
function reachedBy(f: Futures, open: readonly number[]): string {
  const there = good(f).filter((i) => !open.includes(i));
  if (there.length === f.modes.length && there.length > 1) return TEXTS.reachedInAll(SIX[there.length]);
  return TEXTS.reachedIn(there.map((i) => LETTERS[i]).join(', '));
}

/** Futures that no road user follows are planned only for the first planning window. */
function openWords(f: Futures, open: readonly number[]): string {
  const until = seconds(lastStep(f.modes[open[0]].motion) * STEP_S);
  return TEXTS.plannedUpTo(lettersOf(open), open.length, until);
}

// -------------------------------------------------------------- summary by letter

const and = (list: readonly string[]): string =>
  list.length < 2 ? list.join('') : TEXTS.and(list.slice(0, -1).join(', '), list.at(-1));

/** `A, C and D`; three or more in a row are `A to D`. */
function lettersOf(indexes: readonly number[]): string {
  const runs: number[][] = [];
  for (const i of indexes) {
    const run = runs.at(-1);
    if (run && run.at(-1) === i - 1) run.push(i);
    else runs.push([i]);
  }
  return and(
    runs.flatMap((run) =>
      run.length > 2 ? [TEXTS.through(LETTERS[run[0]], LETTERS[run.at(-1)!])] : run.map((i) => LETTERS[i]),
    ),
  );
}

export interface FaultGroup {
  readonly key: string;
  readonly futures: number[];
  /** `cross the median` and `crosses the median`. */
  readonly many: string;
  readonly one: string;
}

/** `A to D cross the median. E reaches the goal by road. F stops short.` */
function whoDoesWhat(f: Futures, chosen: number, hasGoal: boolean, who: Walker): string {
  const named = f.modes[chosen].about?.faults[0]?.kind ?? null;
  const offRoad = f.modes.some((m) => m.about?.faults.some(leavesRoad));
  const list = grouped(f.modes, (i) => groupOf(f, i, f.modes[i].about ?? null, { named, offRoad, hasGoal, who }));
  if (list.length === 1 && list[0].futures.length === f.modes.length) {
    const [{ key, many, futures }] = list;
    return key === 'ok' || futures.length < 2 ? '' : TEXTS.all(SIX[futures.length], many);
  }
  return list.map((g) => `${sentence(g)}.`).join(' ');
}

/** The futures by what they do, in the order of their letters. */
export function grouped(modes: Futures['modes'], of: (i: number) => FaultGroup | null): FaultGroup[] {
  const groups = new Map<string, FaultGroup>();
  modes.forEach((_, i) => {
    const g = of(i);
    if (!g) return;
    const known = groups.get(g.key) ?? g;
    groups.set(g.key, known);
    known.futures.push(i);
  });
  return [...groups.values()];
}

/** `A to D cross the median` */
export const sentence = ({ futures, many, one }: FaultGroup): string =>
  `${lettersOf(futures)} ${futures.length > 1 ? many : one}`;

interface VerdictContext {
  /** The kind that the headline names already. */
  readonly named: FaultKind | null;
  readonly offRoad: boolean;
  readonly hasGoal: boolean;
  readonly who: Walker;
}

export const group = (key: string, many: string, one: string): FaultGroup => ({ key, futures: [], many, one });

/** The group of a future by its worst fault; null where nothing is to be said. */
export function groupOf(f: Futures, i: number, about: FutureFacts | null, said: VerdictContext): FaultGroup | null {
  if (!about) return null;
  const [worst] = about.faults;
  if (!worst) {
    // The headline lists those that reach the goal, unless it names a fault.
    if (said.named === null) return null;
    if (!said.hasGoal) return group('ok', TEXTS.areClear, TEXTS.isClear);
    return said.offRoad ? group('ok', TEXTS.reachByRoad, TEXTS.reachesByRoad) : group('ok', TEXTS.reach, TEXTS.reaches);
  }
  switch (worst.kind) {
    case 'collision': {
      const whom = somebody(worst, said.who.nameOf);
      return group(`hit:${worst.with}`, TEXTS.hit(whom), TEXTS.hits(whom));
    }
    case 'red_light':
      return group(worst.kind, TEXTS.runARedLight, TEXTS.runsARedLight);
    case 'wrong_way':
      return group(worst.kind, TEXTS.goTheWrongWay, TEXTS.goesTheWrongWay);
    case 'over_median':
      return group(worst.kind, TEXTS.crossTheMedian, TEXTS.crossesTheMedian);
    case 'off_road':
      return group(worst.kind, TEXTS.leaveTheRoad, TEXTS.leavesTheRoad);
    case 'off_map':
      return group(worst.kind, TEXTS.leaveTheMap, TEXTS.leavesTheMap);
    case 'on_carriageway':
      return group(worst.kind, TEXTS.walkOnTheCarriageway, TEXTS.walksOnTheCarriageway);
    case 'speeding':
      return group(worst.kind, TEXTS.exceedTheLimit, TEXTS.exceedsTheLimit);
    case 'running':
      return group(worst.kind, TEXTS.run, TEXTS.runs);
    case 'askew':
      return group(worst.kind, TEXTS.endAskew, TEXTS.endsAskew);
    case 'harsh_braking':
      return group(worst.kind, TEXTS.brakeHard, TEXTS.brakesHard);
    case 'harsh_steering':
      return group(worst.kind, TEXTS.steerHard, TEXTS.steersHard);
    case 'fails_to_yield': {
      const whom = somebody(worst, said.who.nameOf);
      return group(`yield:${worst.with}`, TEXTS.failToYield(whom), TEXTS.failsToYield(whom));
    }
    case 'forces_braking': {
      const whom = somebody(worst, said.who.nameOf);
      return group(`forces:${worst.with}`, TEXTS.forceBraking(whom), TEXTS.forcesBraking(whom));
    }
    case 'near_miss': {
      const whom = somebody(worst, said.who.nameOf);
      return group(`near:${worst.with}`, TEXTS.nearlyHit(whom), TEXTS.nearlyHits(whom));
    }
    case 'via_missed':
      return group(worst.kind, TEXTS.missAVia, TEXTS.missesAVia);
    case 'goal_missed': {
      if (Math.abs(endPose(f.modes[i].motion).speed) < THRESHOLDS.moving_mps.usual)
        return group('stops', TEXTS.stopShort, TEXTS.stopsShort);
      return group('short', TEXTS.missTheGoal, TEXTS.missesTheGoal);
    }
  }
}

/** Permission for these faults: `may cross this median`, and the like. The edge is called what the fault calls it. */
export const crossingWords = (faults: readonly Fault[]): typeof TEXTS.thisMedian =>
  faults.some((f) => f.kind === 'over_median') ? TEXTS.thisMedian : TEXTS.thisKerb;

/** What a future with this fault does, as a verb. */
const doesWhat = (f: Fault, nameOf: NameOf): string =>
  faultMark(f) === 'near' ? TEXTS.nearlyHits(somebody(f, nameOf)) : (RULE_VERBS[f.kind] ?? placeWord(f, nameOf));

const RULE_VERBS: Partial<Record<FaultKind, string>> = {
  red_light: TEXTS.runsARedLight,
  wrong_way: TEXTS.goesTheWrongWay,
  over_median: TEXTS.crossesTheMedian,
  off_road: TEXTS.leavesTheRoad,
  off_map: TEXTS.leavesTheMap,
  on_carriageway: TEXTS.walksOnTheCarriageway,
  speeding: TEXTS.exceedsTheLimit,
  running: TEXTS.runs,
  askew: TEXTS.endsAskew,
  via_missed: TEXTS.missesAVia,
};
