// Remedies for a goal that is reached only by breaking rules: by the road, or with permission to cross an edge.
import { leavesRoad, markOf, type Fault } from '../../model/document/future-facts';
import { goalStep, type Command } from '../../model/document/commands';
import { LETTERS, type Future } from '../../model/document/futures';
import type { OnLine, Vec } from '../../model/base/geometry';
import type { Motion } from '../../model/base/motion';
import { pathTo } from '../../model/physics/reach';
import { startPose, type Agent, type GoalSpec } from '../../model/document/scene';
import { crossingWords } from '../../model/words/verdict-words';
import type { Editor } from '../session/editor';
import { roadGoal, verdictsHold } from './goal-verdict';
import { pickFuture } from './moves';
import { TEXTS } from '../../texts/editing/moves';

/** The route by the road: to the nearest goal it leads to, else the future that reaches the goal by it. */
export interface RoadWay {
  readonly words: string;
  readonly note: string;
  /** The goal that it leads to; null where it is the set one. */
  readonly to: OnLine | null;
  /** The route, in metres; empty where unknown. */
  readonly path: readonly Vec[];
  readonly command: Command;
}

/** A future within this distance of a place passes it, metres. */
const PASSES_M = 4;

/** Faults of the shown future, when it reaches the goal by breaking rules. */
function brokenRules(e: Editor, a: Agent): readonly Fault[] {
  const about = a.goal.pos && verdictsHold(e) ? e.reading.futures.value?.modes[e.reading.chosen.value]?.about : null;
  const mark = about && markOf(about);
  // Permission to cross an edge does not make a missed goal reachable.
  if (about?.faults.some((f) => f.kind === 'goal_missed')) return [];
  return mark === 'rule' || mark === 'collision' ? about!.faults : [];
}

export function roadWay(e: Editor, a: Agent): RoadWay | null {
  if (!brokenRules(e, a).length) return null;
  const { modes } = e.reading.futures.value!;
  const to = roadGoal(e, a);
  if (to) {
    const heading = a.goal.heading === null ? null : to.heading;
    const goal: GoalSpec = { ...a.goal, pos: Object.freeze([to.x, to.y] as const), heading };
    const command = goalStep(a, goal, TEXTS.goalOfMovedOntoRoad(a.name));
    return { words: to.words, note: '', to, path: pathBy(e, a, modes, to), command };
  }
  // A pick refers to the futures at rest; those of a drag disappear at its end.
  const good = e.drag.active.value ? -1 : modes.findIndex((m) => m.about && !m.about.faults.length);
  const command = good >= 0 ? pickFuture(e, a, good) : null;
  if (!command) return null;
  const { motion, name } = modes[good];
  return { words: TEXTS.byRoad(LETTERS[good]), note: name, to: null, path: pointsOf(motion.x, motion.y), command };
}

/** Along the future that reaches it on the road, else along the lanes, else as far as a future leads. */
function pathBy(e: Editor, a: Agent, modes: readonly Future[], to: OnLine): readonly Vec[] {
  const [best] = modes
    .filter((m) => m.about && !m.about.faults.some(leavesRoad))
    .map((m) => towards(m.motion, to))
    .sort((p, q) => p.short - q.short);
  if (best && best.short <= PASSES_M) return best.path;
  const start = startPose(a);
  const way = start && pathTo(e.scene.value!.map, a, start, to);
  return way?.lanes.length ? way.line.pts : (best?.path ?? []);
}

/** A motion up to its nearest point to a place, and the remaining distance, metres. */
function towards({ x, y }: Motion, to: OnLine): { path: Vec[]; short: number } {
  const d = x.map((v, i) => Math.hypot(v - to.x, y[i] - to.y));
  const short = Math.min(...d);
  return { path: pointsOf(x, y).slice(0, d.indexOf(short) + 1), short };
}

const pointsOf = (x: Float64Array, y: Float64Array): Vec[] => Array.from(x, (v, i): Vec => [v, y[i]]);

// -------------------------------------------------------------- permission to cross an edge

export interface Leave {
  readonly words: string;
  readonly command: Command;
}

/** Faults of the shown future at road edges that it crosses without permission. */
const crossings = (e: Editor, a: Agent): readonly Fault[] =>
  brokenRules(e, a).filter((f) => f.edge !== null && leavesRoad(f) && !a.goal.mayCross.includes(f.edge));

/** Ids of the road edges that the shown future crosses without permission; none where the generator names none. */
export const edgesInTheWay = (e: Editor, a: Agent): readonly string[] => [
  ...new Set(crossings(e, a).map((f) => f.edge!)),
];

/** Permission to cross the edges of the shown future, for this goal only. */
export function leaveToCross(e: Editor, a: Agent): Leave | null {
  const edges = edgesInTheWay(e, a);
  if (!edges.length) return null;
  const words = crossingWords(crossings(e, a));
  const goal: GoalSpec = { ...a.goal, mayCross: Object.freeze([...a.goal.mayCross, ...edges]) };
  return { words: words.allow, command: goalStep(a, goal, `${a.name} ${words.may}`) };
}

/** The edges that the goal may cross, and the command that withdraws this; null where there are none. */
export function leaveGiven(a: Agent): Leave | null {
  if (!a.goal.mayCross.length) return null;
  const goal: GoalSpec = { ...a.goal, mayCross: Object.freeze([]) };
  return { words: TEXTS.crossingAllowed, command: goalStep(a, goal, TEXTS.crossingNotAllowed(a.name)) };
}
