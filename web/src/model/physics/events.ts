// Events as the timeline and the list show them: what is wrong with the futures that are followed, and the facts of
// the score about everybody else. What the log does by itself is marked so and does not count.
import { compareMarks, faultMark, type Fault, type FaultKind, type Mark } from '../document/future-facts';
import { motionOf } from './playback';
import type { Futures, MotionSet, Score, Stretch } from '../document/futures';
import { poseAt, STEP_S } from '../base/motion';
import { nameIn, touched, type Agent, type Scene } from '../document/scene';
import { acceleration, metres, num, seconds, speedLabel, type SpeedUnit, walkingUnit } from '../base/units';
import { placeWord } from '../words/verdict-words';
import { wrapAngle, type Pose, type Vec } from '../base/geometry';
import { TEXTS } from '../../texts/events';

export interface TrafficEvent {
  readonly kind: Exclude<Mark, 'ok'>;
  readonly what: FaultKind;
  readonly time: number;
  readonly until: number;
  /** How near the two of a near miss come, metres; null of anything else, and where nobody knows. */
  readonly gap: number | null;
  readonly a: Agent;
  /** The other one, where there is one. */
  readonly b: Agent | null;
  /** It happens in the log or in the example itself; nobody was asked for it. */
  readonly inLog: boolean;
  /** Who. */
  readonly title: string;
  /** What and when, for the timeline. */
  readonly label: string;
  /** What and how bad, for the list: `Near miss, 0.6 m`. */
  readonly words: string;
  /** The closest of it, for a label on the map. */
  readonly short: string;
  readonly at: Vec;
  readonly facts: readonly (readonly [string, string])[];
}

/** Meetings of the same two closer together than this are one event: the same pair passing once. */
const SAME_PASS_S = 1.5;
/** Faults of one road user and kind closer together than this are one event. */
const SAME_STRETCH_S = 1;

/** What is known of an event before it is put into words. */
interface Raw {
  readonly what: FaultKind;
  readonly time: number;
  readonly until: number;
  readonly a: string;
  readonly b: string | null;
  readonly extent: number | null;
  readonly ttc: number | null;
  readonly at: Vec | null;
  readonly inLog: boolean;
}

/** Everything that happens in the scene as it is followed. */
export function readEvents(scene: Scene, set: MotionSet, unit: SpeedUnit = 'km/h'): TrafficEvent[] {
  const said: Raw[] = [];
  const judged = new Set<string>();
  for (const id of set.driving) {
    const a = scene.agents.get(id);
    const f = set.futures.get(id);
    const m = a && f?.modes[Math.min(f.modes.length - 1, a.chosen ?? f.chosen)];
    for (const fault of m?.about?.faults ?? []) said.push(ofFault(id, fault));
    if (m?.about && touched(a!)) judged.add(id);
  }
  const scored = set.score ? ofScore(scene, set, set.score) : [];
  // Of those that were asked something the timeline says what the verdict on their shown future says, nothing else.
  const told = (r: Raw): boolean => judged.has(r.a) || (r.b !== null && judged.has(r.b));
  const near = scored.filter((r) => r.what === 'near_miss');
  const own = said.filter((r) => judged.has(r.a) || !told(r)).map((r) => withTime(r, near));
  return inWords(scene, set, unit, [...own, ...scored.filter((r) => !told(r))]);
}

/** The verdict of a future on a near miss, with the time to collision that the score has of the same moment. */
function withTime(r: Raw, near: readonly Raw[]): Raw {
  if (r.what !== 'near_miss') return r;
  const pair = (s: Raw): boolean => (s.a === r.a && s.b === r.b) || (s.a === r.b && s.b === r.a);
  const same = near.find((s) => pair(s) && Math.abs(s.time - r.time) < STEP_S);
  return same ? { ...r, ttc: same.ttc } : r;
}

/** What is wrong with one future on its way, while nobody follows it yet. */
export function eventsOf(
  scene: Scene,
  set: MotionSet,
  id: string,
  f: Futures,
  chosen: number,
  unit: SpeedUnit = 'km/h',
): TrafficEvent[] {
  return inWords(
    scene,
    set,
    unit,
    (f.modes[chosen]?.about?.faults ?? []).map((fault) => ofFault(id, fault)),
  );
}

