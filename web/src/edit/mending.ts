// What can be taken of a scene whose file is broken in places: everything but the parts that are named as broken.
import { MOST_AGENTS } from '../model/base/domain';
import { isMapRef, type MapJson, type SceneJson } from '../model/document/scene-json';
import type { Problem } from '../net/types';
import { TEXTS } from '../texts/files/imports';

export interface Mended {
  readonly scene: SceneJson;
  /** What is left out: `lane E2`. */
  readonly without: readonly string[];
}

/** Parts that a scene can do without, by where their lists stand. */
const PARTS: readonly { readonly list: string; readonly name: string }[] = [
  { list: '/map/lanes', name: TEXTS.lane },
  { list: '/map/road_lines', name: TEXTS.roadLine },
  { list: '/map/road_edges', name: TEXTS.kerb },
  { list: '/map/crosswalks', name: TEXTS.crosswalk },
  { list: '/map/speed_bumps', name: TEXTS.speedBump },
  { list: '/map/driveways', name: TEXTS.driveway },
  { list: '/map/stop_signs', name: TEXTS.stopSign },
  { list: '/map/drivable', name: TEXTS.pavedArea },
  { list: '/signals', name: TEXTS.signal },
  { list: '/agents', name: TEXTS.roadUser },
];

export interface BrokenPart {
  readonly list: string;
  readonly index: number;
  /** `lane “E2”`, as people call it. */
  readonly name: string;
}

const listAt = (scene: SceneJson, list: string): Record<string, unknown>[] | null => {
  const found = list
    .split('/')
    .slice(1)
    .reduce<unknown>((v, k) => (v as Record<string, unknown> | null)?.[k], scene);
  return Array.isArray(found) ? (found as Record<string, unknown>[]) : null;
};

/** The part that a pointer leads into; null where it is about the scene as a whole. */
export function partAt(scene: SceneJson, pointer: string): BrokenPart | null {
  for (const { list, name } of PARTS) {
    const index = pointer.startsWith(`${list}/`) ? Number(pointer.slice(list.length + 1).split('/')[0]) : NaN;
    const item = Number.isInteger(index) ? listAt(scene, list)?.[index] : undefined;
    if (!item) continue;
    const id = item.id ?? item.lane;
    return { list, index, name: typeof id === 'string' ? `${name} “${id}”` : `${name} ${index + 1}` };
  }
  return null;
}

/** Null where what is wrong is not in parts that can be left out. */
export function withoutBroken(scene: SceneJson, problem: Problem): Mended | null {
  if (problem.code === 'too-many-agents') return fewer(scene);
  const parts = (problem.errors ?? []).map((e) => partAt(scene, e.pointer));
  if (!parts.length || parts.some((p) => p === null)) return null;
  const gone = new Map<string, Set<number>>();
  for (const p of parts as BrokenPart[]) gone.set(p.list, (gone.get(p.list) ?? new Set()).add(p.index));
  const copy = structuredClone(scene);
  const lanes = new Set<string>();
  for (const [list, indices] of gone) {
    const items = listAt(copy, list)!;
    if (list === '/map/lanes') for (const i of indices) lanes.add(String(items[i].id));
    const kept = items.filter((_, i) => !indices.has(i));
    items.splice(0, items.length, ...kept);
  }
  forgetLanes(copy, lanes);
  return { scene: copy, without: [...new Set((parts as BrokenPart[]).map((p) => p.name))] };
}

/** As many road users as a scene may have, from the first on. */
function fewer(scene: SceneJson): Mended | null {
  const rest = scene.agents.length - MOST_AGENTS;
  if (rest <= 0) return null;
  return { scene: { ...scene, agents: scene.agents.slice(0, MOST_AGENTS) }, without: [TEXTS.theLastRoadUsers(rest)] };
}

/** Nothing leads to a lane that is not there. */
function forgetLanes(scene: SceneJson, lanes: ReadonlySet<string>): void {
  if (!lanes.size) return;
  const there = (id: unknown): boolean => !lanes.has(String(id));
  if (Array.isArray(scene.signals)) scene.signals = scene.signals.filter((s) => there(s.lane));
  if (!scene.map || isMapRef(scene.map)) return;
  const map = scene.map as MapJson & Record<string, unknown>;
  for (const lane of (map.lanes ?? []) as unknown as Record<string, unknown>[]) {
    for (const k of ['predecessors', 'successors']) if (Array.isArray(lane[k])) lane[k] = lane[k].filter(there);
    for (const k of ['left_neighbors', 'right_neighbors'])
      if (Array.isArray(lane[k])) lane[k] = (lane[k] as { lane: string }[]).filter((n) => there(n.lane));
  }
  for (const sign of (map.stop_signs ?? []) as unknown as { lanes?: string[] }[])
    if (Array.isArray(sign.lanes)) sign.lanes = sign.lanes.filter(there);
}
