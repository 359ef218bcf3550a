// A case in words: what is looked for, what a found one is, and what came nearest.
import { KINDS, type Moment, type Sought, type What } from '../physics/cases';
import type { Pose } from '../base/geometry';
import { startPose, type Agent, type Scene } from '../document/scene';
import { acceleration, metres, num, seconds, speedLabel, type SpeedUnit } from '../base/units';
import { TEXTS } from '../../texts/editing/cases';

export const KIND_WORDS: Readonly<Record<What, string>> = {
  near: TEXTS.nearMiss,
  collision: TEXTS.collision,
  first: TEXTS.whoComesFirst,
  braking: TEXTS.hardBrakingNo,
  goal: TEXTS.goalReachedLittle,
  red: TEXTS.redLight,
};

/** What the search is called. */
export const TITLES: Readonly<Record<What, string>> = {
  near: TEXTS.findANearMiss,
  collision: TEXTS.findACollision,
  first: TEXTS.findWhoComesFirst,
  braking: TEXTS.findHardBraking,
  goal: TEXTS.findATightArrival,
  red: TEXTS.findARedLight,
};

/** As in `find a near miss between …`. */
const SENTENCES: Readonly<Record<What, (a: string, b: string | null) => string>> = {
  near: (a, b) => TEXTS.aNearMissBetween(a, b ?? TEXTS.somebody),
  collision: (a, b) => TEXTS.aCollisionOf(a, b ?? TEXTS.somebody),
  first: (a, b) => TEXTS.justBefore(a, b ?? TEXTS.somebody),
  braking: (a) => TEXTS.hardBrakingOf(a),
  goal: (a, b) => TEXTS.atItsGoalWith(a, b ?? TEXTS.others),
  red: (a) => TEXTS.runsARedLight(a),
};

export const sentenceOf = (what: What, a: string, b: string | null): string => SENTENCES[what](a, b);

/** `0.3 m at 3.6 s` */
export function momentWords({ what }: Sought, m: Moment): string {
  const at = TEXTS.at(seconds(m.time));
  if (what === 'collision') return m.found ? TEXTS.collisionAt(at) : `${metres(m.value, 1)} ${at}`;
  if (what === 'first') return m.value >= 0 ? TEXTS.sAhead(num(m.value, 1), at) : TEXTS.sBehind(num(-m.value, 1), at);
  if (what === 'red') return m.found ? TEXTS.atRed(at) : TEXTS.fromARedLight(metres(m.value, 1), at);
  const { unit } = KINDS[what];
  return `${unit === 'm' ? metres(m.value, 1) : unit === 's' ? seconds(m.value) : acceleration(m.value)} ${at}`;
}

/** Metres from one place to another, below 0 where it lies behind. */
function along(p: Pose, q: Pose): number {
  const d = Math.hypot(q.x - p.x, q.y - p.y);
  const ahead = (q.x - p.x) * Math.cos(p.heading) + (q.y - p.y) * Math.sin(p.heading);
  return d < 0.05 ? 0 : ahead < 0 ? -d : d;
}

/** How it happens: where the other one is, and what the one who is tried begins with. */
export function howWords(a: Agent, scene: Scene, m: Moment, unit: SpeedUnit, was?: Agent): string[] {
  const start = startPose(a);
  const before = was && startPose(was);
  const moved = start && before ? along(before, start) : 0;
  const other = m.other === null ? null : scene.agents.get(m.other)?.name;
  return [
    start ? TEXTS.startsAt(speedLabel(start.speed, unit)) : '',
    moved ? (moved > 0 ? TEXTS.furtherOn : TEXTS.furtherBack)(metres(Math.abs(moved), 1)) : '',
    a.goal.pos ? TEXTS.atItsGoalAt(seconds(a.goal.time)) : '',
    other && m.side ? `${other} ${TEXTS.sides[m.side]}` : '',
  ].filter(Boolean);
}

/** `No near miss in 300 tries. Closest was 1.4 m at 3.9 s.` */
export function nothingWords(s: Sought, tries: number, closest: Moment | null): string {
  const none = TEXTS.notFoundInTries(tries);
  return closest ? TEXTS.nearestToItWas(none, momentWords(s, closest)) : none;
}
