// What was said of a road user's futures, or of ways that the whole scene could go, round after round: which were kept,
// which rejected and why, and plain wishes.
// It is part of the document, and so is what the present cards were drawn by: an undo shows the earlier ones again.
import { patchAgents, patchScene, type Command } from './commands';
import type { FeaturesJson, FeedbackDocJson, RoundCardJson, TraitJson, WishJson } from './scene-json';
import { sceneKey, type Agent, type Scene } from './scene';
import { TEXTS } from '../../texts/feedback';

export type Features = FeaturesJson;
export type Trait = TraitJson;
export type Wish = WishJson;
export type Verdict = 'keep' | 'reject';
/** Box centres at every half second, by road user. */
export type Places = Readonly<Record<string, readonly (readonly number[])[]>>;

/** A card that was kept or rejected. */
export interface Answer {
  readonly features: Features;
  readonly places: Places;
  readonly verdict: Verdict;
  /** What should be otherwise, or was liked. */
  readonly why: Wish | null;
  readonly round: number;
  readonly letter: string;
  /** As the future was called. */
  readonly name: string;
}

/** What the cards of a round are drawn by, beside the answers of the rounds before it. */
export interface Asked {
  readonly round: number;
  /** Names the document that the cards belong to. */
  readonly key: string;
  readonly wishes: readonly Wish[];
  readonly forgotten: readonly Trait[];
}

export interface Feedback {
  readonly answers: readonly Answer[];
  /** Said outright. */
  readonly wishes: readonly Wish[];
  /** Traits that do not count, whatever the answers show. */
  readonly forgotten: readonly Trait[];
  readonly asked: Asked | null;
}

/** As many as a question may carry. */
const MOST_ANSWERS = 200;
/** Of scenes fewer are kept: each holds where everybody is. */
const MOST_ANSWERS_OF_SCENE = 60;
const MOST_WISHES = 32;
/** So many different traits a question may speak of, and so many of them every card has. */
const MOST_TRAITS = 64;
const PLAIN_TRAITS = 5;

const NOTHING: Feedback = Object.freeze({ answers: [], wishes: [], forgotten: [], asked: null });

/** Names all that the cards depend on in a document, wherever it is kept. */
export const printOf = (scene: Scene): string => shortFor(sceneKey({ ...scene, id: '' }));

/** A short text in place of a long one. */
export function shortFor(text: string): string {
  // FNV-1a, twice with different beginnings: 64 bits.
  let [a, b] = [0x811c9dc5, 0x9dc5811c];
  for (const ch of text) {
    const c = ch.codePointAt(0)!;
    a = Math.imul(a ^ c, 0x01000193);
    b = Math.imul(b ^ (c + 7), 0x01000193);
  }
  return [a, b].map((v) => (v >>> 0).toString(16).padStart(8, '0')).join('');
}

/** The round to be shown: the one that was asked last while the document is the same, else the next one. */
export function presentRound(f: Feedback | null, key: string): Asked {
  if (f?.asked?.key === key) return f.asked;
  const last = Math.max(0, ...(f?.answers ?? []).map((a) => a.round));
  return { round: last + 1, key, wishes: f?.wishes ?? [], forgotten: f?.forgotten ?? [] };
}

/** The answers that the cards of a round rest on, in the order in which they are sent. */
export const earlierAnswers = (f: Feedback | null, asked: Asked): readonly Answer[] =>
  (f?.answers ?? []).filter((a) => a.round < asked.round);

