// A picked future is not judged again when others react: its own faults stay, and collisions and near misses come from
// the score of the whole scene.
import { FAULT_KINDS, NOTHING_SAID, type FutureFacts, type Fault } from '../document/future-facts';
import { gapAtLeast, gapBetween, type Footprint } from './boxes';
import type { Vec } from '../base/geometry';
import { AT_GOAL_M, type Agent, type Scene } from '../document/scene';
import { JUDGING, THRESHOLDS } from '../base/domain';
import type { Collision, Future, Futures, NearMiss, Score } from '../document/futures';
import type { FaultJson } from '../document/scene-json';
import { endPose, lastStep, poseAt, poseAtStep, STEP_S, type Motion } from '../base/motion';
import { passed } from '../document/vias';

const SAME_S = JUDGING.same_event_s;

const rank = (x: Fault): number => FAULT_KINDS.indexOf(x.kind);
const meets = (f: Pick<Fault, 'kind'>): boolean => f.kind === 'collision' || f.kind === 'near_miss';

/** The future of `id` with only the meetings of the score. */
export function withMeetingsOf(score: Score, id: string, f: Future): Future {
  if (!f.about) return f;
  const old = f.about.faults.filter(meets);
  const hits = score.collisions.flatMap((c) => meeting(f, id, 'collision', c, c.closing ?? null, old) ?? []);
  const hit = new Set(hits.map((x) => x.with));
  const near = score.nearMisses
    .flatMap((c: NearMiss) => meeting(f, id, 'near_miss', c, c.distance, old) ?? [])
    .filter((x) => !hit.has(x.with));
  const now = [...new Set([...hits, ...near])];
  if (now.length === old.length && now.every((x) => old.includes(x))) return f;
  const faults = [...f.about.faults.filter((x) => !meets(x)), ...now];
  faults.sort((a, b) => rank(a) - rank(b) || a.time - b.time);
  return { ...f, about: { ...f.about, faults }, sent: { ...f.sent, faults: faults.map(faultJson) } };
}

/** A drawn motion, judged by the score of the whole scene. */
export function judgedBy(score: Score, a: Agent, f: Future): Future {
  const { id, goal } = a;
  const place = (t: number): Vec => {
    const p = poseAt(f.motion, t) ?? endPose(f.motion);
    return [p.x, p.y];
  };
  const broken = (score.stretches ?? [])
    .filter((s) => s.agent === id && !s.inLog)
    .map((s): Fault => ({
      kind: s.what,
      time: s.time,
      until: s.until,
      at: place(s.time),
      extent: s.extent,
      with: null,
      edge: null,
    }));
  if (goal.pos) {
    const at = place(goal.time);
    const extent = Math.hypot(at[0] - goal.pos[0], at[1] - goal.pos[1]);
    const { time } = goal;
    if (extent > AT_GOAL_M) broken.push({ kind: 'goal_missed', time, until: time, at, extent, with: null, edge: null });
  }
  passed(goal.via, f.motion).forEach(({ time, away: extent, ok }) => {
    if (!ok) broken.push({ kind: 'via_missed', time, until: time, at: place(time), extent, with: null, edge: null });
  });
  const about = { ...NOTHING_SAID, faults: broken };
  const judged = withMeetingsOf(score, id, { ...f, about });
  const faults = [...judged.about!.faults];
  faults.sort((p, q) => rank(p) - rank(q) || p.time - q.time);
  return { ...judged, about: { ...about, faults }, sent: { faults: faults.map(faultJson) } };
}

const isHarsh = (x: { readonly kind: Fault['kind'] }): boolean =>
  x.kind === 'harsh_braking' || x.kind === 'harsh_steering';

/** The followed futures after a change of thresholds: motions are unchanged, verdicts may shrink. */
export function countedAnew(
  scene: Scene,
  futures: ReadonlyMap<string, Futures>,
  score: Score,
): ReadonlyMap<string, Futures> {
  const out = new Map(futures);
  for (const [id, f] of futures) {
    const a = scene.agents.get(id);
    const shown = a ? Math.min(f.modes.length - 1, a.chosen ?? f.chosen) : -1;
    const m = f.modes[shown];
    if (!m?.about) continue;
    const harsh = (score.stretches ?? []).filter(
      (s) => s.agent === id && !s.inLog && isHarsh({ kind: s.what }) && s.until - s.time >= JUDGING.harsh_s - 1e-6,
    );
    const now = harsh.flatMap((s): Fault[] => {
      const p = poseAt(m.motion, s.time);
      return p
        ? [{ kind: s.what, time: s.time, until: s.until, at: [p.x, p.y], extent: s.extent, with: null, edge: null }]
        : [];
    });
    const faults = [...m.about.faults.filter((x) => !isHarsh(x)), ...now];
    faults.sort((p, q) => rank(p) - rank(q) || p.time - q.time);
    const judged = { ...m, about: { ...m.about, faults }, sent: { ...m.sent, faults: faults.map(faultJson) } };
    const met = withMeetingsOf(score, id, judged);
    out.set(id, { ...f, modes: f.modes.map((was, i) => (i === shown ? met : was)) });
  }
  return out;
}

