// Changed motions: road user, size and cause.
import { distances, lastStep, poseAt, STEP_S, type Motion } from '../base/motion';
import { asIfNotAsked } from '../document/reaction-records';
import type { MotionSet } from '../document/futures';
import type { Pose } from '../base/geometry';
import type { ReactionJson } from '../document/scene-json';
import { answersAhead, guessReaction, type Answered, type Reaction } from './reaction';
import type { Agent, Scene } from '../document/scene';
import { knownMotion, motionOf } from './playback';

/** A road user with a changed motion, and where it waits or is slowest. */
export interface MotionChange {
  readonly id: string;
  readonly name: string;
  /** The reaction and its cause; null when all were drawn again and there is no single cause. */
  readonly reaction: Reaction | null;
  /** The road user that it reacted to before, and no longer does. */
  readonly released: Agent | null;
  /** Largest distance between both motions, metres. */
  readonly size: number;
  /** Delay against before, seconds; negative when earlier. */
  readonly lost: number;
  readonly before: Motion;
  readonly after: Motion;
  /** Scene time when it waits or is slowest. */
  readonly at: number;
  /** Its pose then. */
  readonly place: Pose;
}

/** Smaller differences, in metres and in seconds, are no change. */
const LEAST_M = 0.5;
const LEAST_S = 0.5;

interface Moved {
  readonly agent: Agent;
  /** Cause of a former reaction that has ended. */
  readonly released: Agent | undefined;
  readonly before: Motion;
  readonly after: Motion;
}

/** All changed road users except those in `except`; the one with the largest delay first. */
export function changesBetween(
  scene: Scene,
  before: MotionSet,
  after: MotionSet,
  except: ReadonlySet<string>,
): MotionChange[] {
  const moved: Moved[] = [];
  for (const agent of scene.agents.values()) {
    // Beyond the known time no motion counts as changed.
    const m0 = knownMotion(scene, before, agent),
      m1 = motionOf(scene, after, agent);
    if (m0 === m1 || m1 === motionOf(scene, before, agent)) continue;
    // A repeated reaction is compared with the motion that it gave up: it may equal the last one.
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
    .flatMap((m) => changeOf(scene, after, m, causes) ?? [])
    .sort((x, y) => y.lost - x.lost || y.size - x.size);
}

function changeOf(scene: Scene, set: MotionSet, m: Moved, causes: readonly Answered[]): MotionChange | null {
  const { agent: a, before, after } = m;
  const { d: size } = furthest(before, after, scene.duration);
  const lost = secondsLost(before, after);
  const said = set.answering.get(a.id)?.said;
  // A motion that is left out has no place to compare.
  const changes = said?.kind === 'stays_out' || size > LEAST_M || Math.abs(lost) > LEAST_S;
  if (!changes) return null;
  const guess = () => (m.released ? null : guessReaction(a, before, after, scene.duration, causes, lost));
  const reaction = said ? readReaction(scene, set, after, said) : guess();
  const at = reaction?.time ?? furthest(before, after, scene.duration).t;
  const place = reaction?.place ?? poseAt(after, at) ?? poseAt(before, at);
  if (!place) return null;
  const { id, name } = a;
  return {
    id,
    name,
    reaction,
    released: m.released ?? null,
    size,
    lost: reaction?.delay ?? lost,
    before,
    after,
    at,
    place,
  };
}

/** The reaction that the generator gives. */
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

/** Largest distance between two motions, metres, and its time. */
export function furthest(a: Motion, b: Motion, duration: number): { d: number; t: number } {
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

/** Delay of the second motion over the same distance; negative when earlier. */
function secondsLost(before: Motion, after: Motion): number {
  // If they end at different times, the rest of the longer one is ignored.
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
