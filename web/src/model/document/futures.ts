// Futures: up to six ways a road user could go, and the sets of them that belong to a document.
import type { AgentFuturesJson } from './scene-json';
import { NOTHING_SAID, readAbout, sentAbout, type FutureFacts, type FaultKind, type SentAbout } from './future-facts';
import type { Point, Pose, Vec } from '../base/geometry';
import { furthestApart, motionFrom, type Motion } from '../base/motion';
import { nameAll, type Naming } from '../words/future-names';
import { metres, num, retold } from '../base/units';
import { TEXTS } from '../../texts/reach';

export { LETTERS } from '../words/future-names';

export interface Future {
  readonly probability: number;
  readonly motion: Motion;
  readonly name: string;
  /** What the name rests on: a relation, or a manner. */
  readonly basis?: string;
  /** What the generator says about it; null where it says nothing. */
  readonly about?: FutureFacts | null;
  /** The same as it was sent. */
  readonly sent?: SentAbout;
  /** Which of the generator's ideas this one follows; null for staying at rest, and where nobody says. */
  readonly anchor?: number | null;
}

export interface Futures {
  readonly modes: readonly Future[];
  /** What the generator chose; the document may say otherwise. */
  readonly chosen: number;
  /** 0 is the first rough guess, `steps` is settled. */
  readonly step: number;
  readonly steps: number;
  /** Nobody has said yet what is wrong with them: not that nothing is. */
  readonly unjudged?: boolean;
  /** True for the plain local curve drawn while the generator is away. */
  readonly sketch?: boolean;
}

export const isSettled = (f: Futures): boolean => f.step >= f.steps;

export function readFutures(
  json: AgentFuturesJson,
  start: Pose,
  step: number,
  steps: number,
  isPedestrian: boolean,
  keep?: KeepOrder,
): Futures {
  const sent = json.modes.slice(0, 6);
  const order = placesOf(sent, keep);
  const modes = order.map((i) => {
    const m = sent[i];
    return {
      probability: m.probability,
      motion: motionFrom(m, start),
      about: readAbout(m),
      sent: sentAbout(m),
      anchor: m.anchor ?? null,
    };
  });
  // What is nothing is not sent; of a list that was judged nothing is wrong with the rest.
  if (modes.some((m) => m.about)) for (const m of modes) m.about ??= NOTHING_SAID;
  const names = nameAll(modes, { onFoot: isPedestrian, nameOf: () => null });
  return {
    modes: modes.map((m, i) => ({ ...m, ...names[i], name: sent[order[i]].name ?? names[i].name })),
    chosen: Math.max(0, order.indexOf(json.chosen ?? 0)),
    step,
    steps,
  };
}

/**
 * Which letter each gets: `rank` makes the likeliest A; else the letters of the futures on screen are taken over,
 * always, or only while the ideas are the same. Without it they stand as they were sent.
 */
export type KeepOrder = 'rank' | { readonly like: Futures | null | undefined; readonly always: boolean };

type Sent = HasAnchor & { readonly probability: number };

function placesOf(sent: readonly Sent[], keep: KeepOrder | undefined): number[] {
  const asSent = sent.map((_, i) => i);
  if (keep === 'rank') return asSent.sort((a, b) => sent[b].probability - sent[a].probability || a - b);
  return keep?.like ? placesLike(keep.like.modes, sent, keep.always) : asSent;
}

interface HasAnchor {
  readonly anchor?: number | null;
}

/** Names for the ideas in a list. Two of the same, or several without a number, are told apart by their turn. */
export function ideas(modes: readonly HasAnchor[]): string[] {
  const count = new Map<number | null, number>();
  return modes.map(({ anchor = null }) => {
    const n = count.get(anchor) ?? 0;
    count.set(anchor, n + 1);
    return `${anchor ?? 'rest'}/${n}`;
  });
}

/**
 * In which order to show what was sent (most likely first), so that an idea keeps its letter and colour while the
 * probabilities change places. Ideas that are new take the places of those that are gone.
 */
export function placesLike(shown: readonly HasAnchor[], sent: readonly HasAnchor[], always: boolean): number[] {
  const was = ideas(shown),
    now = ideas(sent);
  const same = was.length === now.length && now.every((k) => was.includes(k));
  if (!same && !always) return now.map((_, i) => i);
  const rest = now.map((_, i) => i).filter((i) => !was.includes(now[i]));
  const order: number[] = [];
  for (const k of was.slice(0, now.length)) {
    const i = now.indexOf(k);
    if (i >= 0) order.push(i);
    else if (rest.length) order.push(rest.shift()!);
  }
  return [...order, ...now.map((_, i) => i).filter((i) => !order.includes(i))];
}

/**
 * Drafts are shown before they are judged. Until the answer each idea keeps the faults that it had last, or verdicts
 * would come and go with every movement of the hand; where nothing was said, they are marked as not judged.
 */
export function keepVerdicts(shown: Futures | null, next: Futures): Futures {
  if (next.modes.some((m) => m.about?.faults.length)) return next;
  if (!shown || shown.unjudged || !isJudged(shown)) return { ...next, unjudged: true };
  const was = new Map(ideas(shown.modes).map((k, i) => [k, shown.modes[i].about]));
  const keys = ideas(next.modes);
  const modes = next.modes.map((m, i) => {
    const old = was.get(keys[i]);
    return old ? { ...m, about: m.about ? { ...m.about, faults: old.faults } : old } : m;
  });
  return { ...next, modes };
}

/** The same futures, called by how they stand to others. */
export function withNames(f: Futures, who: Naming): Futures {
  const names = nameAll(f.modes, who);
  return { ...f, modes: f.modes.map((m, i) => ({ ...m, ...names[i] })) };
}