// -------------------------------------------------------------- others have changed

/** A road user whose motion changed after futures were judged. */
export interface Changed {
  readonly agent: Agent;
  readonly motion: Motion;
}

/**
 * Futures judged before others changed: collisions with the new motions are added. A near miss stays only while it
 * still occurs.
 */
export function metAnew(a: Agent, f: Futures, changed: readonly Changed[]): Futures {
  const others = changed.filter((c) => c.agent.id !== a.id);
  if (!others.length || !f.modes.some((m) => m.about)) return f;
  const modes = f.modes.map((m) => (m.about ? withMeetings(a, m, m.about, others) : m));
  return modes.some((m, i) => m !== f.modes[i]) ? { ...f, modes } : f;
}

function withMeetings(a: Agent, m: Future, about: FutureFacts, others: readonly Changed[]): Future {
  const ids = new Set(others.map((o) => o.agent.id));
  const ofThem = (x: Fault): boolean => meets(x) && x.with !== null && ids.has(x.with);
  const old = about.faults.filter(ofThem);
  const now = others.flatMap((o) => meetingWith(a, m.motion, o, old) ?? []);
  if (now.length === old.length && now.every((x) => old.includes(x))) return m;
  const faults = [...about.faults.filter((x) => !ofThem(x)), ...now];
  faults.sort((p, q) => rank(p) - rank(q) || p.time - q.time);
  return { ...m, about: { ...about, faults }, sent: { ...m.sent, faults: faults.map(faultJson) } };
}

function meetingWith(a: Agent, own: Motion, other: Changed, old: readonly Fault[]): Fault | null {
  const boxOf = (of: Agent, m: Motion, step: number): Footprint | null => {
    const pose = poseAtStep(m, step);
    return pose && { pose, length: of.length, width: of.width };
  };
  // At a high closing speed a larger distance is close too.
  const was = old.find((x) => x.kind === 'near_miss' && x.with === other.agent.id);
  const near = Math.max(THRESHOLDS.gap_m.usual, (was?.extent ?? 0) + JUDGING.same_gap_m);
  let least = Infinity;
  for (let step = Math.max(0, own.first); step <= lastStep(own); step++) {
    const [p, q] = [boxOf(a, own, step), boxOf(other.agent, other.motion, step)];
    if (!p || !q || gapAtLeast(p, q) > near) continue;
    const gap = gapBetween(p, q);
    least = Math.min(least, gap);
    if (gap > 0) continue;
    const time = step * STEP_S;
    const known = old.find(
      (x) => x.kind === 'collision' && x.with === other.agent.id && Math.abs(x.time - time) < SAME_S,
    );
    const at: Vec = [p.pose.x, p.pose.y];
    return known ?? { kind: 'collision', time, until: time, at, extent: null, with: other.agent.id, edge: null };
  }
  return least < near ? (was ?? null) : null;
}

/** Null for a meeting of others, or one without a place on the future. */
function meeting(
  f: Future,
  id: string,
  kind: 'collision' | 'near_miss',
  c: Collision,
  extent: number | null,
  old: readonly Fault[],
): Fault | null {
  if (c.inLog || (c.a !== id && c.b !== id)) return null;
  const other = c.a === id ? c.b : c.a;
  const same = (x: Fault): boolean =>
    x.kind === kind && x.with === other && c.time > x.time - SAME_S && c.time < x.until + SAME_S;
  const known = old.find(same);
  if (known) return known;
  const p = poseAt(f.motion, c.time);
  return p && { kind, time: c.time, until: c.time, at: [p.x, p.y], extent, with: other, edge: null };
}

const faultJson = (f: Fault): FaultJson => ({
  kind: f.kind,
  time_s: f.time,
  until_s: f.until,
  x_m: f.at[0],
  y_m: f.at[1],
  extent: f.extent,
  with: f.with,
  ...(f.edge === null ? {} : { edge: f.edge }),
});
