// The object under the pointer. First match wins: handles, letters, the chosen future, road users, other futures.
import { insideBox, type OnLine, type Vec } from '../../model/base/geometry';
import type { Motion } from '../../model/base/motion';
import { canChange, startPose, type Agent } from '../../model/document/scene';
import { FLAG, handlePoints } from '../../draw/handles';
import type { Rect } from '../../draw/labels';
import { sizeOnScreen } from '../../draw/sprites';
import type { Chip } from '../../draw/strokes';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';
import type { HandlePart } from '../session/drag';
import type { Grip, HandleName } from '../session/drag';
import { NOTHING, type FrameHandle, type Hit, type ToolHandle } from './chart';
import { pinsApart } from '../moves/pins';
import type { RoadSign } from '../overlay/verdicts';
import { signalAway } from './on-the-map';
import { frameAround, poseShown } from '../overlay/frame';
import { onPennant, ringRadius, type Pennant } from '../../draw/marks';

const near = (p: readonly [number, number], x: number, y: number, r: number): boolean =>
  Math.hypot(p[0] - x, p[1] - y) <= r;

export const inRect = (r: Rect, x: number, y: number): boolean =>
  x >= r.x && x <= r.x + r.w && y >= r.y && y <= r.y + r.h;

/** A finger takes objects within this many pixels. */
const FINGER_PX = 24;

/** The same for a signal's stop line: more would leave no room for its lane. */
export const SIGNAL_PX = 16;

/** A flag is grabbed within this many pixels around it. */
const AROUND_FLAG_PX = 4;

/** Is a place on a flag with this foot? */
const onFlag = (v: View, foot: Vec, x: number, y: number): boolean => flagAway(v, foot, x, y) === 0;

/** Distance of a place from a flag, in pixels. */
function flagAway({ grip: k }: View, [fx, fy]: Vec, x: number, y: number): number {
  const around = AROUND_FLAG_PX * k;
  const dx = Math.max(fx - around - x, 0, x - (fx + FLAG.width * k + around));
  const dy = Math.max(fy - FLAG.height * k - around - y, 0, y - (fy + around));
  return Math.hypot(dx, dy);
}

export interface HitContext {
  editor: Editor;
  view: View;
  chips: readonly Chip[];
  timeTag: Rect | null;
  edgeTag: Rect | null;
  roadSign: RoadSign | null;
  /** The tool handle painted at a place. */
  toolHandleAt(x: number, y: number): ToolHandle | null;
  pennants: readonly Pennant[];
  touch: boolean;
}

export function hitTest(c: HitContext, x: number, y: number): Hit {
  const a = c.editor.agent.value;
  if (a && canChange(a)) {
    if (c.roadSign?.label && inRect(c.roadSign.label, x, y)) return { kind: 'by-road' };
    const held = gripAt(c, a, x, y);
    // The flag of a locked road user is still shown: dragging it explains the lock.
    const grip = a.locked && !(held?.part === 'goal' && held.handle === 'body') ? null : held;
    // The tool handle is small; a flag or a box behind it has other places to press.
    const handle = a.locked || (grip && grip.handle !== 'body') ? null : c.toolHandleAt(x, y);
    if (handle) return { kind: 'handle', handle };
    if (grip) return { kind: 'grip', grip };
    if (c.roadSign?.flag && onFlag(c.view, c.roadSign.flag, x, y)) return { kind: 'by-road' };
    for (const chip of c.chips)
      if (near([chip.x, chip.y], x, y, c.touch ? FINGER_PX : 11)) return { kind: 'future', index: chip.index };
    if (c.editor.view.layers.value.futures && futureAt(c, c.editor.reading.chosen.value, x, y))
      return { kind: 'future', index: c.editor.reading.chosen.value };
  }
  const handle = frameHandleAt(c, x, y);
  if (handle && handle !== 'move') return { kind: 'frame', handle };
  const pile = agentsAt(c, x, y);
  if (pile.length) return { kind: 'agent', id: pile[0], pile };
  const beside = c.touch ? nearestTo(c, x, y) : null;
  if (beside) return { kind: 'agent', id: beside, pile: [beside], beside: true };
  if (handle) return { kind: 'frame', handle };
  const pennant = c.pennants.find((p) => onPennant(p, x, y));
  if (pennant) return { kind: 'pennant', id: pennant.id };
  const f = c.editor.reading.futures.value;
  if (a && f && c.editor.view.layers.value.futures)
    for (let i = 0; i < f.modes.length; i++) if (futureAt(c, i, x, y)) return { kind: 'future', index: i };
  if (a && c.editor.view.layers.value.futures)
    for (const { pin, motion } of pinsApart(c.editor)) if (wayAt(c, motion, x, y)) return { kind: 'pinned', pin };
  return NOTHING;
}

