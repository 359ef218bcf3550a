// Names of futures: the manoeuvre, then what visibly tells it from the others with that manoeuvre: a distance covered,
// or the difference from the first in a time or to the side. Whatever a name says is true of one future and false of
// the rest. Of those that look the same it gives the figure that differs most, or says that they are almost identical.
import { JUDGING } from '../base/domain';
import { faultMark, leavesRoad, type Manoeuvre, type Relation } from '../document/future-facts';
import { endPose, lastStep, pathLength, poseAt, STEP_S, type Motion } from '../base/motion';
import { TEXTS } from '../../texts/scene/names';
import { manoeuvreOf, type LaneUser, type MovingFuture } from './manoeuvres';
import {
  SHORTEST_S,
  standOf,
  STANDS_MPS,
  standTime,
  traitsOf,
  type TraitsOf,
  type VisibleTrait,
} from './visible-traits';

/** Inputs of a name. */
export interface Nameable extends MovingFuture {
  /** Relative weight. The likeliest is named first, so that names do not depend on the order of the letters. */
  readonly probability?: number;
}

/** The named road user, and the names of the others. */
export interface Naming extends LaneUser {
  readonly nameOf: (id: string) => string | null;
  /** Its recording; null where there is none. */
  readonly log?: Motion | null;
}

/** A name and its basis: `|after:12`, `left|after:12`, or a manner such as `Turns left`. */
export interface FutureName {
  readonly name: string;
  readonly basis: string;
}

/** The road user that a name speaks of; null for a name of the own motion. */
export const otherNamed = (basis: string | undefined): string | null => /\|\w+?:(.+)$/.exec(basis ?? '')?.[1] ?? null;

/** Letters of a name with another road user that fit in a row of the list. */
const LONGEST = 38;

const nameless: Naming['nameOf'] = () => null;

/** A name for each. */
export const nameAll = (modes: readonly Nameable[], who: Naming = { onFoot: false, nameOf: nameless }): FutureName[] =>
  nameRest(
    modes,
    who,
    modes.map(() => null),
  );

/** Names for those without one, distinct from the others, which keep theirs. */
export function nameRest(modes: readonly Nameable[], who: Naming, kept: readonly (FutureName | null)[]): FutureName[] {
  const likelihood = (i: number): number => modes[i].probability ?? 0;
  const order = modes.map((_, i) => i).sort((i, k) => likelihood(k) - likelihood(i) || i - k);
  const heads = headsOf(modes, who);
  const groups = new Map<string, number[]>();
  for (const i of order) groups.set(heads[i].basis, [...(groups.get(heads[i].basis) ?? []), i]);
  const names = [...kept];
  for (const group of groups.values()) {
    // The others differ from the one whose name has no difference.
    const isPlain = (i: number): boolean => kept[i]?.name === heads[i].words;
    const rank = (i: number): number => (isPlain(i) ? 0 : standTime(modes[i].motion) < SHORTEST_S ? 1 : 2);
    const all = group.sort((i, k) => rank(i) - rank(k));
    const taken = kept.flatMap((k) => k?.name ?? []);
    const list = nameGroup(modes, who, { head: heads[all[0]], all, alone: groups.size === 1, taken });
    for (const i of all) names[i] ??= list.get(i)!;
  }
  return names.map((n) => n!);
}

// -------------------------------------------------------------- the manoeuvre

/** What a name begins with. */
interface NameHead {
  readonly basis: string;
  readonly words: string;
  readonly manoeuvre: Manoeuvre | null;
  /** What can tell it from others; null for one that never moves. */
  readonly kind: TraitsOf['kind'] | null;
}

function headsOf(modes: readonly Nameable[], who: Naming): NameHead[] {
  const onRoad = modes.map((m) => !!m.about && m.about.faults.every((f) => faultMark(f) === 'near'));
  const leaves = modes.some((m) => m.about?.faults.some(leavesRoad));
  const like = modes.map((m) => !!who.log && isLike(m.motion, who.log));
  const isOnly = (i: number, list: readonly boolean[]): boolean => list[i] && list.filter(Boolean).length === 1;
  return modes.map((m, i) => {
    const only = isOnly(i, like) ? TEXTS.asRecorded : leaves && isOnly(i, onRoad) ? TEXTS.staysOnTheRoad : null;
    if (only !== null) return { basis: only, words: only, manoeuvre: null, kind: 'goes' };
    const manoeuvre = movesUp(m, who) ? 'stays' : manoeuvreOf(m, who);
    if (endsStanding(m, manoeuvre)) return { basis: TEXTS.stops, words: TEXTS.stops, manoeuvre: null, kind: 'stops' };
    const words = manner(m.motion, manoeuvre, who.onFoot);
    return { basis: words, words, manoeuvre, kind: kindOf(m.motion, manoeuvre) };
  });
}

