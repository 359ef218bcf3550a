// Events as the timeline and the list show them: facts from the score, plus speeds read off the motions.
import { motionOf } from './changes';
import type { MotionSet } from './futures';
import { poseAt } from './motion';
import type { Agent, Scene } from './scene';
import { num, speedLabel } from './units';
import { wrapAngle, type Vec } from './geometry';

export interface TrafficEvent {
  readonly kind: 'collision' | 'near';
  readonly time: number;
  readonly a: Agent;
  readonly b: Agent;
  readonly title: string;
  readonly label: string;
  /** The closest of it, for a label on the map. */ readonly short: string;
  readonly at: Vec;
  readonly facts: readonly (readonly [string, string])[];
}

/** Near misses closer together than this are one event: the same pair passing once. */
const SAME_PASS_S = 1.5;

export function readEvents(scene: Scene, set: MotionSet): TrafficEvent[] {
  const score = set.score;
  if (!score) return [];
  const out: TrafficEvent[] = [];
  const pair = (a: string, b: string) => (a < b ? `${a}|${b}` : `${b}|${a}`);
  const hit = new Set<string>();
  for (const c of score.collisions) {
    if (hit.has(pair(c.a, c.b))) continue;
    hit.add(pair(c.a, c.b));
    const e = event(scene, set, 'collision', c.a, c.b, c.time, null, null);
    if (e) out.push(e);
  }
  const last = new Map<string, number>();
  for (const n of [...score.nearMisses].sort((x, y) => x.time - y.time)) {
    const key = pair(n.a, n.b);
    if (hit.has(key) || n.time - (last.get(key) ?? -Infinity) < SAME_PASS_S) continue;
    last.set(key, n.time);
    const e = event(scene, set, 'near', n.a, n.b, n.time, n.distance, n.ttc);
    if (e) out.push(e);
  }
  return out.sort((x, y) => x.time - y.time);
}

function event(
  scene: Scene,
  set: MotionSet,
  kind: 'collision' | 'near',
  ida: string,
  idb: string,
  time: number,
  gap: number | null,
  ttc: number | null,
): TrafficEvent | null {
  const a = scene.agents.get(ida),
    b = scene.agents.get(idb);
  if (!a || !b) return null;
  const pa = poseAt(motionOf(scene, set, a), time),
    pb = poseAt(motionOf(scene, set, b), time);
  if (!pa || !pb) return null;
  const closing = Math.hypot(
    pa.speed * Math.cos(pa.heading) - pb.speed * Math.cos(pb.heading),
    pa.speed * Math.sin(pa.heading) - pb.speed * Math.sin(pb.heading),
  );
  const speed = (x: Agent, v: number) => (x.type === 'pedestrian' ? speedLabel(v, 'm/s') : speedLabel(v, 'km/h'));
  const facts: [string, string][] = [
    [a.name, `${speed(a, pa.speed)}, ${doing(scene, set, a, time)}`],
    [b.name, `${speed(b, pb.speed)}, ${doing(scene, set, b, time)}`],
  ];
  if (kind === 'collision') facts.push(['Closing speed', speedLabel(closing, 'km/h')]);
  if (gap !== null) facts.push(['Closest gap', `${num(gap, 1)} m`]);
  if (ttc !== null) facts.push(['Time to collision', `${num(ttc, 1)} s`]);
  const title = kind === 'collision' ? `${a.name} × ${b.name}` : `${a.name}, ${b.name}`;
  const short =
    gap !== null && (gap <= 1 || ttc === null)
      ? `${num(gap, 1)} m to ${b.name}`
      : ttc !== null
        ? `${num(ttc, 1)} s to collision with ${b.name}`
        : b.name;
  return {
    kind,
    time,
    a,
    b,
    title,
    short,
    label: `${kind === 'collision' ? 'Collision' : 'Near miss'} ${num(time, 1)} s`,
    at: [(pa.x + pb.x) / 2, (pa.y + pb.y) / 2],
    facts,
  };
}

function doing(scene: Scene, set: MotionSet, a: Agent, t: number): string {
  const m = motionOf(scene, set, a);
  const p = poseAt(m, Math.max(0, t - 1)) ?? poseAt(m, t),
    q = poseAt(m, Math.min(scene.duration, t + 1)) ?? poseAt(m, t);
  const now = poseAt(m, t);
  if (!p || !q || !now || Math.abs(now.speed) < 0.3) return 'standing';
  const turn = wrapAngle(q.heading - p.heading);
  if (turn > 0.35) return 'turning left';
  if (turn < -0.35) return 'turning right';
  return q.speed < p.speed - 2 ? 'braking' : 'straight on';
}

export function summary(events: readonly TrafficEvent[]): string {
  const c = events.filter((e) => e.kind === 'collision').length,
    n = events.length - c;
  const parts = [c ? `${c} collision${c > 1 ? 's' : ''}` : '', n ? `${n} near miss${n > 1 ? 'es' : ''}` : ''].filter(
    Boolean,
  );
  return parts.length ? parts.join(' · ') : 'No collisions, no near misses';
}
