// Where the picture looks: the whole map, the part where people are on opening, or after the one that is followed.
import type { Context } from '../actions/context';
import { busyBox, sceneCentre } from '../model/busy';
import { poseAt } from '../model/motion';

/** How much of the map the height of the picture shows at first, in metres, and within which zooms. */
const OPENING_M = 88;
const OPENING_ZOOMS = [4.4, 8.5] as const;

export function fitScene({ editor, stage }: Context): void {
  const scene = editor.scene.peek();
  if (!scene) return;
  stage.resize();
  stage.view.fit(scene.map.box);
  stage.invalidate('map');
  stage.viewChanged();
}

/** The same stretch of road on every screen: a junction with the beginnings of its arms. */
export function lookAtOpened({ editor, stage }: Context): void {
  const scene = editor.scene.peek();
  if (!scene) return;
  stage.resize();
  const v = stage.view;
  const [min, max] = OPENING_ZOOMS;
  const z = Math.max(min, Math.min(max, (v.h - v.inset.top - v.inset.bottom) / OPENING_M));
  v.fit(busyBox(scene), 1.1 * z, z);
  v.centre(...sceneCentre(scene));
  stage.invalidate('map');
  stage.viewChanged();
}

/** Keeps the selected road user in the middle while playback runs. */
export function followSelected({ editor, stage }: Context): void {
  if (!editor.playhead.follow.peek() || !editor.playing.peek()) return;
  const a = editor.agent.peek();
  const p = a && poseAt(editor.motionFor(a), editor.time.peek());
  if (!p) return;
  stage.view.centre(p.x, p.y);
  stage.viewChanged();
}
