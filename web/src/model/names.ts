// Names of futures: made of how each stands to others, else of what it does. No two in one list are alike.
import { leavesRoad, type About, type RelationKind } from './about';
import { wrapAngle } from './geometry';
import { distances, endPose, pathLength, type Motion } from './motion';

/** What a name is made from. */
export interface Nameable {
  readonly motion: Motion;
  readonly about?: About | null;
}

/** Who is named, and what the others are called. */
export interface Naming {
  readonly onFoot: boolean;
  readonly nameOf: (id: string) => string | null;
}

/** A name and what it rests on: `after:12`, or a manner such as `Turns left`. */
export interface Named {
  readonly name: string;
  readonly basis: string;
}

/** Letters that a row of the list has room for. */
const LONGEST = 24;

/** Words for one thing to say of a future, the best first, shorter ones after it. */
interface Candidate {
  readonly basis: string;
  readonly forms: readonly string[];
}

const RELATION_WORDS: Readonly<Record<RelationKind, string>> = {
  before: 'Before',
  after: 'After',
  follows: 'Behind',
  gives_way_to: 'Waits for',
};

const nameless: Naming['nameOf'] = () => null;

/** A name for each. What all share says nothing and is not used. */
export function nameAll(modes: readonly Nameable[], who: Naming = { onFoot: false, nameOf: nameless }): Named[] {
  const said = candidates(modes, who);
  const out: Named[] = [];
  modes.forEach((_, i) => out.push(nameOne(i, said[i], modes, out)));
  return out;
}

/** A name for one that is told apart from those of `others`, which keep theirs. */
export function nameBeside(
  i: number,
  modes: readonly Nameable[],
  who: Naming,
  others: readonly (Named | null)[],
): Named {
  return nameOne(i, candidates(modes, who)[i], modes, others);
}

function nameOne(
  i: number,
  said: readonly Candidate[],
  modes: readonly Nameable[],
  others: readonly (Named | null)[],
): Named {
  const taken = new Set(others.map((o) => o?.name));
  const [first] = said;
  const plain = first.forms.find((f) => f.length <= LONGEST)!;
  if (!taken.has(plain)) return { name: plain, basis: first.basis };
  const alike = others.findIndex((o) => o?.name === plain);
  const words = differences(modes[alike].motion, modes[i].motion, modes[alike].about, modes[i].about);
  const free = (c: Candidate, ends: readonly string[]): Named | undefined => {
    // `Straight on, straight` would say the same twice.
    const fits = (f: string, end: string): boolean => !end || !f.toLowerCase().includes(end.split(' ')[0]);
    const names = ends.flatMap((end) => c.forms.filter((f) => fits(f, end)).map((f) => (end ? `${f}, ${end}` : f)));
    const name = names.find((n) => n.length <= LONGEST && !taken.has(n));
    return name === undefined ? undefined : { name, basis: c.basis };
  };
  // First what tells the two apart, then something else to say of this one.
  const rest = said.slice(1);
  const other = (ends: readonly string[]): Named | undefined =>
    rest.reduce<Named | undefined>((known, c) => known ?? free(c, ends), undefined);
  return free(first, words) ?? other(['']) ?? other(words) ?? free(first, ORDINALS) ?? other(ORDINALS)!;
}

/** For those that nothing tells apart. */
const ORDINALS = ['second way', 'third way', 'fourth way', 'fifth way', 'sixth way'];

// -------------------------------------------------------------- what can be said of each

function candidates(modes: readonly Nameable[], who: Naming): Candidate[][] {
  const relations = modes.map((m) => relationsOf(m, who));
  const count = new Map<string, number>();
  const kinds = new Map<string, Set<string>>();
  for (const list of relations)
    for (const r of list) {
      count.set(r.basis, (count.get(r.basis) ?? 0) + 1);
      kinds.set(r.other, (kinds.get(r.other) ?? new Set()).add(r.basis));
    }
  const tells = (r: RelationCandidate): boolean => modes.length === 1 || count.get(r.basis)! < modes.length;
  // Somebody that one future is before and another is after says most about both.
  const contrast = (r: RelationCandidate): number => Number(kinds.get(r.other)!.size > 1);
  const onRoad = modes.map((m) => !!m.about && !m.about.faults.some((f) => leavesRoad(f) || f.kind === 'goal_missed'));
  const alone = onRoad.filter(Boolean).length === 1 && modes.some((m) => m.about?.faults.some(leavesRoad));
  const stops = modes.map((m) => endsStanding(m, who.onFoot));
  const stopTells = modes.length === 1 || stops.some((s) => !s);
  return modes.map((m, i) => [
    ...(alone && onRoad[i] ? [{ basis: 'By the road', forms: ['By the road'] }] : []),
    ...relations[i].filter(tells).sort((a, b) => contrast(b) - contrast(a)),
    ...(stops[i] && stopTells ? [{ basis: 'Stops', forms: ['Stops'] }] : []),
    manner(m, who.onFoot),
  ]);
}

interface RelationCandidate extends Candidate {
  readonly other: string;
}

