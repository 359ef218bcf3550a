// What lies under the pointer. First match wins: handles, letters, the chosen future, road users, other futures.
import { insideBox, type Vec } from '../model/geometry';
import { canChange, startPose, type Agent } from '../model/scene';
import { FLAG_HEIGHT, handlePoints } from '../draw/handles';
import type { Rect } from '../draw/labels';
import { sizeOnScreen } from '../draw/sprites';
import type { Chip } from '../draw/strokes';
import type { View } from '../draw/view';
import type { Editor, Grip } from './editor';
import type { RoadSign } from './overlay-verdicts';
import { frameAround, poseShown } from './frame';
import { onPennant, type Pennant } from '../draw/marks';

export type Hit =
  | { kind: 'grip'; grip: Grip }
  | { kind: 'future'; index: number }
  | { kind: 'by road' }
  | { kind: 'agent'; id: string; pile: string[] }
  | { kind: 'frame'; handle: FrameHandle }
  /** The small flag at the goal of somebody who is not selected. */
  | { kind: 'pennant'; id: string }
  | { kind: 'none' };

/** What one can do with the frame around several: move them, turn them, spread them. */
export type FrameHandle = 'move' | 'turn' | 'spread';

export const NOTHING: Hit = { kind: 'none' };

const near = (p: readonly [number, number], x: number, y: number, r: number): boolean =>
  Math.hypot(p[0] - x, p[1] - y) <= r;

const inRect = (r: Rect, x: number, y: number): boolean => x >= r.x && x <= r.x + r.w && y >= r.y && y <= r.y + r.h;

/** On a flag with its foot at a place. */
const onFlag = ([fx, fy]: Vec, x: number, y: number): boolean =>
  x > fx - 6 && x < fx + 26 && y > fy - FLAG_HEIGHT - 2 && y < fy + 5;

export interface HitContext {
  editor: Editor;
  view: View;
  chips: readonly Chip[];
  timeTag: Rect | null;
  roadSign: RoadSign | null;
  pennants: readonly Pennant[];
  touch: boolean;
}

export function hitTest(c: HitContext, x: number, y: number): Hit {
  const a = c.editor.agent.value;
  if (a && canChange(a)) {
    if (c.roadSign?.label && inRect(c.roadSign.label, x, y)) return { kind: 'by road' };
    const grip = a.locked ? null : gripAt(c, a, x, y);
    if (grip) return { kind: 'grip', grip };
    if (c.roadSign?.flag && onFlag(c.roadSign.flag, x, y)) return { kind: 'by road' };
    for (const chip of c.chips)
      if (near([chip.x, chip.y], x, y, c.touch ? 22 : 11)) return { kind: 'future', index: chip.index };
    if (c.editor.layers.value.futures && futureAt(c, c.editor.chosen.value, x, y))
      return { kind: 'future', index: c.editor.chosen.value };
  }
  const handle = frameHandleAt(c, x, y);
  if (handle && handle !== 'move') return { kind: 'frame', handle };
  const pile = agentsAt(c, x, y);
  if (pile.length) return { kind: 'agent', id: pile[0], pile };
  if (handle) return { kind: 'frame', handle };
  const pennant = c.pennants.find((p) => onPennant(p, x, y));
  if (pennant) return { kind: 'pennant', id: pennant.id };
  const f = c.editor.futures.value;
  if (a && f && c.editor.layers.value.futures)
    for (let i = 0; i < f.modes.length; i++) if (futureAt(c, i, x, y)) return { kind: 'future', index: i };
  return NOTHING;
}

/** The knob turns, the corners spread, the edge moves. */
function frameHandleAt(c: HitContext, x: number, y: number): FrameHandle | null {
  const f = frameAround(c.editor, c.view);
  if (!f || c.editor.time.value > 0.05) return null;
  const r = c.touch ? 22 : 10;
  if (near(f.knob, x, y, r)) return 'turn';
  if (f.corners.some((p) => near(p, x, y, r))) return 'spread';
  const { box: b } = f;
  const edge = c.touch ? 14 : 5;
  const within = (grow: number): boolean =>
    x > b.x - grow && x < b.x + b.w + grow && y > b.y - grow && y < b.y + b.h + grow;
  return within(edge) && !within(-edge) ? 'move' : null;
}

function gripAt(c: HitContext, a: Agent, x: number, y: number): Grip | null {
  const { view: v, editor } = c;
  const r = c.touch ? 22 : 11;
  const goal = editor.goalPose(a);
  if (goal) {
    const g = handlePoints(v, a, goal);
    if (c.timeTag && inRect(c.timeTag, x, y)) return { part: 'goal', handle: 'time' };
    if (goal.set && near(g.tip, x, y, r)) return { part: 'goal', handle: 'speed' };
    if (goal.set && near(g.knob, x, y, r)) return { part: 'goal', handle: 'heading' };
    if (onFlag(g.centre, x, y)) return { part: 'goal', handle: 'body' };
    if (onBox(v, a, goal, x, y)) return { part: 'goal', handle: 'body' };
  }
  const start = startPose(a);
  if (!start || editor.time.value > 0.05) return null;
  const s = handlePoints(v, a, start);
  if (near(s.tip, x, y, r)) return { part: 'start', handle: 'speed' };
  if (near(s.knob, x, y, r)) return { part: 'start', handle: 'heading' };
  return onBox(v, a, start, x, y) ? { part: 'start', handle: 'body' } : null;
}

function onBox(v: View, a: Agent, p: { x: number; y: number; heading: number }, x: number, y: number): boolean {
  const [l, w] = sizeOnScreen(a, v.z);
  const [wx, wy] = v.from(x, y);
  return insideBox(p, Math.max(l, 16) / v.z, Math.max(w, 16) / v.z, wx, wy, 4 / v.z);
}

/** Everybody under the pointer, moving before parked, small before large. */
export function agentsAt(c: HitContext, x: number, y: number): string[] {
  const scene = c.editor.scene.value;
  if (!scene) return [];
  const [wx, wy] = c.view.from(x, y);
  const found: Agent[] = [];
  for (const a of scene.agents.values()) {
    const p = poseShown(c.editor, a);
    if (!p || Math.abs(p.x - wx) > 20 + a.length || Math.abs(p.y - wy) > 20 + a.length) continue;
    if (onBox(c.view, a, p, x, y)) found.push(a);
  }
  found.sort((p, q) => Number(p.parked) - Number(q.parked) || p.length * p.width - q.length * q.width);
  return found.map((a) => a.id);
}

function futureAt(c: HitContext, index: number, x: number, y: number): boolean {
  const m = c.editor.futures.value?.modes[index]?.motion;
  if (!m) return false;
  const reach = c.touch ? 14 : 5;
  let px = c.view.x(m.x[0]),
    py = c.view.y(m.y[0]);
  for (let i = 1; i < m.x.length; i++) {
    const qx = c.view.x(m.x[i]),
      qy = c.view.y(m.y[i]);
    const dx = qx - px,
      dy = qy - py,
      len2 = dx * dx + dy * dy;
    const k = len2 > 0 ? Math.max(0, Math.min(1, ((x - px) * dx + (y - py) * dy) / len2)) : 0;
    if (Math.hypot(x - px - dx * k, y - py - dy * k) <= reach) return true;
    px = qx;
    py = qy;
  }
  return false;
}
