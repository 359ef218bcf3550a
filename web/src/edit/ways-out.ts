// Ways out of a goal that is reached against the rules: by the road, or with leave to go over what is in the way.
import { leavesRoad, markOf, type Fault } from '../model/document/future-facts';
import { goalStep, type Command } from '../model/document/commands';
import { LETTERS, type Future } from '../model/document/futures';
import type { OnLine, Vec } from '../model/base/geometry';
import type { Motion } from '../model/base/motion';
import { pathTo } from '../model/physics/reach';
import { startPose, type Agent, type GoalSpec } from '../model/document/scene';
import { goes, mayCrossWords } from '../model/words/verdict-words';
import type { Editor } from './editor';
import { roadGoal, verdictsHold } from './goal-verdict';
import { pickFuture } from './moves';
import { TEXTS } from '../texts/editing/moves';

/** The way by the road: to the nearest goal that it leads to, else the future that gets to the goal by it. */
export interface RoadWay {
  readonly words: string;
  readonly note: string;
  /** The goal that it leads to; null where it leads to the goal that is set. */
  readonly to: OnLine | null;
  /** The way there, in metres; empty where nobody knows one. */
  readonly path: readonly Vec[];
  readonly command: Command;
}

/** A future that passes a place nearer than this gets there, metres. */
const PASSES_M = 4;

/** What is wrong with the future that is shown, when it reaches the goal against the rules. */
function brokenRules(e: Editor, a: Agent): readonly Fault[] {
  const about = a.goal.pos && verdictsHold(e) ? e.futures.value?.modes[e.chosen.value]?.about : null;
  const mark = about && markOf(about);
  // Leave to break a rule does not bring a goal within reach.
  if (about?.faults.some((f) => f.kind === 'goal_missed')) return [];
  return mark === 'rule' || mark === 'collision' ? about!.faults : [];
}

export function roadWay(e: Editor, a: Agent): RoadWay | null {
  if (!brokenRules(e, a).length) return null;
  const { modes } = e.futures.value!;
  const to = roadGoal(e, a);
  if (to) {
    const heading = a.goal.heading === null ? null : to.heading;
    const goal: GoalSpec = { ...a.goal, pos: Object.freeze([to.x, to.y] as const), heading };
    const command = goalStep(a, goal, TEXTS.goalOfMovedToWhere(a.name));
    return { words: to.words, note: '', to, path: pathBy(e, a, modes, to), command };
  }
  // A pick is one of the futures at rest; those of a drag are gone when it ends.
  const good = e.dragging.value ? -1 : modes.findIndex((m) => m.about && !m.about.faults.length);
  const command = good >= 0 ? pickFuture(e, a, good) : null;
  if (!command) return null;
  const { motion, name } = modes[good];
  return { words: TEXTS.byTheRoad(LETTERS[good]), note: name, to: null, path: pointsOf(motion.x, motion.y), command };
}

/** Along the future that gets there without leaving the road, else along the lanes, else as far as a future leads. */
function pathBy(e: Editor, a: Agent, modes: readonly Future[], to: OnLine): readonly Vec[] {
  const [best] = modes
    .filter((m) => m.about && !m.about.faults.some(leavesRoad))
    .map((m) => towards(m.motion, to))
    .sort((p, q) => p.short - q.short);
  if (best && best.short <= PASSES_M) return best.path;
  const start = startPose(a);
  const way = start && pathTo(e.scene.value!.map, a, start, to);
  return way?.onLanes ? way.line.pts : (best?.path ?? []);
}

/** A motion up to where it is nearest to a place, and how far that is from it, metres. */
function towards({ x, y }: Motion, to: OnLine): { path: Vec[]; short: number } {
  const d = x.map((v, i) => Math.hypot(v - to.x, y[i] - to.y));
  const short = Math.min(...d);
  return { path: pointsOf(x, y).slice(0, d.indexOf(short) + 1), short };
}

const pointsOf = (x: Float64Array, y: Float64Array): Vec[] => Array.from(x, (v, i): Vec => [v, y[i]]);

// -------------------------------------------------------------- leave to go over an edge

export interface Leave {
  readonly words: string;
  readonly command: Command;
}

/** Ids of the road edges that the shown future goes over without leave; none where the generator names none. */
export function edgesInTheWay(e: Editor, a: Agent): readonly string[] {
  const over = brokenRules(e, a).flatMap((f) => (f.edge !== null && leavesRoad(f) ? [f.edge] : []));
  return [...new Set(over)].filter((id) => !a.goal.mayCross.includes(id));
}

/** Leave to go over what the shown future goes over, for this goal alone. */
export function leaveToCross(e: Editor, a: Agent): Leave | null {
  const edges = edgesInTheWay(e, a);
  if (!edges.length) return null;
  const words = mayCrossWords(goes(a.type), e.scene.value!.map, edges);
  const goal: GoalSpec = { ...a.goal, mayCross: Object.freeze([...a.goal.mayCross, ...edges]) };
  return { words: TEXTS.it(words), command: goalStep(a, goal, `${a.name} ${words}`) };
}

/** What it may go over, and the command that takes this back; null where there is nothing. */
export function leaveGiven(e: Editor, a: Agent): Leave | null {
  if (!a.goal.mayCross.length) return null;
  const words = mayCrossWords(goes(a.type), e.scene.value!.map, a.goal.mayCross);
  const goal: GoalSpec = { ...a.goal, mayCross: Object.freeze([]) };
  const not = mayCrossWords(goes(a.type), e.scene.value!.map, a.goal.mayCross, false);
  const command = goalStep(a, goal, `${a.name} ${not}`);
  return { words: words.charAt(0).toUpperCase() + words.slice(1), command };
}
