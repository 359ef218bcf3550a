// What is wrong with futures, in words: one at the place, one in a headline, and who does what.
import {
  compareMarks,
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
import type { LaneMap } from '../document/lanemap';
import { endPose, endsBefore, lastStep, STEP_S } from '../base/motion';
import type { AgentType } from '../base/kinds';
import { acceleration, metres, seconds } from '../base/units';
import { TEXTS } from '../../texts/scene/verdicts';

export type NameOf = (id: string) => string | null;

const somebody = (f: Fault, nameOf: NameOf): string => (f.with !== null && nameOf(f.with)) || TEXTS.somebody;

/** The word on the picture where it happens. */
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
    case 'harsh_braking':
      return f.extent === null ? TEXTS.brakesHard : TEXTS.brakes(acceleration(f.extent));
    case 'harsh_steering':
      return f.extent === null ? TEXTS.steersHard : TEXTS.steers(acceleration(f.extent));
    case 'near_miss':
      // Far apart, but so fast towards each other that the time is what was near.
      return f.extent === null || f.extent > THRESHOLDS.gap_m.usual
        ? TEXTS.closeCallWith(somebody(f, nameOf))
        : TEXTS.to(metres(f.extent, 1), somebody(f, nameOf));
    case 'via_missed':
      return f.extent === null ? TEXTS.pastTheVia : TEXTS.fromTheVia(metres(f.extent, 1));
    case 'goal_missed':
      return f.extent === null ? TEXTS.shortWord : TEXTS.short(metres(f.extent));
  }
}

/** The same in a sentence: `hits Car 12 at 1.3 s`. */
const headlineWord = (f: Fault, nameOf: NameOf): string =>
  f.kind === 'red_light' ? TEXTS.throughRed : f.kind === 'wrong_way' ? TEXTS.theWrongWay : placeWord(f, nameOf);

export interface Headline {
  readonly mark: Mark;
  readonly title: string;
  /** Who does and who does not. */
  readonly words: string;
  /** Scene time of what the title names, seconds; null where it names none. */
  readonly at: number | null;
}

const SIX = ['', TEXTS.one, TEXTS.two, TEXTS.three, TEXTS.four, TEXTS.five, TEXTS.six];

const upper = (s: string): string => s.charAt(0).toUpperCase() + s.slice(1);

/**
 * What is to be said of the futures of one, of which `chosen` is shown; null where nothing is worth it. `goalTime`:
 * when it is to be at its goal, seconds; null where no place is asked for.
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
  const word = headlineWord(worst, who.nameOf);
  const at = TEXTS.at(seconds(worst.time));
  const missed = about.faults.find((x) => x.kind === 'goal_missed');
  const toGoal = hasGoal && !missed && !isOpen(chosen);
  if (worst.kind === 'goal_missed') return { mark, title: TEXTS.ofTheGoal(upper(word)), words, at: worst.time };
  const all = f.modes.length > 1 && f.modes.every((m) => m.about?.faults[0]?.kind === worst.kind);
  const title =
    toGoal && all && leavesRoad(worst)
      ? TEXTS.only(word, at)
      : toGoal
        ? TEXTS.reached(word, at)
        : `${upper(word)}${at}${missed && hasGoal ? `, ${placeWord(missed, who.nameOf)}` : ''}`;
  return { mark, title, words, at: worst.time };
}

/** How it gets about, and what others are called. */
export interface Walker {
  readonly type: AgentType;
  readonly nameOf: NameOf;
}

/** Those with nothing wrong. */
const good = (f: Futures): number[] => f.modes.flatMap((m, i) => (m.about && markOf(m.about) === 'ok' ? [i] : []));

/** Those of them that reach the goal; of `open` ones that is not known yet. */
function reachedBy(f: Futures, open: readonly number[]): string {
  const there = good(f).filter((i) => !open.includes(i));
  if (there.length === f.modes.length && there.length > 1) return TEXTS.reachedInAll(SIX[there.length]);
  return TEXTS.reachedIn(there.map((i) => LETTERS[i]).join(', '));
}

/** Futures that nobody follows are worked out for a first while alone. */
function openWords(f: Futures, open: readonly number[]): string {
  const until = seconds(lastStep(f.modes[open[0]].motion) * STEP_S);
  return TEXTS.workedOutUpTo(and(open.map((i) => LETTERS[i])), open.length, until);
}

// -------------------------------------------------------------- who does what

const and = (list: readonly string[]): string =>
  list.length < 2 ? list.join('') : TEXTS.and(list.slice(0, -1).join(', '), list.at(-1));

interface Group {
  readonly key: string;
  readonly letters: string[];
  /** `drive over it` and `drives over it`. */
  readonly many: string;
  readonly one: string;
}

/** `A, B, C and D drive over it. E gets there by the road. F stops.` */
function whoDoesWhat(f: Futures, chosen: number, hasGoal: boolean, who: Walker): string {
  const named = f.modes[chosen].about?.faults[0]?.kind ?? null;
  const offRoad = f.modes.some((m) => m.about?.faults.some(leavesRoad));
  const groups = new Map<string, Group>();
  f.modes.forEach((m, i) => {
    const g = groupOf(f, i, m.about ?? null, { named, offRoad, hasGoal, who });
    if (!g) return;
    const known = groups.get(g.key) ?? g;
    groups.set(g.key, known);
    known.letters.push(LETTERS[i]);
  });
  const list = [...groups.values()];
  if (list.length === 1 && list[0].letters.length === f.modes.length) {
    const [{ key, many, letters }] = list;
    return key === 'ok' || letters.length < 2 ? '' : TEXTS.all(SIX[letters.length], many);
  }
  return list.map((g) => `${and(g.letters)} ${g.letters.length > 1 ? g.many : g.one}.`).join(' ');
}