/** It is like the recording if it never differs by more than this, metres; one that hardly moves is not compared. */
const LIKE_LOG_M = 2;
const MOVES_M = 4;

function isLike(m: Motion, log: Motion): boolean {
  if (pathLength(log) < MOVES_M) return false;
  for (let t = 0; t <= lastStep(m) * STEP_S + 1e-6; t += 5 * STEP_S) {
    const [p, q] = [poseAt(m, t), poseAt(log, t)];
    // Unrecorded steps cannot be compared.
    if (!q) continue;
    if (!p || Math.hypot(p.x - q.x, p.y - q.y) > LIKE_LOG_M) return false;
  }
  return true;
}

/** One that has braked to less than this, and to this share of its speed, stops to the eye, m/s. */
const ROLLS_MPS = 1;
const ROLLS_SHARE = 0.25;

/** One that stops after its turn is named by the turn, which the eye sees first. */
function endsStanding({ motion: m }: Nameable, manoeuvre: Manoeuvre): boolean {
  if (['stays', 'left', 'right', 'turn_round'].includes(manoeuvre) || pathLength(m) < JUDGING.stays_m) return false;
  const speed = Math.abs(endPose(m).speed);
  return speed < JUDGING.standing_mps || speed < Math.min(ROLLS_MPS, ROLLS_SHARE * Math.max(...m.speed));
}

/** A vehicle that stood and moves up by less than its length goes nowhere to the eye, metres. */
const MOVES_UP_M = 5;

function movesUp(mode: Nameable, who: Naming): boolean {
  const { motion: m } = mode;
  if (who.onFoot || Math.abs(m.speed[0]) >= STANDS_MPS || pathLength(m) >= MOVES_UP_M) return false;
  return manoeuvreOf(mode, who) === 'straight';
}

/** Smaller movements are invisible, metres. */
const CREEPS_M = 0.4;

function kindOf(m: Motion, manoeuvre: Manoeuvre): NameHead['kind'] {
  return manoeuvre !== 'stays' ? 'goes' : pathLength(m) < CREEPS_M ? null : 'rolls';
}

function manner(m: Motion, manoeuvre: Manoeuvre, onFoot: boolean): string {
  switch (manoeuvre) {
    case 'left':
      return TEXTS.turnsLeft;
    case 'right':
      return TEXTS.turnsRight;
    case 'lane_left':
      return onFoot ? TEXTS.bearsLeft : TEXTS.changesLaneLeft;
    case 'lane_right':
      return onFoot ? TEXTS.bearsRight : TEXTS.changesLaneRight;
    case 'turn_round':
      return TEXTS.uTurn;
    case 'stays':
      if (pathLength(m) < CREEPS_M) return TEXTS.standsStill;
      return onFoot ? TEXTS.aStepOrTwo : TEXTS.rollsForward;
    case 'reverse':
      return TEXTS.reverses;
    case 'straight':
      return TEXTS.straightOn;
  }
}

// -------------------------------------------------------------- those of one manoeuvre

interface NameGroup {
  readonly head: NameHead;
  /** The first has no difference, the others differ from it. */
  readonly all: readonly number[];
  /** Have all futures this manoeuvre? */
  readonly alone: boolean;
  /** Names that futures keep. */
  readonly taken: readonly string[];
}

/** Manoeuvres whose relations to others are named: one that stops or turns round is told by that. */
const RELATED: readonly (Manoeuvre | null)[] = ['straight', 'left', 'right', 'lane_left', 'lane_right'];

type Names = Map<number, FutureName>;

