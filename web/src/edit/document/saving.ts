// Saving: every step is kept on this computer, and own scenes go to the server after it. Examples stay here until a
// copy is made of them.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { SceneJson } from '../../model/json';
import type { Scene } from '../../model/scene';
import { Refused, type Client } from '../../net/client';
import type { Editor } from '../editor';
import type { Journal } from './journal';
import type { SceneFile } from './scene-file';
import type { SceneList } from './scene-list';

/** `local`: kept on this computer only. `full`: there was no room even for that. `off`: this page may keep nothing. */
export type SaveState = 'example' | 'saved' | 'saving' | 'local' | 'conflict' | 'full' | 'off';

const DELAY_MS = 300;

export class Saving {
  readonly #server = signal<'none' | 'saved' | 'saving' | 'behind' | 'conflict'>('none');
  readonly #conflict = signal<{ etag: string | null } | null>(null);
  #etag: string | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #running: Promise<void> | null = null;
  #again = false;

  /** The version on the server that is not ours. */
  readonly conflict: ReadonlySignal<{ etag: string | null } | null> = this.#conflict;
  readonly state: ReadonlySignal<SaveState>;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
    private readonly list: SceneList,
    private readonly client: Client,
    private readonly journal: Journal,
  ) {
    this.state = computed<SaveState>(() => {
      const server = this.#server.value;
      if (server === 'conflict' || server === 'saved' || server === 'saving') return server;
      const keeping = journal.keeping.value;
      const changed = editor.undoName.value !== null || server === 'behind';
      if (!changed) return 'example';
      return keeping === 'kept' ? 'local' : keeping;
    });
  }

  get etag(): string | null {
    return this.#etag;
  }

  /** Another scene is open. `ahead`: with changes that the server does not have; `conflict`: and it has others. */
  opened(scene: Scene, etag: string | null, standing: 'same' | 'ahead' | 'conflict'): void {
    clearTimeout(this.#timer);
    this.#etag = etag;
    this.#conflict.value = standing === 'conflict' ? { etag } : null;
    const own = this.file.stored && this.list.isOwn(scene.id);
    this.#server.value = !own ? 'none' : standing === 'same' ? 'saved' : standing === 'ahead' ? 'behind' : 'conflict';
  }

  /** A document change was committed. */
  changed(scene: Scene): void {
    if (!this.file.raw || !this.file.stored || !this.list.isOwn(scene.id)) return;
    if (this.editor.lock.peek() || this.#conflict.peek()) return;
    this.#server.value = 'saving';
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#save(), DELAY_MS);
  }

  /**
   * What everybody does in the document is known, and is kept with it. Worked out anew when it is opened again it
   * could be another: a drag and its release go on from what the hand has seen.
   */
  answered(scene: Scene): void {
    if (this.file.stored && this.list.isOwn(scene.id)) this.changed(scene);
    else this.journal.keepAnswers(this.file.answers());
  }

  /** The server is back, or there is room again: what could not be saved is saved now. */
  retry(): void {
    if (this.#server.peek() === 'behind' && !this.editor.lock.peek()) void this.#save();
  }

  /** What is to be saved is saved, or cannot be. */
  async flush(): Promise<void> {
    if (this.#server.peek() !== 'saving') return;
    clearTimeout(this.#timer);
    await (this.#running ?? this.#save());
    if (this.#running) await this.#running;
  }

  /** Conflict: this version replaces the other one. */
  async keepMine(): Promise<void> {
    await this.#save(true);
    if (this.#server.peek() === 'saved') this.#conflict.value = null;
  }

  /** Conflict: the other version is on screen now. */
  tookTheirs(etag: string | null): void {
    this.#etag = etag;
    this.#conflict.value = null;
    this.#server.value = 'saved';
  }

  #save(force = false): Promise<void> {
    if (this.#running) {
      this.#again = true;
      return this.#running;
    }
    this.#running = this.#saveNow(force).finally(() => {
      this.#running = null;
      if (!this.#again) return;
      this.#again = false;
      if (this.#server.peek() !== 'conflict') void this.#save();
    });
    return this.#running;
  }

  async #saveNow(force: boolean): Promise<void> {
    const scene = this.editor.scene.peek();
    const step = this.editor.history?.head ?? null;
    const body = this.file.current();
    if (!scene || !body) return;
    try {
      const etag = await this.#put(scene.id, body, force);
      if (this.editor.scene.peek()?.id !== scene.id) return;
      this.#etag = etag;
      this.file.noteStored(body);
      if (etag) this.journal.synced(etag, step);
      if (this.editor.scene.peek() === scene) this.#server.value = 'saved';
      void this.list.refresh().catch(() => undefined);
    } catch (e) {
      if (this.editor.scene.peek()?.id === scene.id) this.#failed(e);
    }
  }

  #failed(e: unknown): void {
    const conflict = e instanceof Refused && e.status === 412;
    if (conflict) this.#conflict.value = { etag: e.problem.etag ?? null };
    this.#server.value = conflict ? 'conflict' : 'behind';
  }

  async #put(id: string, body: SceneJson, force: boolean): Promise<string | null> {
    const etag = force ? (this.#conflict.peek()?.etag ?? (await this.client.scene(id)).etag) : this.#etag;
    try {
      return await this.client.save(id, body, etag);
    } catch (e) {
      const unknownMap = e instanceof Refused && e.problem.code === 'unknown-map';
      if (unknownMap) return this.client.save(id, this.file.complete()!, etag);
      throw e;
    }
  }
}
