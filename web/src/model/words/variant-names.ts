// Names of variants, made of what tells each from the others: a future of the road user that they are about, else
// whoever does another thing than in most of them.
import { JUDGING } from '../base/domain';
import { counted } from '../physics/events';
import type { TrafficEvent } from './event-words';
import type { MotionSet } from '../document/futures';
import { wrapAngle } from '../base/geometry';
import { poseAt, type Motion } from '../base/motion';
import type { Agent, Scene, VariantState } from '../document/scene';
import { valueOf, type Over } from '../physics/sweep';
import { num, seconds, speedLabel, type SpeedUnit } from '../base/units';
import { motionOf } from '../physics/playback';
import { TEXTS } from '../../texts/editing/variants';

export interface Nameless {
  readonly id: number;
  readonly state: VariantState;
  readonly scene: Scene | null;
  readonly set: MotionSet | null;
  readonly events?: readonly TrafficEvent[];
}

/** A motion is looked at every so many seconds. */
const EVERY_S = 0.5;
const TURN_RAD = 0.6;
/** Less than this is not worth a name: seconds of waiting, metres of way. */
const LEAST_S = 1.5;
const LEAST_M = 3;
/** A change of direction says as much as so many metres. */
const TURN_SAYS = 30;
const SECOND_SAYS = 6;

/** What somebody does, in a few figures. */
export interface Deed {
  /** Metres covered, seconds stood, and whether it stands at the end. */
  readonly way: number;
  readonly waits: number;
  readonly stands: boolean;
  readonly turn: 'left' | 'right' | 'straight';
}

interface Said {
  readonly words: string;
  readonly weight: number;
}

/** A name for each, no two alike. `unitOf`: what speeds that were asked of a road user are said in. */
export function nameVariants(all: readonly Nameless[], unitOf: (a: Agent) => SpeedUnit = () => 'km/h'): string[] {
  const said = all.map(() => [] as Said[]);
  all.forEach((v, i) => said[i].push(...ofNumbers(v, all, unitOf), ...ofSubject(v), ...ofEvents(v)));
  const known = all.flatMap((v, i) => (v.scene && v.set ? [{ i, scene: v.scene, set: v.set }] : []));
  const ids = new Set(known.flatMap((k) => [...k.set.driving]));
  for (const id of known.length > 1 ? ids : []) {
    const deeds = known.flatMap(({ i, scene, set }) => {
      const a = scene.agents.get(id);
      return a ? [{ i, a, deed: deedOf(scene, motionOf(scene, set, a)) }] : [];
    });
    const usual = usualOf(deeds.map((d) => d.deed));
    for (const { i, a, deed } of deeds) said[i].push(...unlike(a, deed, usual));
  }
  const taken = new Set<string>();
  return said.map((list, i) => {
    const first = list.sort((p, q) => q.weight - p.weight).find((s) => !taken.has(s.words));
    const name = first?.words ?? TEXTS.variant(all[i].id);
    taken.add(name);
    return name;
  });
}

const NUMBERS: readonly Over[] = ['start', 'goal', 'time'];

/** Numbers asked of the road user that no other of its variants has. */
function ofNumbers(v: Nameless, all: readonly Nameless[], unitOf: (a: Agent) => SpeedUnit): Said[] {
  const a = subjectOf(v);
  if (!a) return [];
  const alike = all.flatMap((o) => (o !== v && o.state.subject === v.state.subject ? (subjectOf(o) ?? []) : []));
  const words = NUMBERS.flatMap((over) => {
    const value = valueOf(a, over);
    if (value === null || !alike.length || alike.some((o) => valueOf(o, over) === value)) return [];
    return valueWords(over, value, unitOf(a));
  });
  const said = words.join(', ');
  return said ? [{ words: said[0].toUpperCase() + said.slice(1), weight: Infinity }] : [];
}

const subjectOf = ({ state, scene }: Nameless): Agent | undefined =>
  state.subject === null ? undefined : scene?.agents.get(state.subject);

