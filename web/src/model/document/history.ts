// Undo and redo of committed changes. Steps form a tree: a change after an undo starts a branch, and no step is lost.
import { Emitter } from '../base/emitter';
import type { Command } from './commands';
import type { Scene } from './scene';
import { applyDiff, diffOf, isEmptyDiff, type SceneDiff } from './scene-diff';

/** The camera: centre in metres, pixels per metre, and turn counter-clockwise, radians. */
export interface Camera {
  readonly cx: number;
  readonly cy: number;
  readonly z: number;
  /** Zero (north up) where absent. */
  readonly turn?: number;
}

export interface HistoryStep {
  readonly id: number;
  /** The step before it; null for the first. */
  readonly parent: number | null;
  readonly name: string;
  /** The changed road user, where it is one. */
  readonly agent: string | null;
  /** Time of the change, milliseconds since 1970. */
  readonly at: number;
  readonly diff: SceneDiff;
  /** Cameras before the change and at its commit. */
  readonly from: Camera | null;
  readonly to: Camera | null;
  /** Title given by the user. */
  readonly title?: string;
  /** Number of later changes that joined it; absent for none. */
  readonly revision?: number;
}

/**
 * Identifies a document of a scene exactly: the step that led to it, null before the first, and the step's revision.
 */
export interface DocumentRef {
  readonly step: number | null;
  readonly revision?: number;
}

export const isSameDocument = (a: DocumentRef, b: DocumentRef): boolean =>
  a.step === b.step && (a.revision ?? 0) === (b.revision ?? 0);

/** The committed document, as opposed to the preview of a drag. Every change raises its version. */
export interface Committed extends DocumentRef {
  readonly scene: Scene;
  readonly version: number;
}

/** The stored history, as plain data. */
export interface KeptHistory {
  readonly steps: readonly HistoryStep[];
  /** The current step; null before the first. */
  readonly head: number | null;
  /** Revision of that step. */
  readonly revision?: number;
  /** Redo targets of steps with several successors: pairs of the step and its successor. */
  readonly ahead: readonly (readonly [number | null, number])[];
}

/** A change of the history, for storing it. */
export interface HistoryChange {
  /** New, or with a new title. */
  readonly added?: HistoryStep;
  /** The oldest steps were dropped, so the document before the first one changed. */
  readonly shorter?: true;
}

const FOLD_MS = 600;
/** Number of stored steps, and of further ones before the oldest are dropped. */
export const MOST_STEPS = 500;
const SLACK = 50;

/** A history without the methods that change it. */
export type ReadonlyHistory = Readonly<
  Pick<
    History,
    'committed' | 'scene' | 'ref' | 'undoName' | 'redoName' | 'depth' | 'head' | 'step' | 'kept' | 'line' | 'first'
  >
> & { readonly changed: Pick<History['changed'], 'listen'> };

export class History {
  readonly #steps = new Map<number, HistoryStep>();
  readonly #ahead = new Map<number | null, number>();
  #head: number | null = null;
  #next = 1;
  #committed: Committed;
  #folds: { readonly id: number; readonly fold: string; readonly at: number } | null = null;

  /** The steps or the current one have changed. */
  readonly changed = new Emitter<[change: HistoryChange]>();
  /** Returns the current camera. */
  camera: () => Camera | null = () => null;

  /** `version`: the last one before this history. */
  constructor(
    scene: Scene,
    private readonly now: () => number = () => Date.now(),
    kept: KeptHistory | null = null,
    version = 0,
  ) {
    for (const s of kept?.steps ?? []) this.#steps.set(s.id, s);
    for (const [from, to] of kept?.ahead ?? []) this.#ahead.set(from, to);
    this.#head = kept?.head ?? null;
    this.#next = Math.max(0, ...this.#steps.keys()) + 1;
    this.#committed = { scene, version: version + 1, ...this.ref };
  }

