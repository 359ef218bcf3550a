// Feedback on futures of a road user, or of the whole scene, round by round: kept and rejected cards with reasons, and
// plain preferences. It is part of the document, and so are the inputs of the current cards: undo shows the earlier
// ones again.
import { JUDGING } from '../base/domain';
import type { Schemas } from '../base/schemas';

export type Features = Schemas['Features'];
export type Trait = Schemas['Trait'];
export type Wish = Schemas['Wish'];
export type Verdict = 'keep' | 'reject';
/** Box centres at every half second, by road user. */
export type Places = Readonly<Record<string, readonly (readonly number[])[]>>;

/** A card that was kept or rejected. */
export interface CardVerdict {
  readonly features: Features;
  readonly places: Places;
  readonly verdict: Verdict;
  /** The trait to change, or that was liked. */
  readonly why: Wish | null;
  readonly round: number;
  readonly letter: string;
  /** Name of the future. */
  readonly name: string;
}

/** Inputs of a round's cards, beside the verdicts of earlier rounds. */
export interface RoundInputs {
  readonly round: number;
  /** Key of the document that the cards belong to. */
  readonly key: string;
  readonly wishes: readonly Wish[];
  readonly forgotten: readonly Trait[];
}

export interface Feedback {
  readonly answers: readonly CardVerdict[];
  /** Stated explicitly. */
  readonly wishes: readonly Wish[];
  /** Traits to ignore, whatever the verdicts are. */
  readonly forgotten: readonly Trait[];
  readonly asked: RoundInputs | null;
}

/** Maximum number in a request. */
export const MOST_ANSWERS = 200;
export const MOST_WISHES = 32;
/** Maximum number of different traits in a request, each present on every card. */
const MOST_TRAITS = 64;
const PLAIN_TRAITS = 5;

export const NO_FEEDBACK: Feedback = Object.freeze({ answers: [], wishes: [], forgotten: [], asked: null });

/** The round to show: the last requested one while the document is the same, else the next one. */
export function presentRound(f: Feedback | null, key: string): RoundInputs {
  if (f?.asked?.key === key) return f.asked;
  const last = Math.max(0, ...(f?.answers ?? []).map((a) => a.round));
  return { round: last + 1, key, wishes: f?.wishes ?? [], forgotten: f?.forgotten ?? [] };
}

/** Verdicts that the cards of a round are based on, in the order of sending. */
export const earlierAnswers = (f: Feedback | null, asked: RoundInputs): readonly CardVerdict[] =>
  (f?.answers ?? []).filter((a) => a.round < asked.round);

/** The feedback of a request. */
export function docOf(f: Feedback | null, asked: RoundInputs): Schemas['Feedback'] {
  const earlier = earlierAnswers(f, asked);
  const lean = leanFeatures(
    earlier.map((a) => a.features),
    MOST_TRAITS - PLAIN_TRAITS - asked.wishes.length,
  );
  const answers = earlier.map(({ places, verdict, why }, i) => ({
    features: lean[i],
    places: places as Record<string, number[][]>,
    verdict,
    ...(why ? { why } : {}),
  }));
  return { answers, wishes: [...asked.wishes], forgotten: [...asked.forgotten] };
}

/**
 * The same with a limited number of traits of single road users: in a large scene the traits that distinguish its cards
 * stay.
 */
