// Verdicts, scores and warnings of an answer, in the editor's own types.
import type { FinalEvent, Resolved, ScoreReply } from '../../net/types';
import type { Message } from '../../model/document/message';
import type { Reach, Score, LastingFault } from '../../model/document/futures';

export function readReach(r: Resolved | undefined): Reach | null {
  if (!r) return null;
  const j = r.reach;
  const { by_road: road } = r;
  const byRoad = road ? { x: road.x_m, y: road.y_m, heading: road.heading_rad, distance: road.distance_m } : null;
  const relative = relativeGoal(r);
  if (j.status === 'reached')
    return { status: 'reached', nearest: null, limiting: null, needs: null, message: null, byRoad, relative };
  const { x_m, y_m, heading_rad, speed_mps } = j.nearest;
  return {
    status: 'unreachable',
    // Of a goal that is nowhere no place is the nearest.
    nearest: j.limiting === 'relation' ? null : { x: x_m, y: y_m, heading: heading_rad, speed: speed_mps },
    limiting: j.limiting,
    needs: j.needs,
    message: j.message,
    with: (j as { readonly with?: string | null }).with ?? null,
    byRoad,
    relative,
  };
}

/** The place that a relation came to; null for other goals. */
function relativeGoal({ goal: g, reach }: Resolved): Reach['relative'] {
  const isRelative = [g.x_m, g.time_s].some((field) => field.from === 'relation');
  const isNowhere = reach.status === 'unreachable' && reach.limiting === 'relation';
  if (!isRelative || isNowhere) return null;
  const { x_m, y_m, heading_rad, speed_mps, time_s } = g;
  return { x: x_m.value, y: y_m.value, heading: heading_rad.value, speed: speed_mps.value, time: time_s.value };
}

/** Warnings by road user. The verdict on its goal has its own place. */
export function readWarnings(e: FinalEvent): Map<string, Message[]> {
  const out = new Map<string, Message[]>();
  for (const w of e.warnings)
    if (w.agent && w.code !== 'goal-unreachable') out.set(w.agent, [...(out.get(w.agent) ?? []), w.message]);
  return out;
}

/** The score of the scene as a whole; null where the request had none. */
export function readScore(reply: ScoreReply | null | undefined): Score | null {
  if (!reply) return null;
  const s = reply.scene;
  return {
    collisions: s.collisions.map((c) => ({
      a: c.a,
      b: c.b,
      time: c.time_s,
      closing: c.closing_speed_mps,
      inLog: c.in_log,
    })),
    nearMisses: s.near_misses.map((c) => ({
      a: c.a,
      b: c.b,
      time: c.time_s,
      distance: c.distance_m,
      ttc: c.ttc_s,
      inLog: c.in_log,
    })),
    stretches: [
      ...stretches('off_road', s.off_road),
      ...stretches('over_median', s.over_median),
      ...stretches('wrong_way', s.wrong_way),
      ...stretches('off_map', s.off_map),
      ...stretches('on_carriageway', s.on_carriageway),
      ...stretches('speeding', s.speeding),
      ...stretches('running', s.running),
      ...stretches('askew', s.askew),
      ...stretches('harsh_braking', s.harsh_braking),
      ...stretches('harsh_steering', s.harsh_steering),
      ...(s.red_lights ?? []).map((r) => ({
        what: 'red_light' as const,
        agent: r.agent,
        time: r.time_s,
        until: r.time_s,
        extent: r.speed_mps,
        inLog: r.in_log,
      })),
    ],
    minTtc: s.min_ttc_s,
    minTtcPair: s.min_ttc_pair,
    pet: s.pet_s,
    petOf: petsOf(reply),
    offroadShare: s.offroad_share,
  };
}

/** Road users of a pair that pass the same place one after the other. */
const petsOf = ({ agents }: Partial<ScoreReply>): ReadonlyMap<string, number> =>
  new Map(Object.entries(agents ?? {}).flatMap(([id, a]) => (a.pet_s == null ? [] : [[id, a.pet_s]])));

type SentStretch = ScoreReply['scene']['off_road'][number];

const stretches = (what: LastingFault['what'], sent: readonly SentStretch[] | undefined): LastingFault[] =>
  (sent ?? []).map((s) => ({
    what,
    agent: s.agent,
    time: s.time_s,
    until: s.until_s,
    extent: s.worst,
    inLog: s.in_log,
  }));