function nameGroup(modes: readonly Nameable[], who: Naming, group: NameGroup): Names {
  const { head, all } = group;
  if (!RELATED.includes(head.manoeuvre)) return byTraits(modes, group, who);
  const names = byRelation(modes, who, group) ?? byTraits(modes, group, who);
  // The only one that stands is told by whom it lets pass, unless it is the one that the others differ from.
  const standing = all.filter((i) => standTime(modes[i].motion) >= STEP_S);
  const [i] = standing;
  const waits = standing.length === 1 && (i !== all[0] || modes.length === 1) && waitsFor(modes[i], who);
  const name = waits && withOther(group, WAITS, who.nameOf(waits.with)!);
  if (waits && name && name.length <= LONGEST) names.set(i, { name, basis: basisOf(group, waits) });
  return names;
}

/** A road user that some pass before and all others after. Null where there is none, or its name does not fit. */
function byRelation(modes: readonly Nameable[], who: Naming, group: NameGroup): Names | null {
  const { head, all } = group;
  for (const { with: id } of modes[all[0]].about?.relations ?? []) {
    const other = who.nameOf(id);
    const orders = all.map((i) => orderOf(modes[i], id));
    if (other === null || new Set(orders).size !== 2 || orders.includes(null)) continue;
    const names: Names = new Map();
    for (const [order, word] of Object.entries(ORDERS)) {
      const part = all.filter((_, k) => orders[k] === order);
      const words = withOther(group, word, other);
      for (const [i, { name }] of byTraits(modes, { ...group, head: { ...head, words }, all: part }, who))
        names.set(i, { name, basis: basisOf(group, relationTo(modes[i], id)!) });
    }
    if ([...names.values()].every(({ name }) => name.length <= LONGEST)) return names;
  }
  return null;
}

const relationTo = ({ about }: Nameable, id: string): Relation | undefined =>
  about?.relations.find((r) => r.with === id);

const basisOf = ({ head, alone }: NameGroup, r: Relation): string =>
  `${alone ? '' : head.manoeuvre}|${r.kind}:${r.with}`;

/** Words of a relation: alone, and after the manoeuvre. */
type OtherWords = readonly [alone: (name: string) => string, then: (head: string, name: string) => string];

const ORDERS: Readonly<Record<'before' | 'after', OtherWords>> = {
  before: [TEXTS.before, TEXTS.thenBefore],
  after: [TEXTS.after, TEXTS.thenAfter],
};
const WAITS: OtherWords = [TEXTS.waitsFor, TEXTS.thenWaitsFor];

/** Between the two at the crossing, seconds; less is no order to the eye. */
const CLEAR_S = 0.8;

/** Its order with another where their ways meet, if that is clear and within the time of the future. */
function orderOf(m: Nameable, id: string): keyof typeof ORDERS | null {
  const r = relationTo(m, id);
  if (!r || r.kind === 'follows' || r.gap === null || r.gap < CLEAR_S || isMet(m, id)) return null;
  const isFirst = r.kind === 'before';
  const last = isFirst ? r.time + r.gap : r.time;
  return last > lastStep(m.motion) * STEP_S ? null : isFirst ? 'before' : 'after';
}

/** Does a future have a fault towards another? */
const isMet = ({ about }: Nameable, id: string): boolean => !!about?.faults.some((f) => f.with === id);

/** The words of a relation, after the manoeuvre if that differs. */
const withOther = ({ head, alone }: NameGroup, [only, then]: OtherWords, name: string): string =>
  alone ? only(name) : then(head.words, name);

/** Share of the visible difference from which a word for it is true. */
const SLIGHT = 0.5;
/** Share of the visible difference from which a figure tells two apart that look the same. */
const FIGURE = 0.3;

