// Verdicts, scores and warnings of an answer, in the editor's own terms. Absent members read as "not known".
import type { FinalEvent, ResolvedJson, ScoreJson } from '../net/types';
import type { Reach, Score } from '../model/futures';

export function readReach(r: ResolvedJson | undefined): Reach | null {
  const j = r?.reach;
  if (!j) return null;
  const n = j.nearest;
  return {
    status: j.status === 'unreachable' ? 'unreachable' : 'reached',
    nearest:
      n?.x_m != null && n.y_m != null
        ? { x: n.x_m, y: n.y_m, heading: n.heading_rad ?? 0, speed: n.speed_mps ?? 0 }
        : null,
    limiting: j.limiting ?? null,
    needs: j.needs ?? null,
    words: j.words ?? null,
  };
}

/** Sentences to show beside a road user; what the verdict on its goal says already is left out. */
export function readWarnings(e: FinalEvent): Map<string, string[]> {
  const out = new Map<string, string[]>();
  for (const w of e.warnings ?? [])
    if (w.agent && w.detail && w.code !== 'goal-unreachable') out.set(w.agent, [...(out.get(w.agent) ?? []), w.detail]);
  return out;
}

/** The score of the scene, wherever the reply carries it. */
export function readScore(json: unknown): Score | null {
  const one = (Array.isArray(json) ? json[0] : json) as
    { scene?: ScoreJson; samples?: { scene?: ScoreJson }[] } | null | undefined;
  const s = one?.scene ?? one?.samples?.[0]?.scene ?? (one && 'collisions' in one ? (one as ScoreJson) : undefined);
  if (!s) return null;
  return {
    collisions: (s.collisions ?? []).map((c) => ({ a: String(c.a), b: String(c.b), time: c.time_s })),
    nearMisses: (s.near_misses ?? []).map((c) => ({
      a: String(c.a),
      b: String(c.b),
      time: c.time_s,
      distance: c.distance_m ?? null,
      ttc: c.ttc_s ?? null,
    })),
    minTtc: s.min_ttc_s ?? null,
    offroadShare: s.offroad_share ?? null,
  };
}
