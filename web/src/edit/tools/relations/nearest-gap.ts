// The gap of a goal to the nearest moving road user in its lane, at the time of the goal.
import { wrapAngle } from '../../../model/base/geometry';
import { poseAt } from '../../../model/base/motion';
import type { Command } from '../../../model/document/commands';
import { nameIn, type Agent } from '../../../model/document/scene';
import type { GoalRelationJson } from '../../../model/document/scene-json';
import { relationWords } from '../../../model/words/relation-words';
import { dependence, relate } from '../../moves/relating';
import { lanesFor } from '../../moves/snap';
import type { Editor } from '../../session/editor';
import { TEXTS } from '../../../texts/editing/relation';

/** The other one moves at least this fast, m/s. */
const MOVES_MPS = 1;
/** It is in the same lane: no further aside, metres, and no further turned, radians. */
const ASIDE_M = 1.5;
const TURNED_RAD = 0.35;
/** Gaps between the two that are worth holding, metres. */
const LEAST_M = 4;
const MOST_M = 25;

export interface OfferedGap {
  readonly relation: GoalRelationJson;
  readonly words: string;
  readonly command: Command;
}

/** The gap that a goal can hold, with the command for that; null where no other one is near. */
export function offeredGap(e: Editor, a: Agent): OfferedGap | null {
  const relation = nearestGap(e, a);
  if (!relation) return null;
  const name = nameIn(e.scene.value!)(relation.to) ?? relation.to;
  const where = relationWords(relation, name, null, e.view.unitOf(a));
  const command = relate(e, a, relation, null, where);
  return command && { relation, words: TEXTS.keep(where), command };
}

/** The gap is in whole metres, from box to box. */
function nearestGap(e: Editor, a: Agent): GoalRelationJson | null {
  const scene = e.scene.value;
  const goal = e.reading.goalPose(a);
  if (!scene || !goal?.set || !lanesFor(a)) return null;
  // A gap to the one that the shown future hits or nearly hits is not one to hold.
  const met = e.reading.futures.value?.modes[e.reading.chosen.value]?.about?.faults[0]?.with;
  let best: { readonly gap: number; readonly relation: GoalRelationJson } | null = null;
  for (const other of scene.agents.values()) {
    if (other.id === a.id || other.id === met || other.type === 'pedestrian' || other.type === 'other') continue;
    const at = poseAt(e.reading.motionFor(other), goal.time);
    if (!at || Math.abs(at.speed) < MOVES_MPS || Math.abs(wrapAngle(goal.heading - at.heading)) > TURNED_RAD) continue;
    const [dx, dy] = [goal.x - at.x, goal.y - at.y];
    const [cos, sin] = [Math.cos(at.heading), Math.sin(at.heading)];
    const ahead = dx * cos + dy * sin;
    const gap = Math.abs(ahead) - (a.length + other.length) / 2;
    if (Math.abs(dy * cos - dx * sin) > ASIDE_M || gap < LEAST_M || gap > MOST_M) continue;
    if ((best && best.gap <= gap) || dependence(scene, a, other) !== null) continue;
    const held = Math.round(gap);
    best = { gap, relation: { to: other.id, ...(ahead > 0 ? { ahead_m: held } : { behind_m: held }) } };
  }
  return best?.relation ?? null;
}
