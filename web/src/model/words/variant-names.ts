// Names of variants from their differences: a future of the subject, else a road user with a motion unlike that in most
// variants.
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

/** Sampling interval of a motion, seconds. */
const EVERY_S = 0.5;
/** Smaller differences give no name: seconds of waiting, metres of path. */
const LEAST_S = 1.5;
const LEAST_M = 3;
/** A change of direction weighs as much as this many metres. */
const TURN_SAYS = 30;
const SECOND_SAYS = 6;

/** The motion of a road user in a few figures. */
export interface Deed {
  /** Metres covered, seconds stood, and whether it stands at the end. */
  readonly way: number;
  readonly waits: number;
  readonly stands: boolean;
  readonly turn: 'left' | 'right' | 'straight';
}

interface WeightedWords {
  readonly words: string;
  readonly weight: number;
  /** Several may be named by them. */
  readonly shared?: boolean;
}

/**
 * A name for each, no two alike but for futures of one name. `unitOf`: unit for speed conditions of a road user;
 * `numbered`: the name of one that differs in nothing, by its id.
 */
export function nameVariants(
  all: readonly Nameless[],
  unitOf: (a: Agent) => SpeedUnit = () => 'km/h',
  numbered: (id: number) => string = TEXTS.variant,
): string[] {
  const said = all.map(() => [] as WeightedWords[]);
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
    const first = list.sort((p, q) => q.weight - p.weight).find((s) => s.shared || !taken.has(s.words));
    const name = first?.words ?? numbered(all[i].id);
    taken.add(name);
    return name;
  });
}

const NUMBERS: readonly Over[] = ['start', 'goal', 'time'];

/** Conditions of the subject with values that no other variant of it has. */
function ofNumbers(v: Nameless, all: readonly Nameless[], unitOf: (a: Agent) => SpeedUnit): WeightedWords[] {
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

/** The picked future of the subject. */
function ofSubject(v: Nameless): WeightedWords[] {
  const a = subjectOf(v);
  const f = a && v.set?.futures.get(a.id);
  const name = f && f.modes[Math.min(f.modes.length - 1, a.chosen ?? f.chosen)]?.name;
  if (!name) return [];
  return [{ words: name, weight: Infinity, shared: f.modes.filter((m) => m.name === name).length > 1 }];
}

/** Weight of an event in metres, by its mark. */
const EVENT_SAYS = { collision: 60, rule: 12, near: 8, short: 6 } as const;

function ofEvents({ events = [] }: Nameless): WeightedWords[] {
  return counted(events).map((e) => {
    const { a, b, short } = e;
    const words = !b
      ? `${a.name}, ${short}`
      : `${a.name} ${e.what === 'collision' ? TEXTS.hits : TEXTS.nearlyHits} ${b.name}`;
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
  return {
    way,
    waits,
    stands,
    turn: turned > JUDGING.turn_rad ? 'left' : turned < -JUDGING.turn_rad ? 'right' : 'straight',
  };
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

function unlike(a: Agent, d: Deed, usual: Deed): WeightedWords[] {
  const out: WeightedWords[] = [];
  const say = (words: string, weight: number) => out.push({ words: `${a.name} ${words}`, weight });
  const longer = d.waits - usual.waits;
  // Pedestrians turn all the time.
  if (d.turn !== usual.turn && d.way > LEAST_M && a.type !== 'pedestrian') say(TURNS[d.turn], TURN_SAYS);
  if (longer >= LEAST_S && d.stands && !usual.stands) say(TEXTS.stops, longer * SECOND_SAYS);
  else if (longer >= LEAST_S) say(TEXTS.waitsSLonger(num(longer, 0)), longer * SECOND_SAYS);
  else if (-longer >= LEAST_S) say(d.waits < EVERY_S ? TEXTS.doesNotWait : TEXTS.waitsLess, -longer * SECOND_SAYS);
  const further = d.way - usual.way;
  if (Math.abs(longer) < LEAST_S && Math.abs(further) >= LEAST_M)
    say(further > 0 ? TEXTS.goesFaster : TEXTS.goesSlower, Math.abs(further));
  return out;
}

/** The name of a variant by its swept value. */
export function valueWords(over: Over, value: number, unit: SpeedUnit): string {
  if (over === 'time') return TEXTS.arrivesAfter(Number.isInteger(value) ? `${num(value, 0)} s` : seconds(value));
  return `${over === 'start' ? TEXTS.startsAt : TEXTS.arrivesAt} ${speedLabel(value, unit)}`;
}
