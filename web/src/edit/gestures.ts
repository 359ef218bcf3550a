// The pointer: hover, select, drag a handle, pan, zoom. Pointer moves are gathered and worked off once a frame.
import { clamp, project, wrapAngle, type Pose, type Vec } from '../model/geometry';
import { setBoth, setGoal, setStart, type Command } from '../model/commands';
import { canChange, startPose, type Agent, type GoalSpec, type StartSpec } from '../model/scene';
import { topSpeed } from '../model/domain';
import { speedForTip } from '../draw/handles';
import type { Stage } from '../draw/stage';
import type { Editor, Grip } from './editor';
import type { Asking } from './asking';
import { agentsAt, hitTest, type Hit, type HitContext } from './hit';
import { alongLane, laneWords, snapHeading, snapToLane, softStop } from './snap';
import { goalTime, pickFuture } from './moves';
import type { Picture } from './picture';

interface Mods {
  alt: boolean;
  shift: boolean;
  ctrl: boolean;
}
interface Press {
  id: number;
  x: number;
  y: number;
  hit: Hit;
  moved: boolean;
  pan: boolean;
  touch: boolean;
  cx: number;
  cy: number;
}
interface Drag {
  grip: Grip;
  agent: Agent;
  start: Pose;
  goal: Pose;
  grabX: number;
  grabY: number;
  lane: string | null;
  follow: boolean;
  command: Command | null;
}

const START_PX = 3;
const START_PX_TOUCH = 8;
const EDGE_PX = 32;
const EDGE_SPEED = 600;
const PILE_MS = 800;

export class Gestures {
  private press: Press | null = null;
  private drag: Drag | null = null;
  private at: { x: number; y: number } = { x: 0, y: 0 };
  private mods: Mods = { alt: false, shift: false, ctrl: false };
  private pending = false;
  private spaceHeld = false;
  private inside = false;
  private fingers = new Map<number, { x: number; y: number }>();
  private pile: { ids: string[]; index: number; time: number } | null = null;
  private lastFrame = 0;

  constructor(
    private readonly stage: Stage,
    private readonly editor: Editor,
    private readonly asking: Asking,
    private readonly picture: Picture,
  ) {
    const el = stage.element;
    el.addEventListener('pointerdown', (e) => this.down(e));
    el.addEventListener('pointermove', (e) => this.move(e));
    el.addEventListener('pointerup', (e) => this.up(e));
    el.addEventListener('pointercancel', (e) => {
      this.fingers.delete(e.pointerId);
      this.cancel();
    });
    el.addEventListener('pointerleave', () => {
      this.inside = false;
      if (!this.press) this.setHover({ kind: 'none' });
    });
    el.addEventListener('wheel', (e) => this.wheel(e), { passive: false });
    el.addEventListener('dblclick', (e) => this.doubleClick(e));
    addEventListener('keydown', (e) => this.modifier(e, true));
    addEventListener('keyup', (e) => this.modifier(e, false));
  }

  get dragging(): boolean {
    return this.drag !== null;
  }

  private xy(e: MouseEvent): { x: number; y: number } {
    const r = this.stage.element.getBoundingClientRect();
    return { x: e.clientX - r.left, y: e.clientY - r.top };
  }

  private context(touch = false): HitContext {
    return {
      editor: this.editor,
      view: this.stage.view,
      chips: this.picture.overlay.chips,
      timeTag: this.picture.overlay.timeTag,
      touch,
    };
  }

  private onCanvas = (e: Event): boolean => e.target instanceof HTMLCanvasElement || e.target === this.stage.element;

  private down(e: PointerEvent): void {
    if (!this.onCanvas(e)) return;
    const p = this.xy(e);
    this.fingers.set(e.pointerId, p);
    if (this.fingers.size > 1) {
      this.cancel();
      return;
    }
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    try {
      this.stage.element.setPointerCapture(e.pointerId);
    } catch {
      /* the pointer may be gone already */
    }
    const touch = e.pointerType === 'touch';
    const tool = this.editor.tool.peek();
    const pan = e.button === 1 || this.spaceHeld || tool === 'pan';
    const hit: Hit =
      pan || e.button === 2 || tool === 'measure' ? { kind: 'none' } : hitTest(this.context(touch), p.x, p.y);
    const v = this.stage.view;
    this.at = p;
    this.press = { id: e.pointerId, ...p, hit, moved: false, pan, touch, cx: v.cx, cy: v.cy };
  }