const ofFault = (id: string, f: Fault): Raw => ({
  what: f.kind,
  time: f.time,
  until: f.until,
  a: id,
  b: f.with,
  extent: f.extent,
  ttc: null,
  at: f.at,
  inLog: false,
});

function ofScore(scene: Scene, set: MotionSet, score: Score): Raw[] {
  const replays = (id: string, time: number): boolean => replaysLog(scene, set, id, time);
  const none = { extent: null, ttc: null, at: null };
  const two = score.collisions.map((c): Raw => ({
    ...none,
    ...c,
    what: 'collision',
    until: c.time,
    extent: c.closing ?? null,
    inLog: c.inLog ?? (replays(c.a, c.time) && replays(c.b, c.time)),
  }));
  const near = score.nearMisses.map((c): Raw => ({
    ...none,
    ...c,
    what: 'near_miss',
    until: c.time,
    extent: c.distance,
    inLog: c.inLog ?? (replays(c.a, c.time) && replays(c.b, c.time)),
  }));
  const one = (score.stretches ?? []).map((s: Stretch): Raw => ({
    ...none,
    what: s.what,
    time: s.time,
    until: s.until,
    a: s.agent,
    b: null,
    extent: s.extent,
    inLog: s.inLog ?? replays(s.agent, s.time),
  }));
  return [...two, ...near, ...one];
}

/** Does it do what was recorded, or what the example says? */
function replaysLog(scene: Scene, set: MotionSet, id: string, time: number): boolean {
  const a = scene.agents.get(id);
  if (!a || set.driving.has(id) || (scene.others === 'still' && a.type !== 'other')) return false;
  return poseAt(a.log, time) !== null;
}

/** One event a meeting and a stretch, by time. */
function inWords(scene: Scene, set: MotionSet, unit: SpeedUnit, all: readonly Raw[]): TrafficEvent[] {
  const kept: Raw[] = [];
  const pairOf = (r: Raw): string => (r.b === null ? '' : r.a < r.b ? `${r.a}|${r.b}` : `${r.b}|${r.a}`);
  const hit = new Set(all.filter((r) => r.what === 'collision').map(pairOf));
  const byTime = [...all].sort((p, q) => p.time - q.time);
  // Faults name the place and the extent, so they stand before what the score says of the same.
  for (const r of [...byTime.filter((x) => x.at), ...byTime.filter((x) => !x.at)]) {
    const same = r.b === null ? kept.findIndex((k) => sameStretch(k, r)) : -1;
    if (same >= 0) kept[same] = joined(kept[same], r);
    const meets = (k: Raw): boolean =>
      k.what === r.what && pairOf(k) === pairOf(r) && (r.what === 'collision' || near(k, r) < SAME_PASS_S);
    if (same >= 0 || (r.b !== null && ((r.what !== 'collision' && hit.has(pairOf(r))) || kept.some(meets)))) continue;
    kept.push(r);
  }
  return kept
    .flatMap((r) => event(scene, set, r, unit) ?? [])
    .sort((x, y) => x.time - y.time || compareMarks(x.kind, y.kind));
}

const near = (a: Raw, b: Raw): number => Math.abs(a.time - b.time);

/** To the score a median is off the road like any other. */
const sameKind = (a: FaultKind, b: FaultKind): boolean =>
  a === b || (a === 'over_median' && b === 'off_road') || (a === 'off_road' && b === 'over_median');

const sameStretch = (a: Raw, b: Raw): boolean =>
  a.a === b.a && sameKind(a.what, b.what) && a.time <= b.until + SAME_STRETCH_S && b.time <= a.until + SAME_STRETCH_S;

/** Two stretches as one: as long as both, as bad as the worse; metres that follow each other add up. */
function joined(a: Raw, b: Raw): Raw {
  if (a.what !== b.what) return a;
  const adds = a.what === 'wrong_way' && (b.time > a.until || a.time > b.until);
  const [p, q] = [a.extent ?? b.extent, b.extent ?? a.extent];
  const extent = p === null || q === null ? null : adds ? p + q : Math.max(p, q);
  return { ...a, time: Math.min(a.time, b.time), until: Math.max(a.until, b.until), extent };
}

