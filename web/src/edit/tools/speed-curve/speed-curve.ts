// The drawn speed profile of the selected road user: its points are moved, added and removed, and the effect is shown
// at once. The release is one step; others react then.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import { setCurve } from '../../../model/document/commands';
import { limitsOf, topSpeed } from '../../../model/base/domain';
import type { Futures } from '../../../model/document/futures';
import {
  addedPoint,
  EASING_S,
  endsOf,
  lineOf,
  movedPoint,
  pathOf,
  timeOfStop,
} from '../../../model/physics/speed-profile';
import type { Path, Profile, SpeedPoint } from '../../../model/document/profile';
import type { CurveRemedy } from '../../../model/physics/curve-fit';
import { pointAt, project, type Pose, type Vec } from '../../../model/base/geometry';
import { poseAt, type Motion } from '../../../model/base/motion';
import { canMove, profileOf, sceneKey, type Agent, type Scene } from '../../../model/document/scene';
import { stopPlaces, type StopPlace } from '../../../model/physics/stop-places';
import { withCurve } from '../../asking/drawn-speeds';
import type { Editor } from '../../session/editor';
import { TEXTS } from '../../../texts/editing/moves';

/** A front within this distance of a stop place stops there, metres. */
const THERE_M = 0.6;

/** Least distance of a new point from others, seconds. */
const ROOM_S = 0.4;
/** Largest deceleration for an added stop, m/s². */
const COMFORTABLE_MPS2 = 3;

const speedAt = (m: Motion, t: number): number => Math.abs(poseAt(m, t)?.speed ?? 0);

const nearestOf = (all: readonly StopPlace[], s: number, within: number): StopPlace | undefined =>
  all.filter((p) => Math.abs(p.s - s) <= within).sort((p, q) => Math.abs(p.s - s) - Math.abs(q.s - s))[0];

export class SpeedCurve {
  readonly #inHand = signal<Profile | null>(null);
  readonly #point = signal<number | null>(null);
  /** The curve after the remedy under the pointer. */
  readonly #tried = signal<{ readonly id: string; readonly profile: Profile } | null>(null);
  /** The motion before the last change, and the key of the changed document; null during a drag. */
  readonly #before = signal<{ readonly id: string; readonly motion: Motion; readonly key: string | null } | null>(null);

  /** Index of the point that fields and keys act on. */
  readonly point: ReadonlySignal<number | null> = this.#point;
  /** Is a point being dragged? */
  readonly dragging = computed(() => this.#inHand.value !== null);

  constructor(private readonly editor: Editor) {}

  /** The requested curve: the dragged one, or the document's; null where none is drawn. */
  readonly asked: ReadonlySignal<Profile | null> = computed(() => {
    const a = this.editor.agent.value;
    return this.#inHand.value ?? (a && profileOf(a));
  });

  /** The shown curve. */
  readonly profile: ReadonlySignal<Profile | null> = computed(() => {
    const tried = this.#tried.value;
    return tried && tried.id === this.editor.selection.value ? tried.profile : this.asked.value;
  });

  /** The motion before the curve was changed, until another change. */
  readonly before: ReadonlySignal<Motion | null> = computed(() => {
    const b = this.#before.value;
    if (b?.id !== this.editor.selection.value) return null;
    const here = this.#inHand.value !== null || sceneKey(this.editor.scene.value!) === b.key;
    return here ? b.motion : null;
  });

  /** Draggable points: of the curve, or start and end of the shown future. */
  readonly points: ReadonlySignal<readonly SpeedPoint[]> = computed(() => {
    const profile = this.profile.value;
    if (profile) return profile.points;
    return this.#begun()?.points ?? [];
  });

  /** Why no curve can be drawn; null where one can. */
  get why(): string | null {
    const a = this.editor.agent.peek();
    if (!a || !canMove(a)) return TEXTS.selectARoadUser;
    return this.#begun() ? null : TEXTS.futuresComing;
  }

  /** A curve with the points of the future in force. */
  #begun(): Profile | null {
    const { editor } = this;
    const a = editor.agent.value;
    const f = a && canMove(a) ? editor.answers.motion.value.futures.get(a.id) : undefined;
    const mode = f && !f.sketch ? f.modes[editor.reading.chosen.value] : undefined;
    const path = mode && pathOf(mode.motion);
    if (!a || !path) return null;
    const end = Math.min(a.goal.time, editor.scene.value!.duration);
    return { path, points: endsOf(mode.motion, end) };
  }

