// Verdicts, scores and warnings of an answer, in the editor's own terms.
import type { FinalEvent, Resolved, ScoreReply } from '../net/types';
import type { Reach, Score } from '../model/futures';

export function readReach(r: Resolved | undefined): Reach | null {
  if (!r) return null;
  const j = r.reach;
  const { by_road: road } = r;
  const byRoad = road ? { x: road.x_m, y: road.y_m, heading: road.heading_rad, distance: road.distance_m } : null;
  if (j.status === 'reached')
    return { status: 'reached', nearest: null, limiting: null, needs: null, words: null, byRoad };
  const { x_m, y_m, heading_rad, speed_mps } = j.nearest;
  return {
    status: 'unreachable',
    nearest: { x: x_m, y: y_m, heading: heading_rad, speed: speed_mps },
    limiting: j.limiting,
    needs: j.needs,
    words: j.words,
    byRoad,
  };
}

/** Sentences to show beside a road user; what the verdict on its goal says already is left out. */
export function readWarnings(e: FinalEvent): Map<string, string[]> {
  const out = new Map<string, string[]>();
  for (const w of e.warnings)
    if (w.agent && w.code !== 'goal-unreachable') out.set(w.agent, [...(out.get(w.agent) ?? []), w.detail]);
  return out;
}

/** The score of the scene as a whole; null when none was asked for. */
export function readScore(reply: ScoreReply | null | undefined): Score | null {
  if (!reply) return null;
  const s = reply.scene;
  return {
    collisions: s.collisions.map((c) => ({ a: c.a, b: c.b, time: c.time_s })),
    nearMisses: s.near_misses.map((c) => ({ a: c.a, b: c.b, time: c.time_s, distance: c.distance_m, ttc: c.ttc_s })),
    minTtc: s.min_ttc_s,
    offroadShare: s.offroad_share,
  };
}
