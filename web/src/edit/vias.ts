// Places on the way of the selected road user: added on a path, moved, widened, given a time, taken away. Said once and
// used by handles, keys, fields and menus alike.
import { setVias, type Command } from '../model/document/commands';
import type { Vec } from '../model/base/geometry';
import { poseAt, type Motion } from '../model/base/motion';
import type { Agent } from '../model/document/scene';
import { heldTolerance, MOST_VIAS, nearestOn, placeIn, via, withNew, withVia, type Via } from '../model/document/vias';
import type { Editor } from './editor';
import { TEXTS } from '../texts/editing/via';

/** So far along its path somebody gets a via point where no place was pointed at, as a share of the time. */
const HALF_WAY = 0.5;

/** The motion in force of the selected road user, or one of its futures. */
const motionOf = (e: Editor, index = e.chosen.peek()): Motion | null => e.futures.peek()?.modes[index]?.motion ?? null;

/** Via points are counted from 1; one alone has no number. */
export const viaName = (a: Agent, i: number): string =>
  a.goal.via.length > 1 ? TEXTS.viaPointOf(i + 1) : TEXTS.viaPoint;

/** Why no more can be added; true where one can. */
export const roomForVia = (a: Agent): true | string => a.goal.via.length < MOST_VIAS || TEXTS.asManyAsCanBe(MOST_VIAS);

export interface Added {
  readonly command: Command;
  readonly index: number;
}

/** A via point at the place of a future that is nearest to `near`; without one, half way along the one in force. */
export function addVia(e: Editor, a: Agent, near: Vec | null, future?: number): Added | null {
  const m = motionOf(e, future);
  if (!m || roomForVia(a) !== true) return null;
  const end = a.goal.pos ? a.goal.time : Infinity;
  const time = near ? nearestOn(m, near).time : (m.first + (m.x.length - 1) * HALF_WAY) * 0.1;
  return addViaAt(e, a, Math.min(time, end - 0.5), future);
}

/** The same where a future is at a time. */
export function addViaAt(e: Editor, a: Agent, time: number, future?: number): Added | null {
  const m = motionOf(e, future);
  const at = m && poseAt(m, Math.max(0.5, time));
  if (!m || !at || roomForVia(a) !== true) return null;
  const round = (v: number): number => Math.round(v * 100) / 100;
  const pos = [round(at.x), round(at.y)] as const;
  const index = placeIn(a.goal.via, m, pos);
  return { index, command: setVias(a, withNew(a.goal.via, index, via(pos)), TEXTS.added(a.name)) };
}

/** One of them in another way; `fold` where it is one of many changes that follow each other. */
export function changeVia(a: Agent, i: number, patch: Partial<Via>, fold = false): Command | null {
  if (!a.goal.via[i]) return null;
  const done = 'tolerance' in patch ? TEXTS.toleranceChanged : 'time' in patch ? TEXTS.timeChanged : TEXTS.moved;
  const field = Object.keys(patch)[0];
  return setVias(a, withVia(a.goal.via, i, patch), done(a.name), fold ? `via:${i}:${field}:${a.id}` : undefined);
}

export const moveVia = (a: Agent, i: number, pos: Vec, fold = false): Command | null =>
  changeVia(a, i, { pos: Object.freeze([pos[0], pos[1]] as const) }, fold);

export const widenVia = (a: Agent, i: number, metres: number, fold = false): Command | null =>
  changeVia(a, i, { tolerance: heldTolerance(metres) }, fold);

export const removeVia = (a: Agent, i: number): Command | null =>
  a.goal.via[i] ? setVias(a, withVia(a.goal.via, i, null), TEXTS.removed(viaName(a, i), a.name)) : null;
