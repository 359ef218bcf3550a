// Names of futures: from relations to others, else from the manoeuvre, plus the difference to similar ones, in seconds
// or metres where it has one. Futures that look the same have the same name.
import { JUDGING } from '../base/domain';
import { faultMark, leavesRoad, type FutureFacts, type RelationKind } from '../document/future-facts';
import { wrapAngle } from '../base/geometry';
import { distances, endPose, hardestBraking, lastStep, pathLength, poseAt, STEP_S, type Motion } from '../base/motion';
import { metres, seconds } from '../base/units';
import { TEXTS as KINDS } from '../../texts/scene/kinds';
import { TEXTS } from '../../texts/scene/names';

/** Inputs of a name. */
export interface Nameable {
  readonly motion: Motion;
  /** Relative weight. The likeliest is named first, so that names do not depend on the order of the letters. */
  readonly probability?: number;
  readonly about?: FutureFacts | null;
}

/** The named road user, and the names of the others. */
export interface Naming {
  readonly onFoot: boolean;
  readonly nameOf: (id: string) => string | null;
  /** Its recording; null where there is none. */
  readonly log?: Motion | null;
}

/** A name and its basis: `|after:12`, `left|after:12`, or a manner such as `Turns left`. */
export interface FutureName {
  readonly name: string;
  readonly basis: string;
}

/** Letters that fit in a row of the list. */
const LONGEST = 26;

/** Words for one property of a future, the best first, then shorter ones. */
interface Candidate {
  readonly basis: string;
  readonly forms: readonly string[];
}

const RELATION_WORDS: Readonly<Record<RelationKind, string>> = {
  before: TEXTS.before,
  after: TEXTS.after,
  follows: TEXTS.behind,
  gives_way_to: TEXTS.waitsFor,
};

const nameless: Naming['nameOf'] = () => null;

/** A name for each. A property shared by all is not used. */
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
  const names = nameInOrder(
    order.map((i) => modes[i]),
    who,
    order.map((i) => kept[i]),
  );
  return modes.map((_, i) => names[order.indexOf(i)]);
}

function nameInOrder(modes: readonly Nameable[], who: Naming, kept: readonly (FutureName | null)[]): FutureName[] {
  const list = new NameList(modes, kept);
  const said = candidates(modes, who);
  // The most informative property first; one that it does not distinguish is named by another.
  for (let rank = 0; list.unnamed.length; rank++) {
    const groups = new Map<string, number[]>();
    for (const i of list.unnamed) {
      const c = said[i][rank];
      if (c) groups.set(c.basis, [...(groups.get(c.basis) ?? []), i]);
    }
    if (!groups.size) break;
    for (const group of groups.values()) list.tellApart(group, said[group[0]][rank]);
  }
  // A small true difference is more informative than a similarity.
  for (const i of list.unnamed) said[i].some((c) => list.tellSlightly(i, c));
  for (const i of list.unnamed) list.repeat(i, said[i][0]);
  return list.names;
}

/** The names given so far. */
class NameList {
  readonly #names: (FutureName | null)[];

  constructor(
    private readonly modes: readonly Nameable[],
    kept: readonly (FutureName | null)[],
  ) {
    this.#names = [...kept];
  }

  get unnamed(): number[] {
    return this.#names.flatMap((n, i) => (n ? [] : [i]));
  }

  get names(): FutureName[] {
    return this.#names.map((n) => n!);
  }

  #give(i: number, c: Candidate, end: string): boolean {
    const said = (o: FutureName | null): boolean => !!end && o?.basis === c.basis && o.name.endsWith(`, ${end}`);
    if (this.#names.some(said)) return false;
    const taken = (n: string): boolean => this.#names.some((o) => o?.name === n);
    const names = c.forms.map((f) => (end ? `${f}, ${end}` : f));
    const name = names.find((n) => n.length <= LONGEST && !taken(n));
    if (name === undefined) return false;
    this.#names[i] = { name, basis: c.basis };
    return true;
  }