function leanFeatures(all: readonly Features[], room: number): readonly Features[] {
  const values = new Map<string, Set<unknown>>();
  const seen = new Map<string, number>();
  const note = (key: string, value: unknown): void => {
    values.set(key, (values.get(key) ?? new Set()).add(value));
    seen.set(key, (seen.get(key) ?? 0) + 1);
  };
  const pair = (who: string, other: string): string => `p${JSON.stringify([who, other])}`;
  const deed = (who: string): string => `m${who}`;
  for (const { first, manoeuvres } of all) {
    for (const [who, row] of Object.entries(first ?? {}))
      for (const [other, is] of Object.entries(row)) note(pair(who, other), is);
    for (const [who, does] of Object.entries(manoeuvres ?? {})) note(deed(who), does);
  }
  // The order of two is one trait in either direction; each manoeuvre is one.
  const cost = (key: string): number => (key.startsWith('p') ? 1 : values.get(key)!.size);
  const keys = [...values.keys()];
  if (keys.reduce((sum, k) => sum + cost(k), 0) <= room) return all;
  const tells = (key: string): boolean => values.get(key)!.size > 1 || seen.get(key)! < all.length;
  const kept = new Set<string>();
  let left = room;
  for (const key of [...keys.filter(tells), ...keys.filter((k) => !tells(k))]) {
    if (cost(key) > left) continue;
    left -= cost(key);
    kept.add(key);
  }
  return all.map(({ first, manoeuvres, ...plain }) => {
    const rows = Object.entries(first ?? {}).map(([who, row]) => {
      const few = Object.entries(row).filter(([other]) => kept.has(pair(who, other)));
      return [who, Object.fromEntries(few)] as const;
    });
    const does = Object.entries(manoeuvres ?? {}).filter(([who]) => kept.has(deed(who)));
    return {
      ...plain,
      first: Object.fromEntries(rows.filter(([, row]) => Object.keys(row).length)),
      manoeuvres: Object.fromEntries(does),
    };
  });
}

/** The next round. */
export const following = (f: Feedback | null, { round, key }: RoundInputs): RoundInputs =>
  Object.freeze({ round: round + 1, key, wishes: f?.wishes ?? [], forgotten: f?.forgotten ?? [] });

/** Would the next round have other cards than this one? */
export const hasNews = (f: Feedback | null, asked: RoundInputs): boolean =>
  JSON.stringify(docOf(f, following(f, asked))) !== JSON.stringify(docOf(f, asked));

export function traitKey(t: Trait): string {
  if (t.trait === 'first') return JSON.stringify([t.trait, t.who, t.with]);
  return JSON.stringify(t.trait === 'does' ? [t.trait, t.who, t.manoeuvre] : [t.trait]);
}

/** The trait without its direction. */
export function traitOf(t: Trait): Trait {
  if (t.trait === 'first') return { trait: t.trait, who: t.who, with: t.with };
  return t.trait === 'does' ? { trait: t.trait, who: t.who, manoeuvre: t.manoeuvre } : { trait: t.trait };
}

export const sameTrait = (a: Trait, b: Trait): boolean => traitKey(a) === traitKey(b);

/** Two cards of a round are further apart than this somewhere, metres; a repeated one is nearer. */
export const SAME_M = JUDGING.card_apart_m;

function samePlaces(a: Places, b: Places): boolean {
  const ids = Object.keys(a);
  if (ids.length !== Object.keys(b).length) return false;
  return ids.every((id) => {
    const q = b[id];
    // Only the first position of a standing road user is stored.
    return !!q && a[id].slice(0, q.length).every((p, i) => Math.hypot(p[0] - q[i][0], p[1] - q[i][1]) <= SAME_M);
  });
}

/** The verdict on a card of this round. */
export const answerTo = (
  f: Feedback | null,
  asked: RoundInputs,
  card: { readonly places: Places },
): CardVerdict | null => f?.answers.find((a) => a.round === asked.round && samePlaces(a.places, card.places)) ?? null;

// -------------------------------------------------------------- from a file

const isObject = (v: unknown): v is Record<string, unknown> => typeof v === 'object' && v !== null && !Array.isArray(v);
const isText = (v: unknown): v is string => typeof v === 'string';
const isNumber = (v: unknown): v is number => typeof v === 'number' && Number.isFinite(v) && v >= 0;
const listOf = <T>(v: unknown, most: number, read: (x: unknown) => T | null): readonly T[] =>
  Object.freeze((Array.isArray(v) ? v : []).slice(-most).flatMap((x) => read(x) ?? []));

/** Feedback stored in a file; unreadable parts are dropped. */
export function readFeedback(v: unknown): Feedback | null {
  if (!isObject(v)) return null;
  const answers = listOf(v.answers, MOST_ANSWERS, readAnswer);
  const [wishes, forgotten] = [listOf(v.wishes, MOST_WISHES, readWish), listOf(v.forgotten, MOST_WISHES, readTrait)];
  const asked = readAsked(v.asked);
  return answers.length || wishes.length || forgotten.length || asked
    ? Object.freeze({ answers, wishes, forgotten, asked })
    : null;
}

