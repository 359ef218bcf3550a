// The speed curve of the selected road user in hand: its points are moved, added and taken away, and what comes of it
// is shown at once. The release is one step; others answer it then.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import { setCurve } from '../model/commands';
import { limitsOf, topSpeed } from '../model/domain';
import type { Futures, Score } from '../model/futures';
import { addedPoint, endsOf, motionOf, movedPoint, pathOf, type Profile, type SpeedPoint } from '../model/profile';
import { judgedBy } from '../model/rejudge';
import { canMove, profileOf, type Agent, type Scene } from '../model/scene';
import type { Editor } from './editor';

export class SpeedCurve {
  readonly #inHand = signal<Profile | null>(null);
  readonly #point = signal<number | null>(null);

  /** Index of the point that fields and keys are about. */
  readonly point: ReadonlySignal<number | null> = this.#point;
  /** Is a point being dragged? */
  readonly dragging = computed(() => this.#inHand.value !== null);

  constructor(private readonly editor: Editor) {}

  /** The curve as it is shown: in hand, or in the document; null where nobody has drawn one. */
  readonly profile: ReadonlySignal<Profile | null> = computed(() => {
    const a = this.editor.agent.value;
    return this.#inHand.value ?? (a && profileOf(a));
  });

  /** Points to take hold of: of the curve, or the start and the end of the future that is shown. */
  readonly points: ReadonlySignal<readonly SpeedPoint[]> = computed(() => {
    const profile = this.profile.value;
    if (profile) return profile.points;
    return this.#begun()?.points ?? [];
  });

  /** Why no curve can be drawn; null where one can. */
  get why(): string | null {
    const a = this.editor.agent.peek();
    if (!a || !canMove(a)) return 'Select a road user that can be changed.';
    return this.#begun() ? null : 'Wait for its futures.';
  }

  /** A curve with the points of the future in force. */
  #begun(): Profile | null {
    const { editor } = this;
    const a = editor.agent.value;
    const f = a && canMove(a) ? editor.motion.value.futures.get(a.id) : undefined;
    const mode = f && !f.sketch ? f.modes[editor.chosen.value] : undefined;
    const path = mode && pathOf(mode.motion);
    if (!a || !path) return null;
    const end = Math.min(a.goal.time, editor.scene.value!.duration);
    return { path, points: endsOf(mode.motion, end) };
  }

  take(i: number | null): void {
    this.#point.value = i;
  }

  /** Puts a point somewhere and shows what comes of it. */
  drag(i: number, to: Partial<SpeedPoint>): void {
    const base = this.profile.peek() ?? this.#begun();
    const a = this.editor.agent.peek();
    const scene = this.editor.scene.peek();
    if (!base || !a || !scene || i >= base.points.length) return;
    const v = to.v === undefined ? {} : { v: Math.min(topSpeed(a), to.v) };
    this.#show(a, { ...base, points: movedPoint(base.points, i, { ...to, ...v }, scene.duration) });
    this.#point.value = i;
  }

  /** What is in hand becomes a step. */
  release(): void {
    const profile = this.#inHand.peek();
    const a = this.editor.agent.peek();
    if (profile && a) this.#run(a, profile);
    this.#inHand.value = null;
  }

  /** As it was before the point was taken. */
  cancel(): boolean {
    if (!this.#inHand.peek()) return false;
    batch(() => {
      this.#inHand.value = null;
      this.editor.answers.dropDraft();
    });
    return true;
  }

  /** A value that is typed, or a key. */
  set(i: number, to: Partial<SpeedPoint>): void {
    this.drag(i, to);
    this.release();
  }

  add(t: number, v: number): void {
    const base = this.profile.peek() ?? this.#begun();
    const a = this.editor.agent.peek();
    if (!base || !a) return;
    const added = addedPoint(base.points, { t: Math.round(t * 10) / 10, v: Math.min(topSpeed(a), v), hold: 0 });
    if (!added) {
      this.editor.notices.show({ text: 'There is no room for a point here.' });
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
    // The next one takes its place, also under the keys.
    this.#point.value = i;
    this.#run(a, { ...profile, points: profile.points.filter((_, k) => k !== i) });
  }

  /** The future as the generator had it. */
  clear(): void {
    const a = this.editor.agent.peek();
    if (!a || !profileOf(a)) return;
    this.#point.value = null;
    this.editor.run(setCurve(a, null, null));
  }

  #run(a: Agent, profile: Profile): void {
    this.#show(a, profile);
    this.#inHand.value = null;
    this.editor.run(setCurve(a, this.editor.chosen.peek(), profile));
  }

  #show(a: Agent, profile: Profile): void {
    const { editor } = this;
    const f = editor.motion.peek().futures.get(a.id);
    if (!f) return;
    batch(() => {
      this.#inHand.value = profile;
      editor.answers.showDraft(a.id, withCurve(f, editor.chosen.peek(), profile, a, editor.scene.peek()!.duration));
    });
  }
}

/** What a future is called whose speed was drawn by hand. */
const OWN_SPEED = 'At your speed';

/** Futures of which one goes as it was drawn; what was said about it is not true any more. */
export function withCurve(f: Futures, chosen: number, profile: Profile, a: Agent, duration: number): Futures {
  const motion = motionOf(profile, limitsOf(a), duration);
  const modes = f.modes.map((m, i) =>
    i === chosen ? { ...m, motion, name: OWN_SPEED, about: null, sent: undefined } : m,
  );
  return { ...f, modes };
}

/** The futures of a scene, those with a speed drawn by hand as they were drawn. */
export function withCurves(scene: Scene, futures: ReadonlyMap<string, Futures>): ReadonlyMap<string, Futures> {
  const drawn = [...scene.agents.values()].filter((a) => profileOf(a) && futures.has(a.id));
  if (!drawn.length) return futures;
  const out = new Map(futures);
  for (const a of drawn) out.set(a.id, withCurve(futures.get(a.id)!, a.chosen!, profileOf(a)!, a, scene.duration));
  return out;
}

/** The same, judged by what the score of the scene says of them. */
export function judgedCurves(
  scene: Scene,
  futures: ReadonlyMap<string, Futures>,
  score: Score,
): ReadonlyMap<string, Futures> {
  const drawn = [...scene.agents.values()].filter((a) => profileOf(a) && futures.has(a.id));
  if (!drawn.length) return futures;
  const out = new Map(futures);
  for (const a of drawn) {
    const f = out.get(a.id)!;
    out.set(a.id, { ...f, modes: f.modes.map((m, i) => (i === a.chosen ? judgedBy(score, a, m) : m)) });
  }
  return out;
}