  get committed(): Committed {
    return this.#committed;
  }
  get scene(): Scene {
    return this.#committed.scene;
  }
  /** The current document. */
  get ref(): DocumentRef {
    const revision = this.step(this.#head)?.revision;
    return { step: this.#head, ...(revision ? { revision } : {}) };
  }

  get undoName(): string | null {
    return this.step(this.#head)?.name ?? null;
  }
  get redoName(): string | null {
    return this.step(this.#ahead.get(this.#head) ?? null)?.name ?? null;
  }
  /** Number of steps that undo can take back. */
  get depth(): number {
    return this.#path(this.#head).length;
  }
  get head(): number | null {
    return this.#head;
  }

  step(id: number | null): HistoryStep | null {
    return (id !== null && this.#steps.get(id)) || null;
  }

  kept(): KeptHistory {
    const { step: head, ...revision } = this.ref;
    return { steps: [...this.#steps.values()], head, ...revision, ahead: [...this.#ahead] };
  }

  /** The current line, oldest first: steps that undo takes back, then steps that redo applies. */
  line(): HistoryStep[] {
    const line = this.#path(this.#head);
    for (let id = this.#ahead.get(this.#head); id !== undefined; id = this.#ahead.get(id)) {
      const s = this.#steps.get(id);
      if (!s) break;
      line.push(s);
    }
    return line;
  }

  /** The document before the first stored step. */
  first(): Scene {
    return this.#path(this.#head).reduceRight((s, step) => applyDiff(s, step.diff, 'back'), this.scene);
  }

  /** Replaces the document; the current step is set already. */
  #put(scene: Scene): void {
    this.#committed = { scene, version: this.#committed.version + 1, ...this.ref };
  }

  /** Runs a command; key repeats on the same field within 600 ms fold into one step. */
  run(command: Command): Scene {
    const joined = command.joins ? this.#last() : null;
    const name = joined?.name ?? command.name;
    return this.#done(name, command.apply(this.scene), this.camera(), command.fold, joined);
  }

  /** Runs a command as a separate step; `from`: the camera before it. */
  commit(command: Command, from: Camera | null): Scene {
    return this.#done(command.name, command.apply(this.scene), from);
  }

  /** Replaces the document with another version, as a step that can be undone. */
  adopt(name: string, scene: Scene): void {
    if (isEmptyDiff(diffOf(this.scene, scene))) this.#put(scene);
    else this.#done(name, scene, this.camera());
  }

  #done(name: string, after: Scene, from: Camera | null, fold?: string, joined: HistoryStep | null = null): Scene {
    const before = this.scene;
    if (after === before) return before;
    const at = this.now();
    const last = joined ?? (fold === undefined ? null : this.#foldInto(fold, at));
    const diff = diffOf(last ? applyDiff(before, last.diff, 'back') : before, after);
    const added: HistoryStep = {
      id: last?.id ?? this.#next++,
      parent: last ? last.parent : this.#head,
      name,
      agent: diff.agents.length === 1 ? diff.agents[0].id : null,
      at,
      diff,
      from: last ? last.from : from,
      to: this.camera(),
      ...(last ? { revision: (last.revision ?? 0) + 1 } : {}),
    };
    this.#steps.set(added.id, added);
    this.#ahead.set(added.parent, added.id);
    this.#head = added.id;
    this.#put(after);
    this.#folds = fold === undefined ? null : { id: added.id, fold, at };
    const shorter = this.#steps.size >= MOST_STEPS + SLACK;
    if (shorter) this.#drop();
    this.changed.emit(shorter ? { shorter: true } : { added });
    return after;
  }

  /** The newest step, where none follows it. */
  #last(): HistoryStep | null {
    const last = this.step(this.#head);
    return last && !this.#ahead.has(last.id) ? last : null;
  }

  /** The step that the next one of its kind joins. */
  #foldInto(fold: string, at: number): HistoryStep | null {
    const last = this.#last();
    const f = this.#folds;
    return last && f?.id === last.id && f.fold === fold && at - f.at < FOLD_MS ? last : null;
  }

  // -------------------------------------------------------------- undo and redo

  undo(): HistoryStep | null {
    const step = this.step(this.#head);
    if (!step) return null;
    this.#back(step);
    this.changed.emit({});
    return step;
  }

  redo(): HistoryStep | null {
    const step = this.step(this.#ahead.get(this.#head) ?? null);
    if (!step) return null;
    this.#forth(step);
    this.changed.emit({});
    return step;
  }

  /** Goes to any step, null for before the first, by way of the common ancestor. */
  goTo(id: number | null): Scene {
    if (id !== null && !this.#steps.has(id)) return this.scene;
    const there = this.#path(id);
    const meant = new Set(there.map((s) => s.id));
    for (let s = this.step(this.#head); s && !meant.has(s.id); s = this.step(this.#head)) this.#back(s);
    for (const s of there.slice(this.#path(this.#head).length)) this.#forth(s);
    this.changed.emit({});
    return this.scene;
  }

  /** Titles a step, or removes its title. */
  entitle(id: number, title: string | null): void {
    const s = this.step(id);
    if (!s) return;
    const added = { ...s, title: title || undefined };
    this.#steps.set(id, added);
    this.changed.emit({ added });
  }

  #back(step: HistoryStep): void {
    this.#ahead.set(step.parent, step.id);
    this.#head = step.parent;
    this.#put(applyDiff(this.scene, step.diff, 'back'));
    this.#folds = null;
  }

  #forth(step: HistoryStep): void {
    this.#ahead.set(step.parent, step.id);
    this.#head = step.id;
    this.#put(applyDiff(this.scene, step.diff, 'forth'));
    this.#folds = null;
  }

  /** The steps up to one, oldest first. */
  #path(id: number | null): HistoryStep[] {
    const path: HistoryStep[] = [];
    for (let s = this.step(id); s; s = this.step(s.parent)) path.push(s);
    return path.reverse();
  }

  // -------------------------------------------------------------- dropping the oldest

  /** Makes room: the end of the branch left longest ago first, then the start of the current line. */
  #drop(): void {
    const drop = (id: number): void => {
      const parent = this.#steps.get(id)?.parent;
      if (parent !== undefined && this.#ahead.get(parent) === id) this.#ahead.delete(parent);
      this.#steps.delete(id);
      this.#ahead.delete(id);
    };
    for (let end = this.#oldestEnd(); end !== null && this.#steps.size > MOST_STEPS; end = this.#oldestEnd()) drop(end);
    while (this.#steps.size > MOST_STEPS) {
      const first = this.line()[0];
      if (!first || first.id === this.#head) break;
      // Branches from before it are dropped too: their parent document is gone.
      for (const id of this.#under(null).filter((s) => s !== first.id)) for (const i of this.#tree(id)) drop(i);
      for (const id of this.#under(first.id)) this.#steps.set(id, { ...this.#steps.get(id)!, parent: null });
      const after = this.#ahead.get(first.id);
      drop(first.id);
      if (after !== undefined) this.#ahead.set(null, after);
    }
  }

  /** The step with the lowest id that ends a branch, off the current line and without a title. */
  #oldestEnd(): number | null {
    const stays = new Set<number | null>(this.line().map((s) => s.id));
    for (const s of this.#steps.values()) stays.add(s.parent);
    const ends = [...this.#steps.values()].filter((s) => !stays.has(s.id) && !s.title);
    return ends.length ? Math.min(...ends.map((s) => s.id)) : null;
  }

  #under(id: number | null): number[] {
    return [...this.#steps.values()].filter((s) => s.parent === id).map((s) => s.id);
  }

  #tree(id: number): number[] {
    return [id, ...this.#under(id).flatMap((i) => this.#tree(i))];
  }
}

/** The document at the head of a stored history, from the one before its first step. */
export function replay(first: Scene, kept: KeptHistory): Scene {
  const h = new History(first, undefined, { ...kept, head: null });
  return h.goTo(kept.head);
}
