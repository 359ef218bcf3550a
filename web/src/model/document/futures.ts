// Futures: up to six possible motions of a road user, and the sets of them that belong to a document.
import type { Message } from './message';
import type { AgentFuturesJson, ReactionJson } from './scene-json';
import { NOTHING_SAID, readAbout, sentAbout, type FutureFacts, type FaultKind, type SentAbout } from './future-facts';
import type { Point, Pose } from '../base/geometry';
import { furthestApart, motionFrom, type Motion } from '../base/motion';

/** Letters of six futures on the picture. */
export const LETTERS = 'ABCDEF';

export interface Future {
  readonly probability: number;
  readonly motion: Motion;
  readonly name: string;
  /** Basis of the name: a relation, or a manner. */
  readonly basis?: string;
  /** Facts of the generator; null where it gives none. */
  readonly about?: FutureFacts | null;
  /** The same, as received. */
  readonly sent?: SentAbout;
  /** Index of the anchor that the future follows; null for staying at rest, and where unknown. */
  readonly anchor?: number | null;
}

export interface Futures {
  readonly modes: readonly Future[];
  /** The generator's choice; the document may override it. */
  readonly chosen: number;
  /** 0 is the first rough draft, `steps` is final. */
  readonly step: number;
  readonly steps: number;
  /** Not judged yet, so no faults are known. */
  readonly unjudged?: boolean;
  /** True for the plain local curve that is drawn while the generator is unreachable. */
  readonly sketch?: boolean;
}

export const isSettled = (f: Futures): boolean => f.step >= f.steps;

/** Futures as received; the name is empty where the answer has none. Null for a start that the futures contain. */
export function unnamedFutures(
  json: AgentFuturesJson,
  start: Pose | null,
  step: number,
  steps: number,
  keep?: KeepOrder,
): Futures {
  const sent = json.modes.slice(0, 6);
  const order = placesOf(sent, keep);
  const modes = order.map((i) => {
    const m = sent[i];
    return {
      probability: m.probability,
      name: m.name ?? '',
      motion: motionFrom(m, start ?? undefined),
      about: readAbout(m),
      sent: sentAbout(m),
      anchor: m.anchor ?? null,
    };
  });
  // Empty facts are not sent: in a judged list, modes without facts have no faults.
  if (modes.some((m) => m.about)) for (const m of modes) m.about ??= NOTHING_SAID;
  return {
    modes,
    chosen: Math.max(0, order.indexOf(json.chosen ?? 0)),
    step,
    steps,
  };
}

/**
 * Order of the letters: `rank` makes the likeliest A; else the letters of the shown futures are kept, always, or only
 * while the anchors are the same. Without it the received order stays.
 */
export type KeepOrder = 'rank' | { readonly like: Futures | null | undefined; readonly always: boolean };

type SentMode = HasAnchor & { readonly probability: number };

function placesOf(sent: readonly SentMode[], keep: KeepOrder | undefined): number[] {
  const asSent = sent.map((_, i) => i);
  if (keep === 'rank') return asSent.sort((a, b) => sent[b].probability - sent[a].probability || a - b);
  return keep?.like ? placesLike(keep.like.modes, sent, keep.always) : asSent;
}

interface HasAnchor {
  readonly anchor?: number | null;
}

/** Keys of the anchors in a list. Several with the same anchor, or without one, are numbered. */
export function ideas(modes: readonly HasAnchor[]): string[] {
  const count = new Map<number | null, number>();
  return modes.map(({ anchor = null }) => {
    const n = count.get(anchor) ?? 0;
    count.set(anchor, n + 1);
    return `${anchor ?? 'rest'}/${n}`;
  });
}

