// Reachability of a goal in words: by the server's verdict, or by the limits of motion until it arrives.
import { isBlocked, type Reach } from '../document/futures';
import type { LaneMap } from '../document/lanemap';
import type { Agent, GoalSpec } from '../document/scene';
import { PLANNING } from '../base/domain';
import type { Pose, Vec } from '../base/geometry';
import { metres, num, seconds, speedLabel, type SpeedUnit } from '../base/units';
import { goalReach, type GoalReach } from '../physics/reach';
import { messageParts, messageText } from './message-text';
import { TEXTS } from '../../texts/scene/reach';

/** The generator's verdict as a title, which names the reason, and the rest. */
export function reachWords(
  r: Reach,
  goal: { readonly pos: Vec | null; readonly time: number },
  nameOf: (id: string) => string | null = () => null,
): { title: string; words: string } {
  if (isBlocked(r) && r.nearest && goal.pos) {
    const who = (r.with != null && nameOf(r.with)) || TEXTS.aRoadUser;
    const short = Math.hypot(goal.pos[0] - r.nearest.x, goal.pos[1] - r.nearest.y);
    return { title: TEXTS.isInTheWay(who), words: TEXTS.stopsShort(metres(short, 0)) };
  }
  const parts = r.message && messageParts(r.message);
  return {
    title: parts?.title ?? TEXTS.outOfReachIn(num(goal.time, 1)),
    words: parts?.rest || (r.message && !parts ? messageText(r.message) : TEXTS.theNearestReachable),
  };
}

export interface LocalReach extends GoalReach {
  readonly title: string;
  readonly words: string;
}

/** Reachability of a goal in words. */
export function localReach(map: LaneMap, a: Agent, start: Pose, goal: GoalSpec, unit: SpeedUnit): LocalReach | null {
  const r = goalReach(map, a, start, goal);
  return r && { ...r, ...wordsOf(r, a, start.speed, goal.time, unit) };
}

const WHO: Readonly<Record<Agent['kind'], string>> = {
  car: TEXTS.thisCar,
  truck: TEXTS.thisTruck,
  bus: TEXTS.thisBus,
  motorcycle: TEXTS.thisMotorcycle,
  cyclist: TEXTS.thisCyclist,
  pedestrian: TEXTS.thisPedestrian,
  other: TEXTS.thisRoadUser,
};

function wordsOf(r: GoalReach, a: Agent, v: number, t: number, unit: SpeedUnit): { title: string; words: string } {
  const { along, max, min } = r;
  switch (r.kind) {
    case 'far': {
      const away = r.onLanes ? TEXTS.theGoalIsAway : TEXTS.theGoalIsAwayStraight;
      const gets = TEXTS.coversAtMost(seconds(t), speedLabel(v, unit), WHO[a.kind], metres(max, 0));
      return { title: TEXTS.tooFarFor(seconds(t)), words: away(metres(along, 0)) + gets };
    }
    case 'near':
      return {
        title: TEXTS.cannotStopThat,
        words: TEXTS.brakingTakes(speedLabel(v, unit), metres(min, 0), metres(along, 0)),
      };
    case 'sharp':
      return { title: TEXTS.tooTightAtThis, words: TEXTS.possibleAt(speedLabel(r.speed!, unit)) };
    case 'ok': {
      const mean = speedLabel(along / t, unit);
      const onFoot = a.type === 'pedestrian';
      const words = onFoot
        ? TEXTS.in(metres(along, 1), seconds(t), mean, walkWords(along / t))
        : TEXTS.needsOnAverage(mean);
      return { title: TEXTS.reachable, words };
    }
  }
}

/** The word for a pace on foot, m/s, after the number. */
export const walkWords = (v: number): string =>
  v < 0.6 ? TEXTS.aSlowWalk : v < 1.6 ? TEXTS.aNormalWalk : v < PLANNING.walking_mps ? TEXTS.aBriskWalk : TEXTS.running;
