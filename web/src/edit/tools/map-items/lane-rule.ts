// The speed limit of a lane, and who may use it, as a step.
import { patchScene, type Command } from '../../../model/document/commands';
import { ruleOf, rulesOf, type Lane } from '../../../model/document/lanemap';
import type { Scene } from '../../../model/document/scene';
import type { LaneRule } from '../../../model/document/scene-json';

/** Another rule of a lane: all road users are computed again. */
export function setLaneRule(scene: Scene, lane: Lane, rule: LaneRule, name: string): Command {
  const was = ruleOf(lane);
  const same = was.speed_limit_mps === rule.speed_limit_mps && was.type === rule.type;
  const others = Object.entries(scene.laneRules).filter(([id]) => id !== lane.id);
  const laneRules = rulesOf(same ? others : [...others, [lane.id, rule]]);
  return patchScene(name, { laneRules, drawn: scene.drawn + 1 }, `${name}:${lane.id}`);
}
