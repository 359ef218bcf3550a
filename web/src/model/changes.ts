// Who changed when somebody else was given a goal, and how to say it in one sentence.
import { distances, poseAt, poseAtStep, STEP_S, type Motion } from './motion';
import type { MotionSet } from './futures';
import type { Agent, Scene } from './scene';
import { GOAL_TIME, startPose, staysAway } from './scene';
import { heldStill, nowhere, straightOn } from './motion';
import { num, speedText } from './units';

export interface Change {
  readonly id: string;
  readonly name: string;
  readonly words: string;
  readonly short: string;
  readonly size: number;
  readonly before: Motion;
  readonly at: number;
}

/**
 * The motion a road user follows in playback. Past 9 s it goes on where nobody says more, as the generator takes it
 * to: straight on from where it was last seen.
 */
export function motionOf(scene: Scene, set: MotionSet, a: Agent): Motion {
  const m = knownMotion(scene, set, a);
  return scene.length > GOAL_TIME ? straightOn(m, Math.round(scene.duration / STEP_S)) : m;
}

function knownMotion(scene: Scene, set: MotionSet, a: Agent): Motion {
  const f = set.driving.has(a.id) ? set.futures.get(a.id) : undefined;
  if (f?.modes.length) return f.modes[Math.min(f.modes.length - 1, a.chosen ?? f.chosen)].motion;
  if (scene.others === 'still' && a.type !== 'other') {
    const p = startPose(a);
    if (p) return heldStill(p, Math.max(scene.steps, Math.round(scene.duration / STEP_S) + 1));
    if (staysAway(scene, a)) return nowhere;
  }
  return a.log;
}

/** Everybody but `except` whose motion differs by more than a metre somewhere (a footstep for people on foot). */
export function findChanges(scene: Scene, before: MotionSet, after: MotionSet, except: ReadonlySet<string>): Change[] {
  const out: Change[] = [];
  for (const a of scene.agents.values()) {
    if (except.has(a.id) || !after.driving.has(a.id)) continue;
    const m0 = motionOf(scene, before, a),
      m1 = motionOf(scene, after, a);
    if (m0 === m1) continue;
    const apart = furthest(m0, m1, scene.duration);
    if (apart.d < (a.type === 'pedestrian' ? 0.6 : 1.2)) continue;
    out.push({
      id: a.id,
      name: a.name,
      size: apart.d,
      at: apart.t,
      before: m0,
      ...sentence(a, m0, m1, scene.duration),
    });
  }
  return out.sort((x, y) => y.size - x.size);
}

function furthest(a: Motion, b: Motion, duration: number): { d: number; t: number } {
  let d = 0,
    at = 0;
  for (let t = 0; t <= duration + 1e-6; t += STEP_S * 2) {
    const p = poseAt(a, t),
      q = poseAt(b, t);
    if (!p || !q) continue;
    const e = Math.hypot(p.x - q.x, p.y - q.y);
    if (e > d) {
      d = e;
      at = t;
    }
  }
  return { d, t: at };
}

function sentence(a: Agent, before: Motion, after: Motion, duration: number): { words: string; short: string } {
  const ped = a.type === 'pedestrian';
  const unit = ped ? 'm/s' : 'km/h';
  const s0 = distances(before),
    s1 = distances(after);
  const end0 = s0[s0.length - 1] ?? 0,
    end1 = s1[s1.length - 1] ?? 0;
  const stopped = longestStop(after, ped ? 0.2 : 0.6),
    stoppedBefore = longestStop(before, ped ? 0.2 : 0.6);
  const low = slowest(after);
  if (stopped.seconds > stoppedBefore.seconds + 0.8 && stopped.seconds >= 1) {
    const ends = stopped.until >= duration - 0.3;
    const words = ends
      ? `stops after ${num(stopped.from, 1)} s`
      : `waits ${num(stopped.seconds, 1)} s, then ${ped ? 'walks on' : 'goes'}`;
    return { words, short: ends ? 'stops' : `waits ${num(stopped.seconds, 1)} s` };
  }
  if (end1 < end0 - 1) {
    const late = delay(s0, s1, duration);
    const tail = late !== null ? `, passes ${num(late, 1)} s later` : '';
    const slows = low < (ped ? 0.2 : 0.6) ? 'stops briefly' : `slows to ${speedText(low, unit)} ${unit}`;
    return { words: `${slows}${tail}`, short: late !== null ? `gives way, ${num(late, 1)} s later` : 'slows' };
  }
  if (end1 > end0 + 1) {
    const early = delay(s1, s0, duration);
    return early !== null
      ? { words: `goes on, ${num(early, 1)} s earlier`, short: `${num(early, 1)} s earlier` }
      : { words: `gets ${num(end1 - end0, 0)} m further`, short: 'goes faster' };
  }
  return { words: 'takes another line', short: 'takes another line' };
}

/** How much later the second motion covers the distance that the first covers by the end of the second. */
function delay(s0: Float64Array, s1: Float64Array, duration: number): number | null {
  const reach = s1[s1.length - 1] ?? 0;
  if (reach < 2) return null;
  const i = s0.findIndex((v) => v >= reach - 0.05);
  if (i < 0) return null;
  const late = duration - i * STEP_S;
  return late > 0.2 && late < duration ? late : null;
}

const slowest = (m: Motion): number => m.speed.reduce((lo, v) => Math.min(lo, Math.abs(v)), Infinity);

function longestStop(m: Motion, below: number): { seconds: number; from: number; until: number } {
  let best = { seconds: 0, from: 0, until: 0 },
    since = -1;
  for (let i = 0; i <= m.speed.length; i++) {
    const still = i < m.speed.length && Math.abs(m.speed[i]) < below;
    if (still && since < 0) since = i;
    if (!still && since >= 0) {
      const s = (i - since) * STEP_S;
      if (s > best.seconds) best = { seconds: s, from: (m.first + since) * STEP_S, until: (m.first + i) * STEP_S };
      since = -1;
    }
  }
  return best;
}

/** Words for the ghost of the log: how far the edited road user gets from what was recorded. */
export function comparedWithLog(a: Agent, m: Motion, duration: number): { d: number; t: number; words: string } | null {
  if (m === a.log) return null;
  const f = furthest(a.log, m, duration);
  if (f.d < 0.3) return null;
  const end = poseAtStep(m, Math.round(duration / STEP_S)),
    log = poseAtStep(a.log, Math.round(duration / STEP_S));
  let words = 'Moves differently from the log.';
  if (end && log) {
    const s1 = distances(m).at(-1) ?? 0,
      s0 = distances(a.log).at(-1) ?? 0;
    const turn = Math.abs(Math.atan2(Math.sin(end.heading - log.heading), Math.cos(end.heading - log.heading)));
    if (turn > 0.6) words = 'Ends facing another way than in the log.';
    else if (s1 < s0 - 2) words = `Gets ${num(s0 - s1, 0)} m less far than in the log.`;
    else if (s1 > s0 + 2) words = `Gets ${num(s1 - s0, 0)} m further than in the log.`;
  }
  return { ...f, words };
}
