// Events of a scene in words, as the timeline, the list and the map show them.
import type { FaultKind } from '../document/future-facts';
import type { Futures, MotionSet } from '../document/futures';
import { nameIn, type Agent, type Scene } from '../document/scene';
import { JUDGING, THRESHOLDS } from '../base/domain';
import { wrapAngle, type Pose } from '../base/geometry';
import { poseAt } from '../base/motion';
import { acceleration, degrees, metres, num, seconds, speedLabel, walkingUnit, type SpeedUnit } from '../base/units';
import { counted, eventsIn, eventsOfFuture, type SceneEvent } from '../physics/events';
import { motionOf } from '../physics/playback';
import { placeWord } from './verdict-words';
import { TEXTS } from '../../texts/scene/events';

export interface TrafficEvent extends SceneEvent {
  /** The road users. */
  readonly title: string;
  /** Kind and time, for the timeline. */
  readonly label: string;
  /** Kind and severity, for the list: `Near miss, 0.6 m`. */
  readonly words: string;
  /** Closest value, for a label on the map. */
  readonly short: string;
  readonly facts: readonly (readonly [string, string])[];
}

/** All events of the followed motions. */
export const readEvents = (scene: Scene, set: MotionSet, unit: SpeedUnit = 'km/h'): TrafficEvent[] =>
  eventsIn(scene, set).map((e) => inWords(scene, set, e, unit));

/** Faults of one future that no road user follows yet. */
export const eventsOf = (
  scene: Scene,
  set: MotionSet,
  id: string,
  f: Futures,
  chosen: number,
  unit: SpeedUnit = 'km/h',
): TrafficEvent[] => eventsOfFuture(scene, set, id, f, chosen).map((e) => inWords(scene, set, e, unit));

const WORDS: Readonly<Record<FaultKind, string>> = {
  collision: TEXTS.collision,
  red_light: TEXTS.redLight,
  wrong_way: TEXTS.wrongWay,
  over_median: TEXTS.overTheMedian,
  off_road: TEXTS.offTheRoad,
  off_map: TEXTS.offTheMap,
  on_carriageway: TEXTS.onTheCarriageway,
  speeding: TEXTS.speeding,
  running: TEXTS.running,
  askew: TEXTS.askew,
  harsh_braking: TEXTS.hardBraking,
  harsh_steering: TEXTS.hardSteering,
  fails_to_yield: TEXTS.failsToYield,
  forces_braking: TEXTS.forcesBraking,
  near_miss: TEXTS.nearMiss,
  via_missed: TEXTS.viaMissed,
  goal_missed: TEXTS.goalMissed,
};

/** Their gap exceeds the threshold, or is unknown: the time to collision made it a near miss. */
const isMissInTime = ({ extent }: SceneEvent): boolean => extent === null || extent > THRESHOLDS.gap_m.usual;

/** Severity, in the unit of its kind. */
function extentWords(r: SceneEvent, unit: SpeedUnit): string | null {
  if (r.what === 'near_miss' && isMissInTime(r)) return r.ttc === null ? null : TEXTS.ttc(num(r.ttc, 1));
  if (r.extent === null) return null;
  switch (r.what) {
    case 'collision':
      return TEXTS.closingAt(speedLabel(r.extent, unit));
    case 'red_light':
      return TEXTS.at(speedLabel(r.extent, unit));
    case 'speeding':
      return TEXTS.over(speedLabel(r.extent, unit));
    case 'running':
      return TEXTS.at(speedLabel(r.extent, walkingUnit(unit)));
    case 'askew':
      return degrees(r.extent);
    case 'harsh_braking':
    case 'harsh_steering':
    case 'forces_braking':
      return acceleration(r.extent);
    case 'fails_to_yield':
      return seconds(r.extent);
    case 'wrong_way':
    case 'off_map':
    case 'on_carriageway':
    case 'goal_missed':
      return metres(r.extent);
    default:
      return metres(r.extent, 1);
  }
}

