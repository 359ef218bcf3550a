// Preferences, their evidence, and reasons of verdicts, in plain words.
import type { NameOf } from '../document/scene';
import { traitKey, type CardVerdict, type Features, type Trait, type Verdict, type Wish } from '../document/feedback';
import type { LearnedWishJson } from '../document/scene-json';
import {
  acceleration,
  accelerationUnit,
  lengthText,
  lengthUnit,
  num,
  seconds,
  speedText,
  type SpeedUnit,
} from '../base/units';
import { TEXTS } from '../../texts/scene/feedback';
import { inSentence } from '../../texts/language';

export interface Speaking {
  readonly nameOf: NameOf;
  readonly unit: SpeedUnit;
}

const MANOEUVRES = {
  straight: TEXTS.straightOn,
  left: TEXTS.turnsLeft,
  right: TEXTS.turnsRight,
  turn_round: TEXTS.makesUTurn,
  lane_left: TEXTS.toTheLeftLane,
  lane_right: TEXTS.toTheRightLane,
  stays: TEXTS.standsStill,
  reverse: TEXTS.backsUp,
} as const;

const PLAIN = {
  pace: { more: TEXTS.faster, less: TEXTS.slower },
  gap: { more: TEXTS.widerGap, less: TEXTS.smallerGap },
  harshness: { more: TEXTS.harsher, less: TEXTS.smoother },
  standing: { more: TEXTS.waitsLonger, less: TEXTS.waitsLess },
  from_log: { more: TEXTS.lessLikeTheLog, less: TEXTS.moreLikeTheLog },
} as const;

const called = (nameOf: NameOf, id: string): string => nameOf(id) ?? TEXTS.roadUser(id);

/** Shorter gaps are no preference, seconds. */
const LEAST_GAP_S = 1;

/** `Smoother`, `Car 12 first`, `Keeps a 2 s gap`. `kept`: the range of the kept ones. */
export function wishWords(w: Wish, nameOf: NameOf, kept?: readonly [number, number] | null): string {
  if (w.trait === 'first') return TEXTS.first(called(nameOf, w.wants === 'more' ? w.who : w.with));
  if (w.trait === 'does')
    return w.wants === 'more' ? MANOEUVRES[w.manoeuvre] : TEXTS.not(inSentence(MANOEUVRES[w.manoeuvre]));
  if (w.trait === 'gap' && w.wants === 'more' && kept && kept[0] >= LEAST_GAP_S)
    return TEXTS.keepsSGap(num(Math.floor(kept[0] * 10) / 10, kept[0] % 1 < 0.1 ? 0 : 1));
  return PLAIN[w.trait][w.wants];
}

type TraitRange = readonly [number, number];

/** `Waiting time: kept 0 to 1.2, rejected 3 to 4 s.` */
export function restsOn(w: LearnedWishJson, answers: readonly CardVerdict[], { unit }: Speaking): string {
  const sentence = w.trait === 'first' || w.trait === 'does' ? shares(w, answers) : ranges(w, unit);
  return [w.said ? TEXTS.setByYou : '', sentence].filter(Boolean).join(' ');
}

function ranges(w: LearnedWishJson, speeds: SpeedUnit): string {
  const say = saying(w, speeds);
  if (!say) return '';
  const { what, value, unit } = say;
  const [kept, rejected] = [w.kept ?? null, w.rejected ?? null];
  if (kept && rejected) return TEXTS.keptAndRejected(what, value(kept), value(rejected), unit);
  if (kept) return TEXTS.keptAlone(what, value(kept), unit);
  return rejected ? TEXTS.rejectedAlone(what, value(rejected), unit) : '';
}

interface TraitWords {
  readonly what: string;
  /** After a value, with the space between. */
  readonly unit: string;
  value(r: TraitRange): string;
}

const between = (r: TraitRange, text: (v: number) => string): string =>
  text(r[0]) === text(r[1]) ? text(r[0]) : TEXTS.to(text(r[0]), text(r[1]));

