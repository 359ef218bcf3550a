// The scene in four figures: how often somebody is hit, how close it gets, how many goals are reached, how far from
// the log.
import { counted } from '../../model/physics/events';
import { comparedWithLog } from '../../model/words/change-words';
import { meetsGoal } from '../../model/physics/playback';
import { canChange } from '../../model/document/scene';
import { metres, num } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import type { Editor } from '../../edit/editor';
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

function figures(e: Editor): (readonly [string, string])[] {
  const [scene, set] = [e.scene.value, e.motion.value];
  if (!scene?.agents.size || !set.score || set.stale) return [];
  const all = [...scene.agents.values()].filter((a) => a.type !== 'other');
  const hits = counted(e.events.value).filter((ev) => ev.kind === 'collision').length;
  const goals = all.filter((a) => a.goal.pos !== null && canChange(a));
  const reached = goals.filter((a) => meetsGoal(set, a)).length;
  const far = all.flatMap((a) =>
    set.driving.has(a.id) ? (comparedWithLog(a, e.motionFor(a), scene.duration) ?? []) : [],
  );
  const furthest = far.reduce((most, c) => Math.max(most, c.d), 0);
  const { minTtc, pet } = set.score;
  return [
    [TEXTS.collisionsPer, num(hits / Math.max(1, all.length), 2)],
    [TEXTS.leastTimeToCollision, minTtc === null ? TEXTS.noneOnTheWay : `${num(minTtc, 1)} s`],
    ...(pet == null ? [] : [[TEXTS.leastGapInTime, `${num(pet, 1)} s`] as const]),
    ...(goals.length ? [[TEXTS.goalsReached, TEXTS.countOf(reached, goals.length)] as const] : []),
    ...(furthest > 0 ? [[TEXTS.furthestFrom, metres(furthest, 1)] as const] : []),
  ];
}
