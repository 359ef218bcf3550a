import { buildCrossing } from './standin/crossing.mjs';
import type { SceneJson } from '../src/model/document/scene-json';
import { readScene } from '../src/model/document/scene-reader';
import type { Scene } from '../src/model/document/scene';

export const crossingJson = (): SceneJson => structuredClone(buildCrossing().scene) as SceneJson;
export const crossing = (): Scene => readScene(crossingJson());
export const car = (s: Scene) => s.agents.get('1')!;
export const walker = (s: Scene) => [...s.agents.values()].find((a) => a.type === 'pedestrian')!;