function byTraits(modes: readonly Nameable[], { head, all, taken }: NameGroup, { onFoot }: Naming): Names {
  const { kind } = head;
  const traits = kind ? traitsOf((i) => modes[i].motion, all, { kind, onFoot }) : [];
  const visible = traits.filter((t) => !t.isFine);
  const [own, looks] = lookingAlike(visible, all);
  const told = tellApart(visible, own);
  const by = (trait: VisibleTrait, i: number): number => trait.values.get(i)! - trait.values.get(all[0])!;
  const wordsOf = (trait: VisibleTrait, i: number): string => trait.words(by(trait, i), i);
  const used = new Set([...told].map(([i, trait]) => wordsOf(trait, i)));
  for (const [i, like] of looks) {
    const asLike = told.get(like);
    const isSo = asLike && by(asLike, i) * by(asLike, like) > 0 && apart(asLike, i, all[0]) >= SLIGHT;
    const most = traits.toSorted((t, u) => apart(u, i, like) - apart(t, i, like));
    const isNew = (t: VisibleTrait): boolean => {
      const words = wordsOf(t, i);
      return words !== '' && apart(t, i, like) >= FIGURE && !used.has(words) && !taken.includes(nameOf(head, words));
    };
    const trait = [...(isSo ? [asLike] : []), ...most].find(isNew);
    if (!trait) continue;
    told.set(i, trait);
    used.add(wordsOf(trait, i));
  }
  // A single one to this side needs no number.
  const isOnly = (trait: VisibleTrait, i: number): boolean =>
    kind !== 'rolls' &&
    !looks.has(i) &&
    [...told].every(([k, t]) => k === i || t !== trait || by(t, k) * by(t, i) <= 0);
  const endOf = (i: number): string => {
    const trait = told.get(i);
    if (!trait) return looks.has(i) ? TEXTS.almostIdentical : '';
    const plain = i !== all[0] && isOnly(trait, i) && head.manoeuvre && trait.plain?.(by(trait, i));
    // Where one has its distance, the first has its own.
    if (!plain && trait === traits[0]) told.set(all[0], trait);
    return plain || wordsOf(trait, i);
  };
  const names: Names = new Map();
  for (const i of all.toReversed()) names.set(i, { name: nameOf(head, endOf(i)), basis: head.basis });
  return names;
}

function nameOf({ words, kind }: NameHead, end: string): string {
  if (!end) return words;
  return `${words}${kind === 'stops' && end !== TEXTS.almostIdentical ? ' ' : ', '}${end}`;
}

/** Those that differ from each other, and those that look like one of them. */
function lookingAlike(traits: readonly VisibleTrait[], all: readonly number[]): [number[], Map<number, number>] {
  const own: number[] = [];
  const looks = new Map<number, number>();
  for (const i of all) {
    const like = own.find((k) => traits.every((t) => apart(t, i, k) < 1));
    if (like === undefined) own.push(i);
    else looks.set(i, like);
  }
  return [own, looks];
}

/** Difference in multiples of the visible one. */
const apart = ({ values, least }: VisibleTrait, i: number, k: number): number =>
  Math.abs(values.get(i)! - values.get(k)!) / least;

/** The trait that tells each, except the first, from all others; one that tells more of them is better. */
function tellApart(traits: readonly VisibleTrait[], all: readonly number[]): Map<number, VisibleTrait> {
  const told = new Map<number, VisibleTrait>();
  const margin = (t: VisibleTrait, i: number): number =>
    apart(t, i, all[0]) < 1 ? -1 : Math.min(...all.filter((k) => k !== i).map((k) => apart(t, i, k)));
  let left = all.slice(1);
  for (let least = 1; left.length;) {
    const claims = traits.map((t) => left.filter((i) => margin(t, i) >= least));
    const most = Math.max(...claims.map((c) => c.length));
    const best = claims.findIndex((c) => c.length === most);
    for (const i of claims[best]) told.set(i, traits[best]);
    left = left.filter((i) => !told.has(i));
    if (most) continue;
    // No single trait tells the rest from all: the one that comes nearest.
    const nearest = Math.max(...left.flatMap((i) => traits.map((t) => margin(t, i))));
    if (!(nearest < least)) break;
    least = nearest;
  }
  return told;
}

/** At most so far from where the other passes does one wait for it, metres. */
const WAITS_WITHIN_M = 15;

/** The other that passes close by while it stands, if it stands for that one. */
function waitsFor(mode: Nameable, who: Naming): Relation | null {
  const { motion: m, about } = mode;
  const stand = standOf(m);
  if (!stand || standTime(m) < SHORTEST_S) return null;
  const [from, to] = stand.map((i) => (m.first + i) * STEP_S);
  const [x, y] = [m.x[stand[1]], m.y[stand[1]]];
  const passes = (r: Relation): boolean => {
    if (r.kind !== 'gives_way_to' || r.gap === null || who.nameOf(r.with) === null || isMet(mode, r.with)) return false;
    const left = r.time - r.gap;
    return Math.hypot(r.at[0] - x, r.at[1] - y) < WAITS_WITHIN_M && left > from && left < to + SHORTEST_S;
  };
  return about?.relations.find(passes) ?? null;
}
