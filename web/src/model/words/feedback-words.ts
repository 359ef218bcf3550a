// Wishes, what they rest on, and why a card was kept or rejected, in plain words.
import { traitKey, type Answer, type Features, type Trait, type Verdict, type Wish } from '../document/feedback';
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

type NameOf = (id: string) => string | null;
export interface Speaking {
  readonly nameOf: NameOf;
  readonly unit: SpeedUnit;
}

const MANOEUVRES = {
  straight: TEXTS.straightOn,
  left: TEXTS.turnsLeft,
  right: TEXTS.turnsRight,
  turn_round: TEXTS.turnsRound,
  lane_left: TEXTS.toTheLeftLane,
  lane_right: TEXTS.toTheRightLane,
  stays: TEXTS.stays,
  reverse: TEXTS.backsUp,
} as const;

const PLAIN = {
  pace: { more: TEXTS.faster, less: TEXTS.slower },
  gap: { more: TEXTS.widerGap, less: TEXTS.closer },
  harshness: { more: TEXTS.sharper, less: TEXTS.smoother },
  standing: { more: TEXTS.waitsLonger, less: TEXTS.waitsLess },
  from_log: { more: TEXTS.offTheRecording, less: TEXTS.nearerTheRecording },
} as const;

const called = (nameOf: NameOf, id: string): string => nameOf(id) ?? TEXTS.roadUser(id);

/** A shorter gap than this is nothing to be kept, seconds. */
const LEAST_GAP_S = 1;

/** `Smoother`, `Car 12 first`, `Keeps 2 s gap`. `kept`: the range of the kept ones. */
export function wishWords(w: Wish, nameOf: NameOf, kept?: readonly [number, number] | null): string {
  if (w.trait === 'first') return TEXTS.first(called(nameOf, w.wants === 'more' ? w.who : w.with));
  if (w.trait === 'does')
    return w.wants === 'more' ? MANOEUVRES[w.manoeuvre] : TEXTS.not(inSentence(MANOEUVRES[w.manoeuvre]));
  if (w.trait === 'gap' && w.wants === 'more' && kept && kept[0] >= LEAST_GAP_S)
    return TEXTS.keepsSGap(num(Math.floor(kept[0] * 10) / 10, kept[0] % 1 < 0.1 ? 0 : 1));
  return PLAIN[w.trait][w.wants];
}

type Range = readonly [number, number];

/** `Kept ones stand 0 to 1.2 s, rejected ones 3 to 4 s.` */
export function restsOn(w: LearnedWishJson, answers: readonly Answer[], { unit }: Speaking): string {
  const sentence = w.trait === 'first' || w.trait === 'does' ? shares(w, answers) : ranges(w, unit);
  return [w.said ? TEXTS.youSaidSo : '', sentence].filter(Boolean).join(' ');
}

function ranges(w: LearnedWishJson, unit: SpeedUnit): string {
  const say = saying(w, unit);
  if (!say) return '';
  const { does, value, of } = say;
  const [kept, rejected] = [w.kept ?? null, w.rejected ?? null];
  if (kept && rejected) return TEXTS.keptOnesRejected(does, value(kept), value(rejected), of);
  return kept ? TEXTS.keptOnes(does, value(kept), of) : rejected ? TEXTS.rejectedOnes(does, value(rejected), of) : '';
}

interface Saying {
  /** Before the value, after it. */
  readonly does: string;
  readonly of: string;
  value(r: Range): string;
}

const between = (r: Range, text: (v: number) => string): string =>
  text(r[0]) === text(r[1]) ? text(r[0]) : TEXTS.to(text(r[0]), text(r[1]));

function saying({ trait, wants }: LearnedWishJson, unit: SpeedUnit): Saying | null {
  const one = (v: number) => num(v, 1);
  switch (trait) {
    case 'pace':
      return { does: TEXTS.drive, of: TEXTS.onAverage(unit), value: (r) => between(r, (v) => speedText(v, unit)) };
    case 'gap':
      return wants === 'more'
        ? { does: TEXTS.leaveAtLeast, of: ' s', value: (r) => one(r[0]) }
        : { does: TEXTS.leave, of: ' s', value: (r) => between(r, one) };
    case 'harshness':
      return wants === 'less'
        ? { does: TEXTS.brakeSpeedUp, of: ` ${accelerationUnit()}`, value: (r) => lengthText(r[1], 1) }
        : {
            does: TEXTS.brakeSpeedUpOr,
            of: ` ${accelerationUnit()}`,
            value: (r) => between(r, (v) => lengthText(v, 1)),
          };
    case 'standing':
      return { does: TEXTS.stand, of: ' s', value: (r) => between(r, one) };
    case 'from_log':
      return {
        does: TEXTS.are,
        of: TEXTS.fromTheRecording(lengthUnit()),
        value: (r) => between(r, (v) => lengthText(v, 1)),
      };
    default:
      return null;
  }
}

/** Does a card show what is wished? Null where that cannot be said of it. */
function shows(f: Features, w: Wish): boolean | null {
  const is =
    w.trait === 'first'
      ? f.first?.[w.who]?.[w.with]
      : w.trait === 'does' && f.manoeuvres?.[w.who] !== undefined
        ? f.manoeuvres[w.who] === w.manoeuvre
        : undefined;
  return is === undefined ? null : is === (w.wants === 'more');
}

