// Goals relative to another road user: set from a typed text, and ended.
import { setGoal, type Command } from '../../model/document/commands';
import type { GoalRelationJson } from '../../model/document/scene-json';
import type { Agent } from '../../model/document/scene';
import { TEXTS } from '../../texts/editing/relation';
import type { Editor } from '../session/editor';
import { goalTime } from './moves';

/** The command that relates a goal; null for a passing without a place that both pass. */
export function relate(
  e: Editor,
  a: Agent,
  relation: GoalRelationJson,
  time: number | null,
  words: string,
): Command | null {
  const due = time === null ? a.goal.time : goalTime(e.scene.peek(), Math.round(time * 10) / 10);
  const own = Object.freeze({ ...relation });
  if (relation.after_s == null) {
    const goal = { ...a.goal, pos: null, heading: null, speed: null, time: due, relation: own };
    return { ...setGoal(a, goal), name: TEXTS.related(a.name, words), fold: undefined };
  }
  const at = e.reading.goalPose(a);
  if (!at?.set) return null;
  const goal = { ...a.goal, pos: Object.freeze([at.x, at.y] as const), relation: own };
  return { ...setGoal(a, goal), name: TEXTS.related(a.name, words), fold: undefined };
}

/** The goal stays where it is, as an ordinary one. */
export function endRelation(e: Editor, a: Agent): Command {
  const at = e.reading.goalPose(a);
  const pos = at ? Object.freeze([at.x, at.y] as const) : null;
  const time = at ? Math.round(at.time * 10) / 10 : a.goal.time;
  return { ...setGoal(a, { ...a.goal, relation: undefined, pos, time }), name: TEXTS.ended(a.name), fold: undefined };
}
