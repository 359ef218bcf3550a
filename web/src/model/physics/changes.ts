// Who does something else than before, how much, and why.
import { distances, endsBefore, lastStep, poseAt, poseAtStep, STEP_S, type Motion } from '../base/motion';
import { asIfNotAsked } from '../document/reaction-records';
import type { Future, MotionSet } from '../document/futures';
import type { Pose } from '../base/geometry';
import type { ReactionJson } from '../document/scene-json';
import { answersAhead, guessReaction, type Answered, type Reaction } from './reaction';
import { reactionWords } from '../words/change-words';
import type { Agent, Scene } from '../document/scene';
import { doing, GOAL_TIME, startPose, staysAway } from '../document/scene';
import { heldStill, nowhere, straightOn } from '../base/motion';
import { metres, type SpeedUnit } from '../base/units';
import { TEXTS } from '../../texts/reactions';

/** A road user that does something else, and where it waits or is slowest. */
export interface Change {
  readonly id: string;
  readonly name: string;
  /** What it does and for whom; null when everybody was worked out anew and nobody in particular is the cause. */
  readonly reaction: Reaction | null;
  /** `waits 2 s for Car 7` */
  readonly words: string;
  /** Metres between both motions where they are furthest apart. */
  readonly size: number;
  /** Seconds that it comes later than before; negative when earlier. */
  readonly lost: number;
  readonly before: Motion;
  readonly after: Motion;
  /** Scene time at which it waits or is slowest. */
  readonly at: number;
  /** Where that is. */
  readonly place: Pose;
}

/** Less than this, in metres and in seconds, is no change. */
const LEAST_M = 0.5;
const LEAST_S = 0.5;

/**
 * The motion a road user follows in playback. Past 9 s it goes on where nobody says more, as the generator takes it
 * to: straight on from where it was last seen. Who was seen to go away stays away.
 */
export function motionOf(scene: Scene, set: MotionSet, a: Agent): Motion {
  const m = knownMotion(scene, set, a);
  if (scene.length <= GOAL_TIME || (m === a.log && goesAway(scene, m))) return m;
  return straightOn(m, Math.round(scene.duration / STEP_S));
}

/** Until when somebody is there who only does what was recorded, seconds; null for one that stays to the end. */
export function seenUntil(scene: Scene, set: MotionSet, a: Agent): number | null {
  const gone = !a.placed && motionOf(scene, set, a) === a.log && goesAway(scene, a.log);
  return gone ? lastStep(a.log) * STEP_S : null;
}

/** Was it seen for a while, and no more when the recording ended? */
function goesAway(scene: Scene, log: Motion): boolean {
  const seen = log.valid.reduce((sum, [from, to]) => sum + to - from, 0);
  return seen > 1 && lastStep(log) < scene.steps - 1;
}

/** The future that a road user follows, where it follows one. */
function followed(set: MotionSet, a: Agent): Future | undefined {
  const f = set.driving.has(a.id) ? set.futures.get(a.id) : undefined;
  return f?.modes[Math.min(f.modes.length - 1, a.chosen ?? f.chosen)];
}

/** Is somebody at its goal in time, as it goes now? Null where nobody has said. */
export function meetsGoal(set: MotionSet, a: Agent): boolean | null {
  const future = followed(set, a);
  if (future?.about && !endsBefore(future.motion, a.goal.time))
    return !future.about.faults.some((f) => f.kind === 'goal_missed');
  const reach = set.reach.get(a.id);
  return reach ? reach.status === 'reached' : null;
}

