// What the generator has answered, and how far it is: the motion in force, the draft on its way, who changed, the
// status line, and whether the generator is there at all.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';
import { findChanges, type Change } from '../../model/words/change-words';
import {
  ByDocument,
  emptyMotion,
  type Futures,
  type MotionSet,
  type Reach,
  type Score,
} from '../../model/document/futures';
import { withTaken } from '../../model/document/pins';
import { sceneKey, type Scene } from '../../model/document/scene';
import type { SpeedUnit } from '../../model/base/units';
import type { Way } from '../../model/document/scene-diff';
import type { Commit } from '../document/document';
import { onlyPicked, type Step } from '../document/step';

export type Status =
  | { kind: 'loading' }
  | { kind: 'ready' }
  /** `part`: the seconds that a later window is about. */
  | { kind: 'refining'; step: number; steps: number; ms: number; part?: string }
  | { kind: 'slow'; ms: number }
  | { kind: 'settled'; ms: number; adapted: number | null }
  | { kind: 'away' }
  | { kind: 'refused'; words: string };

/** Futures on their way: the latest draft and the ones before it, which stay behind as trails. */
export interface Draft {
  readonly id: string;
  readonly futures: Futures;
  readonly earlier: readonly Futures[];
}

export interface Away {
  /** Seconds until the next try. */
  readonly retryIn: number;
  /** Changes that wait for the generator. */
  readonly waiting: number;
}

/** A sentence about one road user. */
export interface Remark {
  readonly id: string;
  readonly words: string;
}

export interface LiveReach {
  readonly id: string;
  readonly reach: Reach;
  /** Has the goal moved on since? */
  readonly moved: boolean;
}

export class Answers {
  readonly #motion = signal<MotionSet>(emptyMotion(''));
  readonly #draft = signal<Draft | null>(null);
  readonly #changes = signal<readonly Change[]>([]);
  readonly #previewed = signal<readonly Change[] | null>(null);
  readonly #liveReach = signal<LiveReach | null>(null);
  readonly #remark = signal<Remark | null>(null);
  readonly #status = signal<Status>({ kind: 'loading' });
  readonly #away = signal<Away | null>(null);
  readonly #cache = new ByDocument<MotionSet>();
  /** Who else changed with the step that led to a document. */
  readonly #told = new ByDocument<{ readonly key: string; readonly changes: readonly Change[] }>();

  /** Everything worked out for the document, or for the one before it when `stale`. */
  readonly motion: ReadonlySignal<MotionSet> = this.#motion;
  readonly draft: ReadonlySignal<Draft | null> = this.#draft;
  /** Who else does something else since the last change. */
  readonly changes: ReadonlySignal<readonly Change[]> = this.#changes;
  /** Who else would change if one let go now; null where nobody has asked, or nobody has answered yet. */
  readonly previewed: ReadonlySignal<readonly Change[] | null> = this.#previewed;
  /** The generator's verdict on the goal as it is being dragged. */
  readonly liveReach: ReadonlySignal<LiveReach | null> = this.#liveReach;
  /** Why another future is shown than the one that was bold in the drag. */
  readonly remark: ReadonlySignal<Remark | null> = this.#remark;
  readonly status: ReadonlySignal<Status> = this.#status;
  /** Null while the generator answers. */
  readonly away: ReadonlySignal<Away | null> = this.#away;

  open(scene: Scene, saved: MotionSet | null): void {
    batch(() => {
      this.#cache.clear();
      this.#told.clear();
      this.#draft.value = null;
      this.#changes.value = [];
      this.#previewed.value = null;
      this.#liveReach.value = null;
      this.#remark.value = null;
      const known = saved ?? emptyMotion(sceneKey(scene));
      // What a pinned future is stands in the document, also where its answer was not kept.
      this.#motion.value = { ...known, futures: withTaken(scene, known.futures) };
      if (saved) this.#cache.put(this.#motion.value);
      this.#status.value = { kind: 'ready' };
    });
  }

  /** Somebody else is selected: what was said about the last one is over. */
  forgetLook(): void {
    batch(() => {
      this.#draft.value = null;
      this.#liveReach.value = null;
      this.#remark.value = null;
    });
  }

  /** A drag begins: who changed the last time is no longer of interest. */
  dragBegan(): void {
    batch(() => {
      this.#changes.value = [];
      this.#remark.value = null;
      this.#previewed.value = null;
    });
  }

  dragMoved(): void {
    const live = this.#liveReach.peek();
    if (live && !live.moved) this.#liveReach.value = { ...live, moved: true };
  }

  dragPutBack(): void {
    batch(() => {
      this.forgetLook();
      this.#previewed.value = null;
      this.#status.value = { kind: 'ready' };
    });
  }

  followed(commit: Commit, step: Step, way: Way | 'there' | null): void {
    if (step.counting) this.#countsOtherwise(commit.after);
    else {
      const fresh = step.agent && onlyPicked(commit, step.agent) ? step.agent : null;
      this.#documentChanged(commit.after, fresh, way === 'forth' || way === null);
    }
  }