/** What is sent. */
export function docOf(f: Feedback | null, asked: Asked): FeedbackDocJson {
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
 * The same with no more than so many traits of single road users: of a scene with many in it those count that tell its
 * cards from each other.
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
  // An order is one trait, whichever way; each manoeuvre is one.
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

const following = (f: Feedback | null, { round, key }: Asked): Asked =>
  Object.freeze({ round: round + 1, key, wishes: f?.wishes ?? [], forgotten: f?.forgotten ?? [] });

/** Would the next round have other cards than this one? */
export const hasNews = (f: Feedback | null, asked: Asked): boolean =>
  JSON.stringify(docOf(f, following(f, asked))) !== JSON.stringify(docOf(f, asked));

export function traitKey(t: Trait): string {
  if (t.trait === 'first') return JSON.stringify([t.trait, t.who, t.with]);
  return JSON.stringify(t.trait === 'does' ? [t.trait, t.who, t.manoeuvre] : [t.trait]);
}

/** The trait alone, without which way it is wished. */
export function traitOf(t: Trait): Trait {
  if (t.trait === 'first') return { trait: t.trait, who: t.who, with: t.with };
  return t.trait === 'does' ? { trait: t.trait, who: t.who, manoeuvre: t.manoeuvre } : { trait: t.trait };
}

export const sameTrait = (a: Trait, b: Trait): boolean => traitKey(a) === traitKey(b);

/** Two of a round are further apart than this somewhere, metres; the same one drawn again is nearer. */
const SAME_M = 0.3;

function samePlaces(a: Places, b: Places): boolean {
  const ids = Object.keys(a);
  if (ids.length !== Object.keys(b).length) return false;
  return ids.every((id) => {
    const q = b[id];
    // Of whoever stands there only the first place is kept.
    return !!q && a[id].slice(0, q.length).every((p, i) => Math.hypot(p[0] - q[i][0], p[1] - q[i][1]) <= SAME_M);
  });
}

/** A scene's places in few words: to a tenth of a metre, and one of whoever stands. */
function shortPlaces(all: Places): Places {
  const tenth = (v: number): number => Math.round(v * 10) / 10;
  const short = ([first, ...rest]: readonly (readonly number[])[]): readonly (readonly number[])[] => {
    const stands = rest.every((p) => Math.hypot(p[0] - first[0], p[1] - first[1]) <= SAME_M / 2);
    return (stands ? [first] : [first, ...rest]).map(([x, y]) => [tenth(x), tenth(y)]);
  };
  return Object.fromEntries(Object.entries(all).flatMap(([id, p]) => (p.length ? [[id, short(p)]] : [])));
}

/** What was said of a card of this round. */
export const answerTo = (f: Feedback | null, asked: Asked, card: Pick<RoundCardJson, 'places'>): Answer | null =>
  f?.answers.find((a) => a.round === asked.round && samePlaces(a.places, card.places)) ?? null;

// -------------------------------------------------------------- commands

/** A card as it is on the page. */
export interface Judged {
  readonly card: RoundCardJson;
  readonly letter: string;
  readonly name: string;
}

/** Whom rounds are about. */
export interface Subject {
  /** Null for everybody: a card is a scene then. */
  readonly id: string | null;
  readonly name: string;
  readonly feedback: Feedback | null;
  /** The command that keeps what was said. */
  say(name: string, feedback: Feedback): Command;
}

export const oneSubject = (a: Agent): Subject => ({
  id: a.id,
  name: a.name,
  feedback: a.feedback,
  say: (name, feedback) => patchAgents(name, new Map([[a.id, { feedback }]])),
});

export const everybody = (scene: Scene): Subject => ({
  id: null,
  name: TEXTS.theWholeScene,
  feedback: scene.feedback,
  say: (name, feedback) => patchScene(name, { feedback }),
});

const put = (name: string, a: Subject, asked: Asked, patch: Partial<Feedback>): Command =>
  a.say(name, Object.freeze({ ...(a.feedback ?? NOTHING), asked, ...patch }));

const upper = (word: string): string => word.charAt(0).toUpperCase() + word.slice(1);

/** Keeps or rejects a card; null opens it again. */
export function judge(a: Subject, asked: Asked, of: Judged, verdict: Verdict | null, why: Wish | null = null): Command {
  const was = answerTo(a.feedback, asked, of.card);
  const answers = a.feedback?.answers ?? [];
  const { letter, name } = of;
  const { features } = of.card;
  const places = a.id === null ? shortPlaces(of.card.places) : of.card.places;
  const most = a.id === null ? MOST_ANSWERS_OF_SCENE : MOST_ANSWERS;
  const said: Answer | null = verdict && {
    ...{ features, places: was?.places ?? places, verdict, why, letter, name },
    round: asked.round,
  };
  const at = was ? answers.indexOf(was) : answers.length;
  const next = answers.toSpliced(at, was ? 1 : 0, ...(said ? [Object.freeze(said)] : []));
  const word = verdict === null ? TEXTS.openAgain : verdict === 'keep' ? TEXTS.kept : TEXTS.rejected;
  const what = a.id === null ? TEXTS.card : TEXTS.future;
  const step = was && was.verdict === verdict ? TEXTS.whyWas(what, letter, word) : `${upper(what)} ${letter} ${word}`;
  return put(`${step}, ${a.name}`, a, asked, { answers: Object.freeze(next.slice(-most)) });
}

/** A wish of one's own; it takes the place of another about the same. */
export function addWish(a: Subject, asked: Asked, wish: Wish, words: string): Command {
  const { wishes, forgotten } = a.feedback ?? NOTHING;
  const others = wishes.filter((w) => !sameTrait(w, wish)).slice(1 - MOST_WISHES);
  return put(TEXTS.wishedFor(words, a.name), a, asked, {
    wishes: Object.freeze([...others, wish]),
    forgotten: forgotten.filter((t) => !sameTrait(t, wish)),
  });
}

/** Whatever the answers show of it, it does not count. `words`: what is forgotten. */
export function forget(a: Subject, asked: Asked, traits: readonly Trait[], words: string): Command {
  const { wishes, forgotten } = a.feedback ?? NOTHING;
  const gone = (t: Trait): boolean => traits.some((g) => sameTrait(g, t));
  const all = [...forgotten.filter((t) => !gone(t)), ...traits.map(traitOf)];
  return put(TEXTS.forgottenFor(words, a.name), a, asked, {
    wishes: wishes.filter((w) => !gone(w)),
    forgotten: Object.freeze(all.slice(-MOST_WISHES)),
  });
}

/** Cards by what was said until now. */
export function nextRound(a: Subject, asked: Asked): Command {
  const next = following(a.feedback, asked);
  return put(TEXTS.roundOf(next.round, a.name), a, next, {});
}

// -------------------------------------------------------------- from a file

const isObject = (v: unknown): v is Record<string, unknown> => typeof v === 'object' && v !== null && !Array.isArray(v);
const isText = (v: unknown): v is string => typeof v === 'string';
const isNumber = (v: unknown): v is number => typeof v === 'number' && Number.isFinite(v) && v >= 0;
const listOf = <T>(v: unknown, most: number, read: (x: unknown) => T | null): readonly T[] =>
  Object.freeze((Array.isArray(v) ? v : []).slice(-most).flatMap((x) => read(x) ?? []));

/** What was kept of it in a file; what cannot be read is left out. */
export function readFeedback(v: unknown): Feedback | null {
  if (!isObject(v)) return null;
  const answers = listOf(v.answers, MOST_ANSWERS, readAnswer);
  const [wishes, forgotten] = [listOf(v.wishes, MOST_WISHES, readWish), listOf(v.forgotten, MOST_WISHES, readTrait)];
  const asked = readAsked(v.asked);
  return answers.length || wishes.length || forgotten.length || asked
    ? Object.freeze({ answers, wishes, forgotten, asked })
    : null;
}

function readAsked(v: unknown): Asked | null {
  if (!isObject(v) || !Number.isSafeInteger(v.round) || (v.round as number) < 1 || !isText(v.key)) return null;
  const [wishes, forgotten] = [listOf(v.wishes, MOST_WISHES, readWish), listOf(v.forgotten, MOST_WISHES, readTrait)];
  return Object.freeze({ round: v.round as number, key: v.key, wishes, forgotten });
}

function readAnswer(v: unknown): Answer | null {
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