/** The future that the road user was given which the variants are about. */
function ofSubject(v: Nameless): Said[] {
  const a = subjectOf(v);
  const f = a && v.set?.futures.get(a.id);
  const name = f && f.modes[Math.min(f.modes.length - 1, a.chosen ?? f.chosen)]?.name;
  return name ? [{ words: name, weight: Infinity }] : [];
}

/** What happens says as much as so many metres, by its mark. */
const EVENT_SAYS = { collision: 60, rule: 12, near: 8, short: 6 } as const;

function ofEvents({ events = [] }: Nameless): Said[] {
  return counted(events).map((e) => {
    const { a, b, short } = e;
    const words = !b
      ? `${a.name}, ${short}`
      : `${a.name} ${e.what === 'collision' ? TEXTS.meets : TEXTS.closeTo} ${b.name}`;
    return { words, weight: EVENT_SAYS[e.kind] };
  });
}

export function deedOf(scene: Scene, m: Motion): Deed {
  let way = 0,
    waits = 0,
    turned = 0;
  let last = poseAt(m, 0);
  let stands = false;
  for (let t = EVERY_S; t <= scene.duration + 1e-6; t += EVERY_S) {
    const p = poseAt(m, t);
    if (p && last) {
      way += Math.hypot(p.x - last.x, p.y - last.y);
      turned += wrapAngle(p.heading - last.heading);
    }
    stands = !!p && Math.abs(p.speed) < JUDGING.standing_mps;
    if (stands) waits += EVERY_S;
    last = p ?? last;
  }
  return { way, waits, stands, turn: turned > TURN_RAD ? 'left' : turned < -TURN_RAD ? 'right' : 'straight' };
}

function usualOf(deeds: readonly Deed[]): Deed {
  const middle = (of: (d: Deed) => number): number => deeds.map(of).sort((a, b) => a - b)[(deeds.length - 1) >> 1];
  const most = (['straight', 'left', 'right'] as const).map((turn) => ({
    turn,
    n: deeds.filter((d) => d.turn === turn).length,
  }));
  const { turn } = most.reduce((a, b) => (b.n > a.n ? b : a));
  const stands = deeds.filter((d) => d.stands).length * 2 > deeds.length;
  return { way: middle((d) => d.way), waits: middle((d) => d.waits), stands, turn };
}

const TURNS: Record<Deed['turn'], string> = {
  left: TEXTS.turnsLeft,
  right: TEXTS.turnsRight,
  straight: TEXTS.goesStraight,
};

function unlike(a: Agent, d: Deed, usual: Deed): Said[] {
  const out: Said[] = [];
  const say = (words: string, weight: number) => out.push({ words: `${a.name} ${words}`, weight });
  const longer = d.waits - usual.waits;
  // People on foot turn all the time.
  if (d.turn !== usual.turn && d.way > LEAST_M && a.type !== 'pedestrian') say(TURNS[d.turn], TURN_SAYS);
  if (longer >= LEAST_S && d.stands && !usual.stands) say(TEXTS.stops, longer * SECOND_SAYS);
  else if (longer >= LEAST_S) say(TEXTS.waitsSLonger(num(longer, 0)), longer * SECOND_SAYS);
  else if (-longer >= LEAST_S) say(d.waits < EVERY_S ? TEXTS.doesNotWait : TEXTS.waitsLess, -longer * SECOND_SAYS);
  const further = d.way - usual.way;
  if (Math.abs(longer) < LEAST_S && Math.abs(further) >= LEAST_M)
    say(further > 0 ? TEXTS.goesFaster : TEXTS.goesSlower, Math.abs(further));
  return out;
}

/** What tells a variant by its number. */
export function valueWords(over: Over, value: number, unit: SpeedUnit): string {
  if (over === 'time') return TEXTS.thereAfter(Number.isInteger(value) ? `${num(value, 0)} s` : seconds(value));
  return `${over === 'start' ? TEXTS.startsAt : TEXTS.arrivesAt} ${speedLabel(value, unit)}`;
}