  /** The first of a group is named by its common property; each other one by its difference from the rest. */
  tellApart(group: readonly number[], c: Candidate): void {
    const named = this.#names.flatMap((n, i) => (n?.basis === c.basis ? [i] : []));
    const left = [...group];
    if (!named.length && this.#give(left[0], c, '')) named.push(left.shift()!);
    if (!left.length) return;
    const all = [...named, ...left];
    const { traits, halfway } = traitsOf(this.modes, all, c.basis);
    const take = (claims: readonly Claim[]): void => {
      for (const { i, word } of [...claims].sort((p, q) => q.margins - p.margins))
        if (left.includes(i) && this.#give(i, c, word)) left.splice(left.indexOf(i), 1);
    };
    const [pace] = traits;
    // For two, the plainest difference. Several are distinguished by pace first.
    if (all.length > 2) take(scaleOf(pace, all));
    take(traits.flatMap((t) => extremesOf(t, all)));
    // Those of equal pace, against each other and the first.
    for (const i of [...left]) {
      const same = all.filter((j) => j === all[0] || Math.abs(pace.values.get(j)! - pace.values.get(i)!) < pace.least);
      take([...traits, halfway].flatMap((t) => extremesOf(t, same)).filter((claim) => claim.i === i));
    }
  }

  /** Named by a small difference from the first of its group. */
  tellSlightly(i: number, c: Candidate): boolean {
    const named = this.#names.flatMap((n, j) => (n?.basis === c.basis ? [j] : []));
    if (!named.length) return false;
    const [first] = named;
    const all = [...named, i];
    const { traits, halfway } = traitsOf(this.modes, all, c.basis);
    // A trait in which another named one is alike distinguishes less.
    const isShared = ({ values, least }: VisibleTrait): boolean =>
      named.some((j) => j !== first && Math.abs(values.get(j)! - values.get(i)!) < SMALL * least);
    const differs = [...new Set([...traits, halfway, brakingTime(this.modes, all)])]
      .map((t) => ({ t, by: (t.values.get(i)! - t.values.get(first)!) / t.least }))
      // Less than the visible difference in time is noise.
      .filter(({ t, by }) => Math.abs(by) >= (t === halfway ? 1 : SMALL))
      .sort((p, q) => Number(isShared(p.t)) - Number(isShared(q.t)) || Math.abs(q.by) - Math.abs(p.by));
    for (const { t, by } of differs) {
      const word = by > 0 ? t.more : lessOf(t, i);
      if (this.#give(i, c, t.amount?.(by * t.least) ?? word)) return true;
    }
    return false;
  }

  /** A future that looks like another one has the same name. */
  repeat(i: number, { basis, forms }: Candidate): void {
    this.#names[i] = { name: forms[0], basis };
  }
}

/** Share of the visible threshold, used where nothing else distinguishes. */
const SMALL = 0.5;

// -------------------------------------------------------------- properties of each

type ManoeuvreName = NonNullable<FutureFacts['manoeuvre']>;

/** What a future does: as the generator says, else by its shape. */
export const manoeuvreOf = ({ motion, about }: Nameable, onFoot: boolean): ManoeuvreName =>
  about?.manoeuvre ?? shapeOf(motion, onFoot);

/** Manoeuvres that the eye sees before any relation, as they begin a name; lanes are only those of vehicles. */
const TURNS: Partial<Record<ManoeuvreName, string>> = { left: TEXTS.left, right: TEXTS.right, turn_round: TEXTS.uTurn };
const LANES: Partial<Record<ManoeuvreName, string>> = { lane_left: TEXTS.leftLane, lane_right: TEXTS.rightLane };

function candidates(modes: readonly Nameable[], who: Naming): Candidate[][] {
  const words = who.onFoot ? TURNS : { ...TURNS, ...LANES };
  const manoeuvres = modes.map((m) => manoeuvreOf(m, who.onFoot));
  // A manoeuvre of all distinguishes none.
  const differ = new Set(manoeuvres.map((name) => words[name])).size > 1;
  const relations = modes.map((m, i) => relationsOf(m, who, differ ? (words[manoeuvres[i]] ?? '') : ''));
  const count = new Map<string, number>();
  const kinds = new Map<string, Set<string>>();
  for (const list of relations)
    for (const r of list) {
      count.set(r.relation, (count.get(r.relation) ?? 0) + 1);
      kinds.set(r.other, (kinds.get(r.other) ?? new Set()).add(r.relation));
    }
  const tells = (r: RelationCandidate): boolean => modes.length === 1 || count.get(r.relation)! < modes.length;
  // A road user that one future passes before and another after is the most informative for both.
  const contrast = (r: RelationCandidate): number => Number(kinds.get(r.other)!.size > 1);
  const onRoad = modes.map((m) => !!m.about && m.about.faults.every((f) => faultMark(f) === 'near'));
  const alone = onRoad.filter(Boolean).length === 1 && modes.some((m) => m.about?.faults.some(leavesRoad));
  const stops = modes.map((m) => endsStanding(m, who.onFoot));
  const stopTells = modes.length === 1 || stops.some((s) => !s);
  return modes.map((m, i) => [
    ...(who.log && isLike(m.motion, who.log) ? [{ basis: TEXTS.likeTheLog, forms: [TEXTS.likeTheLog] }] : []),
    ...(alone && onRoad[i] ? [{ basis: TEXTS.byRoad, forms: [TEXTS.byRoad] }] : []),
    ...relations[i].filter(tells).sort((a, b) => contrast(b) - contrast(a)),
    stops[i] && stopTells && !hasTurned(m, who.onFoot) ? { basis: STOPS, forms: [STOPS] } : manner(m, who.onFoot),
  ]);
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

const STOPS = TEXTS.stops;

interface RelationCandidate extends Candidate {
  /** `after:12`, whatever the manoeuvre. */
  readonly relation: string;
  readonly other: string;
}

/** `first`: the manoeuvre that begins the name, or nothing. */
function relationsOf(m: Nameable, who: Naming, first: string): RelationCandidate[] {
  const out = new Map<string, RelationCandidate>();
  // A future does not wait for a road user that it hits.
  const hit = new Set(m.about?.faults.flatMap((f) => (f.kind === 'collision' && f.with !== null ? [f.with] : [])));
  for (const r of m.about?.relations ?? []) {
    const name = hit.has(r.with) ? null : who.nameOf(r.with);
    const relation = `${r.kind}:${r.with}`;
    if (!name || out.has(relation)) continue;
    // Giving way at speed is not waiting.
    const rolls = r.kind === 'gives_way_to' && !waitsBy(m.motion, r.time, who.onFoot);
    const word = rolls ? TEXTS.slowsFor : RELATION_WORDS[r.kind];
    const short = shortName(name);
    const words = [`${word} ${name}`, `${word} ${short}`];
    if (r.kind === 'gives_way_to') words.push(TEXTS.yieldsTo(short));
    const forms = first ? words.map((w) => `${first}, ${w.charAt(0).toLowerCase()}${w.slice(1)}`) : words;
    const basis = `${first && manoeuvreOf(m, who.onFoot)}|${relation}`;
    if (forms.some((f) => f.length <= LONGEST)) out.set(relation, { basis, forms, relation, other: r.with });
  }
  return [...out.values()];
}

/** Slower than walking pace is waiting, m/s. */
const CRAWLS_M_S = 1.4;

/** Has it stood or crept by a scene time? */
function waitsBy(m: Motion, time: number, onFoot: boolean): boolean {
  const slow = onFoot ? JUDGING.standing_mps : CRAWLS_M_S;
  return m.speed.some((v, i) => (m.first + i) * STEP_S <= time && Math.abs(v) < slow);
}

/** A given name with the long word shortened. */
const shortName = (name: string): string => SHORT.reduce((n, [long, short]) => n.replace(long, short), name);
const SHORT = [
  [KINDS.pedestrian, TEXTS.ped],
  [KINDS.motorcycle, TEXTS.moto],
  [KINDS.cyclist, TEXTS.cycl],
] as const;

/** Smaller movements are invisible, metres. */
const CREEPS_M = 0.4;

/** One that stops after its turn is named by the turn, which the eye sees first. */
const hasTurned = (m: Nameable, onFoot: boolean): boolean => manoeuvreOf(m, onFoot) in TURNS;

function endsStanding(m: Nameable, onFoot: boolean): boolean {
  if (manoeuvreOf(m, onFoot) === 'stays' || pathLength(m.motion) < JUDGING.stays_m) return false;
  return Math.abs(endPose(m.motion).speed) < JUDGING.standing_mps;
}

function manner(m: Nameable, onFoot: boolean): Candidate {
  const forms = mannerWords(m.motion, manoeuvreOf(m, onFoot), onFoot);
  return { basis: forms[0], forms };
}

function mannerWords(m: Motion, manoeuvre: ManoeuvreName, onFoot: boolean): string[] {
  switch (manoeuvre) {
    case 'left':
    case 'right': {
      const turn = manoeuvre === 'left' ? TEXTS.turnsLeft : TEXTS.turnsRight;
      return !onFoot && shiftsFirst(m) ? [TEXTS.laneChangeThen[manoeuvre], TEXTS.laneChange[manoeuvre], turn] : [turn];
    }
    case 'lane_left':
    case 'lane_right': {
      const side = manoeuvre === 'lane_left' ? 'left' : 'right';
      return onFoot ? [TEXTS.bears[side]] : [TEXTS.toTheLane[side], side === 'left' ? TEXTS.leftLane : TEXTS.rightLane];
    }
    case 'turn_round':
      return [TEXTS.uTurn];
    case 'stays':
      if (pathLength(m) >= CREEPS_M) return [onFoot ? TEXTS.aStepOrTwo : TEXTS.rollsForward];
      return [onFoot ? TEXTS.stays : TEXTS.standsStill];
    case 'reverse':
      return [TEXTS.backsUp];
    case 'straight':
      return onFoot ? [TEXTS.straight] : [TEXTS.straightOn, TEXTS.straight];
  }
}

// -------------------------------------------------------------- shapes

/** The manoeuvre, from the shape only. */
function shapeOf(m: Motion, onFoot: boolean): ManoeuvreName {
  const n = m.x.length - 1;
  if (n < 2 || pathLength(m) < JUDGING.stays_m) return 'stays';
  const turn = totalTurn(m);
  if (Math.abs(turn) > JUDGING.turn_round_rad) return 'turn_round';
  if (Math.abs(turn) > JUDGING.turn_rad) return turn > 0 ? 'left' : 'right';
  // Sideways without a turn; a long road with a slight bend is still straight on.
  const h = m.heading[0] + wrapAngle(m.heading[n] - m.heading[0]) / 2;
  const far = Math.hypot(m.x[n] - m.x[0], m.y[n] - m.y[0]);
  const left = sideways(m, n, h);
  const limit = onFoot ? Math.max(1, 0.18 * far) : Math.max(2.2, 0.07 * far);
  return Math.abs(left) > limit ? (left > 0 ? 'lane_left' : 'lane_right') : 'straight';
}

function totalTurn(m: Motion): number {
  let t = 0;
  for (let i = 1; i < m.heading.length; i++) t += wrapAngle(m.heading[i] - m.heading[i - 1]);
  return t;
}

/** Metres to the left of the start, seen along a heading. */
const sideways = (m: Motion, i: number, heading: number): number =>
  -(m.x[i] - m.x[0]) * Math.sin(heading) + (m.y[i] - m.y[0]) * Math.cos(heading);

/** About a lane's width, and the heading from which it is a turn and not a lane change, radians. */
const LANE_M = 2.4;
const TURNING = 0.3;

/** Has it changed lanes before it turns? */
function shiftsFirst(m: Motion): boolean {
  const i = m.heading.findIndex((h) => Math.abs(wrapAngle(h - m.heading[0])) > TURNING);
  return i > 0 && Math.abs(sideways(m, i, m.heading[0])) > LANE_M;
}

// -------------------------------------------------------------- differences

/** A visible property of each of a group. */
interface VisibleTrait {
  readonly values: ReadonlyMap<number, number>;
  /** Smaller differences are invisible. */
  readonly least: number;
  readonly more: string;
  readonly less: string;
  /** The difference in numbers, signed. */
  readonly amount?: (by: number) => string;
  /** The word for almost nothing of it, in place of "less". */
  readonly none?: { readonly below: number; readonly word: string };
}

const lessOf = ({ values, less, none }: VisibleTrait, i: number): string =>
  none && values.get(i)! < none.below ? none.word : less;

interface Claim {
  readonly i: number;
  readonly word: string;
  /** Difference in multiples of the visible threshold. */
  readonly margins: number;
}

/** The largest and smallest of a trait: each beyond all of the others. */
function extremesOf(trait: VisibleTrait, all: readonly number[]): Claim[] {
  const { values, least, more } = trait;
  const order = [...all].sort((a, b) => values.get(b)! - values.get(a)!);
  const gap = (a: number, b: number): number => (values.get(order[a])! - values.get(order[b])!) / least;
  const last = order.length - 1;
  return [
    { i: order[0], word: more, margins: gap(0, 1) },
    { i: order[last], word: lessOf(trait, order[last]), margins: gap(last - 1, last) },
  ].filter((claim) => claim.margins >= 1);
}

/** More and less of a trait than the first has, level by level. */
function scaleOf({ values, least, more, less, amount }: VisibleTrait, all: readonly number[]): Claim[] {
  const [first] = all;
  const out: Claim[] = [];
  for (const [sign, word] of [
    [1, more],
    [-1, less],
  ] as const) {
    const beyond = (i: number): number => (sign * (values.get(i)! - values.get(first)!)) / least;
    const levels: number[] = [];
    for (const i of [...all].sort((a, b) => beyond(a) - beyond(b)))
      if (beyond(i) >= 1 + (levels.length ? beyond(levels.at(-1)!) : 0)) levels.push(i);
    const exact = (i: number): string => amount?.(values.get(i)! - values.get(first)!) ?? word;
    // A single one needs no number.
    levels.forEach((i) => out.push({ i, word: levels.length > 1 ? exact(i) : word, margins: beyond(i) }));
  }
  return out;
}

/** Less than this is no braking, m/s². */
const BRAKES_MPS2 = 0.4;

/** Time of the hardest braking, seconds; unused if one of them hardly brakes. */
function brakingTime(modes: readonly Nameable[], group: readonly number[]): VisibleTrait {
  const at = (m: Motion): number => {
    let most = 1,
      when = NaN;
    for (let i = 5; i < m.speed.length; i++) {
      const braking = (Math.abs(m.speed[i - 5]) - Math.abs(m.speed[i])) / 0.5;
      if (braking > most) [most, when] = [braking, i * STEP_S];
    }
    return when;
  };
  const values = new Map(group.map((i) => [i, at(modes[i].motion)]));
  return { values, least: 1, more: TEXTS.brakesLater, less: TEXTS.brakesEarlier };
}

interface Traits {
  /** The pace first. */
  readonly traits: readonly VisibleTrait[];
  /** Progress at half time. */
  readonly halfway: VisibleTrait;
}

/** Differences of slower ones are not converted to seconds by their own speed, m/s. */
const LEAST_PACE_MPS = 0.5;

/** Smaller differences in time are invisible: seconds, and metres of those that are slow. */
const LEAST_APART_S = 0.3;
const LEAST_APART_M = 0.8;

/** All visible traits in which members of a group may differ. */
function traitsOf(modes: readonly Nameable[], group: readonly number[], basis: string): Traits {
  const motion = (i: number): Motion => modes[i].motion;
  const gone = new Map(group.map((i) => [i, distances(motion(i))]));
  const n = Math.min(...[...gone.values()].map((d) => d.length)) - 1;
  const trait = (of: (i: number) => number, least: number, more: string, less: string): VisibleTrait => ({
    values: new Map(group.map((i) => [i, of(i)])),
    least,
    more,
    less,
  });
  const at = (part: number) => (i: number) => gone.get(i)![Math.round(n * part)];
  const ends = group.map(at(1));
  const far = Math.max(1, 0.03 * Math.max(...ends));
  const together = Math.max(...ends) - Math.min(...ends) < far;
  const speed = Math.max(LEAST_PACE_MPS, distances(motion(group[0]))[n] / (n * STEP_S));
  const apart = Math.max(LEAST_APART_M, LEAST_APART_S * speed);
  const halfway: VisibleTrait = {
    ...trait(at(0.5), apart, TEXTS.earlier, TEXTS.later),
    amount: (by) => (by > 0 ? TEXTS.earlierBy : TEXTS.laterBy)(seconds(Math.abs(by) / speed)),
  };
  const [more, less] = basis === STOPS ? [TEXTS.furtherOn, TEXTS.sooner] : [TEXTS.faster, TEXTS.slower];
  // With a goal all get equally far, so progress is compared on the way.
  const pace: VisibleTrait = together
    ? halfway
    : {
        ...trait(at(1), far, more, less),
        amount: (by) => (by > 0 ? TEXTS.furtherBy : TEXTS.shorterBy)(metres(Math.max(1, Math.abs(by)), 0)),
      };
  const [first] = group;
  const turn = totalTurn(motion(first));
  const turns = Math.abs(turn) > 0.4;
  // Positive outwards in a turn, else to the left.
  const side = new Map(group.map((i) => [i, (turns ? -Math.sign(turn) : 1) * sideOf(motion(first), motion(i), n)]));
  const offset = (i: number): number => side.get(i)!;
  const traits: VisibleTrait[] = [
    pace,
    trait(at(0.25), apart, TEXTS.fasterStart, TEXTS.slowerStart),
    trait((i) => Math.abs(motion(i).speed[n]), 1.5, TEXTS.fasterEnd, TEXTS.slowerEnd),
    {
      ...trait((i) => hardestBraking(motion(i)), 1, TEXTS.brakesHarder, TEXTS.brakesLess),
      none: { below: BRAKES_MPS2, word: TEXTS.noBraking },
    },
    turns ? trait(offset, 0.5, TEXTS.wider, TEXTS.tighter) : trait(offset, 0.5, TEXTS.moreLeft, TEXTS.moreRight),
  ];
  return { traits, halfway };
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
