// Futures: up to six ways a road user could go, and the sets of them that belong to a document.
import type { AgentFuturesJson } from './json';
import { endPose, motionFrom, pathLength, poseAtStep, type Motion } from './motion';
import { wrapAngle, type Pose } from './geometry';

export const LETTERS = 'ABCDEF';

export interface Future { readonly probability: number; readonly motion: Motion; readonly name: string }

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

export function readFutures(json: AgentFuturesJson, start: Pose, step: number, steps: number, isPedestrian: boolean): Futures {
  const modes = json.modes.slice(0, 6).map((m) => {
    const motion = motionFrom(m, start);
    return { probability: m.probability, motion, name: m.name ?? describe(motion, isPedestrian) };
  });
  return { modes: step >= steps ? distinct(modes) : modes, chosen: json.chosen ?? 0, step, steps };
}

/** A short plain name from the shape of the motion, for generators that send none. */
export function describe(m: Motion, isPedestrian: boolean): string {
  const n = m.x.length - 1;
  const a = poseAtStep(m, m.first), b = endPose(m);
  if (!a || n < 2) return 'Unknown';
  const length = pathLength(m);
  if (length < 1.5) return isPedestrian ? 'Stays' : 'Stands still';
  const turn = totalTurn(m);
  const side = turn > 0 ? 'left' : 'right';
  const where = Math.abs(turn) > 2.5 ? 'Turns round' : Math.abs(turn) > 0.6 ? `Turns ${side}` : shift(m) ?? (isPedestrian ? 'Straight' : 'Straight on');
  return `${where}${pace(m, a, b, length, isPedestrian)}`;
}

function totalTurn(m: Motion): number {
  let t = 0;
  for (let i = 1; i < m.heading.length; i++) t += wrapAngle(m.heading[i] - m.heading[i - 1]);
  return t;
}

/** Sideways move without a turn, as in a lane change. */
function shift(m: Motion): string | null {
  const h = m.heading[0], dx = m.x[m.x.length - 1] - m.x[0], dy = m.y[m.y.length - 1] - m.y[0];
  const left = -dx * Math.sin(h) + dy * Math.cos(h);
  return Math.abs(left) > 2.2 ? `Moves ${left > 0 ? 'left' : 'right'}` : null;
}

function pace(m: Motion, a: Pose, b: Pose, length: number, ped: boolean): string {
  const slow = ped ? 0.25 : 0.8;
  let low = Infinity, lowAt = 0;
  m.speed.forEach((v, i) => { if (Math.abs(v) < low) { low = Math.abs(v); lowAt = i; } });
  const ends = Math.abs(b.speed);
  if (ends < slow) return ', stops';
  if (low < slow && lowAt > 3 && a.speed > slow * 2) return ', waits first';
  if (a.speed < slow && lowAt > 5) return ', sets off late';
  const mean = length / (m.x.length * 0.1);
  if (mean > a.speed * 1.2 + 0.5) return ', faster';
  if (mean < a.speed * 0.8 - 0.3) return ', slower';
  return '';
}

/** Two futures may look alike; the second then says how it differs in speed, so that a list can be read. */
function distinct(modes: Future[]): Future[] {
  const seen = new Map<string, number>();
  return modes.map((m) => {
    const n = seen.get(m.name) ?? 0;
    seen.set(m.name, n + 1);
    if (!n) return m;
    const first = modes.find((o) => o.name === m.name)!;
    const d = pathLength(m.motion) - pathLength(first.motion);
    const base = m.name.split(',')[0];
    return { ...m, name: Math.abs(d) < 1 ? `${base}, another line` : `${base}, ${Math.abs(d).toFixed(0)} m ${d > 0 ? 'further' : 'less'}` };
  });
}

export interface Collision { a: string; b: string; time: number }
export interface NearMiss extends Collision { distance: number | null; ttc: number | null }
export interface Score {
  readonly collisions: readonly Collision[]; readonly nearMisses: readonly NearMiss[];
  readonly minTtc: number | null; readonly offroadShare: number | null;
}

export interface Reach {
  readonly status: 'reached' | 'unreachable'; readonly nearest: Pose | null;
  readonly limiting: string | null; readonly needs: unknown; readonly words: string | null;
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
  /** Unlikely things that were done anyway, by road user. */
  readonly warnings?: ReadonlyMap<string, readonly string[]>;
  /** What the server wants kept beside the futures when they are saved: hashes, seed, options. */
  readonly head?: Readonly<Record<string, unknown>>;
}

export const emptyMotion = (key: string): MotionSet => ({ key, futures: new Map(), driving: new Set(), score: null, reach: new Map(), stale: false });

/** Answers by document key, so that undo shows the old paths at once. Oldest out first. */
export class MotionCache {
  private readonly map = new Map<string, MotionSet>();
  constructor(private readonly limit = 120) {}

  get(key: string): MotionSet | undefined { return this.map.get(key); }

  put(set: MotionSet): void {
    this.map.delete(set.key);
    this.map.set(set.key, set);
    if (this.map.size > this.limit) this.map.delete(this.map.keys().next().value as string);
  }

  clear(): void { this.map.clear(); }
}