/** The knob turns, the corners spread, the edge moves. */
function frameHandleAt(c: HitContext, x: number, y: number): FrameHandle | null {
  const f = frameAround(c.editor, c.view);
  if (!f || c.editor.playhead.time.value > 0.05) return null;
  const r = c.touch ? FINGER_PX : 10;
  if (near(f.knob, x, y, r)) return 'turn';
  if (f.corners.some((p) => near(p, x, y, r))) return 'spread';
  const { box: b } = f;
  const edge = c.touch ? 14 : 5;
  const within = (grow: number): boolean =>
    x > b.x - grow && x < b.x + b.w + grow && y > b.y - grow && y < b.y + b.h + grow;
  return within(edge) && !within(-edge) ? 'move' : null;
}

const EDGE: Grip = { part: 'goal', handle: 'body', edge: true };

function gripAt(c: HitContext, a: Agent, x: number, y: number): Grip | null {
  if (c.touch) return gripForFinger(c, a, x, y);
  const { view: v, editor } = c;
  const r = 11;
  const via = viaAt(v, a, x, y);
  if (via) return via;
  const goal = editor.reading.goalPose(a);
  if (goal) {
    const g = handlePoints(v, a, goal);
    if (c.edgeTag && inRect(c.edgeTag, x, y)) return EDGE;
    if (c.timeTag && inRect(c.timeTag, x, y)) return { part: 'goal', handle: 'time' };
    if (goal.set && near(g.tip, x, y, r)) return { part: 'goal', handle: 'speed' };
    if (goal.set && near(g.knob, x, y, r)) return { part: 'goal', handle: 'heading' };
    if (onFlag(v, g.centre, x, y)) return { part: 'goal', handle: 'body' };
    if (onBox(v, a, goal, x, y)) return { part: 'goal', handle: 'body' };
  }
  const start = startPose(a);
  if (!start || editor.playhead.time.value > 0.05) return null;
  const s = handlePoints(v, a, start);
  if (near(s.tip, x, y, r)) return { part: 'start', handle: 'speed' };
  if (near(s.knob, x, y, r)) return { part: 'start', handle: 'heading' };
  return onBox(v, a, start, x, y) ? { part: 'start', handle: 'body' } : null;
}

/** The diamond of a via point, or its ring where that is elsewhere. */
function viaAt(v: View, a: Agent, x: number, y: number): Grip | null {
  const away = a.goal.via.map((via) => v.away(via.pos, { x, y }));
  const at = away.findIndex((d) => d <= 10);
  if (at >= 0) return { part: 'goal', handle: 'via', index: at };
  const ring = away.findIndex((d, i) => Math.abs(d - ringRadius(v, a.goal.via[i].tolerance)) <= 5);
  return ring < 0 ? null : { part: 'goal', handle: 'ring', index: ring };
}