interface Said {
  /** What the headline names already. */
  readonly named: FaultKind | null;
  readonly offRoad: boolean;
  readonly hasGoal: boolean;
  readonly who: Walker;
}

const group = (key: string, many: string, one: string): Group => ({ key, letters: [], many, one });

function groupOf(f: Futures, i: number, about: FutureFacts | null, said: Said): Group | null {
  if (!about) return null;
  const [worst] = about.faults;
  if (!worst) {
    // The headline lists those that get there, unless it names what is wrong.
    if (said.named === null) return null;
    if (!said.hasGoal) return group('ok', TEXTS.doNot, TEXTS.doesNot);
    return said.offRoad
      ? group('ok', TEXTS.getThereByThe, TEXTS.getsThereByThe)
      : group('ok', TEXTS.getThere, TEXTS.getsThere);
  }
  const it = said.named === worst.kind;
  const [drive, drives] = GOES[said.who.type];
  switch (worst.kind) {
    case 'collision': {
      const whom = somebody(worst, said.who.nameOf);
      return group(`hit:${worst.with}`, TEXTS.hit(whom), TEXTS.hitsWhom(whom));
    }
    case 'red_light':
      return group(worst.kind, TEXTS.driveThroughRed(drive), TEXTS.drivesThroughRed(drives));
    case 'wrong_way':
      return group(worst.kind, TEXTS.driveTheWrongWay(drive), TEXTS.drivesTheWrongWay(drives));
    case 'over_median': {
      const over = it ? TEXTS.overIt : TEXTS.overTheMedian;
      return group(worst.kind, `${drive} ${over}`, `${drives} ${over}`);
    }
    case 'off_road':
      return group(worst.kind, TEXTS.leaveTheRoad, TEXTS.leavesTheRoad);
    case 'harsh_braking':
      return group(worst.kind, TEXTS.brakeHard, TEXTS.brakesHard);
    case 'harsh_steering':
      return group(worst.kind, TEXTS.steerHard, TEXTS.steersHard);
    case 'near_miss': {
      const whom = somebody(worst, said.who.nameOf);
      return group(`near:${worst.with}`, TEXTS.nearlyHit(whom), TEXTS.nearlyHits(whom));
    }
    case 'via_missed':
      return group(worst.kind, TEXTS.missAVia, TEXTS.missesAVia);
    case 'goal_missed': {
      if (Math.abs(endPose(f.modes[i].motion).speed) < THRESHOLDS.moving_mps.usual)
        return group('stops', TEXTS.stop, TEXTS.stops);
      return group('short', TEXTS.doNotGetThere, TEXTS.doesNotGetThere);
    }
  }
}

const GOES: Readonly<Record<AgentType, readonly [many: string, one: string]>> = {
  vehicle: [TEXTS.drive, TEXTS.drives],
  cyclist: [TEXTS.ride, TEXTS.rides],
  pedestrian: [TEXTS.walk, TEXTS.walks],
  other: [TEXTS.go, TEXTS.goes],
};

/** `drive`, `ride`, `walk`: how one kind gets about. */
export const goes = (type: AgentType): string => GOES[type][0];

/** `may drive over this median`, or may not. An island has several edges and is one median all the same. */
export function mayCrossWords(go: string, map: LaneMap, edges: readonly string[], may = true): string {
  const medians = new Set(map.edges.filter((e) => e.type === 'median').map((e) => e.id));
  const median = edges.every((id) => medians.has(id));
  if (!may) return median ? TEXTS.mayNotOverThisMedian(go) : TEXTS.mayNotOverThisKerb(go);
  return median ? TEXTS.mayOverThisMedian(go) : TEXTS.mayOverThisKerb(go);
}

// -------------------------------------------------------------- why another is shown

/** Why the future at `shown` is shown and not the one at `was`: what is worse about that one; null for nothing. */
export function whyNot(f: Futures, was: number, shown: number, nameOf: NameOf): string | null {
  const [old, now] = [f.modes[was]?.about, f.modes[shown]?.about];
  if (!old || !now || compareMarks(markOf(old), markOf(now)) >= 0) return null;
  const [worst] = old.faults;
  return TEXTS.isShown(LETTERS[shown], LETTERS[was], WHY[faultMark(worst)](worst, nameOf));
}

/** The same where the bold one before was another, and something is to be said of it whatever the reason. */
export function whyAnother(f: Futures, was: number, shown: number, nameOf: NameOf): string | null {
  const [old, now] = [f.modes[was], f.modes[shown]];
  if (!now || was === shown) return null;
  const is = TEXTS.isShownOnly(LETTERS[shown]);
  if (!old) return TEXTS.theOneBefore(is);
  const likelier = now.probability > old.probability;
  const plain = likelier ? TEXTS.itIsLikelier(is, LETTERS[was]) : TEXTS.itWasInTheDrag(is, LETTERS[was]);
  return whyNot(f, was, shown, nameOf) ?? plain;
}

const WHY: Readonly<Record<Mark, (f: Fault, nameOf: NameOf) => string>> = {
  collision: placeWord,
  rule: (f, nameOf) => RULE_VERBS[f.kind] ?? placeWord(f, nameOf),
  near: (f, nameOf) => TEXTS.nearlyHitsSomebody(somebody(f, nameOf)),
  short: (f, nameOf) => TEXTS.ends(placeWord(f, nameOf)),
  ok: () => '',
};

const RULE_VERBS: Partial<Record<FaultKind, string>> = {
  red_light: TEXTS.runsARedLight,
  wrong_way: TEXTS.goesTheWrong,
  over_median: TEXTS.goesOverTheMedian,
  off_road: TEXTS.leavesTheRoad,
};
