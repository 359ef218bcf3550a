// Futures: up to six ways a road user could go, and the sets of them that belong to a document.
import type { AgentFuturesJson, ReactionJson } from './json';
import { distances, endPose, motionFrom, pathLength, poseAtStep, type Motion } from './motion';
import { wrapAngle, type Pose } from './geometry';

export const LETTERS = 'ABCDEF';

export interface Future {
  readonly probability: number;
  readonly motion: Motion;
  readonly name: string;
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
  const order = keep?.like ? placesLike(keep.like.modes, sent, keep.always) : sent.map((_, i) => i);
  const modes = order.map((i) => {
    const m = sent[i],
      motion = motionFrom(m, start);
    return {
      probability: m.probability,
      motion,
      name: m.name ?? describe(motion, isPedestrian),
      anchor: m.anchor ?? null,
    };
  });
  return {
    modes: step >= steps ? distinct(modes) : modes,
    chosen: Math.max(0, order.indexOf(json.chosen ?? 0)),
    step,
    steps,
  };
}

/** The futures on screen, whose letters the new ones take over: always, or only while the ideas are the same. */
export interface KeepOrder {
  readonly like: Futures | null | undefined;
  readonly always: boolean;
}

interface HasAnchor {
  readonly anchor?: number | null;
}

/** Names for the ideas in a list. Two of the same, or several without a number, are told apart by their turn. */
function ideas(modes: readonly HasAnchor[]): string[] {
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

/** A short plain name from the shape of the motion, for generators that send none. */
function describe(m: Motion, isPedestrian: boolean): string {
  const n = m.x.length - 1;
  const a = poseAtStep(m, m.first),
    b = endPose(m);
  if (!a || n < 2) return 'Unknown';
  const length = pathLength(m);
  if (length < 1.5) return isPedestrian ? 'Stays' : 'Stands still';
  const turn = totalTurn(m);
  const side = turn > 0 ? 'left' : 'right';
  const where =
    Math.abs(turn) > 2.5
      ? 'Turns round'
      : Math.abs(turn) > 0.6
        ? `Turns ${side}`
        : (shift(m, isPedestrian) ?? (isPedestrian ? 'Straight' : 'Straight on'));
  return `${where}${pace(m, a, b, length, isPedestrian)}`;
}

function totalTurn(m: Motion): number {
  let t = 0;
  for (let i = 1; i < m.heading.length; i++) t += wrapAngle(m.heading[i] - m.heading[i - 1]);
  return t;
}

/** Sideways move without a turn, as in a lane change; a long road that bends a little is still straight on. */
function shift(m: Motion, isPedestrian: boolean): string | null {
  const n = m.x.length - 1;
  const h = m.heading[0] + wrapAngle(m.heading[n] - m.heading[0]) / 2,
    dx = m.x[n] - m.x[0],
    dy = m.y[n] - m.y[0];
  const left = -dx * Math.sin(h) + dy * Math.cos(h);
  const limit = isPedestrian ? Math.max(1, 0.18 * Math.hypot(dx, dy)) : Math.max(2.2, 0.07 * Math.hypot(dx, dy));
  return Math.abs(left) > limit ? `${isPedestrian ? 'Bears' : 'Moves'} ${left > 0 ? 'left' : 'right'}` : null;
}

function pace(m: Motion, a: Pose, b: Pose, length: number, ped: boolean): string {
  const slow = ped ? 0.25 : 0.8;
  let low = Infinity,
    lowAt = 0;
  m.speed.forEach((v, i) => {
    if (Math.abs(v) < low) {
      low = Math.abs(v);
      lowAt = i;
    }
  });
  const ends = Math.abs(b.speed);
  if (ends < slow) return ', stops';
  if (low < slow && lowAt > 3 && a.speed > slow * 2) return ', waits first';
  if (a.speed < slow && lowAt > 5) return ', sets off late';
  const mean = length / (m.x.length * 0.1);
  if (mean > a.speed * 1.2 + 0.5) return ', faster';
  if (mean < a.speed * 0.8 - 0.3) return ', slower';
  return '';
}

/** Two futures may look alike; the second then says how it differs, so that a list can be read. */
function distinct(modes: Future[]): Future[] {
  const seen = new Map<string, number>();
  return modes.map((m, i) => {
    const first = seen.get(m.name);
    if (first === undefined) {
      seen.set(m.name, i);
      return m;
    }
    return {
      ...m,
      name: `${m.name.split(',')[0]}, ${difference(modes[first].motion, m.motion) ?? `almost as ${LETTERS[first]}`}`,
    };
  });
}

function difference(a: Motion, b: Motion): string | null {
  const sa = distances(a),
    sb = distances(b);
  const n = Math.min(sa.length, sb.length) - 1;
  const end = sb[n] - sa[n];
  if (Math.abs(end) > 1) return `${Math.abs(end).toFixed(0)} m ${end > 0 ? 'further' : 'less'}`;
  const mid = n >> 1,
    early = sb[mid] - sa[mid];
  if (Math.abs(early) > 0.8) return early > 0 ? 'earlier' : 'later';
  let side = 0;
  for (let i = 1; i <= n; i++) {
    const left = -(b.x[i] - a.x[i]) * Math.sin(a.heading[i]) + (b.y[i] - a.y[i]) * Math.cos(a.heading[i]);
    if (Math.abs(left) > Math.abs(side)) side = left;
  }
  return Math.abs(side) > 0.4 ? `further ${side > 0 ? 'left' : 'right'}` : null;
}

export interface Collision {
  a: string;
  b: string;
  time: number;
}
export interface NearMiss extends Collision {
  distance: number | null;
  ttc: number | null;
}
export interface Score {
  readonly collisions: readonly Collision[];
  readonly nearMisses: readonly NearMiss[];
  readonly minTtc: number | null;
  readonly offroadShare: number | null;
}

export interface Reach {
  readonly status: 'reached' | 'unreachable';
  readonly nearest: Pose | null;
  readonly limiting: string | null;
  readonly needs: unknown;
  readonly words: string | null;
}

/** The generator's verdict as a title and the rest: its first sentence says what is wrong. */
export function reachWords(r: Reach, time: number): { title: string; words: string } {
  const text = r.words?.trim() ?? '';
  const cut = /[.!?](?=\s|$)/.exec(text);
  const title = cut ? text.slice(0, cut.index) : text;
  const rest = cut ? text.slice(cut.index + 1).trim() : '';
  return {
    title: title || `Out of reach in ${time.toFixed(1)} s`,
    words: rest || 'The nearest reachable point is shown.',
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
  /** Why those that answer others do so. */
  readonly reactions?: ReadonlyMap<string, ReactionJson>;
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
  stale: false,
});

/** Answers by document key, so that undo shows the old paths at once. Oldest out first. */
export class MotionCache {
  private readonly map = new Map<string, MotionSet>();
  constructor(private readonly limit = 120) {}

  get(key: string): MotionSet | undefined {
    return this.map.get(key);
  }

  put(set: MotionSet): void {
    this.map.delete(set.key);
    this.map.set(set.key, set);
    if (this.map.size > this.limit) this.map.delete(this.map.keys().next().value as string);
  }

  clear(): void {
    this.map.clear();
  }
}
