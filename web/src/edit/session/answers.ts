// Answers of the generator: the motion in force, the current draft, reactions, the status line, and whether the
// generator is reachable.
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
import type { HistoryDirection } from '../../model/document/scene-diff';
import type { Commit } from '../document/document';
import { onlyPicked, type Step } from '../document/step';

export type Status =
  | { kind: 'loading' }
  | { kind: 'ready' }
  /** `part`: the seconds of a later planning window. */
  | { kind: 'refining'; step: number; steps: number; ms: number; part?: string }
  | { kind: 'slow'; ms: number }
  | { kind: 'settled'; ms: number; adapted: number | null }
  | { kind: 'away' }
  | { kind: 'refused'; words: string };

/** Drafts: the latest and the ones before it, which remain as trails. */
export interface Draft {
  readonly id: string;
  readonly futures: Futures;
  readonly earlier: readonly Futures[];
}

export interface Outage {
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
  readonly #away = signal<Outage | null>(null);
  readonly #cache = new ByDocument<MotionSet>();
  /** Reactions to the step that led to a document. */
  readonly #told = new ByDocument<{ readonly key: string; readonly changes: readonly Change[] }>();

  /** All answers for the document, or for the one before it when `stale`. */
  readonly motion: ReadonlySignal<MotionSet> = this.#motion;
  readonly draft: ReadonlySignal<Draft | null> = this.#draft;
  /** Road users that changed their motion because of the last change. */
  readonly changes: ReadonlySignal<readonly Change[]> = this.#changes;
  /** Road users that would change if the drag ended now; null where not requested or not answered yet. */
  readonly previewed: ReadonlySignal<readonly Change[] | null> = this.#previewed;
  /** The generator's verdict on the dragged goal. */
  readonly liveReach: ReadonlySignal<LiveReach | null> = this.#liveReach;
  /** Why the shown future is not the one that was bold in the drag. */
  readonly remark: ReadonlySignal<Remark | null> = this.#remark;
  readonly status: ReadonlySignal<Status> = this.#status;
  /** Null while the generator answers. */
  readonly away: ReadonlySignal<Outage | null> = this.#away;

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
      // The document stores taken pinned futures, even where their answer was not stored.
      this.#motion.value = { ...known, futures: withTaken(scene, known.futures) };
      if (saved) this.#cache.put(this.#motion.value);
      this.#status.value = { kind: 'ready' };
    });
  }

  /** Another selection: verdict and draft of the last one end. */
  forgetLook(): void {
    batch(() => {
      this.#draft.value = null;
      this.#liveReach.value = null;
      this.#remark.value = null;
    });
  }

  /** A drag begins: reactions to the last change are no longer of interest. */
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

  followed(commit: Commit, step: Step, way: HistoryDirection | 'there' | null): void {
    if (step.counting) this.#countsOtherwise(commit.after);
    else {
      const fresh = step.agent && onlyPicked(commit, step.agent) ? step.agent : null;
      this.#documentChanged(commit.after, fresh, way === 'forth' || way === null);
    }
  }

  /** The shown answers no longer fit the document; they stay, marked as stale. */
  outdate(): void {
    this.#motion.value = { ...this.#motion.peek(), stale: true };
  }

  /**
   * The document changed. Known answers appear at once; otherwise the old ones stay, marked as stale. `fresh`: the one
   * road user whose futures still hold. `again` (redo or repeat): the known reactions to the step are reported again.
   */
  #documentChanged(scene: Scene, fresh: string | null, again: boolean): void {
    const key = sceneKey(scene);
    const known = this.#cache.get(key);
    const now = this.#motion.peek();
    // Names and notes do not reach the generator.
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

  /**
   * Only what is counted changed: all motions stay. Futures that no road user follows are judged at the next request.
   */
  #countsOtherwise(scene: Scene): void {
    const key = sceneKey(scene);
    const m = this.#motion.peek();
    const futures = new Map([...m.futures].filter(([id]) => m.driving.has(id)));
    this.#motion.value = this.#cache.get(key) ?? { ...m, key, futures };
  }

  /** A removed road user has no motion any more. */
  #forgetGone(scene: Scene): void {
    const m = this.#motion.peek();
    const d = this.#draft.peek();
    if (d && !scene.agents.has(d.id)) this.#draft.value = null;
    if (![...m.futures.keys()].some((id) => !scene.agents.has(id))) return;
    const here = <T>(of: ReadonlyMap<string, T>) => new Map([...of].filter(([id]) => scene.agents.has(id)));
    const driving = new Set([...m.driving].filter((id) => scene.agents.has(id)));
    this.#motion.value = { ...m, futures: here(m.futures), reach: here(m.reach), driving };
  }

  /** Takes over the answer for the current document; reports the reactions, except those of ids in `except`. */
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

  /** Caches answers for another document than the shown one; they appear when it is shown. */
  know(set: MotionSet): void {
    this.#cache.put(set);
  }

  /** Reactions of the others during a drag; null when no longer known. */
  preview(changes: readonly Change[] | null): void {
    this.#previewed.value = changes;
  }

  showDraft(id: string, futures: Futures, earlier: readonly Futures[] = []): void {
    this.#draft.value = { id, futures, earlier };
  }

  dropDraft(): void {
    this.#draft.value = null;
  }

  /** Stores the six futures of one road user beside the others' motions; none is followed yet. */
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

  /** The verdict of the whole answer replaces the one during the drag. */
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

  missing(away: Outage): void {
    this.#away.value = away;
  }

  back(): void {
    batch(() => {
      this.#away.value = null;
      this.#draft.value = null;
    });
  }
}
