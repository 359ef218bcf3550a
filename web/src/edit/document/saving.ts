// Saving: every step is stored on this computer; own scenes then go to the server, each by its own queue. Examples stay
// local until they are copied.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import { isMapRef, type SceneJson } from '../../model/document/scene-json';
import type { Committed } from '../../model/document/history';
import { readScene } from '../../model/document/scene-reader';
import type { Client } from '../../net/client';
import type { Document } from './document';
import { versionOf, type Journal, type Standing } from './journal';
import { SaveQueue, type Conflict, type QueueState } from './save-queue';
import type { SceneFile, Snapshot } from './scene-file';
import type { SceneList } from './scene-list';

/** `local`: stored on this computer only. `full`: the local storage is full. `off`: this page may store nothing. */
export type SaveState = 'example' | 'saved' | 'saving' | 'local' | 'conflict' | 'full' | 'off';

/** A local storage without an answer delays a save by at most this. */
const SENDING_MS = 1000;

export class Saving {
  readonly #queues = new Map<string, SaveQueue>();
  /** The queue of the open scene; null where the scene is not saved to the server. */
  readonly #open = signal<SaveQueue | null>(null);
  /** The version of the document that the server holds. */
  readonly #held = signal<number | null>(null);

  /** The foreign version on the server. */
  readonly conflict = computed<Conflict | null>(() => this.#open.value?.conflict.value ?? null);
  readonly state: ReadonlySignal<SaveState>;

  constructor(
    private readonly document: Document,
    private readonly file: SceneFile,
    private readonly list: SceneList,
    private readonly client: Client,
    private readonly journal: Journal,
  ) {
    this.state = computed<SaveState>(() => {
      const server = this.#serverState();
      if (server === 'conflict' || server === 'saved' || server === 'saving') return server;
      const changed = document.undoName.value !== null || server === 'behind';
      if (!changed) return 'example';
      const keeping = journal.keeping.value;
      return keeping === 'kept' ? 'local' : keeping;
    });
  }

  /** Null for a scene that is not saved to the server. */
  #serverState(): QueueState | null {
    const state = this.#open.value?.state.value ?? null;
    // A version not yet pushed is not on the server, whatever the state of the ones before it.
    return state === 'saved' && this.#held.value !== this.document.committed.value?.version ? 'behind' : state;
  }

  /** ETag of the open scene on the server, where known. */
  get etag(): string | null {
    return this.#open.peek()?.etag ?? null;
  }

  /** The newest version of a scene, where the server lacks it. */
  unsaved(id: string): Snapshot | null {
    return this.#queues.get(id)?.unsaved ?? null;
  }

  /** ETag of the version that the unsaved one of a scene replaces. */
  etagOf(id: string): string | null {
    return this.#queues.get(id)?.etag ?? null;
  }

  /**
   * Another scene is open: `ahead` with changes that the server lacks, `conflict` where it has others. Resolves when
   * the scene before is saved, or cannot be.
   */
  opened(committed: Committed, etag: string | null, standing: Standing): Promise<void> {
    const queue = this.#open.peek();
    const other = queue !== this.#queues.get(committed.scene.id);
    const before = (other && queue?.flush()) || Promise.resolve();
    this.#openAs(committed, etag, standing);
    return before;
  }

  #openAs(committed: Committed, etag: string | null, standing: Standing): void {
    const { id } = committed.scene;
    if (!this.#isSaved(id)) {
      this.#open.value = null;
      return;
    }
    const queue = this.#queueOf(id);
    queue.opened(etag, standing === 'ahead' ? 'behind' : standing === 'conflict' ? 'conflict' : 'saved');
    this.#held.value = committed.version;
    this.#open.value = queue;
  }

  /** The committed document has changed, or its answers arrived. */
  changed(): void {
    const snapshot = this.document.lock.peek() ? null : this.file.snapshot();
    if (snapshot && this.#isSaved(snapshot.committed.scene.id)) this.#open.peek()?.push(snapshot);
  }

  /**
   * Stores the known motions with the document. Computed again at the next opening they could differ: a drag and its
   * release continue from the shown future.
   */
  answered(): void {
    if (this.#open.peek()) this.changed();
    else this.journal.keepAnswers(this.file.answers());
  }

  /** Is a request to save this scene under way? */
  isSending(id: string): boolean {
    return this.#queues.get(id)?.isSending ?? false;
  }

  /** The server is back: sends all unsaved versions. */
  retry(): void {
    for (const queue of this.#queues.values()) queue.retry();
  }

  /** Saves the open scene, and one about to be opened; resolves when both are saved, or cannot be. */
  async flush(id?: string): Promise<void> {
    const about = id === undefined ? undefined : this.#queues.get(id);
    about?.retry();
    await Promise.all([this.#open.peek()?.flush(), about?.flush()]);
  }

  /** Another tab saves a scene from now on, the open one or one left here, with its stored steps. */
  letGo(id?: string): void {
    const queue = id === undefined ? this.#open.peek() : this.#queues.get(id);
    if (this.journal.keeping.peek() === 'kept') queue?.stop();
  }

  /** Conflict: this version replaces the other one, or creates the scene again where it was deleted. */
  async keepMine(): Promise<void> {
    const snapshot = this.file.snapshot();
    if (snapshot) await this.#open.peek()?.keep(snapshot);
  }

  /** Conflict: the other version is shown now. */
  tookTheirs(etag: string | null): void {
    this.#open.peek()?.tookTheirs(etag);
    this.#held.value = this.document.committed.peek()?.version ?? null;
  }

  #isSaved(id: string): boolean {
    return this.file.stored && this.list.isOwn(id);
  }

  #queueOf(id: string): SaveQueue {
    const known = this.#queues.get(id);
    if (known) return known;
    const queue: SaveQueue = new SaveQueue(id, this.client, {
      saved: (snapshot, etag) => this.#saved(queue, snapshot, etag),
      sending: ({ committed }) => atMost(SENDING_MS, this.journal.sending(committed)),
      compare: (theirs, snapshot) => this.#compare(theirs, snapshot),
    });
    this.#queues.set(id, queue);
    return queue;
  }

  #saved(queue: SaveQueue, { committed, body }: Snapshot, etag: string | null): void {
    if (this.#open.peek() === queue) {
      this.#held.value = committed.version;
      this.file.noteStored(body());
    }
    if (etag) this.journal.saved(committed, etag);
    void this.list.refresh().catch(() => undefined);
  }

  /** A save with a lost reply, or a late one of the previous tab, is not a foreign version. */
  #compare(theirs: SceneJson, { committed, map }: Snapshot): 'same' | 'ours' | 'theirs' {
    const there = isMapRef(theirs.map) ? map : theirs.map;
    if (!there) return 'theirs';
    const scene = readScene(theirs, there);
    if (versionOf(scene) === versionOf(committed.scene)) return 'same';
    return this.journal.wasSent(scene) ? 'ours' : 'theirs';
  }
}

/** Resolves with the work, or after this many milliseconds. */
export const atMost = (ms: number, work: Promise<void>): Promise<void> =>
  Promise.race([work, new Promise<void>((resolve) => setTimeout(resolve, ms))]);