const WORDS: Readonly<Record<FaultKind, string>> = {
  collision: TEXTS.collision,
  red_light: TEXTS.redLight,
  wrong_way: TEXTS.wrongWay,
  over_median: TEXTS.overTheMedian,
  off_road: TEXTS.offTheRoad,
  harsh_braking: TEXTS.hardBraking,
  harsh_steering: TEXTS.hardSteering,
  near_miss: TEXTS.nearMiss,
  via_missed: TEXTS.viaMissed,
  goal_missed: TEXTS.goalMissed,
};

/** They come no nearer than this, metres, or nobody knows how near: what counts is how little time there was. */
const isMissInTime = ({ extent }: Raw): boolean => extent === null || extent > 1;

/** How bad it is, in the unit of its kind. */
function extentWords(r: Raw, unit: SpeedUnit): string | null {
  if (r.what === 'near_miss' && isMissInTime(r)) return r.ttc === null ? null : TEXTS.sToCollision(num(r.ttc, 1));
  if (r.extent === null) return null;
  switch (r.what) {
    case 'collision':
      return TEXTS.closingAt(speedLabel(r.extent, unit));
    case 'red_light':
      return TEXTS.at(speedLabel(r.extent, unit));
    case 'harsh_braking':
    case 'harsh_steering':
      return acceleration(r.extent);
    case 'wrong_way':
    case 'goal_missed':
      return metres(r.extent);
    default:
      return metres(r.extent, 1);
  }
}

function event(scene: Scene, set: MotionSet, r: Raw, unit: SpeedUnit): TrafficEvent | null {
  const a = scene.agents.get(r.a),
    b = r.b === null ? null : scene.agents.get(r.b);
  if (!a || b === undefined) return null;
  const pa = poseAt(motionOf(scene, set, a), r.time),
    pb = b && poseAt(motionOf(scene, set, b), r.time);
  const at = placeOf(r, pa, pb);
  if (!at || (b && !r.at && !pb)) return null;
  const kind = faultMark({ kind: r.what }) as TrafficEvent['kind'];
  const extent = extentWords(r, unit);
  const words = extent ? `${WORDS[r.what]}, ${extent}` : WORDS[r.what];
  return {
    kind,
    what: r.what,
    time: r.time,
    until: r.until,
    gap: r.what === 'near_miss' ? r.extent : null,
    a,
    b,
    inLog: r.inLog,
    title: !b ? a.name : kind === 'collision' ? `${a.name} × ${b.name}` : `${a.name}, ${b.name}`,
    short: shortOf(scene, r),
    label: `${WORDS[r.what]} ${num(r.time, 1)} s`,
    words: r.inLog ? TEXTS.inTheLog(words) : words,
    at,
    facts: factsOf(scene, set, r, unit, [a, pa], [b, pb]),
  };
}

function placeOf(r: Raw, pa: Pose | null, pb: Pose | null): Vec | null {
  const own: Vec | null = r.at ?? (pa && [pa.x, pa.y]);
  return own && pb ? [(own[0] + pb.x) / 2, (own[1] + pb.y) / 2] : own;
}

function shortOf(scene: Scene, r: Raw): string {
  const other = (r.b !== null && nameIn(scene)(r.b)) || '';
  if (r.what === 'near_miss' && r.ttc !== null && isMissInTime(r)) return TEXTS.sToCollisionWith(num(r.ttc, 1), other);
  const fault = {
    kind: r.what,
    time: r.time,
    until: r.until,
    at: [0, 0] as const,
    extent: r.extent,
    with: r.b,
    edge: null,
  };
  return placeWord(fault, nameIn(scene));
}

type Part = readonly [Agent | null, Pose | null];

