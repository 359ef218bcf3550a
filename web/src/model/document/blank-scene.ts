// Scenes without road users.
import type { MapJson, SceneJson } from './scene-json';

/** Steps of a scene of 9 s, the first at 0 s. */
const STEPS = 91;

/** The same road and signals, without road users. */
export function withoutRoadUsers(json: SceneJson): SceneJson {
  return { ...json, agents: [], generated: null, x_editor: undefined };
}

/** Ground without a road. */
export function emptyScene(): SceneJson {
  const map: MapJson = {};
  return {
    format: 'dragtraffic.scene',
    version: 1,
    meta: { source: 'drawn' },
    time: { step_s: 0.1, steps: STEPS, now_step: 0 },
    map,
    signals: [],
    agents: [],
  };
}