function inWords(scene: Scene, set: MotionSet, e: SceneEvent, unit: SpeedUnit): TrafficEvent {
  const { a, b, what } = e;
  const extent = extentWords(e, unit);
  const words = extent ? `${WORDS[what]}, ${extent}` : WORDS[what];
  return {
    ...e,
    title: !b ? a.name : e.kind === 'collision' ? `${a.name} × ${b.name}` : `${a.name}, ${b.name}`,
    short: shortOf(scene, e),
    label: `${WORDS[what]} ${num(e.time, 1)} s`,
    words: e.inLog ? TEXTS.inTheLog(words) : words,
    facts: factsOf(scene, set, e, unit),
  };
}

function shortOf(scene: Scene, r: SceneEvent): string {
  if (r.what === 'near_miss' && r.ttc !== null && isMissInTime(r)) return TEXTS.ttcTo(num(r.ttc, 1), r.b?.name ?? '');
  const { time, until, extent, at } = r;
  return placeWord({ kind: r.what, time, until, at, extent, with: r.b?.id ?? null, edge: null }, nameIn(scene));
}

function factsOf(scene: Scene, set: MotionSet, r: SceneEvent, unit: SpeedUnit): [string, string][] {
  const speed = (x: Agent, v: number) =>
    x.type === 'pedestrian' ? speedLabel(v, walkingUnit(unit)) : speedLabel(v, unit);
  const [pa, pb] = r.poses;
  const who = [
    [r.a, pa],
    [r.b, pb],
  ] as const;
  const facts = who.flatMap(([x, p]): [string, string][] =>
    x && p ? [[x.name, `${speed(x, p.speed)}, ${doing(scene, set, x, r.time)}`]] : [],
  );
  const closing = r.extent ?? (pa && pb ? relativeSpeed(pa, pb) : null);
  if (r.what === 'collision' && closing !== null) facts.push([TEXTS.closingSpeed, speedLabel(closing, unit)]);
  if (r.what === 'near_miss' && r.extent !== null) facts.push([TEXTS.gapThen, metres(r.extent, 1)]);
  if (r.ttc !== null) facts.push([TEXTS.ttcAlone, `${num(r.ttc, 1)} s`]);
  const fact = FACTS[r.what];
  if (fact && r.extent !== null) facts.push([fact, SPEED_FACTS[r.what]?.(r.extent, unit) ?? extentWords(r, unit)!]);
  if (r.until > r.time + 0.15) facts.push([TEXTS.interval, TEXTS.to(num(r.time, 1), seconds(r.until))]);
  if (r.inLog) facts.push([TEXTS.source, TEXTS.inTheLogNotCounted]);
  return facts;
}

/** Facts that say a speed where the list says more. */
const SPEED_FACTS: Partial<Record<FaultKind, (mps: number, unit: SpeedUnit) => string>> = {
  red_light: speedLabel,
  speeding: speedLabel,
  running: (mps, unit) => speedLabel(mps, walkingUnit(unit)),
};

const FACTS: Partial<Record<FaultKind, string>> = {
  red_light: TEXTS.speedAtStopLine,
  wrong_way: TEXTS.distanceDriven,
  over_median: TEXTS.pastTheEdge,
  off_road: TEXTS.pastTheEdge,
  off_map: TEXTS.fromTheLanes,
  on_carriageway: TEXTS.distanceWalked,
  speeding: TEXTS.overTheLimit,
  running: TEXTS.speed,
  askew: TEXTS.angleToTheLane,
  harsh_braking: TEXTS.braking,
  harsh_steering: TEXTS.lateral,
  fails_to_yield: TEXTS.waited,
  forces_braking: TEXTS.otherBrakes,
  via_missed: TEXTS.distanceToVia,
  goal_missed: TEXTS.distanceToGoal,
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
  if (!p || !q || !now || Math.abs(now.speed) < JUDGING.standing_mps) return TEXTS.standing;
  const turn = wrapAngle(q.heading - p.heading);
  if (turn > 0.35) return TEXTS.turningLeft;
  if (turn < -0.35) return TEXTS.turningRight;
  return q.speed < p.speed - 2 ? TEXTS.brakingWithin : TEXTS.straightOn;
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