function relationsOf(m: Nameable, who: Naming): RelationCandidate[] {
  const out = new Map<string, RelationCandidate>();
  for (const r of m.about?.relations ?? []) {
    const name = who.nameOf(r.with);
    const basis = `${r.kind}:${r.with}`;
    if (!name || out.has(basis)) continue;
    const word = RELATION_WORDS[r.kind];
    const short = shortName(name);
    const forms = [`${word} ${name}`, `${word} ${short}`];
    if (r.kind === 'gives_way_to') forms.push(`Lets ${short} go`);
    if (forms.some((f) => f.length <= LONGEST)) out.set(basis, { basis, forms, other: r.with });
  }
  return [...out.values()];
}

/** A name of its own with the long word cut. */
const shortName = (name: string): string =>
  name.replace('Pedestrian', 'Ped.').replace('Motorcycle', 'Moto').replace('Cyclist', 'Cycl.');

/** Slower than this is standing, m/s. */
const standing = (onFoot: boolean): number => (onFoot ? 0.25 : 0.8);
/** Less than this is no way at all, metres. */
const STAYS_M = 1.5;

const endsStanding = ({ motion: m, about }: Nameable, onFoot: boolean): boolean =>
  about?.manoeuvre !== 'stays' && pathLength(m) >= STAYS_M && Math.abs(endPose(m).speed) < standing(onFoot);

function manner({ motion, about }: Nameable, onFoot: boolean): Candidate {
  const forms = mannerWords(motion, about?.manoeuvre ?? shapeOf(motion, onFoot), onFoot);
  return { basis: forms[0], forms };
}

function mannerWords(m: Motion, manoeuvre: NonNullable<About['manoeuvre']>, onFoot: boolean): string[] {
  switch (manoeuvre) {
    case 'left':
    case 'right': {
      const turn = `Turns ${manoeuvre}`;
      return !onFoot && shiftsFirst(m) ? [`Other lane, then ${manoeuvre}`, `Lane, then ${manoeuvre}`, turn] : [turn];
    }
    case 'lane_left':
    case 'lane_right': {
      const side = manoeuvre === 'lane_left' ? 'left' : 'right';
      return onFoot ? [`Bears ${side}`] : [`To the ${side} lane`, side === 'left' ? 'Left lane' : 'Right lane'];
    }
    case 'turn_round':
      return ['Turns round'];
    case 'stays':
      return [onFoot ? 'Stays' : 'Stands still'];
    case 'reverse':
      return ['Backs up'];
    case 'straight':
      return [onFoot ? 'Straight' : 'Straight on'];
  }
}

// -------------------------------------------------------------- shapes

/** What it does, from its shape alone. */
function shapeOf(m: Motion, onFoot: boolean): NonNullable<About['manoeuvre']> {
  const n = m.x.length - 1;
  if (n < 2 || pathLength(m) < STAYS_M) return 'stays';
  const turn = totalTurn(m);
  if (Math.abs(turn) > 2.5) return 'turn_round';
  if (Math.abs(turn) > 0.6) return turn > 0 ? 'left' : 'right';
  // Sideways without a turn; a long road that bends a little is still straight on.
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

/** About a lane's width, and a heading that is a turn and no change of lanes, radians. */
const LANE_M = 2.4;
const TURNING = 0.3;

/** Has it changed lanes before it turns? */
function shiftsFirst(m: Motion): boolean {
  const i = m.heading.findIndex((h) => Math.abs(wrapAngle(h - m.heading[0])) > TURNING);
  return i > 0 && Math.abs(sideways(m, i, m.heading[0])) > LANE_M;
}

const SIDE: Partial<Record<NonNullable<About['manoeuvre']>, string>> = {
  left: 'left',
  right: 'right',
  straight: 'straight',
  lane_left: 'left lane',
  lane_right: 'right lane',
  turn_round: 'round',
};

/** How the second differs from the first, in words of which the first one says most. */
export function differences(a: Motion, b: Motion, sa?: About | null, sb?: About | null): string[] {
  const found: [weight: number, word: string][] = [];
  const to = sb?.manoeuvre;
  if (to && sa?.manoeuvre && to !== sa.manoeuvre && SIDE[to]) found.push([Infinity, SIDE[to]]);
  const da = distances(a),
    db = distances(b);
  const n = Math.min(da.length, db.length) - 1;
  if (n < 2) return found.map(([, word]) => word);
  const say = (value: number, least: number, more: string, less: string): void => {
    if (Math.abs(value) >= least) found.push([Math.abs(value) / least, value > 0 ? more : less]);
  };
  // With a goal all get as far in the end; then it is told on the way who is ahead.
  const ahead = (i: number): number => db[i] - da[i];
  const far = Math.max(1, 0.03 * da[n]);
  if (Math.abs(ahead(n)) >= far) say(ahead(n), far, 'faster', 'slower');
  else say(ahead(n >> 1), 0.8, 'earlier', 'later');
  say(ahead(n >> 2), 0.8, 'early start', 'late start');
  say(ahead(n) - ahead((3 * n) >> 2), 0.8, 'faster end', 'slower end');
  const side = sideOf(a, b, n);
  const turn = totalTurn(a);
  if (Math.abs(turn) > 0.4) say(turn > 0 ? -side : side, 0.4, 'wider', 'tighter');
  else say(side, 0.4, 'more left', 'more right');
  return found.sort((p, q) => q[0] - p[0]).map(([, word]) => word);
}

/** The furthest that the second path lies to the left of the first, metres; negative to the right. */
function sideOf(a: Motion, b: Motion, n: number): number {
  let most = 0;
  for (let i = 2; i <= n; i += 2) {
    // Beside the nearest point of the first path, so that pace is not taken for width.
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
