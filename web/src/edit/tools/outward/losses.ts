// Details of a scene that a file cannot hold, in plain words and with the numbers of that scene.
import { num } from '../../../model/base/units';
import type { Scene } from '../../../model/document/scene';
import { TEXTS } from '../../../texts/files/losses';
import { countWords } from '../../../model/base/kinds';
import type { Message } from '../../../model/document/message';
import { messageText } from '../../../model/words/message-text';
import { SENTENCES } from '../../../texts/messages/file-messages';

export interface Loss {
  /** `Goals` */
  readonly what: string;
  /** `2 that you set become finished motion` */
  readonly how: string;
}

const count = (scene: Scene, is: (a: Scene['agents'] extends ReadonlyMap<string, infer A> ? A : never) => boolean) =>
  [...scene.agents.values()].filter(is).length;
const FINER = ['truck', 'bus', 'motorcycle'] as const;

/** Trucks, buses and motorcycles of the scene. */
function finer(scene: Scene): string {
  const all = FINER.flatMap((kind) => {
    const n = count(scene, (a) => a.kind === kind);
    return n ? countWords(kind, n) : [];
  });
  return all.length ? TEXTS.asPlainVehicles(all.join(', ')) : TEXTS.kindsInTheFile;
}

function goals(scene: Scene): string {
  const n = count(scene, (a) => a.goal.pos !== null);
  return n ? TEXTS.goalsAsMotion(TEXTS.goalCount(n)) : TEXTS.startsAsMotion;
}

function notes(scene: Scene): string {
  const n = count(scene, (a) => a.note !== '');
  return n ? TEXTS.namesAndTags(TEXTS.notes(n)) : TEXTS.namesAndTagsAlone;
}

type LossWords = readonly [what: string, how: string | ((scene: Scene) => string)];

/** The server's codes of losses, the worst first. */
const WORDS: Record<string, LossWords> = {
  'no-road-users': [TEXTS.roadUsers, (s) => TEXTS.roadOnly(s.agents.size)],
  'no-map': [TEXTS.road, (s) => TEXTS.kerbsCrosswalks(TEXTS.lanes(s.map.lanes.size))],
  'no-signals': [
    TEXTS.signals,
    (s) => (s.signals.length ? TEXTS.signalsOf(TEXTS.lanes(s.signals.length)) : TEXTS.sceneHasNone),
  ],
  'no-conditions': [TEXTS.goals, goals],
  'no-modes': [TEXTS.otherFutures, TEXTS.theChosenOnes],
  'no-generated': [TEXTS.generatedMotion, TEXTS.allMotionCounts],
  'single-ego': [TEXTS.otherGoals, TEXTS.oneGoalOnly],
  'late-road-users': [TEXTS.lateRoadUsers, TEXTS.strictReaders],
  'no-unseen': [TEXTS.unseenRoadUsers, TEXTS.notSeen],
  'no-subtype': [TEXTS.subtypes, finer],
  'no-sizes': [TEXTS.sizes, TEXTS.defaultSizes],
  'no-velocity': [TEXTS.speeds, TEXTS.derivedSpeeds],
  'no-timing': [TEXTS.time, TEXTS.currentStep],
  'no-validity-gaps': [TEXTS.gaps, TEXTS.stepsNotSeen],
  'no-judgements': [TEXTS.verdicts, TEXTS.chancesFaults],
  'no-trips': [TEXTS.someTrips, TEXTS.roadUsersOff],
  'no-rollouts': [TEXTS.someRollouts, TEXTS.theChallenge],
  'no-lane-graph': [TEXTS.linksOfLanes, TEXTS.successorsAndNeighbours],
  'no-lane-width': [TEXTS.widthsOfLanes, TEXTS.defaultSizes],
  'no-lane-type': [TEXTS.someLaneTypes, TEXTS.nearestType],
  'no-speed-limits': [TEXTS.speedLimits, TEXTS.ofAllLanes],
  'no-signal-states': [TEXTS.someSignalStates, TEXTS.allButRedYellow],
  'no-z': [TEXTS.heights, TEXTS.mapIsFlat],
  'no-drivable': [TEXTS.pavedAreas, TEXTS.lanesAndKerbs],
  'no-lines': [TEXTS.paintedLines, TEXTS.markingsAndKerbs],
  'no-areas': [TEXTS.someAreas, TEXTS.suchAsDriveways],
  'no-neighbors': [TEXTS.adjacentLanes, TEXTS.partlyAdjacent],
  'geometry-approximated': [TEXTS.exactLines, TEXTS.resampled],
  'no-roles': [TEXTS.roles, TEXTS.egoAndTargets],
  'no-notes': [TEXTS.namesAndNotes, notes],
  'no-licence': [TEXTS.licence, (s) => (s.licence ? TEXTS.isNotStated(s.licence) : TEXTS.notStated)],
  'no-ids': [TEXTS.numbers, TEXTS.renumbered],
  'ids-renumbered': [TEXTS.numbers, TEXTS.someRenumbered],
  'long-record': [TEXTS.usualLength, TEXTS.nothingIsCut],
};
const ORDER = Object.keys(WORDS);
/** Unknown codes come last. */
const rank = (code: string): number => (ORDER.indexOf(code) + ORDER.length + 1) % (ORDER.length + 1);

/** A loss from the server; with numbers it has a message. */
interface SentLoss {
  readonly code: string;
  readonly detail: string;
  readonly message?: Message;
}

/** The server's losses, a list in JSON: one for each code, preferably with numbers. */
export function lossesOf(sent: string | null, scene: Scene): readonly Loss[] {
  const all = JSON.parse(sent ?? '[]') as readonly SentLoss[];
  const codes = [...new Set(all.map(({ code }) => code))].sort((a, b) => rank(a) - rank(b));
  return codes.map((code) => {
    const [what, how] = WORDS[code] ?? [plainly(code), TEXTS.notInTheFile];
    const counted = all.find((loss) => loss.code === code && loss.message);
    if (counted?.message) return { what, how: messageText(counted.message, counted.detail, SENTENCES) };
    return { what, how: typeof how === 'string' ? how : how(scene) };
  });
}

/** `no-lane-width`: `Lane width` */
function plainly(code: string): string {
  const words = code.replace(/^no-/, '').replaceAll('-', ' ');
  return words[0].toUpperCase() + words.slice(1);
}

/** One line on what the file still contains. */
export function stays(losses: readonly Loss[], scene: Scene): string {
  const lost = new Set(losses.map((l) => l.what));
  const parts: readonly (readonly [kept: boolean, words: string])[] = [
    [!lost.has(TEXTS.road), TEXTS.theRoad],
    [scene.signals.length > 0 && !lost.has(TEXTS.signals), TEXTS.signalsWithin],
    [scene.agents.size > 0 && !lost.has(TEXTS.roadUsers), TEXTS.roadUserCount(scene.agents.size)],
  ];
  const kept = parts.filter(([is]) => is).map(([, words]) => words);
  if (!lost.has(TEXTS.roadUsers)) kept.push(TEXTS.sAt10Hz(num(scene.duration, 1)));
  return kept.join(', ');
}
