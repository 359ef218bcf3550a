// Events for the timeline and the list: faults of followed futures, and the score's events of all others. Events of the
// recording are marked and do not count.
import { compareMarks, faultMark, type Fault, type FaultKind, type Mark } from '../document/future-facts';
import { JUDGING } from '../base/domain';
import { motionOf } from './playback';
import type { Futures, MotionSet, Score, LastingFault } from '../document/futures';
import { poseAt, STEP_S } from '../base/motion';
import { touched, type Agent, type Scene } from '../document/scene';
import type { Pose, Vec } from '../base/geometry';

export interface SceneEvent {
  readonly kind: Exclude<Mark, 'ok'>;
  readonly what: FaultKind;
  readonly time: number;
  readonly until: number;
  /** Gap of a near miss, metres; null for other kinds, and where unknown. */
  readonly gap: number | null;
  readonly a: Agent;
  /** The other party, where there is one. */
  readonly b: Agent | null;
  /** In the recording or the example itself, without conditions. */
  readonly inLog: boolean;
  readonly at: Vec;
  /** Severity, in the unit of its kind; null where unknown. */
  readonly extent: number | null;
  /** Time to collision, seconds; null where unknown. */
  readonly ttc: number | null;
  /** Poses of both at that time. */
  readonly poses: readonly [Pose | null, Pose | null];
}

/** Events of one kind and the same road users within this time are merged, seconds. */
const SAME_S = JUDGING.same_event_s;

/** An event before merging. */
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

/** All events of the followed motions. */
export function eventsIn(scene: Scene, set: MotionSet): SceneEvent[] {
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
  // For a conditioned road user, events come only from the verdict on its shown future.
  const told = (r: Raw): boolean => judged.has(r.a) || (r.b !== null && judged.has(r.b));
  const near = scored.filter((r) => r.what === 'near_miss');
  const own = said.filter((r) => judged.has(r.a) || !told(r)).map((r) => withTime(r, near));
  return merged(scene, set, [...own, ...scored.filter((r) => !told(r))]);
}

/** A near miss from the verdict, with the time to collision from the score at the same moment. */
function withTime(r: Raw, near: readonly Raw[]): Raw {
  if (r.what !== 'near_miss') return r;
  const pair = (s: Raw): boolean => (s.a === r.a && s.b === r.b) || (s.a === r.b && s.b === r.a);
  const same = near.find((s) => pair(s) && Math.abs(s.time - r.time) < STEP_S);
  return same ? { ...r, ttc: same.ttc } : r;
}

/** Faults of one future that no road user follows yet. */
export function eventsOfFuture(scene: Scene, set: MotionSet, id: string, f: Futures, chosen: number): SceneEvent[] {
  return merged(
    scene,
    set,
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
  const one = (score.stretches ?? []).map((s: LastingFault): Raw => ({
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

/** Does it replay the recording, or the example? */
function replaysLog(scene: Scene, set: MotionSet, id: string, time: number): boolean {
  const a = scene.agents.get(id);
  if (!a || set.driving.has(id) || (scene.others === 'still' && a.type !== 'other')) return false;
  return poseAt(a.log, time) !== null;
}

/** One event for each meeting and stretch, by time. */
function merged(scene: Scene, set: MotionSet, all: readonly Raw[]): SceneEvent[] {
  const kept: Raw[] = [];
  const pairOf = (r: Raw): string => (r.b === null ? '' : r.a < r.b ? `${r.a}|${r.b}` : `${r.b}|${r.a}`);
  const hit = new Set(all.filter((r) => r.what === 'collision').map(pairOf));
  const byTime = [...all].sort((p, q) => p.time - q.time);
  // Faults have place and extent, so they precede the score's entry for the same event.
  for (const r of [...byTime.filter((x) => x.at), ...byTime.filter((x) => !x.at)]) {
    const same = r.b === null ? kept.findIndex((k) => sameStretch(k, r)) : -1;
    if (same >= 0) kept[same] = joined(kept[same], r);
    const meets = (k: Raw): boolean =>
      k.what === r.what && pairOf(k) === pairOf(r) && (r.what === 'collision' || near(k, r) < SAME_S);
    if (same >= 0 || (r.b !== null && ((r.what !== 'collision' && hit.has(pairOf(r))) || kept.some(meets)))) continue;
    kept.push(r);
  }
  return kept
    .flatMap((r) => event(scene, set, r) ?? [])
    .sort((x, y) => x.time - y.time || compareMarks(x.kind, y.kind));
}

const near = (a: Raw, b: Raw): number => Math.abs(a.time - b.time);

/** The score does not distinguish a median from other off-road ground. */
const sameKind = (a: FaultKind, b: FaultKind): boolean =>
  a === b || (a === 'over_median' && b === 'off_road') || (a === 'off_road' && b === 'over_median');

const sameStretch = (a: Raw, b: Raw): boolean =>
  a.a === b.a && sameKind(a.what, b.what) && a.time <= b.until + SAME_S && b.time <= a.until + SAME_S;

/** Merges two stretches: the length of both, the worse severity; consecutive metres add up. */
function joined(a: Raw, b: Raw): Raw {
  if (a.what !== b.what) return a;
  const adds = a.what === 'wrong_way' && (b.time > a.until || a.time > b.until);
  const [p, q] = [a.extent ?? b.extent, b.extent ?? a.extent];
  const extent = p === null || q === null ? null : adds ? p + q : Math.max(p, q);
  return { ...a, time: Math.min(a.time, b.time), until: Math.max(a.until, b.until), extent };
}

function event(scene: Scene, set: MotionSet, r: Raw): SceneEvent | null {
  const a = scene.agents.get(r.a),
    b = r.b === null ? null : scene.agents.get(r.b);
  if (!a || b === undefined) return null;
  const pa = poseAt(motionOf(scene, set, a), r.time),
    pb = b && poseAt(motionOf(scene, set, b), r.time);
  const at = placeOf(r, pa, pb);
  if (!at || (b && !r.at && !pb)) return null;
  const kind = faultMark({ kind: r.what }) as SceneEvent['kind'];
  const gap = r.what === 'near_miss' ? r.extent : null;
  return { ...r, kind, gap, a, b, at, poses: [pa, pb] };
}

function placeOf(r: Raw, pa: Pose | null, pb: Pose | null): Vec | null {
  const own: Vec | null = r.at ?? (pa && [pa.x, pa.y]);
  return own && pb ? [(own[0] + pb.x) / 2, (own[1] + pb.y) / 2] : own;
}

/** Events that count: those of the recording do not. */
export const counted = <E extends SceneEvent>(events: readonly E[]): E[] => events.filter((e) => !e.inLog);

/** The worst event that counts; null without one. */
export function worstOf(events: readonly SceneEvent[]): SceneEvent['kind'] | null {
  const kinds = counted(events).map((e) => e.kind);
  return kinds.length ? kinds.reduce((a, b) => (compareMarks(b, a) < 0 ? b : a)) : null;
}

/** An arrival within this time after another road user has left is close, whatever the near-miss threshold, seconds. */
const CLOSE_S = 1;

/** Least post-encroachment time of road users that do not only replay the recording, if it is that short. */
export function closeInTime(set: MotionSet): number | null {
  const all = [...set.driving].flatMap((id) => set.score?.petOf?.get(id) ?? []);
  const least = Math.min(...all);
  return least < CLOSE_S ? least : null;
}