function readAsked(v: unknown): RoundInputs | null {
  if (!isObject(v) || !Number.isSafeInteger(v.round) || (v.round as number) < 1 || !isText(v.key)) return null;
  const [wishes, forgotten] = [listOf(v.wishes, MOST_WISHES, readWish), listOf(v.forgotten, MOST_WISHES, readTrait)];
  return Object.freeze({ round: v.round as number, key: v.key, wishes, forgotten });
}

function readAnswer(v: unknown): CardVerdict | null {
  if (!isObject(v) || (v.verdict !== 'keep' && v.verdict !== 'reject')) return null;
  const [features, places] = [readFeatures(v.features), readPlaces(v.places)];
  if (!features || !places || !Number.isSafeInteger(v.round) || (v.round as number) < 1) return null;
  return Object.freeze({
    features,
    places,
    verdict: v.verdict,
    why: readWish(v.why),
    round: v.round as number,
    letter: isText(v.letter) ? v.letter.slice(0, 1) : '',
    name: isText(v.name) ? v.name.slice(0, 80) : '',
  });
}

const MANOEUVRES = ['straight', 'left', 'right', 'turn_round', 'lane_left', 'lane_right', 'stays', 'reverse'] as const;
type Does = Extract<Trait, { trait: 'does' }>['manoeuvre'];
const isManoeuvre = (v: unknown): v is Does => MANOEUVRES.includes(v as Does);

function readFeatures(v: unknown): Features | null {
  if (!isObject(v)) return null;
  const { pace_mps, gap_s, harshness_mps2, standing_s, from_log_m } = v;
  if (!isNumber(pace_mps) || !isNumber(gap_s) || !isNumber(harshness_mps2) || !isNumber(standing_s)) return null;
  const out: Features = { pace_mps, gap_s, harshness_mps2, standing_s };
  if (isNumber(from_log_m)) out.from_log_m = from_log_m;
  if (isObject(v.first) && Object.values(v.first).every(isObject)) {
    const rows = Object.entries(v.first as Record<string, Record<string, unknown>>).map(([who, row]) => {
      const known = Object.entries(row).filter((e): e is [string, boolean] => typeof e[1] === 'boolean');
      return [who, Object.fromEntries(known)] as const;
    });
    out.first = Object.fromEntries(rows);
  }
  if (isObject(v.manoeuvres))
    out.manoeuvres = Object.fromEntries(
      Object.entries(v.manoeuvres).filter((e): e is [string, Does] => isManoeuvre(e[1])),
    );
  return Object.freeze(out);
}

const MOST_PLACES = 41;
const isPlace = (v: unknown): v is number[] => Array.isArray(v) && v.length === 2 && v.every(Number.isFinite);

function readPlaces(v: unknown): Places | null {
  if (!isObject(v)) return null;
  const all = Object.entries(v);
  const fine = all.every(([, p]) => Array.isArray(p) && p.length <= MOST_PLACES && p.every(isPlace));
  return fine ? (Object.freeze(Object.fromEntries(all)) as Places) : null;
}

const PLAIN = ['pace', 'gap', 'harshness', 'standing', 'from_log'] as const;

function readTrait(v: unknown): Trait | null {
  if (!isObject(v)) return null;
  const plain = PLAIN.find((t) => t === v.trait);
  if (plain) return Object.freeze({ trait: plain });
  if (v.trait === 'first' && isText(v.who) && isText(v.with))
    return Object.freeze({ trait: 'first', who: v.who, with: v.with });
  if (v.trait === 'does' && isText(v.who) && isManoeuvre(v.manoeuvre))
    return Object.freeze({ trait: 'does', who: v.who, manoeuvre: v.manoeuvre });
  return null;
}

function readWish(v: unknown): Wish | null {
  const trait = readTrait(v);
  const wants = isObject(v) ? v.wants : null;
  return trait && (wants === 'more' || wants === 'less') ? Object.freeze({ ...trait, wants }) : null;
}