  /** What is on screen no longer answers the document; it stays, marked. */
  outdate(): void {
    this.#motion.value = { ...this.#motion.peek(), stale: true };
  }

  /**
   * The document changed. Known answers appear at once; otherwise the old ones stay, marked as out of date. `fresh`
   * is the one road user whose futures still hold. Done `again`,
   * whether by redo or anew, a step says once more who else changed with it.
   */
  #documentChanged(scene: Scene, fresh: string | null, again: boolean): void {
    const key = sceneKey(scene);
    const known = this.#cache.get(key);
    const now = this.#motion.peek();
    // A name or a note is nothing that the generator knows of.
    if (now.key === key && !now.stale) return;
    batch(() => {
      this.#forgetGone(scene);
      this.#changes.value = (known && again && this.#told.get(key)?.changes) || [];
      this.#remark.value = null;
      if (known) {
        this.#motion.value = known;
        this.#draft.value = null;
        this.#previewed.value = null;
        return;
      }
      const m = this.#motion.peek();
      const keeps = fresh && m.futures.has(fresh) ? fresh : null;
      const futures = withTaken(scene, m.futures, keeps);
      const taken = [...futures].flatMap(([id, f]) => (m.futures.get(id) === f ? [] : [id]));
      const driving = keeps || taken.length ? new Set([...m.driving, ...taken, ...(keeps ? [keeps] : [])]) : m.driving;
      this.#motion.value = { ...m, futures, key, stale: true, fresh: keeps, driving };
    });
  }

  /** Other things count: everybody goes on as they do. Looks that nobody follows are judged when asked anew. */
  #countsOtherwise(scene: Scene): void {
    const key = sceneKey(scene);
    const m = this.#motion.peek();
    const futures = new Map([...m.futures].filter(([id]) => m.driving.has(id)));
    this.#motion.value = this.#cache.get(key) ?? { ...m, key, futures };
  }

  /** Who has gone from the scene has no motion any more. */
  #forgetGone(scene: Scene): void {
    const m = this.#motion.peek();
    const d = this.#draft.peek();
    if (d && !scene.agents.has(d.id)) this.#draft.value = null;
    if (![...m.futures.keys()].some((id) => !scene.agents.has(id))) return;
    const here = <T>(of: ReadonlyMap<string, T>) => new Map([...of].filter(([id]) => scene.agents.has(id)));
    const driving = new Set([...m.driving].filter((id) => scene.agents.has(id)));
    this.#motion.value = { ...m, futures: here(m.futures), reach: here(m.reach), driving };
  }

  /** Takes over what was worked out for the document as it is now; says who changed, but for those in `except`. */
  settle(scene: Scene, set: MotionSet, except: ReadonlySet<string> | null, unit?: SpeedUnit): void {
    const before = this.#motion.peek();
    batch(() => {
      this.#cache.put(set);
      this.#motion.value = set;
      this.#draft.value = null;
      this.#previewed.value = null;
      if (!except) return;
      this.#changes.value = findChanges(scene, before, set, except, unit);
      this.#told.put({ key: set.key, changes: this.#changes.value });
    });
  }

  /** Takes note of what belongs to another document than the one on screen; it appears when that is taken. */
  know(set: MotionSet): void {
    this.#cache.put(set);
  }

  /** What the others would do; null when it is not known any more. */
  preview(changes: readonly Change[] | null): void {
    this.#previewed.value = changes;
  }

  showDraft(id: string, futures: Futures, earlier: readonly Futures[] = []): void {
    this.#draft.value = { id, futures, earlier };
  }

  dropDraft(): void {
    this.#draft.value = null;
  }

  /** A look at the six futures of one: kept beside the others', nobody follows them yet. */
  look(id: string, futures: Futures, reach: Reach | null): void {
    const m = this.#motion.peek();
    const next: MotionSet = {
      ...m,
      futures: new Map(m.futures).set(id, futures),
      reach: reach ? new Map(m.reach).set(id, reach) : m.reach,
    };
    batch(() => {
      this.#motion.value = next;
      this.#cache.put(next);
      if (this.#draft.peek()?.id === id) this.#draft.value = null;
    });
  }

  judge(id: string, reach: Reach): void {
    this.#liveReach.value = { id, reach, moved: false };
  }

  /** The verdict of the whole answer takes the place of the one during the drag. */
  dropLiveReach(): void {
    this.#liveReach.value = null;
  }

  explain(remark: Remark | null): void {
    this.#remark.value = remark;
  }

  scored(score: Score | null, futures = this.#motion.peek().futures): void {
    const next = { ...this.#motion.peek(), futures, score };
    this.#motion.value = next;
    this.#cache.put(next);
  }

  report(status: Status): void {
    this.#status.value = status;
  }

  missing(away: Away): void {
    this.#away.value = away;
  }

  back(): void {
    batch(() => {
      this.#away.value = null;
      this.#draft.value = null;
    });
  }
}