  private move(e: PointerEvent): void {
    const p = this.xy(e);
    this.inside = true;
    if (this.fingers.has(e.pointerId)) {
      if (this.fingers.size === 2) {
        this.pinch(e.pointerId, p);
        return;
      }
      this.fingers.set(e.pointerId, p);
    }
    this.at = p;
    this.mods = { alt: e.altKey, shift: e.shiftKey, ctrl: e.ctrlKey || e.metaKey };
    if (!this.press && !this.onCanvas(e)) {
      this.setHover({ kind: 'none' });
      return;
    }
    this.pending = true;
    this.stage.invalidate();
  }

  /** Two fingers pan and zoom at once. */
  private pinch(id: number, p: { x: number; y: number }): void {
    const other = [...this.fingers].find(([k]) => k !== id)![1];
    const old = this.fingers.get(id)!;
    const v = this.stage.view;
    const before = Math.hypot(old.x - other.x, old.y - other.y),
      after = Math.hypot(p.x - other.x, p.y - other.y);
    v.panBy((p.x - old.x) / 2, (p.y - old.y) / 2);
    v.zoomAt((p.x + other.x) / 2, (p.y + other.y) / 2, after / Math.max(1, before));
    this.fingers.set(id, p);
    this.stage.viewChanged();
  }

  /** Works off the newest pointer position; called by the stage before it paints. */
  frame(now: number): void {
    const dt = this.lastFrame ? Math.min(0.05, (now - this.lastFrame) / 1000) : 0.016;
    this.lastFrame = now;
    if (this.drag && this.press && this.edgeScroll(dt)) this.pending = true;
    if (!this.pending) return;
    this.pending = false;
    const press = this.press;
    if (!press) {
      this.setHover(
        this.editor.tool.peek() === 'select' ? hitTest(this.context(), this.at.x, this.at.y) : { kind: 'none' },
      );
      return;
    }
    if (
      !press.moved &&
      Math.hypot(this.at.x - press.x, this.at.y - press.y) >= (press.touch ? START_PX_TOUCH : START_PX)
    ) {
      press.moved = true;
      this.begin(press);
    }
    if (!press.moved) return;
    if (this.drag) this.dragTo(this.drag);
    else if (this.editor.tool.peek() === 'measure' && !press.pan) {
      const v = this.stage.view;
      this.editor.measure.value = { a: v.from(press.x, press.y), b: v.from(this.at.x, this.at.y) };
    } else if (press.pan) {
      const v = this.stage.view;
      v.cx = press.cx - (this.at.x - press.x) / v.z;
      v.cy = press.cy + (this.at.y - press.y) / v.z;
      this.stage.viewChanged();
    }
  }

  private begin(press: Press): void {
    const { editor } = this;
    let hit = press.hit;
    if (editor.tool.peek() === 'measure' && !press.pan) return;
    if (hit.kind === 'agent' && editor.time.peek() < 0.05) {
      editor.select(hit.id);
      hit = { kind: 'grip', grip: { part: 'start', handle: 'body' } };
    }
    const a = editor.agent.peek();
    const start = a && startPose(a);
    if (hit.kind !== 'grip' || !a || !start || !canChange(a)) {
      press.pan = true;
      this.stage.element.dataset.cursor = 'grabbing';
      return;
    }
    const goal = editor.goalPose(a) ?? {
      ...start,
      x: start.x + Math.cos(start.heading) * 20,
      y: start.y + Math.sin(start.heading) * 20,
    };
    const [gx, gy] = this.stage.view.from(press.x, press.y);
    const spec = hit.grip.part === 'goal' ? a.goal : a.start;
    // A heading set by hand is never overwritten by a lane.
    const startOnLane =
      hit.grip.part === 'start' &&
      snapToLane(editor.scene.peek()!.map, a, start.x, start.y, start.heading, this.stage.view.z, null).lane !== null;
    const follow = spec.heading === null || editor.snappedHeadings.has(`${hit.grip.part}:${a.id}`) || startOnLane;
    editor.playing.value = false;
    editor.focusPart.value = hit.grip.part;
    editor.history?.begin();
    this.drag = { grip: hit.grip, agent: a, start, goal, grabX: gx, grabY: gy, lane: null, follow, command: null };
    editor.drag.value = { grip: hit.grip, laneName: null, laneId: null, stop: null };
    editor.changes.value = [];
    editor.notify(null);
    this.stage.element.dataset.cursor =
      hit.grip.handle === 'body' ? 'grabbing' : hit.grip.handle === 'heading' ? 'crosshair' : 'resize';
    this.stage.invalidate('agents');
  }

