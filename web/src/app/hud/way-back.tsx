// A button to return when the scene is out of view.
import { useComputed } from '@preact/signals';
import { boxesMeet, boxOf, type Box } from '../../model/base/geometry';
import type { LaneMap } from '../../model/document/lanemap';
import { startPose } from '../../model/document/scene';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { viewTick } from './view-tick';

const boxes = new WeakMap<LaneMap, readonly Box[]>();

/** Boxes around each lane; a map without lanes has its own box. */
function boxesOf(map: LaneMap): readonly Box[] {
  const known = boxes.get(map);
  if (known) return known;
  const all = [...map.lanes.values()].map((l) => boxOf(l.line.pts));
  const made = all.length ? all : [map.box];
  boxes.set(map, made);
  return made;
}

export function WayBack() {
  const { editor, stage } = useApp();
  const lost = useComputed(() => {
    void viewTick.value;
    const scene = editor.resting.value;
    if (!scene || editor.drag.active.value) return false;
    const { view: v } = stage;
    const there = v.box();
    const screen = { x0: 0, y0: 0, x1: v.w, y1: v.h };
    const inside = (p: { x: number; y: number } | null): boolean => p !== null && v.shows(p.x, p.y);
    return (
      !boxesOf(scene.map).some((b) => boxesMeet(b, there) && boxesMeet(v.around(b), screen)) &&
      ![...scene.agents.values()].some((a) => inside(startPose(a)))
    );
  }).value;
  return lost ? (
    <div class="card wayback">
      <ActionButton id="back-to-scene" size={16} withKey />
    </div>
  ) : null;
}