function saying({ trait, wants }: LearnedWishJson, unit: SpeedUnit): TraitWords | null {
  const one = (v: number) => num(v, 1);
  switch (trait) {
    case 'pace':
      return { what: TEXTS.meanSpeed, unit: ` ${unit}`, value: (r) => between(r, (v) => speedText(v, unit)) };
    case 'gap':
      return wants === 'more'
        ? { what: TEXTS.smallestGap, unit: ' s', value: (r) => one(r[0]) }
        : { what: TEXTS.gapOf, unit: ' s', value: (r) => between(r, one) };
    case 'harshness':
      return wants === 'less'
        ? { what: TEXTS.highestAcceleration, unit: ` ${accelerationUnit()}`, value: (r) => lengthText(r[1], 1) }
        : {
            what: TEXTS.acceleration,
            unit: ` ${accelerationUnit()}`,
            value: (r) => between(r, (v) => lengthText(v, 1)),
          };
    case 'standing':
      return { what: TEXTS.waitingTime, unit: ' s', value: (r) => between(r, one) };
    case 'from_log':
      return {
        what: TEXTS.distanceToLog,
        unit: ` ${lengthUnit()}`,
        value: (r) => between(r, (v) => lengthText(v, 1)),
      };
    default:
      return null;
  }
}

/** Does a card show the preferred trait? Null where undecidable. */
function shows(f: Features, w: Wish): boolean | null {
  const is =
    w.trait === 'first'
      ? f.first?.[w.who]?.[w.with]
      : w.trait === 'does' && f.manoeuvres?.[w.who] !== undefined
        ? f.manoeuvres[w.who] === w.manoeuvre
        : undefined;
  return is === undefined ? null : is === (w.wants === 'more');
}

function shares(w: Wish, answers: readonly CardVerdict[]): string {
  const of = (verdict: Verdict) => {
    const known = answers.filter((a) => a.verdict === verdict).map((a) => shows(a.features, w));
    const all = known.filter((v) => v !== null);
    return all.length ? TEXTS.of(all.filter(Boolean).length, all.length) : null;
  };
  const [kept, rejected] = [of('keep'), of('reject')];
  if (kept && rejected) return TEXTS.trueOfBoth(kept, rejected);
  return kept ? TEXTS.trueOfKept(kept) : rejected ? TEXTS.trueOfRejected(rejected) : '';
}

/** Verdicts that contradict a preference: `A of round 1, “After Car 12”, was kept.` */
export const againstWords = (a: CardVerdict): string =>
  a.name
    ? a.verdict === 'keep'
      ? TEXTS.ofRoundWasKept(a.letter, a.round, a.name)
      : TEXTS.ofRoundWasRejected(a.letter, a.round, a.name)
    : a.verdict === 'keep'
      ? TEXTS.unnamedWasKept(a.letter, a.round)
      : TEXTS.unnamedWasRejected(a.letter, a.round);

// -------------------------------------------------------------- reasons

export interface Choice {
  /** Identifies the preference; equal for equal ones. */
  readonly key: string;
  readonly words: string;
  readonly wish: Wish;
}

export const wishKey = (w: Wish): string => `${w.wants} ${traitKey(w)}`;

const choice = (wish: Wish, words: string): Choice => ({ key: wishKey(wish), words, wish });

type PlainTrait = Exclude<Trait['trait'], 'first' | 'does'>;
type ReasonRow = readonly [PlainTrait, 'more' | 'less', fault: string, liked: string];

const REASONS: readonly ReasonRow[] = [
  ['pace', 'more', TEXTS.tooSlow, TEXTS.brisk],
  ['pace', 'less', TEXTS.tooFast, TEXTS.calm],
  ['gap', 'more', TEXTS.tooClose, TEXTS.keepsClear],
  ['gap', 'less', TEXTS.tooCareful, TEXTS.takesTheGap],
  ['harshness', 'less', TEXTS.tooHarsh, TEXTS.smooth],
  ['standing', 'less', TEXTS.waitsTooLong, TEXTS.hardlyWaits],
  ['standing', 'more', TEXTS.shouldWait, TEXTS.waits],
  ['from_log', 'less', TEXTS.tooUnlikeTheLog, TEXTS.likeTheLog],
];

