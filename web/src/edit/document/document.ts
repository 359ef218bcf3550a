// The document of the open scene: the committed scene with its history, and on top of it the trial of a drag. A trial
// is never part of the committed scene; while one is open, no other commit is possible.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Command } from '../../model/document/commands';
import {
  History,
  type ReadonlyHistory,
  type Camera,
  type Committed,
  type HistoryStep,
  type KeptHistory,
} from '../../model/document/history';
import type { Scene } from '../../model/document/scene';

/** Why the document is read-only, and the way out. */
export interface Lock {
  readonly words: string;
  readonly label: string;
  run(): void;
}

/** The preview of a drag: the committed document with the drag's newest command applied. */
export interface DragTrial {
  readonly base: Committed;
  readonly scene: Scene;
  /** Null until the pointer has moved. */
  readonly command: Command | null;
  /** The camera at the start of the drag. */
  readonly from: Camera | null;
}

/** The documents before and after a change, and the name of the change. */
export interface Commit {
  readonly before: Scene;
  readonly after: Scene;
  readonly name: string;
}

/** The same by undo or redo, with the step that it went over. */
export interface Travel extends Commit {
  readonly step: HistoryStep;
}

/** A commit was tried during a drag. End the drag first, or wait until it has ended (`afterTrial`). */
export class TrialOpenError extends Error {
  override readonly name = 'TrialOpenError';
}

export class Document {
  readonly #committed = signal<Committed | null>(null);
  readonly #trial = signal<DragTrial | null>(null);
  readonly #lock = signal<Lock | null>(null);
  readonly #historyTick = signal(0);
  #history: History | null = null;
  #waiting: (() => void)[] = [];

  /** Null while no scene is open. */
  readonly committed: ReadonlySignal<Committed | null> = this.#committed;
  readonly trial: ReadonlySignal<DragTrial | null> = this.#trial;
  /** The committed scene. */
  readonly scene = computed<Scene | null>(() => this.committed.value?.scene ?? null);
  /** The scene on screen: the previewed one during a drag, else the committed one. */
  readonly shown = computed<Scene | null>(() => this.trial.value?.scene ?? this.scene.value);
  /** Null while the document can be changed. */
  readonly lock: ReadonlySignal<Lock | null> = this.#lock;
  /** Rises with every change of the history, titles of steps included. */
  readonly historyTick: ReadonlySignal<number> = this.#historyTick;
  readonly undoName = computed<string | null>(() => (void this.historyTick.value, this.#history?.undoName ?? null));
  readonly redoName = computed<string | null>(() => (void this.historyTick.value, this.#history?.redoName ?? null));

  /** Returns the camera; stored with every step. */
  camera: () => Camera | null = () => null;

  /** The history of the open scene. */
  get history(): ReadonlyHistory | null {
    return this.#history;
  }

  /** Opens a scene with the steps stored for it. A trial of the scene before ends without a change. */
  open(scene: Scene, kept: KeptHistory | null = null): void {
    const history = new History(scene, undefined, kept, this.#committed.peek()?.version);
    history.camera = () => this.camera();
    this.#history = history;
    this.#waiting = [];
    batch(() => {
      this.#trial.value = null;
      this.#lock.value = null;
      this.#changed();
    });
  }

  /** The document is read-only while a lock is set. */
  lockWith(lock: Lock | null): void {
    this.#lock.value = lock;
  }

  // -------------------------------------------------------------- commits; each throws `TrialOpenError` during a drag

  /** Commits a command; null where no scene is open. */
  run(command: Command): Commit | null {
    return this.#commit((h) => {
      h.run(command);
      return h.undoName ?? command.name;
    });
  }

  /** Replaces the document with another version of the same scene, as a step. */
  adopt(name: string, scene: Scene): Commit | null {
    return this.#commit((h) => {
      h.adopt(name, scene);
      return name;
    });
  }

  /** Undoes a step; null where there is none. */
  undo(): Travel | null {
    return this.#travel((h) => h.undo());
  }

  /** Redoes the next step. */
  redo(): Travel | null {
    return this.#travel((h) => h.redo());
  }

  /** Goes to any step of the history; null for the document before the first. */
  goTo(id: number | null): Commit | null {
    return this.#commit((h) => {
      h.goTo(id);
      return h.step(id)?.name ?? '';
    });
  }

  /** Titles a step; the document does not change. */
  entitle(id: number, title: string | null): void {
    this.#history?.entitle(id, title);
    this.#historyTick.value++;
  }

  #travel(move: (h: History) => HistoryStep | null): Travel | null {
    const steps: HistoryStep[] = [];
    const commit = this.#commit((h) => {
      steps.push(...[move(h)].filter((s) => s !== null));
      return steps[0]?.name ?? '';
    });
    return commit && steps.length ? { ...commit, step: steps[0] } : null;
  }

  #commit(move: (h: History) => string): Commit | null {
    const h = this.#history;
    if (!h) return null;
    if (this.#trial.peek()) throw new TrialOpenError();
    const before = h.scene;
    const name = move(h);
    this.#changed();
    return { before, after: h.scene, name };
  }

  #changed(): void {
    batch(() => {
      this.#committed.value = this.#history?.committed ?? null;
      this.#historyTick.value++;
    });
  }

  // -------------------------------------------------------------- the trial of a drag

  /** Opens a trial; one that is open already ends without a change. */
  begin(): void {
    const base = this.#committed.peek();
    this.#trial.value = base && { base, scene: base.scene, command: null, from: this.camera() };
  }

  /** Previews a command on the committed document. False where no trial is open. */
  preview(command: Command): boolean {
    const trial = this.#trial.peek();
    if (trial) this.#trial.value = { ...trial, command, scene: command.apply(trial.base.scene) };
    return trial !== null;
  }

  /** Ends the trial and commits a command as one step. Null where no trial is open. */
  commit(command: Command): Commit | null {
    const trial = this.#trial.peek();
    if (!trial) return null;
    return batch(() => {
      this.#trial.value = null;
      return this.#commit((h) => {
        h.commit(command, trial.from);
        return command.name;
      });
    });
  }

  /** Ends the trial without a change. */
  cancel(): void {
    this.#trial.value = null;
  }

  /** Runs `work` at once where no trial is open, else when `settle` is called after it; never for another scene. */
  afterTrial(work: () => void): void {
    if (this.#trial.peek()) this.#waiting.push(work);
    else work();
  }

  /** Runs the work that waited for the end of the trial. */
  settle(): void {
    const waiting = this.#waiting;
    this.#waiting = [];
    for (const work of waiting) this.afterTrial(work);
  }
}