  private dragTo(d: Drag): void {
    const { editor } = this;
    const [wx, wy] = this.stage.view.from(this.at.x, this.at.y);
    const command = this.commandFor(d, wx, wy);
    if (!command) return;
    d.command = command;
    editor.preview(command);
    editor.liveReach.value = null;
    this.asking.preview(d.agent.id);
    this.stage.invalidate('overlay');
  }

  private commandFor(d: Drag, wx: number, wy: number): Command | null {
    const { agent: a, grip } = d;
    const pose = grip.part === 'goal' ? d.goal : d.start;
    const put = (patch: Partial<GoalSpec>): Command => {
      if (this.mods.ctrl && grip.handle !== 'time') return this.both(d, patch);
      return grip.part === 'goal'
        ? setGoal(a, { ...a.goal, ...patch })
        : { ...setStart(a, { ...a.start, ...patch } as StartSpec), name: `Start of ${a.name} moved` };
    };
    switch (grip.handle) {
      case 'body':
        return this.moveBody(d, pose, wx, wy, put);
      case 'heading': {
        this.editor.snappedHeadings.delete(`${grip.part}:${a.id}`);
        const raw = Math.atan2(pose.y - wy, pose.x - wx);
        const heading = snapHeading(
          this.editor.scene.peek()!.map,
          a,
          pose.x,
          pose.y,
          raw,
          this.mods.alt ? 'fine' : this.mods.shift ? 'steps' : 'lane',
        );
        return {
          ...put({ heading, ...this.keepGoal(d) }),
          name: `${grip.part === 'goal' ? 'Goal heading' : 'Heading'} of ${a.name} changed`,
        };
      }
      case 'speed':
        return {
          ...put({ speed: this.speedAt(d, pose, wx, wy), ...this.keepGoal(d) }),
          name: `${grip.part === 'goal' ? 'Goal speed' : 'Speed'} of ${a.name} changed`,
        };
      case 'time': {
        const raw = a.goal.time + (this.at.x - this.press!.x) / 40;
        const grid = this.mods.alt ? 0.01 : this.mods.shift || Math.abs(raw - Math.round(raw)) < 0.15 ? 1 : 0.1;
        const time = goalTime(this.editor.scene.peek(), Math.round(raw / grid) * grid);
        return {
          ...put({ time: Math.round(time * 100) / 100, ...this.keepGoal(d) }),
          name: `Goal time of ${a.name} changed`,
        };
      }
    }
  }

  /** Turning a goal's tiller means that the goal is wanted here: a free position becomes fixed with it. */
  private keepGoal(d: Drag): Partial<GoalSpec> {
    return d.grip.part === 'goal' && !d.agent.goal.pos ? { pos: Object.freeze([d.goal.x, d.goal.y] as const) } : {};
  }

