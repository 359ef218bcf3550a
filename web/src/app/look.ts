// Moves of the camera: the whole map, the active part on opening, following a road user, and the camera of a step.
import { effect } from '@preact/signals-core';
import type { Context, Opening } from '../actions/context';
import { busyBox, openingCentre } from '../model/physics/scene-centre';
import { wrapAngle, type Vec } from '../model/base/geometry';
import type { HistoryDirection } from '../model/document/scene-diff';
import type { Camera, HistoryStep } from '../model/document/history';
import { poseShown } from '../edit/overlay/frame';
import { endPose, poseAt } from '../model/base/motion';
import { canChange, startPose, type Agent } from '../model/document/scene';
import type { View } from '../draw/view';

/** Initial height of the picture in metres, and the limits of its zoom. */
const OPENING_M = 88;
const OPENING_ZOOMS = [4.4, 8.5] as const;
/** A map without road users is fitted whole down to this zoom. */
const EMPTY_ZOOM = 1.6;
/** A picture of the same place within this many pixels is unchanged. */
const SAME_PX = 4;

export function fitScene({ editor, stage, layouts }: Context): void {
  const scene = layouts.made.peek()?.scene ?? editor.scene.peek();
  if (!scene) return;
  stage.resize();
  stage.invalidate('map');
  stage.glide.by((v) => v.fit(scene.map.box));
}

/** A map being made is framed with each new template; while its parameters change the picture stays. */
export function lookAtMade({ stage, layouts }: Context): void {
  let looked: string | null = null;
  effect(() => {
    const made = layouts.made.value;
    if (!layouts.isOpen.value) looked = null;
    if (!made || made.layout.template === looked) return;
    looked = made.layout.template;
    const { x0, y0, x1, y1 } = made.scene.map.box;
    const near = (v: number, far: number): number => Math.min(far, Math.max(-far, v));
    stage.glide.by((v) => {
      v.turn = 0;
      v.fit({ x0: near(x0, 62), y0: near(y0, 42), x1: near(x1, 62), y1: near(y1, 42) });
    });
  });
}

/** The same stretch of road on every screen, where most movement is: a junction with the start of its arms. */
export function lookAtOpened({ editor, stage }: Opening): void {
  const scene = editor.scene.peek();
  if (!scene) return;
  stage.resize();
  stage.glide.stop();
  const v = stage.view;
  const [min, max] = OPENING_ZOOMS;
  const h = v.h - v.inset.top - v.inset.bottom;
  const z = Math.max(min, Math.min(max, h / OPENING_M));
  if (scene.agents.size) v.fit(busyBox(scene), 1.1 * z, z);
  else v.fit(scene.map.box, z, EMPTY_ZOOM);
  const half = [(v.w - v.inset.left - v.inset.right) / v.z / 2, h / v.z / 2] as const;
  const { x0, y0, x1, y1 } = scene.map.box;
  const whole = !scene.agents.size && x1 - x0 <= 2 * half[0] && y1 - y0 <= 2 * half[1];
  if (!whole) v.centre(...openingCentre(scene, ...half));
  stage.invalidate('map');
  stage.viewChanged();
}

/** Keeps the selected road user centred during playback. */
export function followSelected({ editor, stage }: Opening): void {
  if (!editor.playhead.follow.peek() || !editor.playhead.playing.peek()) return;
  const a = editor.agent.peek();
  const p = a && poseAt(editor.reading.motionFor(a), editor.playhead.time.peek());
  if (!p) return;
  stage.view.centre(p.x, p.y);
  stage.viewChanged();
}

const moved = (a: Camera, b: Camera): boolean =>
  Math.hypot(a.cx - b.cx, a.cy - b.cy) * a.z > SAME_PX ||
  Math.abs(Math.log(a.z / b.z)) > 0.02 ||
  Math.abs(wrapAngle((a.turn ?? 0) - (b.turn ?? 0))) > 0.02;

/**
 * Undo and redo show their change: a camera moved with the step moves back, and for a change out of view the camera of
 * the step returns.
 */
export function lookWhereItWas(c: Opening): void {
  const { editor, stage } = c;
  editor.document.camera = () => stage.view.camera;
  const travelled = (step: HistoryStep, way: HistoryDirection): void => {
    const there = way === 'back' ? step.from : step.to;
    if (!there || !step.from || !step.to || !moved(there, stage.view.camera)) return;
    const a = step.agent === null ? undefined : editor.scene.peek()?.agents.get(step.agent);
    if (moved(step.from, step.to) || (a && !inView(c, a))) stage.glide.to(there);
  };
  editor.join({ travelled });
}

/** Are start and goal of a road user in the picture? */
function inView({ editor, stage }: Opening, a: Agent): boolean {
  const places = [startPose(a), editor.reading.goalPose(a)].filter((p) => p !== null);
  return places.every((p) => stage.view.shows(p.x, p.y, -20));
}

/** Nearer to a panel or to the edge than this a road user counts as out of view, pixels. */
const EDGE_PX = 24;
/** Margin around several that are brought into view, metres, and closest zoom. */
const AROUND_M = 12;

