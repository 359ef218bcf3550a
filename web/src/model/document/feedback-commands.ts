// Commands on feedback: a card is kept or rejected, a preference is added or forgotten, the next round begins.
import type { Schemas } from '../base/schemas';
import { patchAgents, patchScene, type Command } from './commands';
import { answerTo, following, MOST_ANSWERS, MOST_WISHES, NO_FEEDBACK, SAME_M, sameTrait, traitOf } from './feedback';
import type { CardVerdict, RoundInputs, Feedback, Places, Trait, Verdict, Wish } from './feedback';
import type { Agent, Scene } from './scene';
import { capitalised } from '../../texts/language';
import { TEXTS } from '../../texts/scene/feedback';

/** Limit for whole scenes, which is lower: each answer holds the positions of all. */
const MOST_ANSWERS_OF_SCENE = 60;

/** A displayed card. */
export interface Judged {
  readonly card: Schemas['RoundCard'];
  readonly letter: string;
  readonly name: string;
}

/** Subject of rounds. */
export interface Subject {
  /** Null for the whole scene: each card is a scene then. */
  readonly id: string | null;
  readonly name: string;
  readonly feedback: Feedback | null;
  /** The command that stores the feedback. */
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

/** Short form of a scene's positions: to 0.1 m, and one position for each standing road user. */
function shortPlaces(all: Places): Places {
  const tenth = (v: number): number => Math.round(v * 10) / 10;
  const short = ([first, ...rest]: readonly (readonly number[])[]): readonly (readonly number[])[] => {
    const stands = rest.every((p) => Math.hypot(p[0] - first[0], p[1] - first[1]) <= SAME_M / 2);
    return (stands ? [first] : [first, ...rest]).map(([x, y]) => [tenth(x), tenth(y)]);
  };
  return Object.fromEntries(Object.entries(all).flatMap(([id, p]) => (p.length ? [[id, short(p)]] : [])));
}

const put = (name: string, a: Subject, asked: RoundInputs, patch: Partial<Feedback>): Command =>
  a.say(name, Object.freeze({ ...(a.feedback ?? NO_FEEDBACK), asked, ...patch }));

/** Keeps or rejects a card; null clears the verdict. */
export function judge(
  a: Subject,
  asked: RoundInputs,
  of: Judged,
  verdict: Verdict | null,
  why: Wish | null = null,
): Command {
  const was = answerTo(a.feedback, asked, of.card);
  const answers = a.feedback?.answers ?? [];
  const { letter, name } = of;
  const { features } = of.card;
  const places = a.id === null ? shortPlaces(of.card.places) : of.card.places;
  const most = a.id === null ? MOST_ANSWERS_OF_SCENE : MOST_ANSWERS;
  const said: CardVerdict | null = verdict && {
    ...{ features, places: was?.places ?? places, verdict, why, letter, name },
    round: asked.round,
  };
  const at = was ? answers.indexOf(was) : answers.length;
  const next = answers.toSpliced(at, was ? 1 : 0, ...(said ? [Object.freeze(said)] : []));
  const word = verdict === null ? TEXTS.openAgain : verdict === 'keep' ? TEXTS.kept : TEXTS.rejected;
  const what = a.id === null ? TEXTS.card : TEXTS.future;
  const step =
    was && was.verdict === verdict ? TEXTS.whyWas(what, letter, word) : `${capitalised(what)} ${letter} ${word}`;
  return put(`${step}, ${a.name}`, a, asked, { answers: Object.freeze(next.slice(-most)) });
}

/** Adds a preference; it replaces another one about the same trait. */
export function addWish(a: Subject, asked: RoundInputs, wish: Wish, words: string): Command {
  const { wishes, forgotten } = a.feedback ?? NO_FEEDBACK;
  const others = wishes.filter((w) => !sameTrait(w, wish)).slice(1 - MOST_WISHES);
  return put(TEXTS.wishedFor(words, a.name), a, asked, {
    wishes: Object.freeze([...others, wish]),
    forgotten: forgotten.filter((t) => !sameTrait(t, wish)),
  });
}

/** Ignores a trait, whatever the verdicts show. `words`: the name of the trait. */
export function forget(a: Subject, asked: RoundInputs, traits: readonly Trait[], words: string): Command {
  const { wishes, forgotten } = a.feedback ?? NO_FEEDBACK;
  const gone = (t: Trait): boolean => traits.some((g) => sameTrait(g, t));
  const all = [...forgotten.filter((t) => !gone(t)), ...traits.map(traitOf)];
  return put(TEXTS.forgottenFor(words, a.name), a, asked, {
    wishes: wishes.filter((w) => !gone(w)),
    forgotten: Object.freeze(all.slice(-MOST_WISHES)),
  });
}

/** Cards from the feedback so far. */
export function nextRound(a: Subject, asked: RoundInputs): Command {
  const next = following(a.feedback, asked);
  return put(TEXTS.roundOf(next.round, a.name), a, next, {});
}