  private moveBody(d: Drag, pose: Pose, wx: number, wy: number, put: (p: Partial<GoalSpec>) => Command): Command {
    const { editor } = this;
    const { agent: a, grip } = d;
    const map = editor.scene.peek()!.map;
    const x = pose.x + wx - d.grabX,
      y = pose.y + wy - d.grabY;
    const start = startPose(a)!;
    // A start prefers lanes in its own direction; a goal may lie on any lane, best one that leads away from the start.
    const travel =
      grip.part === 'goal' && Math.hypot(x - start.x, y - start.y) > 6 ? Math.atan2(y - start.y, x - start.x) : null;
    const hint = !d.follow || grip.part === 'start' ? pose.heading : d.lane ? null : travel;
    const s =
      (this.mods.shift && alongLane(map, d.lane, x, y)) ||
      (this.mods.alt
        ? { x, y, laneHeading: null, lane: null }
        : snapToLane(map, a, x, y, hint, this.stage.view.z, d.lane, travel));
    const stop =
      s.lane && !this.mods.alt && a.type === 'vehicle'
        ? softStop(editor.scene.peek()!, s.lane, a, project(s.lane.line, s.x, s.y).s, this.stage.view.z)
        : null;
    if (stop) Object.assign(s, { x: stop.x, y: stop.y, laneHeading: stop.heading });
    d.lane = s.lane?.id ?? null;
    const key = `${grip.part}:${a.id}`;
    const patch: { pos: Vec; heading?: number | null } = { pos: Object.freeze([s.x, s.y] as const) };
    if (d.follow && s.laneHeading !== null) {
      patch.heading = wrapAngle(s.laneHeading);
      editor.snappedHeadings.add(key);
    } else if (d.follow && grip.part === 'goal') {
      patch.heading = null;
      editor.snappedHeadings.delete(key);
    }
    const laneName = laneWords(map, a, s.x, s.y, s.laneHeading);
    const old = editor.drag.peek();
    if (old?.laneId !== d.lane || old?.laneName !== laneName || (old.stop === null) !== (stop === null))
      editor.drag.value = { grip, laneId: d.lane, laneName, stop };
    return put(patch);
  }

  /** Ctrl: start and goal move, turn or change speed together. */
  private both(d: Drag, patch: Partial<GoalSpec>): Command {
    const a = d.agent;
    const start: StartSpec = { pos: a.start.pos, heading: a.start.heading, speed: a.start.speed };
    const goal: GoalSpec = { ...a.goal };
    const from = d.grip.part === 'goal' ? d.goal : d.start;
    const s = { ...start },
      g = { ...goal };
    if (patch.pos) {
      const dx = patch.pos[0] - from.x,
        dy = patch.pos[1] - from.y;
      s.pos = Object.freeze([d.start.x + dx, d.start.y + dy] as const);
      g.pos = Object.freeze([d.goal.x + dx, d.goal.y + dy] as const);
    } else if (patch.heading != null) {
      const turn = patch.heading - from.heading;
      s.heading = wrapAngle(d.start.heading + turn);
      g.heading = wrapAngle(d.goal.heading + turn);
    } else if (patch.speed != null) s.speed = g.speed = patch.speed;
    return setBoth(a, s, g);
  }

  private speedAt(d: Drag, pose: Pose, wx: number, wy: number): number {
    const a = d.agent;
    const raw = speedForTip(this.stage.view, a, pose, wx, wy);
    const unit = a.type === 'pedestrian' ? 0.1 : 1 / 3.6;
    const step = this.mods.shift ? unit * 10 : unit;
    const v = this.mods.alt ? raw : Math.round(raw / step) * step;
    return clamp(v, 0, topSpeed(a));
  }

  private edgeScroll(dt: number): boolean {
    if (!this.press?.moved || matchMedia('(prefers-reduced-motion: reduce)').matches) return false;
    const v = this.stage.view;
    const push = (at: number, size: number) =>
      at < EDGE_PX ? (EDGE_PX - at) / EDGE_PX : at > size - EDGE_PX ? -(at - size + EDGE_PX) / EDGE_PX : 0;
    const px = clamp(push(this.at.x, v.w), -1, 1),
      py = clamp(push(this.at.y, v.h), -1, 1);
    if (!px && !py) return false;
    v.panBy(px * EDGE_SPEED * dt, py * EDGE_SPEED * dt);
    this.stage.viewChanged();
    return true;
  }

  private up(e: PointerEvent): void {
    this.fingers.delete(e.pointerId);
    const press = this.press;
    if (!press || press.id !== e.pointerId) return;
    this.at = this.xy(e);
    if (this.drag) {
      this.pending = true;
      this.frame(performance.now());
    }
    this.press = null;
    const d = this.drag;
    this.drag = null;
    delete this.stage.element.dataset.cursor;
    if (d) this.release(d);
    else if (!press.moved) this.click(press, e);
    this.stage.invalidate('agents', 'overlay');
  }

  private release(d: Drag): void {
    const { editor } = this;
    editor.drag.value = null;
    if (d.command) editor.commit(d.command);
    else editor.cancelPreview();
  }