function shares(w: Wish, answers: readonly Answer[]): string {
  const of = (verdict: Verdict) => {
    const known = answers.filter((a) => a.verdict === verdict).map((a) => shows(a.features, w));
    const all = known.filter((v) => v !== null);
    return all.length ? TEXTS.of(all.filter(Boolean).length, all.length) : null;
  };
  const [kept, rejected] = [of('keep'), of('reject')];
  if (kept && rejected) return TEXTS.soItIsInKept(kept, rejected);
  return kept ? TEXTS.soItIsInKeptOnes(kept) : rejected ? TEXTS.soItIsInRejected(rejected) : '';
}

/** Which answers contradict a wish: `A of round 1, “After Car 12”, was kept.` */
export const againstWords = (a: Answer): string =>
  a.name
    ? a.verdict === 'keep'
      ? TEXTS.ofRoundWasKept(a.letter, a.round, a.name)
      : TEXTS.ofRoundWasRejected(a.letter, a.round, a.name)
    : a.verdict === 'keep'
      ? TEXTS.unnamedWasKept(a.letter, a.round)
      : TEXTS.unnamedWasRejected(a.letter, a.round);

// -------------------------------------------------------------- why

export interface Choice {
  /** Names the wish; equal for equal ones. */
  readonly key: string;
  readonly words: string;
  readonly wish: Wish;
}

export const wishKey = (w: Wish): string => `${w.wants} ${traitKey(w)}`;

const choice = (wish: Wish, words: string): Choice => ({ key: wishKey(wish), words, wish });

type Plain = Exclude<Trait['trait'], 'first' | 'does'>;
type Row = readonly [Plain, 'more' | 'less', fault: string, liked: string];

const REASONS: readonly Row[] = [
  ['pace', 'more', TEXTS.tooSlow, TEXTS.brisk],
  ['pace', 'less', TEXTS.tooFast, TEXTS.calm],
  ['gap', 'more', TEXTS.tooClose, TEXTS.keepsClear],
  ['gap', 'less', TEXTS.tooCareful, TEXTS.goesWhileItCan],
  ['harshness', 'less', TEXTS.tooHarsh, TEXTS.smooth],
  ['standing', 'less', TEXTS.waitsTooLong, TEXTS.hardlyWaits],
  ['standing', 'more', TEXTS.shouldWait, TEXTS.waits],
  ['from_log', 'less', TEXTS.tooFarFromThe, TEXTS.nearTheRecording],
];

/** More orders of two than this are no choice but a list, in a scene. */
const MOST_ORDERS = 12;

/** Who goes before whom, as far as it is known: of one road user, or of everybody. */
function orders(id: string | null, f: Features): (readonly [who: string, other: string, first: boolean])[] {
  const all = Object.entries(f.first ?? {}).filter(([who]) => id === null || who === id);
  const pairs = all.flatMap(([who, row]) => Object.entries(row).map(([other, first]) => [who, other, first] as const));
  // Of a scene the same two stand there from both sides.
  const once = pairs.filter(([p, q], i) => !pairs.slice(0, i).some(([r, s]) => r === q && s === p));
  return id === null ? once.slice(0, MOST_ORDERS) : pairs;
}

/** What may be said about a card: what is wrong with it, or what was liked. */
export function reasons(id: string | null, f: Features, verdict: Verdict, nameOf: NameOf): Choice[] {
  const liked = verdict === 'keep';
  const plain = REASONS.filter(([t]) => t !== 'from_log' || f.from_log_m != null).map(([trait, wants, fault, good]) =>
    choice({ trait, wants }, liked ? good : fault),
  );
  const order = orders(id, f).map(([me, other, first]) => {
    const who = called(nameOf, other);
    const wish: Wish = { trait: 'first', who: me, with: other, wants: first === liked ? 'more' : 'less' };
    // Of a whole scene it must be said who.
    const it = id === null ? `${called(nameOf, me)} ` : '';
    if (liked) return choice(wish, it + (first ? TEXTS.goesBefore(who) : TEXTS.letsGoFirst(who)));
    return choice(wish, it + (first ? TEXTS.shouldGoAfter(who) : TEXTS.shouldGoBefore(who)));
  });
  return [...plain, ...order];
}

/** All that may be wished, given the cards on the table. */
export function wishes(id: string | null, cards: readonly Features[], nameOf: NameOf): Choice[] {
  const logged = cards.some((f) => f.from_log_m != null);
  const plain = (Object.keys(PLAIN) as Plain[])
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

/** Whom it lets go first, where several could be meant. */
const firstWords = (w: Wish, nameOf: NameOf): string | null =>
  w.trait === 'first' && w.wants === 'more' ? TEXTS.calledBefore(called(nameOf, w.who), called(nameOf, w.with)) : null;

export const whyWords = (id: string | null, a: Answer, nameOf: NameOf): string => {
  const key = a.why && wishKey(a.why);
  return key ? (reasons(id, a.features, a.verdict, nameOf).find((c) => c.key === key)?.words ?? '') : '';
};

/** What a card is like, in two facts. */
export function factWords(f: Features): string {
  // The widest gap that is counted says only that nobody is near.
  const gap = f.gap_s >= 5 ? TEXTS.clear : TEXTS.gap(seconds(f.gap_s));
  return `${gap} · ${f.standing_s >= 0.5 ? TEXTS.stands(seconds(f.standing_s)) : acceleration(f.harshness_mps2)}`;
}
