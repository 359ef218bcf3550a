// The motion of all road users after an answer: the earlier motion, updated by the answer.
import { DEFAULTS } from '../../model/base/domain';
import { asIfNotAsked, toBeGivenUp } from '../../model/document/reaction-records';
import type { AgentFuturesJson } from '../../model/document/scene-json';
import type { Answering, Futures, KeepOrder, MotionSet, Score } from '../../model/document/futures';
import { motionOf } from '../../model/physics/playback';
import { naming, readFutures, withNames } from '../../model/words/named-futures';
import { firstPose } from '../../model/document/scene-reader';
import { metAnew, withMeetingsOf, type Changed } from '../../model/physics/verdict-updates';
import { doing, sceneKey, touched, touchedIn, type Agent, type Scene } from '../../model/document/scene';
import type { FinalEvent } from '../../net/types';
import type { Wanted } from './request-builder';
import { readReach, readScore, readWarnings } from './read-answer';
import { judgedCurves, withCurves } from './drawn-speeds';

/** Order of the letters for the futures of a road user. */
export type Keep = (a: Agent) => KeepOrder;

export function motionAfter(last: MotionSet, scene: Scene, e: FinalEvent, w: Wanted, keep: Keep): MotionSet {
  const before = asIfNotAsked(last, w.anew);
  const answers = futuresOf(before, scene, e, keep);
  const mine = touchedIn(scene);
  // Futures requested before the change, only for a selection, are no longer true.
  const stillTrue = (id: string) => {
    const a = scene.agents.get(id);
    return a !== undefined && (before.driving.has(id) || w.kept?.has(id) || touched(a));
  };
  const known = new Map([...[...before.futures].filter(([id]) => stillTrue(id)), ...answers]);
  const futures = new Map(withCurves(scene, known));
  const score = readScore(e.scores?.[0]);
  const drives = (id: string) => {
    const a = scene.agents.get(id);
    return a !== undefined && (w.agents === 'all' || touched(a) || doing(scene, a) === 'react');
  };
  const driving = new Set([...before.driving, ...answers.keys()].filter(drives));
  for (const id of mine) if (futures.has(id)) driving.add(id);
  // The motions that these were judged against have changed with the answer.
  const now: MotionSet = { ...before, futures, driving };
  const since = changedSince(last, now, scene);
  const picked = (w.pinned ?? []).filter((id) => !since.some((c) => c.agent.id === id));
  const changed = [...since, ...doingNow(scene, now, picked)];
  // For a road user with a picked future, all six were already judged with the others' reactions; those verdicts stay.
  const stands = new Set([...answers.keys(), ...(w.pinned ?? [])]);
  const own = mine.filter((id) => !answers.has(id));
  const met = metAgain(scene, futures, changed, stands, score, own);
  const judged = score ? judgedCurves(scene, met, score) : met;
  const reach = new Map(before.reach);
  for (const [id, resolved] of Object.entries(e.resolved)) {
    const verdict = readReach(resolved);
    if (verdict) reach.set(id, verdict);
    else reach.delete(id);
  }
  return {
    key: sceneKey(scene),
    futures: judged,
    driving,
    score,
    reach,
    stale: false,
    head: e.generated,
    answering: answeringAfter(before, e, w.pinned),
    warnings: readWarnings(e),
  };
}

/** The same after a pick without a generator request: the score gives the pairs that meet. */
export const rejudged = (scene: Scene, set: MotionSet, score: Score, picked: readonly string[]): Map<string, Futures> =>
  metAgain(scene, set.futures, doingNow(scene, set, picked), new Set(picked), score, touchedIn(scene));

/**
 * Futures judged again after the `changed` motions; verdicts of the ids in `stands` stay. The followed future of each
 * of `own` is judged by the score, where there is one.
 */
function metAgain(
  scene: Scene,
  futures: MotionSet['futures'],
  changed: readonly Changed[],
  stands: ReadonlySet<string>,
  score: Score | null,
  own: readonly string[],
): Map<string, Futures> {
  const out = new Map<string, Futures>();
  for (const [id, known] of futures) {
    const a = scene.agents.get(id);
    if (!a) continue;
    const f = stands.has(id) ? known : metAnew(a, known, changed);
    const shown = a.chosen ?? f.chosen;
    const met = score && own.includes(id) && f.modes[shown] ? withMeetingsOf(score, id, f.modes[shown]) : null;
    out.set(id, met && met !== f.modes[shown] ? { ...f, modes: f.modes.map((m, i) => (i === shown ? met : m)) } : f);
  }
  return out;
}

/** Current motions of these ids, to judge others against. */
const doingNow = (scene: Scene, set: MotionSet, ids: readonly string[]): Changed[] =>
  ids.flatMap((id) => {
    const agent = scene.agents.get(id);
    return agent ? [{ agent, motion: motionOf(scene, set, agent) }] : [];
  });

/** All road users with another motion than before. */
function changedSince(before: MotionSet, now: MotionSet, scene: Scene): Changed[] {
  return [...scene.agents.values()].flatMap((agent) => {
    const motion = motionOf(scene, now, agent);
    return motion === motionOf(scene, before, agent) ? [] : [{ agent, motion }];
  });
}

export function futuresOf(before: MotionSet, scene: Scene, e: FinalEvent, keep: Keep): Map<string, Futures> {
  const out = new Map<string, Futures>();
  for (const [id, json] of Object.entries(e.samples[0]?.agents ?? {})) {
    const a = scene.agents.get(id);
    const f = a && futuresFrom(before, scene, a, json, keep);
    if (f) out.set(id, f);
  }
  return out;
}

function futuresFrom(before: MotionSet, scene: Scene, a: Agent, json: AgentFuturesJson, keep: Keep): Futures | null {
  const start = firstPose(a, json);
  if (!json.modes?.length) return null;
  const known = before.futures.get(a.id);
  const picked = a.chosen !== null && json.modes.length === 1 ? known?.modes[a.chosen] : undefined;
  if (!known || !picked) {
    const { steps } = DEFAULTS;
    const f = readFutures(json, start, steps, steps, a.type === 'pedestrian', keep(a));
    return withNames(f, naming(scene, a));
  }
  // A picked future returns extended and judged to its end; the other five stay unchanged.
  const [read] = readFutures(json, start, 1, 1, a.type === 'pedestrian').modes;
  const longer = { ...picked, motion: read.motion, about: read.about ?? picked.about, sent: read.sent };
  return { ...known, modes: known.modes.map((m) => (m === picked ? longer : m)) };
}

/** The cause of each reaction; reactions that were not computed again keep their earlier cause. */
function answeringAfter(before: MotionSet, e: FinalEvent, pinned: readonly string[] = []): Map<string, Answering> {
  const out = new Map(before.answering);
  for (const id of pinned) out.delete(id);
  const agents: Record<string, AgentFuturesJson> = e.samples[0]?.agents ?? {};
  for (const [id, { reaction }] of Object.entries(agents)) {
    if (reaction) out.set(id, { said: reaction, gaveUp: toBeGivenUp(before, id) });
    else out.delete(id);
  }
  return out;
}
