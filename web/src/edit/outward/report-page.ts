// One page about a scene, to be read and printed: the picture, who is there, what happens, and how it was made.
import { findChanges } from '../../model/words/change-words';
import { meetsGoal, motionOf } from '../../model/physics/playback';
import { counted } from '../../model/physics/events';
import type { TrafficEvent } from '../../model/words/event-words';
import type { MotionSet } from '../../model/document/futures';
import type { Vec } from '../../model/base/geometry';
import { endPose } from '../../model/base/motion';
import { canChange, changedByHand, hasGoal, startPose, type Agent, type Scene } from '../../model/document/scene';
import { num, seconds, speedLabel, type SpeedUnit, walkingUnit } from '../../model/base/units';
import { LANGUAGE } from '../../texts/language';
import { resultCode } from '../../model/document/result-code';
import { TEXTS } from '../../texts/files/report-page';
import { TEXTS as CODE } from '../../texts/files/result-code';

export interface ReportOf {
  readonly scene: Scene;
  readonly motion: MotionSet;
  readonly events: readonly TrafficEvent[];
  /** What the variant that is shown is called; null where none is. */
  readonly variant: string | null;
  readonly unit: SpeedUnit;
  /** Data address of the picture. */
  readonly picture: string;
  readonly time: number;
  readonly origin: string;
}

const text = (s: string): string => s.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');
const cell = (s: string): string => `<td>${text(s)}</td>`;
const place = ([x, y]: Vec): string => TEXTS.place(num(x), num(y));

const STYLE = `
body{font:14px/1.5 system-ui,sans-serif;color:#14181d;max-width:1000px;margin:32px auto;padding:0 16px}
h1{font-size:24px;margin:0}h2{font-size:16px;margin:28px 0 8px}p{margin:4px 0;color:#454d57}
img{width:100%;border:1px solid #e1e4e8;border-radius:8px;margin-top:16px}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}
th,td{text-align:left;padding:4px 10px 4px 0;border-bottom:1px solid #e1e4e8;vertical-align:top}
th{font-weight:600;color:#616a75}tr.asked td:first-child{font-weight:600}
@media print{body{margin:0}img{break-inside:avoid}}`;

export function reportPage(r: ReportOf): string {
  const { scene } = r;
  const all = [...scene.agents.values()];
  const own = counted(r.events);
  const words = wordsOf(r);
  const asked = all.filter((a) => isAsked(a) && canChange(a));
  const reached = asked.filter((a) => a.goal.pos && meetsGoal(r.motion, a) !== false);
  const goals = asked.filter((a) => a.goal.pos);
  const facts: [string, string][] = [
    ...(r.variant === null ? [] : [[TEXTS.variant, r.variant] as [string, string]]),
    [TEXTS.roadUsers, String(all.length)],
    [TEXTS.asked, String(asked.length)],
    [TEXTS.goalsReached, goals.length ? TEXTS.of(reached.length, goals.length) : TEXTS.noneSet],
    [TEXTS.collisions, String(own.filter((e) => e.kind === 'collision').length)],
    [TEXTS.nearMisses, String(own.filter((e) => e.kind === 'near').length)],
    [TEXTS.leastTime, r.motion.score?.minTtc == null ? TEXTS.none : seconds(r.motion.score.minTtc)],
    [TEXTS.seedDiversity, `${scene.seed}, ${Math.round(scene.diversity * 100)} %`],
    [CODE.code, resultCode(scene, r.motion)],
    [TEXTS.others, { react: TEXTS.react, log: TEXTS.replayTheLog, still: TEXTS.holdStill }[scene.others]],
    [TEXTS.length, seconds(scene.duration)],
    ...(scene.licence ? [[TEXTS.licence, scene.licence] as [string, string]] : []),
  ];
  const rows = (list: [string, string][]): string =>
    list.map(([k, v]) => `<tr><th scope="row">${text(k)}</th>${cell(v)}</tr>`).join('');
  return `<!doctype html>
<html lang="${LANGUAGE}"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>${text(scene.name)}</title><style>${STYLE}</style></head><body>
<h1>${text(scene.name)}</h1>
<p>${text(TEXTS.thePictureShows(seconds(r.time), seconds(scene.duration)))}</p>
<img alt="${text(TEXTS.fromAbove)}" src="${r.picture}">
<h2>${TEXTS.result}</h2><table>${rows(facts)}</table>
<h2>${TEXTS.whatHappens}</h2>${eventTable(r.events)}
<h2>${TEXTS.roadUsers}</h2>
<table>${head(TEXTS.who, TEXTS.start('m'), TEXTS.speed, TEXTS.goal('m'), TEXTS.endsAt('m'), '')}
${all.map((a) => agentRow(r, a, words.get(a.id))).join('\n')}</table>
<h2>${TEXTS.unitsAndAxes}</h2><p>${text(TEXTS.axesInMetres)} ${text(r.origin)}</p>
</body></html>
`;
}

const head = (...names: string[]): string => `<tr>${names.map((n) => `<th>${n}</th>`).join('')}</tr>`;
const row = (...cells: string[]): string => `<tr>${cells.map(cell).join('')}</tr>`;

function eventTable(events: readonly TrafficEvent[]): string {
  if (!events.length) return `<p>${TEXTS.nothingJudged}</p>`;
  const rows = events.map((e) => row(seconds(e.time), e.words, e.title, place(e.at), e.inLog ? TEXTS.inTheLog : ''));
  return `<table>${head(TEXTS.when, TEXTS.what, TEXTS.who, TEXTS.where('m'), '')}${rows.join('')}</table>`;
}

/** Is something asked of a road user? Who was put here is asked nothing by that alone. */
const isAsked = (a: Agent): boolean =>
  a.placed ? hasGoal(a.goal) || a.goal.via.length > 0 || a.chosen !== null : changedByHand(a);

/** What everybody does otherwise than in the log, or for somebody else where there is none, in words. */
function wordsOf({ scene, motion }: ReportOf): ReadonlyMap<string, string> {
  const log = { ...motion, driving: new Set<string>() };
  const told = (id: string): boolean => !scene.agents.get(id)!.placed || motion.answering.has(id);
  const changes = findChanges(scene, log, motion, new Set()).filter((c) => told(c.id));
  return new Map(changes.map((c) => [c.id, c.words]));
}

function agentRow(r: ReportOf, a: Agent, words: string | undefined): string {
  const start = startPose(a);
  const end = endPose(motionOf(r.scene, r.motion, a));
  const unit = a.type === 'pedestrian' ? walkingUnit(r.unit) : r.unit;
  const goal = a.goal.pos ? TEXTS.at(place(a.goal.pos), seconds(a.goal.time)) : '';
  const cells = [
    a.name,
    start ? place([start.x, start.y]) : TEXTS.comesLater,
    start ? speedLabel(start.speed, unit) : '',
    goal,
    end ? place([end.x, end.y]) : '',
    words ?? (a.parked ? TEXTS.parked : ''),
  ];
  return `<tr${isAsked(a) ? ' class="asked"' : ''}>${cells.map(cell).join('')}</tr>`;
}