/** What somebody does anyway first, in place of the one of these that is most like it. */
export function withOwnFirst(own: Future, f: Futures): Futures {
  const off = f.modes.map((m) => furthestApart(own.motion, m.motion));
  const like = f.modes[off.indexOf(Math.min(...off))];
  const { probability, anchor } = like;
  return { ...f, modes: [{ ...own, probability, anchor }, ...f.modes.filter((m) => m !== like)], chosen: 0 };
}

/** Does the generator say of these futures what is wrong with them? */
export const isJudged = (f: Futures): boolean => f.modes.some((m) => m.about);

/** How likely each is of those that are shown, in whole per cent; together 100. */
export function percents(modes: readonly Pick<Future, 'probability'>[]): number[] {
  const sum = modes.reduce((s, m) => s + m.probability, 0);
  if (!(sum > 0)) return modes.map(() => 0);
  const exact = modes.map((m) => (m.probability / sum) * 100);
  const out = exact.map(Math.floor);
  const byRest = exact.map((v, i) => ({ i, rest: v - out[i] })).sort((a, b) => b.rest - a.rest || a.i - b.i);
  const left = Math.round(100 - out.reduce((s, v) => s + v, 0));
  for (const { i } of byRest.slice(0, left)) out[i]++;
  return out;
}

export interface Collision {
  a: string;
  b: string;
  time: number;
  /** m/s. */
  closing?: number | null;
  /** Absent where the generator does not tell. */
  inLog?: boolean;
}
export interface NearMiss extends Collision {
  distance: number | null;
  ttc: number | null;
}
/** One road user does something that it should not for a while. */
export interface Stretch {
  readonly what: Exclude<FaultKind, 'collision' | 'near_miss'>;
  readonly agent: string;
  readonly time: number;
  readonly until: number;
  readonly extent: number | null;
  readonly inLog?: boolean;
}
export interface Score {
  readonly collisions: readonly Collision[];
  readonly nearMisses: readonly NearMiss[];
  readonly stretches?: readonly Stretch[];
  readonly minTtc: number | null;
  /** Least time between one leaving a place and another coming there, seconds. */
  readonly pet?: number | null;
  /** The same of each road user that is part of such a pair. */
  readonly petOf?: ReadonlyMap<string, number>;
  readonly offroadShare: number | null;
}

export interface Reach {
  readonly status: 'reached' | 'unreachable';
  readonly nearest: Pose | null;
  readonly limiting: string | null;
  readonly needs: unknown;
  readonly words: string | null;
  /** Id of whoever is in the way, where traffic is what keeps it from the goal and the generator says who. */
  readonly with?: string | null;
  /** The nearest goal that the road reaches in the time, and how far it is from the one that was set. */
  readonly byRoad?: ByRoad | null;
}

export interface ByRoad extends Point {
  readonly heading: number;
  /** Metres. */
  readonly distance: number;
}

/** Is it somebody else who keeps it from the goal? */
export const isBlocked = (r: Reach | null): boolean => r?.status === 'unreachable' && r.limiting === 'traffic';

/** The generator's verdict as a title and the rest: its first sentence says what is wrong. */
export function reachWords(
  r: Reach,
  goal: { readonly pos: Vec | null; readonly time: number },
  nameOf: (id: string) => string | null = () => null,
): { title: string; words: string } {
  if (isBlocked(r) && r.nearest && goal.pos) {
    const who = (r.with != null && nameOf(r.with)) || TEXTS.somebody;
    const short = Math.hypot(goal.pos[0] - r.nearest.x, goal.pos[1] - r.nearest.y);
    return { title: TEXTS.isInTheWay(who), words: TEXTS.haltsShort(metres(short, 0)) };
  }
  const text = retold(r.words?.trim() ?? '');
  const cut = /[.!?](?=\s|$)/.exec(text);
  const title = cut ? text.slice(0, cut.index) : text;
  const rest = cut ? text.slice(cut.index + 1).trim() : '';
  return {
    title: title || TEXTS.outOfReachIn(num(goal.time, 1)),
    words: rest || TEXTS.theNearestReachable,
  };
}

/** Everything worked out for one document key. */
export interface MotionSet {
  readonly key: string;
  readonly futures: ReadonlyMap<string, Futures>;
  /** Road users that follow a future of theirs in playback; the rest replay their log. */
  readonly driving: ReadonlySet<string>;
  readonly score: Score | null;
  readonly reach: ReadonlyMap<string, Reach>;
  readonly stale: boolean;
  /** The one road user whose futures still hold while the rest is out of date: another of its six was picked. */
  readonly fresh?: string | null;
  /** Those that answer others: why, and what they gave up for it. */
  readonly answering: ReadonlyMap<string, Answering>;
  /** Unlikely things that were done anyway, by road user. */
  readonly warnings?: ReadonlyMap<string, readonly string[]>;
  /** What the server wants kept beside the futures when they are saved: hashes, seed, options. */
  readonly head?: Readonly<Record<string, unknown>>;
}

export const emptyMotion = (key: string): MotionSet => ({
  key,
  futures: new Map(),
  driving: new Set(),
  score: null,
  reach: new Map(),
  answering: new Map(),
  stale: false,
});

/** What belongs to a document, by its key, so that undo and redo show it at once. Oldest out first. */
export class ByDocument<T extends { readonly key: string }> {
  private readonly map = new Map<string, T>();
  constructor(private readonly limit = 120) {}

  get(key: string): T | undefined {
    return this.map.get(key);
  }

  put(of: T): void {
    this.map.delete(of.key);
    this.map.set(of.key, of);
    if (this.map.size > this.limit) this.map.delete(this.map.keys().next().value as string);
  }

  clear(): void {
    this.map.clear();
  }
}