function knownMotion(scene: Scene, set: MotionSet, a: Agent): Motion {
  const future = followed(set, a);
  if (future) return future.motion;
  // Until the generator has decided, who was put here stands there.
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

interface Moved {
  readonly agent: Agent;
  /** Whom it answered and answers no more. */
  readonly released: Agent | undefined;
  readonly before: Motion;
  readonly after: Motion;
}

/** Everybody but `except`, the ones asked something, whose motion is another; who loses most time comes first. */
export function findChanges(
  scene: Scene,
  before: MotionSet,
  after: MotionSet,
  except: ReadonlySet<string>,
  unit: SpeedUnit = 'km/h',
): Change[] {
  const moved: Moved[] = [];
  for (const agent of scene.agents.values()) {
    // Past the end of what was known nobody does anything else than before.
    const m0 = knownMotion(scene, before, agent),
      m1 = motionOf(scene, after, agent);
    if (m0 === m1 || m1 === motionOf(scene, before, agent)) continue;
    // Whoever answers again is compared with what it does otherwise: it may answer as it did the last time.
    const [was, is] = [before.answering.get(agent.id), after.answering.get(agent.id)];
    const own = is?.gaveUp === undefined ? m0 : knownMotion(scene, asIfNotAsked(after, new Set([agent.id])), agent);
    const released = was && !is ? scene.agents.get(was.said.cause) : undefined;
    moved.push({ agent, released, before: own, after: m1 });
  }
  const causes: Answered[] = moved.map(({ agent, after: motion }) => ({
    id: agent.id,
    name: agent.name,
    motion,
    asked: except.has(agent.id),
  }));
  return moved
    .filter(({ agent: { id } }) => !except.has(id) && (after.driving.has(id) || before.answering.has(id)))
    .flatMap((m) => changeOf(scene, after, m, causes, unit) ?? [])
    .sort((x, y) => y.lost - x.lost || y.size - x.size);
}

function changeOf(scene: Scene, set: MotionSet, m: Moved, causes: readonly Answered[], unit: SpeedUnit): Change | null {
  const { agent: a, before, after } = m;
  const { d: size } = furthest(before, after, scene.duration);
  const lost = secondsLost(before, after);
  if (size <= LEAST_M && Math.abs(lost) <= LEAST_S) return null;
  const said = set.answering.get(a.id)?.said;
  const guess = () => (m.released ? null : guessReaction(a, before, after, scene.duration, causes, lost));
  const reaction = said ? readReaction(scene, set, after, said) : guess();
  const at = reaction?.time ?? furthest(before, after, scene.duration).t;
  const place = reaction?.place ?? poseAt(after, at) ?? poseAt(before, at);
  if (!place) return null;
  const alone = m.released ? TEXTS.noLongerAnswers(m.released.name) : TEXTS.workedOutAnew;
  const words = reaction ? reactionWords(a, reaction, unit) : alone;
  const { id, name } = a;
  return { id, name, reaction, words, size, lost: reaction?.delay ?? lost, before, after, at, place };
}

/** What the generator said of it. */
function readReaction(scene: Scene, set: MotionSet, after: Motion, r: ReactionJson): Reaction | null {
  const cause = scene.agents.get(r.cause);
  const time = r.time_s ?? 0;
  const seen = poseAt(after, time);
  const x = r.x_m ?? seen?.x,
    y = r.y_m ?? seen?.y;
  if (!cause || x === undefined || y === undefined) return null;
  const speed = r.speed_mps ?? Math.abs(seen?.speed ?? 0);
  const place = { x, y, heading: seen?.heading ?? 0, speed };
  const ahead = answersAhead(after, motionOf(scene, set, cause), time);
  return { kind: r.kind, cause: { id: cause.id, name: cause.name }, delay: r.delay_s ?? null, time, place, ahead };
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

/** How much later the second motion comes as far as the first; negative when earlier. */
function secondsLost(before: Motion, after: Motion): number {
  // Of two that end at different times the rest of the longer one says nothing.
  const last = Math.min(lastStep(before), lastStep(after));
  const upTo = (m: Motion): Float64Array => distances(m).subarray(0, Math.max(0, last - m.first + 1));
  const s0 = upTo(before),
    s1 = upTo(after);
  const end0 = s0.at(-1) ?? 0,
    end1 = s1.at(-1) ?? 0;
  return end1 < end0 ? timeBetween(s0, end1) : -timeBetween(s1, end0);
}

/** Seconds from where a motion has covered a distance to its end; standing at the end counts as not being there yet. */
function timeBetween(s: Float64Array, distance: number): number {
  const total = s.at(-1) ?? 0;
  if (total - distance < 0.2) return 0;
  const i = s.findIndex((v) => v >= distance - 0.05);
  const arrived = s.findIndex((v) => v >= total - 0.05);
  return i < 0 ? 0 : (Math.max(i, arrived) - i) * STEP_S;
}

const firstStep = (m: Motion): number => m.valid[0]?.[0] ?? m.first;

/** Words for the ghost of the log: how far the edited road user gets from what was recorded, where it was. */
export function comparedWithLog(a: Agent, m: Motion, duration: number): { d: number; t: number; words: string } | null {
  if (m === a.log || a.placed) return null;
  const f = furthest(a.log, m, duration);
  if (f.d < 0.3) return null;
  const last = Math.round(duration / STEP_S);
  const end = poseAtStep(m, last),
    log = poseAtStep(a.log, last);
  let words = TEXTS.movesDifferently;
  if (end && log) {
    // A recording may begin before, and go on after what is worked out.
    const from = Math.max(firstStep(m), firstStep(a.log));
    const gone = (of: Motion): number => {
      const s = distances(of);
      return s[last - of.first] - (s[from - of.first] ?? 0);
    };
    const [s1, s0] = [gone(m), gone(a.log)];
    const turn = Math.abs(Math.atan2(Math.sin(end.heading - log.heading), Math.cos(end.heading - log.heading)));
    if (turn > 0.6) words = TEXTS.endsFacingAnother;
    else if (s1 < s0 - 2) words = TEXTS.getsLessFar(metres(s0 - s1, 0));
    else if (s1 > s0 + 2) words = TEXTS.getsFurther(metres(s1 - s0, 0));
  }
  return { ...f, words };
}
