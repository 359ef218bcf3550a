// Goals relative to another road user: set from a typed text or an offer, and ended.
import { RELATION } from '../../model/base/domain';
import { setGoal, type Command } from '../../model/document/commands';
import type { GoalRelationJson } from '../../model/document/scene-json';
import type { Agent, Scene } from '../../model/document/scene';
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
    const speed = relation.slower_mps == null ? a.goal.speed : null;
    const goal = { ...a.goal, pos: null, heading: null, speed, time: due, relation: own };
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

/** Why the goal of a road user cannot depend on another's; null where it can. */
export function dependence(scene: Scene, own: Agent, to: Agent): string | null {
  let next: Agent | undefined = to;
  for (let row = 1; next; row++) {
    if (next.id === own.id) return TEXTS.ring(to.name);
    if (!next.goal.relation) return null;
    if (row >= RELATION.most_in_a_row) return TEXTS.row(RELATION.most_in_a_row);
    next = scene.agents.get(next.goal.relation.to);
  }
  return null;
}