  private click(press: Press, e: PointerEvent): void {
    const { editor } = this;
    if (press.pan || editor.tool.peek() !== 'select') {
      editor.measure.value = null;
      return;
    }
    const hit = press.hit;
    const a = editor.agent.peek();
    if (hit.kind === 'agent') {
      editor.playing.value = false;
      editor.select(this.throughPile(hit.pile, e.timeStamp));
    } else if (hit.kind === 'future' && a) {
      const c = pickFuture(editor, a, hit.index);
      if (c && a.chosen !== hit.index) editor.run(c);
    } else if (hit.kind === 'none') editor.select(null);
    else if (hit.kind === 'grip') {
      editor.focusPart.value = hit.grip.part;
      const below =
        hit.grip.part === 'start' && hit.grip.handle === 'body' ? agentsAt(this.context(), press.x, press.y) : [];
      if (below.length > 1) editor.select(this.throughPile(below, e.timeStamp));
    }
  }

  /** A second click on a heap of boxes takes the next one below. */
  private throughPile(ids: string[], time: number): string {
    const p = this.pile;
    const same = p && p.ids.join() === ids.join() && time - p.time < PILE_MS;
    const index = same ? (p.index + 1) % ids.length : 0;
    this.pile = { ids, index, time };
    return ids[index];
  }

  private doubleClick(e: MouseEvent): void {
    if (!this.onCanvas(e)) return;
    const p = this.xy(e);
    if (hitTest(this.context(), p.x, p.y).kind === 'none') {
      this.stage.view.zoomAt(p.x, p.y, 1.6);
      this.stage.viewChanged();
    }
  }

  /** Esc: everything back to where it was before the press. */
  cancel(): boolean {
    const d = this.drag;
    this.press = null;
    this.drag = null;
    delete this.stage.element.dataset.cursor;
    if (!d) return false;
    const { editor } = this;
    editor.drag.value = null;
    editor.cancelPreview();
    editor.draft.value = null;
    editor.liveReach.value = null;
    editor.status.value = { kind: 'ready' };
    this.asking.cancelPreviews();
    editor.say('Put back.');
    this.stage.invalidate('agents', 'overlay');
    return true;
  }

  private wheel(e: WheelEvent): void {
    if (!this.onCanvas(e)) return;
    e.preventDefault();
    const v = this.stage.view;
    if (e.shiftKey && !e.ctrlKey) v.panBy(-(e.deltaX || e.deltaY), 0);
    else {
      const p = this.xy(e);
      const lines = e.deltaMode === 1 ? 33 : 1;
      v.zoomAt(p.x, p.y, Math.exp(-e.deltaY * lines * (e.ctrlKey ? 0.006 : 0.0016)));
    }
    if (this.drag) this.pending = true;
    this.stage.viewChanged();
  }

  private modifier(e: KeyboardEvent, down: boolean): void {
    if (e.key === ' ') {
      this.spaceHeld = down;
      if (this.drag && this.press && down) e.preventDefault();
    }
    if (!this.drag || !['Alt', 'Shift', 'Control', 'Meta'].includes(e.key)) return;
    e.preventDefault();
    this.mods = { alt: e.altKey, shift: e.shiftKey, ctrl: e.ctrlKey || e.metaKey };
    this.pending = true;
    this.stage.invalidate();
  }

  private setHover(hit: Hit): void {
    const { editor } = this;
    editor.hover.value = hit.kind === 'agent' ? hit.id : null;
    editor.hoverFuture.value = hit.kind === 'future' ? hit.index : null;
    editor.hoverGrip.value = hit.kind === 'grip' ? hit.grip : null;
    const style = this.stage.element.dataset;
    const cursor =
      hit.kind === 'grip'
        ? hit.grip.handle === 'body'
          ? 'grab'
          : hit.grip.handle === 'heading'
            ? 'crosshair'
            : 'resize'
        : hit.kind === 'agent'
          ? editor.time.peek() < 0.05
            ? 'grab'
            : 'pointer'
          : hit.kind === 'future'
            ? 'pointer'
            : { select: '', pan: 'grab', measure: 'crosshair' }[editor.tool.peek()];
    if (style.cursor !== cursor) style.cursor = cursor;
    this.stage.invalidate('overlay');
  }

  /** Pointer position for the hover card; null outside the stage. */
  get pointer(): { x: number; y: number } | null {
    return this.inside ? this.at : null;
  }
}
