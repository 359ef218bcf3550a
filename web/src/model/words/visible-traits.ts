// Measures in which futures of one manoeuvre visibly differ, and their words.
import { distances, endPose, STEP_S, type Motion } from '../base/motion';
import { metres, seconds, speedInUse } from '../base/units';
import { TEXTS } from '../../texts/scene/names';

/** A measure of each of a group. */
export interface VisibleTrait {
  readonly values: ReadonlyMap<number, number>;
  /** Smaller differences are invisible. */
  readonly least: number;
  /** Words for one that differs from the first by this much; empty where the shown figure would not differ. */
  readonly words: (by: number, i: number) => string;
  /** Words for the only one on its side of the first, without a number; null where there are none. */
  readonly plain: ((by: number) => string) | null;
  /** Is it for those that look the same only: nothing that the path and the times show? */
  readonly isFine?: boolean;
}

/** The group whose traits are measured. */
export interface TraitsOf {
  /** All come to a stop, move up a little, or do none of these. */
  readonly kind: 'stops' | 'rolls' | 'goes';
  readonly onFoot: boolean;
}

/** Slower is standing to the eye, m/s. */
export const STANDS_MPS = 0.5;

/** Smaller visible differences: of the way in metres and as a share; of time, seconds; to the side, metres. */
const LEAST_M = 2;
const LEAST_SHARE = 0.04;
const LEAST_S = 0.5;
const LEAST_ASIDE_M = 0.8;
/** Of the speed at the end, m/s. */
const LEAST_MPS = 2;
/** Slower is the end of a drive that comes to a stop, m/s. */
const CRAWLS_MPS = 1;

/** A shorter stand is no waiting, seconds. */
export const SHORTEST_S = 1;

/** A stand between two drives: its first and last step of the motion. */
export type Stand = readonly [from: number, to: number];

/** The longest stand after which it visibly drives on; null without one. */
export function standOf(m: Motion): Stand | null {
  let best: Stand | null = null;
  const end = m.x.length - 1;
  for (let from = 0, i = 0; i <= end; i++) {
    if (Math.abs(m.speed[i]) < STANDS_MPS) continue;
    const goesOn = Math.hypot(m.x[end] - m.x[i], m.y[end] - m.y[i]) > LEAST_M;
    if (goesOn && i > from && (!best || i - from > best[1] - best[0])) best = [from, i - 1];
    from = i + 1;
  }
  return best;
}

/** Duration of that stand, seconds. */
export function standTime(m: Motion): number {
  const stand = standOf(m);
  return stand ? (stand[1] - stand[0]) * STEP_S : 0;
}

type AmountWords = (amount: string) => string;

/** Words of an amount to either side; none for one that is shown as zero. */
function sized(by: number, more: AmountWords, less: AmountWords, shown: (amount: number) => string): string {
  const amount = shown(Math.abs(by));
  return amount === shown(0) ? '' : (by > 0 ? more : less)(amount);
}

/** When it crawls for good, in seconds; a drive that never does is at its end. */
const stopTime = (m: Motion): number => (m.speed.findLastIndex((v) => Math.abs(v) >= CRAWLS_MPS) + 1) * STEP_S;

/** The visible traits of a group, the plainest first: the distance. All differences are from the first of the group. */
export function traitsOf(
  motion: (i: number) => Motion,
  group: readonly number[],
  { kind, onFoot }: TraitsOf,
): VisibleTrait[] {
  const first = motion(group[0]);
  const gone = new Map(group.map((i) => [i, distances(motion(i))]));
  const n = Math.min(...[...gone.values()].map((d) => d.length)) - 1;
  const of = (value: (i: number) => number): VisibleTrait['values'] => new Map(group.map((i) => [i, value(i)]));
  const ends = of((i) => gone.get(i)![n]);
  const lastSpeed = of((i) => Math.abs(endPose(motion(i)).speed));
  // All get at least as far as this.
  const halfway = Math.min(...ends.values()) / 2;
  const stops = kind === 'stops';
  const covered = (i: number): string => (stops ? TEXTS.stopsAfter : TEXTS.covers)(metres(ends.get(i)!, 0));
  const traits: VisibleTrait[] = [
    {
      values: ends,
      least: Math.max(LEAST_M, LEAST_SHARE * Math.max(...ends.values())),
      // A distance is true without the others: the first has its own.
      words: (_, i) => (i !== group[0] && covered(i) === covered(group[0]) ? '' : covered(i)),
      plain: (by) => (by > 0 ? TEXTS.faster : TEXTS.slower),
    },
    {
      values: of((i) => sideOf(first, motion(i), n)),
      least: LEAST_ASIDE_M,
      words: (by) => sized(by, TEXTS.leftBy, TEXTS.rightBy, (m) => metres(m)),
      plain: (by) => (by > 0 ? TEXTS.furtherLeft : TEXTS.furtherRight),
    },
    {
      // Positive where it is earlier.
      values: of((i) => -(stops ? stopTime(motion(i)) : gone.get(i)!.findIndex((d) => d >= halfway) * STEP_S)),
      least: LEAST_S,
      words: (by) => sized(by, TEXTS.earlierBy, TEXTS.laterBy, seconds),
      plain: null,
    },
  ];
  if (stops || kind === 'rolls') return traits;
  const stand: VisibleTrait = {
    values: of((i) => standTime(motion(i))),
    least: SHORTEST_S,
    words: (by, i) => {
      const time = standTime(motion(i));
      if (Math.abs(by) < SHORTEST_S) return '';
      return time < SHORTEST_S ? TEXTS.doesNotWait : TEXTS.waits(seconds(time));
    },
    plain: null,
  };
  const speed = (i: number): string => speedInUse(lastSpeed.get(i)!, onFoot);
  const end: VisibleTrait = {
    values: lastSpeed,
    least: LEAST_MPS,
    words: (_, i) => (speed(i) === speed(group[0]) ? '' : TEXTS.endsAt(speed(i))),
    plain: null,
    isFine: true,
  };
  return [traits[0], stand, ...traits.slice(1), end];
}

/** Largest offset of the second path to the left of the first, metres; negative to the right. */
function sideOf(a: Motion, b: Motion, n: number): number {
  let most = 0;
  for (let i = 2; i <= n; i += 2) {
    // From the nearest point of the first path, so that pace does not count as offset.
    let best = Infinity,
      at = 0;
    for (let k = 0; k < a.x.length; k += 2) {
      const d = (a.x[k] - b.x[i]) ** 2 + (a.y[k] - b.y[i]) ** 2;
      if (d < best) {
        best = d;
        at = k;
      }
    }
    if (at === 0 || at >= a.x.length - 2) continue;
    const left = -(b.x[i] - a.x[at]) * Math.sin(a.heading[at]) + (b.y[i] - a.y[at]) * Math.cos(a.heading[at]);
    if (Math.abs(left) > Math.abs(most)) most = left;
  }
  return most;
}