/** Beyond this number the orders of a scene are a list, not a choice. */
const MOST_ORDERS = 12;

/** Known passing orders: of one road user, or of all. */
function orders(id: string | null, f: Features): (readonly [who: string, other: string, first: boolean])[] {
  const all = Object.entries(f.first ?? {}).filter(([who]) => id === null || who === id);
  const pairs = all.flatMap(([who, row]) => Object.entries(row).map(([other, first]) => [who, other, first] as const));
  // A scene lists the same pair from both sides.
  const once = pairs.filter(([p, q], i) => !pairs.slice(0, i).some(([r, s]) => r === q && s === p));
  return id === null ? once.slice(0, MOST_ORDERS) : pairs;
}

/** Possible reasons for a verdict: faults of the card, or what was liked. */
export function reasons(id: string | null, f: Features, verdict: Verdict, nameOf: NameOf): Choice[] {
  const liked = verdict === 'keep';
  const plain = REASONS.filter(([t]) => t !== 'from_log' || f.from_log_m != null).map(([trait, wants, fault, good]) =>
    choice({ trait, wants }, liked ? good : fault),
  );
  const order = orders(id, f).map(([me, other, first]) => {
    const who = called(nameOf, other);
    const wish: Wish = { trait: 'first', who: me, with: other, wants: first === liked ? 'more' : 'less' };
    // For a whole scene the road user must be named.
    const it = id === null ? `${called(nameOf, me)} ` : '';
    if (liked) return choice(wish, it + (first ? TEXTS.goesBefore(who) : TEXTS.yieldsTo(who)));
    return choice(wish, it + (first ? TEXTS.shouldGoAfter(who) : TEXTS.shouldGoBefore(who)));
  });
  return [...plain, ...order];
}

/** All possible preferences for the current cards. */
export function wishes(id: string | null, cards: readonly Features[], nameOf: NameOf): Choice[] {
  const logged = cards.some((f) => f.from_log_m != null);
  const plain = (Object.keys(PLAIN) as PlainTrait[])
    .filter((t) => t !== 'from_log' || logged)
    .flatMap((trait) => (['less', 'more'] as const).map((wants): Wish => ({ trait, wants })));
  const met = new Map(cards.flatMap((f) => orders(id, f)).map(([who, other]) => [`${who}|${other}`, [who, other]]));
  const order = [...met.values()].flatMap(([who, other]) =>
    (['more', 'less'] as const).map((wants): Wish => ({ trait: 'first', who, with: other, wants })),
  );
  const done = new Set(id === null ? [] : cards.flatMap((f) => f.manoeuvres?.[id] ?? []));
  const does = [...done].map((manoeuvre): Wish => ({ trait: 'does', who: id!, manoeuvre, wants: 'more' }));
  return [...plain, ...order, ...does].map((w) => choice(w, firstWords(w, nameOf) ?? wishWords(w, nameOf)));
}

/** Passing order with the name of the other one, where several are possible. */
const firstWords = (w: Wish, nameOf: NameOf): string | null =>
  w.trait === 'first' && w.wants === 'more' ? TEXTS.calledBefore(called(nameOf, w.who), called(nameOf, w.with)) : null;

export const whyWords = (id: string | null, a: CardVerdict, nameOf: NameOf): string => {
  const key = a.why && wishKey(a.why);
  return key ? (reasons(id, a.features, a.verdict, nameOf).find((c) => c.key === key)?.words ?? '') : '';
};

/** A card in two facts. */
export function factWords(f: Features): string {
  // The widest counted gap means only that no road user is near.
  const gap = f.gap_s >= 5 ? TEXTS.clear : TEXTS.gap(seconds(f.gap_s));
  return `${gap} · ${f.standing_s >= 0.5 ? TEXTS.waitsFor(seconds(f.standing_s)) : acceleration(f.harshness_mps2)}`;
}
