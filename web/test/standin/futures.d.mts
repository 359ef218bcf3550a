import type { AgentJson, ConditionJson, ModeJson, ReactionJson } from '../../src/model/document/scene-json';
export function sixFutures(
  agent: AgentJson,
  condition: ConditionJson | undefined,
  step: number,
  steps: number,
): ModeJson[];
export function giveWay(agent: AgentJson, seconds: number): ModeJson;
export function reactionTo(cause: string, mode: ModeJson, delay_s: number): ReactionJson;
export function goOn(mode: ModeJson, steps: number): void;