function factsOf(scene: Scene, set: MotionSet, r: Raw, unit: SpeedUnit, ...who: readonly Part[]): [string, string][] {
  const speed = (x: Agent, v: number) =>
    x.type === 'pedestrian' ? speedLabel(v, walkingUnit(unit)) : speedLabel(v, unit);
  const facts = who.flatMap(([x, p]): [string, string][] =>
    x && p ? [[x.name, `${speed(x, p.speed)}, ${doing(scene, set, x, r.time)}`]] : [],
  );
  const [[, pa], [, pb]] = who;
  const closing = r.extent ?? (pa && pb ? relativeSpeed(pa, pb) : null);
  if (r.what === 'collision' && closing !== null) facts.push([TEXTS.closingSpeed, speedLabel(closing, unit)]);
  if (r.what === 'near_miss' && r.extent !== null) facts.push([TEXTS.gapThen, metres(r.extent, 1)]);
  if (r.ttc !== null) facts.push([TEXTS.timeToCollision, `${num(r.ttc, 1)} s`]);
  const fact = FACTS[r.what];
  if (fact && r.extent !== null)
    facts.push([fact, r.what === 'red_light' ? speedLabel(r.extent, unit) : extentWords(r, unit)!]);
  if (r.until > r.time + 0.15) facts.push([TEXTS.fromTo, TEXTS.to(num(r.time, 1), seconds(r.until))]);
  if (r.inLog) facts.push([TEXTS.whereFrom, TEXTS.inTheLogNotCounted]);
  return facts;
}

const FACTS: Partial<Record<FaultKind, string>> = {
  red_light: TEXTS.speedOverThe,
  wrong_way: TEXTS.waySoDriven,
  over_median: TEXTS.pastTheEdge,
  off_road: TEXTS.pastTheEdge,
  harsh_braking: TEXTS.braking,
  harsh_steering: TEXTS.sideways,
  via_missed: TEXTS.awayFromTheVia,
  goal_missed: TEXTS.leftToTheGoal,
};

const relativeSpeed = (p: Pose, q: Pose): number =>
  Math.hypot(
    p.speed * Math.cos(p.heading) - q.speed * Math.cos(q.heading),
    p.speed * Math.sin(p.heading) - q.speed * Math.sin(q.heading),
  );

function doing(scene: Scene, set: MotionSet, a: Agent, t: number): string {
  const m = motionOf(scene, set, a);
  const p = poseAt(m, Math.max(0, t - 1)) ?? poseAt(m, t),
    q = poseAt(m, Math.min(scene.duration, t + 1)) ?? poseAt(m, t);
  const now = poseAt(m, t);
  if (!p || !q || !now || Math.abs(now.speed) < 0.3) return TEXTS.standing;
  const turn = wrapAngle(q.heading - p.heading);
  if (turn > 0.35) return TEXTS.turningLeft;
  if (turn < -0.35) return TEXTS.turningRight;
  return q.speed < p.speed - 2 ? TEXTS.brakingWithin : TEXTS.straightOn;
}

/** Those that count: what is in the log does not. */
export const counted = (events: readonly TrafficEvent[]): TrafficEvent[] => events.filter((e) => !e.inLog);

/** The worst of those that count; null where nothing does. */
export function worstOf(events: readonly TrafficEvent[]): TrafficEvent['kind'] | null {
  const kinds = counted(events).map((e) => e.kind);
  return kinds.length ? kinds.reduce((a, b) => (compareMarks(b, a) < 0 ? b : a)) : null;
}

/** One who comes to a place so soon after another has left it was close, whatever counts as a near miss, seconds. */
const CLOSE_S = 1;

/** The least time between two in one place, where it is that short and one of them does not just replay its log. */
export function closeInTime(set: MotionSet): number | null {
  const all = [...set.driving].flatMap((id) => set.score?.petOf?.get(id) ?? []);
  const least = Math.min(...all);
  return least < CLOSE_S ? least : null;
}

const COUNTED = [
  ['collision', TEXTS.collisions],
  ['rule', TEXTS.rulesBroken],
  ['near', TEXTS.nearMisses],
  ['short', TEXTS.goalsMissed],
] as const;

export function summary(events: readonly TrafficEvent[]): string {
  const parts = COUNTED.flatMap(([kind, words]) => {
    const n = counted(events).filter((e) => e.kind === kind).length;
    return n ? words(n) : [];
  });
  return parts.length ? parts.join(' · ') : TEXTS.noCollisions;
}