  take(i: number | null): void {
    this.#point.value = i;
  }

  /** Moves a point and shows the effect. */
  drag(i: number, to: Partial<SpeedPoint>): void {
    const base = this.profile.peek() ?? this.#begun();
    const a = this.editor.agent.peek();
    const scene = this.editor.scene.peek();
    if (!base || !a || !scene || i >= base.points.length) return;
    const v = to.v === undefined ? {} : { v: Math.min(topSpeed(a), to.v) };
    this.#show(a, { ...base, points: movedPoint(base.points, i, { ...to, ...v }, scene.duration) });
    this.#point.value = i;
  }

  /**
   * Moves a stop along the path so that the front of the road user reaches a place; a stop place within `sticks` metres
   * catches it.
   */
  stopAt(i: number, [x, y]: Vec, sticks: number): void {
    const a = this.editor.agent.peek();
    const scene = this.editor.scene.peek();
    const base = this.profile.peek();
    if (!a || !scene || !base || i >= base.points.length) return;
    const line = lineOf(base.path);
    const { s } = project(line, x, y);
    const place = nearestOf(this.#places(scene, a, base), s, sticks);
    const to = pointAt(line, place?.s ?? s);
    this.drag(i, { t: timeOfStop(base, i, [to.x, to.y], a.length / 2, limitsOf(a), scene.duration) });
  }

  /** The stop place there, in words; null where there is none. */
  placeOf(a: Agent, { x, y }: Pose): string | null {
    const scene = this.editor.scene.peek();
    const base = this.profile.peek();
    if (!scene || !base) return null;
    const front = project(lineOf(base.path), x, y).s + a.length / 2;
    return nearestOf(this.#places(scene, a, base), front, THERE_M)?.words ?? null;
  }

  /** Computed once for each path: a drag keeps the path. */
  #places(scene: Scene, a: Agent, { path }: Profile): readonly StopPlace[] {
    if (this.#known?.path !== path || this.#known.agents !== scene.agents)
      this.#known = { path, agents: scene.agents, all: stopPlaces(scene, a, path) };
    return this.#known.all;
  }
  #known: { readonly path: Path; readonly agents: Scene['agents']; readonly all: readonly StopPlace[] } | null = null;

  /** Commits the dragged curve as a step. */
  release(): void {
    const profile = this.#inHand.peek();
    const a = this.editor.agent.peek();
    if (profile && a) this.#run(a, profile);
    this.#inHand.value = null;
  }

  /** Restores the state before the drag. */
  cancel(): boolean {
    if (!this.#inHand.peek()) return false;
    batch(() => {
      this.#inHand.value = null;
      this.editor.answers.dropDraft();
    });
    return true;
  }

  /** A typed value, or a key. */
  set(i: number, to: Partial<SpeedPoint>): void {
    this.drag(i, to);
    this.release();
  }

  /** Adds a point, or a stop with this duration, at the playhead; else in the middle of the widest gap. */
  addHere(hold: number | null): void {
    const points = this.points.peek();
    const motion = this.editor.reading.futures.peek()?.modes[this.editor.reading.chosen.peek()]?.motion;
    if (points.length < 2 || !motion) {
      this.editor.notices.show({ text: this.why ?? TEXTS.thereIsNoRoom });
      return;
    }
    const gaps = points.slice(1).map((p, i) => ({ from: points[i].t + points[i].hold, to: p.t }));
    const now = this.editor.playhead.time.peek();
    const chosen = now > 0 && !this.editor.playhead.playing.peek();
    const here = chosen && gaps.some(({ from, to }) => now > from + ROOM_S && now < to - ROOM_S - (hold ?? 0));
    const widest = gaps.reduce((a, b) => (b.to - b.from > a.to - a.from ? b : a));
    const middle = (widest.from + widest.to - (hold ?? 0)) / 2;
    // A stop without a chosen time is placed where comfortable braking suffices, if there is room.
    const comfortable = widest.from + speedAt(motion, widest.from) / COMFORTABLE_MPS2 + EASING_S;
    const t = here ? now : hold === null ? middle : Math.max(middle, Math.min(comfortable, widest.to - hold - ROOM_S));
    const v = hold === null ? speedAt(motion, t) : 0;
    this.add(t, v, hold ?? 0);
  }

  add(t: number, v: number, hold = 0): void {
    const base = this.profile.peek() ?? this.#begun();
    const a = this.editor.agent.peek();
    if (!base || !a) return;
    const added = addedPoint(base.points, { t: Math.round(t * 10) / 10, v: Math.min(topSpeed(a), v), hold });
    if (!added) {
      this.editor.notices.show({ text: TEXTS.thereIsNoRoom });
      return;
    }
    this.#point.value = added.at;
    this.#run(a, { ...base, points: added.points });
  }

  /** Start and end stay. */
  remove(i: number): void {
    const profile = this.profile.peek();
    const a = this.editor.agent.peek();
    if (!profile || !a || i < 1 || i >= profile.points.length - 1) return;
    // The next one takes its place, also for keys.
    this.#point.value = i;
    this.#run(a, { ...profile, points: profile.points.filter((_, k) => k !== i) });
  }

  /** Shows the curve after a remedy; null shows the curve again. */
  try(way: CurveRemedy | null): void {
    const a = this.editor.agent.peek();
    const base = this.asked.peek();
    const f = a && this.editor.answers.motion.peek().futures.get(a.id);
    batch(() => {
      if (way && a && base && f) {
        const profile = { ...base, points: way.points };
        this.#tried.value = { id: a.id, profile };
        this.#draw(a, f, profile);
      } else if (this.#tried.peek()) {
        this.#tried.value = null;
        this.editor.answers.dropDraft();
      }
    });
  }

  /** Takes a remedy. */
  accept(way: CurveRemedy): void {
    const a = this.editor.agent.peek();
    const base = this.asked.peek();
    this.#tried.value = null;
    if (a && base) this.#run(a, { ...base, points: way.points }, way.goalTime);
  }

  /** Restores the generator's future. */
  clear(): void {
    const a = this.editor.agent.peek();
    if (!a || !profileOf(a) || this.#isLocked(a)) return;
    this.#point.value = null;
    this.editor.commits.run(setCurve(a, null, null));
  }

  /** For a locked road user, a notice explains why nothing changes. */
  #isLocked(a: Agent): boolean {
    if (a.locked) this.editor.notices.show({ text: TEXTS.allAreLocked(1) });
    return a.locked;
  }

  /**
   * Draws the speeds of the selected road user again, along the likeliest path, after a change put its curve out of
   * force. With `joins` it becomes part of that change. False where it cannot.
   */
  takeUp(id: string, joins: boolean): boolean {
    const a = this.editor.agent.peek();
    const drawn = a?.id === id && a.chosen === null ? a.profile : null;
    const begun = drawn && this.#begun();
    if (!a || !drawn || !begun) return false;
    const [first, last] = [begun.points[0], begun.points[begun.points.length - 1]];
    const between = drawn.points.slice(1).filter((p) => p.t <= last.t + 1e-6);
    this.#run(a, { path: begun.path, points: [{ ...drawn.points[0], v: first.v }, ...between] }, undefined, joins);
    return true;
  }

  #run(a: Agent, profile: Profile, goalTime?: number, joins = false): void {
    const { editor } = this;
    if (this.#isLocked(a)) return;
    this.#show(a, profile);
    this.#inHand.value = null;
    editor.commits.run({ ...setCurve(a, editor.reading.chosen.peek(), profile, goalTime), joins });
    const before = this.#before.peek();
    this.#before.value = before && { ...before, key: sceneKey(editor.scene.peek()!) };
  }

  #show(a: Agent, profile: Profile): void {
    const { editor } = this;
    const f = editor.answers.motion.peek().futures.get(a.id);
    if (!f) return;
    const motion = f.modes[editor.reading.chosen.peek()]?.motion;
    batch(() => {
      if (!this.#inHand.peek() && motion) this.#before.value = { id: a.id, motion, key: null };
      this.#inHand.value = profile;
      this.#draw(a, f, profile);
    });
  }

  #draw(a: Agent, f: Futures, profile: Profile): void {
    const { answers, reading, scene } = this.editor;
    answers.showDraft(a.id, withCurve(f, reading.chosen.peek(), profile, a, scene.peek()!.duration));
  }
}
