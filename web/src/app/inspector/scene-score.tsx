// The scene in four figures: collisions, closest approach, goals reached, distance from the recording.
import type { ComponentChildren } from 'preact';
import { counted } from '../../model/physics/events';
import { comparedWithLog } from '../../model/words/change-words';
import { meetsGoal } from '../../model/physics/playback';
import { canChange } from '../../model/document/scene';
import { threshold } from '../../model/document/thresholds';
import { metres, num } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import type { Editor } from '../../edit/session/editor';
import { TEXTS } from '../../texts/panels/inspector';

export function SceneScore() {
  const { editor } = useApp();
  const rows = figures(editor);
  if (!rows.length) return null;
  return (
    <section class="sect">
      <h3>{TEXTS.score}</h3>
      <dl class="wh figures">
        {rows.flatMap(([what, value]) => [<dt key={what}>{what}</dt>, <dd key={`${what}:`}>{value}</dd>])}
      </dl>
    </section>
  );
}

function figures(e: Editor): (readonly [string, ComponentChildren])[] {
  const [scene, set] = [e.scene.value, e.answers.motion.value];
  if (!scene?.agents.size || !set.score || set.stale) return [];
  const all = [...scene.agents.values()].filter((a) => a.type !== 'other');
  const events = counted(e.reading.events.value);
  const hits = events.filter((ev) => ev.kind === 'collision').length;
  // A small time of two road users that both follow their recording is no result of an edit.
  const ttc = threshold(scene, 'ttc_s');
  const seconds = (s: number, isRecorded: boolean): ComponentChildren => (
    <>
      {num(s, 1)} s{isRecorded && s < ttc ? <small> {TEXTS.inTheRecording}</small> : null}
    </>
  );
  const goals = all.filter((a) => a.goal.pos !== null && canChange(a));
  const reached = goals.filter((a) => meetsGoal(set, a)).length;
  const far = all.flatMap((a) =>
    set.driving.has(a.id) ? (comparedWithLog(a, e.reading.motionFor(a), scene.duration) ?? []) : [],
  );
  const furthest = far.reduce((most, c) => Math.max(most, c.d), 0);
  const { minTtc, minTtcPair, pet } = set.score;
  const recordedPair = minTtcPair?.every((id) => !set.driving.has(id)) ?? false;
  return [
    [TEXTS.collisionsPer, num(hits / Math.max(1, all.length), 2)],
    [TEXTS.minimumTtc, minTtc === null ? TEXTS.none : seconds(minTtc, recordedPair)],
    ...(pet == null ? [] : [[TEXTS.minimumPet, seconds(pet, !set.driving.size)] as const]),
    ...(goals.length ? [[TEXTS.goalsReached, TEXTS.countOf(reached, goals.length)] as const] : []),
    ...(furthest > 0 ? [[TEXTS.largestDistance, metres(furthest, 1)] as const] : []),
  ];
}