/** To show a road user with its goal the picture zooms out, down to this share of the zoom. */
const FURTHER = 0.6;

/** Where a road user will be at its goal time, by the recording until there is an answer; null away from the start. */
export function endShown(editor: Opening['editor'], a: Agent): Vec | null {
  if (editor.playhead.time.peek() > 0.05 || !canChange(a)) return null;
  if (a.goal.pos) return a.goal.pos;
  const m = editor.reading.motionFor(a);
  const end = poseAt(m, a.goal.time) ?? endPose(m);
  return end && [end.x, end.y];
}

/** Brings road users into view, if they are not; a single one with its end. */
export function reveal(c: Opening, ids: readonly string[]): void {
  bringIn(c, ids);
  whenItsEndIsKnown(c, ids, () => bringIn(c, ids));
}

/** The end is known with the futures; runs `does` then, unless the view was moved meanwhile. */
export function whenItsEndIsKnown({ editor, stage }: Opening, ids: readonly string[], does: () => void): void {
  const [id] = ids;
  if (ids.length !== 1 || editor.answers.motion.peek().futures.has(id)) return;
  const { cx, cy, z } = stage.glide.end;
  const end = effect(() => {
    const there = editor.answers.motion.value.futures.has(id);
    const left = editor.selection.value !== id;
    if (!there && !left) return;
    queueMicrotask(() => end());
    const v = stage.glide.end;
    if (!left && v.cx === cx && v.cy === cy && v.z === z && !editor.drag.active.peek()) does();
  });
}

function bringIn({ editor, stage }: Opening, ids: readonly string[]): void {
  const scene = editor.scene.peek();
  const ps = ids.flatMap((id) => {
    const a = scene?.agents.get(id);
    return (a && poseShown(editor, a)) ?? [];
  });
  const alone = ids.length === 1 ? scene?.agents.get(ids[0]) : undefined;
  const end = alone && endShown(editor, alone);
  const v = stage.view;
  const seen = (p: { x: number; y: number }): boolean => v.isClear(p.x, p.y, EDGE_PX);
  if (!ps.length || (ps.every(seen) && (!end || seen({ x: end[0], y: end[1] })))) return;
  const all = ps.map((p): Vec => [p.x, p.y]);
  const to = v.copy();
  to.fitPlaces(end ? [...all, end] : all, AROUND_M, v.z);
  // If the end is too far to be shown too, the picture stays near.
  if (!alone || to.z >= v.z * FURTHER) v.look(to.camera);
  else if (!ps.every(seen)) v.centre(ps[0].x, ps[0].y);
  stage.viewChanged();
}

/** A corner of the picture in the world, and its zoom. */
interface Corner {
  readonly at: Vec;
  readonly z: number;
}

/**
 * Keeps the selected ones in the picture when a panel takes space; one already outside stays outside. When the panel
 * gives the space back, the picture returns to its place.
 */
export function keepInView(c: Opening): void {
  const { editor, stage } = c;
  const v = stage.view;
  const corner = (): Corner => ({ at: v.from(0, 0), z: v.z });
  let back: { readonly to: Corner; readonly from: Corner } | null = null;
  stage.shrunk.listen((before) => {
    const all = editor.chosenOnes.flatMap((a) => poseShown(editor, a) ?? []);
    const seen = (by: View): boolean => all.every((p) => by.isClear(p.x, p.y, EDGE_PX));
    if (!seen(before) || seen(v) || editor.drag.active.peek()) return;
    const to = corner();
    bringIn(c, editor.selected.peek());
    back = { to, from: corner() };
  });
  stage.grown.listen(() => {
    const now = corner();
    const stayed = back?.from.z === now.z && v.away(back.from.at, { x: 0, y: 0 }) < 1;
    if (back && stayed) {
      v.z = back.to.z;
      v.put([0, 0], back.to.at);
      stage.viewChanged();
    }
    back = null;
  });
}

/**
 * The menu of the selection: beside its pressed button, else at the first of them; without a selection the menu of the
 * ground, in the middle.
 */
export function openMenu(c: Context): void {
  const { editor, stage, ui } = c;
  const [first, ...more] = editor.chosenOnes;
  const button = document.activeElement?.closest('[data-action="menu"]')?.getBoundingClientRect();
  if (first && button) {
    const { left, top } = stage.element.getBoundingClientRect();
    const at = { x: button.left - left, y: button.bottom - top };
    ui.openContextMenu({ ...at, on: more.length ? 'several' : 'road-user' });
    return;
  }
  if (first) reveal(c, [first.id]);
  const p = first && poseShown(editor, first);
  const v = stage.view;
  const [x, y] = p ? v.to(p.x, p.y) : [v.w / 2 - EDGE_PX, v.h / 3];
  const at = { x: x + EDGE_PX, y };
  ui.openContextMenu({ ...at, on: !first ? 'ground' : more.length ? 'several' : 'road-user' });
}