/** The handle nearest to a finger: it covers several, and one under it wins over one beside it. */
function gripForFinger(c: HitContext, a: Agent, x: number, y: number): Grip | null {
  const { view: v, editor } = c;
  let best: Grip | null = null;
  let least = FINGER_PX;
  const offer = (grip: Grip, away: number): void => {
    if (away >= least) return;
    least = away;
    best = grip;
  };
  const point = (part: HandlePart, handle: HandleName, p: Vec): void =>
    offer({ part, handle }, Math.hypot(p[0] - x, p[1] - y));
  const goal = editor.reading.goalPose(a);
  if (goal) {
    const g = handlePoints(v, a, goal);
    if (c.edgeTag) offer(EDGE, rectAway(c.edgeTag, x, y));
    if (c.timeTag) offer({ part: 'goal', handle: 'time' }, rectAway(c.timeTag, x, y));
    offer({ part: 'goal', handle: 'body' }, Math.min(flagAway(v, g.centre, x, y), boxAway(v, a, goal, x, y)));
    if (goal.set) {
      point('goal', 'speed', g.tip);
      point('goal', 'heading', g.knob);
    }
  }
  a.goal.via.forEach((via, index) => {
    const away = v.away(via.pos, { x, y });
    offer({ part: 'goal', handle: 'via', index }, away);
    // A finger inside the ring takes the point, unless it is nearer to the ring.
    offer({ part: 'goal', handle: 'ring', index }, Math.abs(away - ringRadius(v, via.tolerance)) + 6);
  });
  const start = startPose(a);
  if (!start || editor.playhead.time.value > 0.05) return best;
  const s = handlePoints(v, a, start);
  offer({ part: 'start', handle: 'body' }, boxAway(v, a, start, x, y));
  point('start', 'speed', s.tip);
  point('start', 'heading', s.knob);
  return best;
}

const rectAway = (r: Rect, x: number, y: number): number =>
  Math.hypot(Math.max(r.x - x, 0, x - r.x - r.w), Math.max(r.y - y, 0, y - r.y - r.h));

/** Distance of a place from the box of a road user, in pixels. */
function boxAway(v: View, a: Agent, p: OnLine, x: number, y: number): number {
  const [l, w] = sizeOnScreen(a, v.z);
  const [px, py] = v.to(p.x, p.y);
  const [dx, dy] = [x - px, y - py];
  const [right, down] = v.ahead(p.heading);
  const ahead = Math.abs(dx * right + dy * down) - l / 2,
    aside = Math.abs(dy * right - dx * down) - w / 2;
  return Math.hypot(Math.max(0, ahead), Math.max(0, aside));
}

/**
 * The road user whose box is nearest to a finger on the empty picture; null where a signal is nearer, which it can take
 * while nothing is selected.
 */
function nearestTo(c: HitContext, x: number, y: number): string | null {
  let best: string | null = null;
  const scene = c.editor.scene.value;
  const signal = scene && !c.editor.selected.value.length ? signalAway(scene, c.view.from(x, y)) * c.view.z : Infinity;
  let least = signal <= SIGNAL_PX ? signal : FINGER_PX;
  for (const a of c.editor.scene.value?.agents.values() ?? []) {
    const p = poseShown(c.editor, a);
    const away = p ? boxAway(c.view, a, p, x, y) : Infinity;
    if (away >= least) continue;
    least = away;
    best = a.id;
  }
  return best;
}

function onBox(v: View, a: Agent, p: { x: number; y: number; heading: number }, x: number, y: number): boolean {
  const [l, w] = sizeOnScreen(a, v.z);
  const [wx, wy] = v.from(x, y);
  return insideBox(p, Math.max(l, 16) / v.z, Math.max(w, 16) / v.z, wx, wy, 4 / v.z);
}

/** All road users under the pointer, moving before parked, small before large. */
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
  const m = c.editor.reading.futures.value?.modes[index]?.motion;
  return m !== undefined && wayAt(c, m, x, y);
}

function wayAt(c: HitContext, m: Motion, x: number, y: number): boolean {
  const reach = c.touch ? 14 : 5;
  let p = c.view.to(m.x[0], m.y[0]);
  for (let i = 1; i < m.x.length; i++) {
    const q = c.view.to(m.x[i], m.y[i]);
    if (awayFrom([p, q], x, y) <= reach) return true;
    p = q;
  }
  return false;
}

/** Distance of a place from a line, in pixels. */
export function awayFrom([[px, py], [qx, qy]]: readonly [Vec, Vec], x: number, y: number): number {
  const [dx, dy] = [qx - px, qy - py];
  const len2 = dx * dx + dy * dy;
  const k = len2 > 0 ? Math.max(0, Math.min(1, ((x - px) * dx + (y - py) * dy) / len2)) : 0;
  return Math.hypot(x - px - dx * k, y - py - dy * k);
}