/**
 * Display order of the received futures (likeliest first), so that an anchor keeps its letter and colour while
 * probabilities change. New anchors take the places of missing ones.
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
 * Drafts are shown before they are judged. Until the answer each anchor keeps its last faults, or verdicts would
 * flicker with every move of a drag; without earlier verdicts they are marked as not judged.
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

/** The road user's own motion first, in place of the most similar one. */
export function withOwnFirst(own: Future, f: Futures): Futures {
  const off = f.modes.map((m) => furthestApart(own.motion, m.motion));
  const like = f.modes[off.indexOf(Math.min(...off))];
  const { probability, anchor } = like;
  return { ...f, modes: [{ ...own, probability, anchor }, ...f.modes.filter((m) => m !== like)], chosen: 0 };
}

/** Has the generator judged these futures? */
export const isJudged = (f: Futures): boolean => f.modes.some((m) => m.about);

/** Rank by probability, from 1. Probabilities are relative weights (`calibrated` of an answer): no figure is shown. */
export const rankOf = (modes: readonly Pick<Future, 'probability'>[], index: number): number =>
  1 +
  modes.filter(({ probability: p }, i) => (i < index ? p >= modes[index].probability : p > modes[index].probability))
    .length;

export interface Collision {
  a: string;
  b: string;
  time: number;
  /** m/s. */
  closing?: number | null;
  /** Absent where the generator does not give it. */
  inLog?: boolean;
}
export interface NearMiss extends Collision {
  distance: number | null;
  ttc: number | null;
}
/** A fault of one road user that lasts for a while. */
export interface LastingFault {
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
  readonly stretches?: readonly LastingFault[];
  readonly minTtc: number | null;
  /** Ids of the two with that time to collision. */
  readonly minTtcPair?: readonly string[] | null;
  /** Least time between one road user leaving a place and another arriving there, seconds. */
  readonly pet?: number | null;
  /** The same for each road user of such a pair. */
  readonly petOf?: ReadonlyMap<string, number>;
  readonly offroadShare: number | null;
}

export interface Reach {
  readonly status: 'reached' | 'unreachable';
  readonly nearest: Pose | null;
  readonly limiting: string | null;
  readonly needs: unknown;
  /** Why the goal is unreachable. */
  readonly message: Message | null;
  /** Id of the blocking road user, where traffic blocks the goal and the generator names it. */
  readonly with?: string | null;
  /** The nearest goal that is reachable by road in the time, and its distance from the set one. */
  readonly byRoad?: ByRoad | null;
  /** Where and when a goal relative to another road user is due. */
  readonly relative?: RelativeGoal | null;
}

export interface RelativeGoal extends Pose {
  readonly time: number;
}

export interface ByRoad extends Point {
  readonly heading: number;
  /** Metres. */
  readonly distance: number;
}

/** Is the goal blocked by another road user? */
export const isBlocked = (r: Reach | null): boolean => r?.status === 'unreachable' && r.limiting === 'traffic';

/** Why a road user gave up a motion, and which one. */
export interface Answering {
  readonly said: ReactionJson;
  /** Null for the recording; absent where unknown. */
  readonly gaveUp?: GivenUp | null;
}

/** A motion that was given up; it may have been a reaction itself. */
export interface GivenUp {
  readonly futures: Futures;
  readonly answering?: Answering;
}

/** All answers for one document key. */
export interface MotionSet {
  readonly key: string;
  readonly futures: ReadonlyMap<string, Futures>;
  /** Road users that follow a future in playback; the rest replay the recording. */
  readonly driving: ReadonlySet<string>;
  readonly score: Score | null;
  readonly reach: ReadonlyMap<string, Reach>;
  readonly stale: boolean;
  /** The only road user whose futures still hold while the rest is stale: another of its six was picked. */
  readonly fresh?: string | null;
  /** Road users that react: the reason, and the motion they gave up. */
  readonly answering: ReadonlyMap<string, Answering>;
  /** Unlikely conditions that were met anyway, by road user. */
  readonly warnings?: ReadonlyMap<string, readonly Message[]>;
  /** Members that the server stores beside saved futures: hashes, seed, options. */
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

/** Values by document key, so that undo and redo show them at once. The oldest are dropped first. */
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
