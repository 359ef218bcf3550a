// The followed motion of each road user in playback.
import type { Future, MotionSet } from '../document/futures';
import { doing, GOAL_TIME, startPose, staysAway, type Agent, type Scene } from '../document/scene';
import { endsBefore, heldStill, lastStep, nowhere, STEP_S, straightOn, type Motion } from '../base/motion';

/**
 * The followed motion of a road user in playback. Past 9 s a motion without an answer continues straight from its last
 * pose, as the generator assumes. A road user that left the recording stays away.
 */
export function motionOf(scene: Scene, set: MotionSet, a: Agent): Motion {
  const m = knownMotion(scene, set, a);
  if (scene.length <= GOAL_TIME || (m === a.log && goesAway(scene, m))) return m;
  return straightOn(m, Math.round(scene.duration / STEP_S));
}

/** Last recorded time of a road user that only replays, seconds; null for one that stays to the end. */
export function seenUntil(scene: Scene, set: MotionSet, a: Agent): number | null {
  const gone = !a.placed && motionOf(scene, set, a) === a.log && goesAway(scene, a.log);
  return gone ? lastStep(a.log) * STEP_S : null;
}

/** Was it recorded for a while, but no longer at the end of the recording? */
function goesAway(scene: Scene, log: Motion): boolean {
  const seen = log.valid.reduce((sum, [from, to]) => sum + to - from, 0);
  return seen > 1 && lastStep(log) < scene.steps - 1;
}

/** The followed future of a road user, where there is one. */
function followed(set: MotionSet, a: Agent): Future | undefined {
  const f = set.driving.has(a.id) ? set.futures.get(a.id) : undefined;
  return f?.modes[Math.min(f.modes.length - 1, a.chosen ?? f.chosen)];
}

/** Is a road user at its goal in time with its current motion? Null where unknown. */
export function meetsGoal(set: MotionSet, a: Agent): boolean | null {
  const future = followed(set, a);
  if (future?.about && !endsBefore(future.motion, a.goal.time))
    return !future.about.faults.some((f) => f.kind === 'goal_missed');
  const reach = set.reach.get(a.id);
  return reach ? reach.status === 'reached' : null;
}

/** The same, only as far as a motion is known. */
export function knownMotion(scene: Scene, set: MotionSet, a: Agent): Motion {
  const future = followed(set, a);
  if (future) return future.motion;
  // Until the generator answers, a placed road user stands still.
  if (a.placed || (doing(scene, a) === 'still' && a.type !== 'other')) {
    if (staysAway(scene, a)) return nowhere;
    return standing(scene, a);
  }
  return a.log;
}

const stand = new WeakMap<Agent, Motion>();

function standing(scene: Scene, a: Agent): Motion {
  const p = startPose(a);
  if (!p) return a.log;
  const steps = Math.max(scene.steps, Math.round(scene.duration / STEP_S) + 1);
  const known = stand.get(a);
  if (known?.x.length === steps) return known;
  const m = heldStill(p, steps);
  stand.set(a, m);
  return m;
}
