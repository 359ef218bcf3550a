// Saving: own scenes go to the server after every step; edits of examples stay in this browser until a copy is made.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { Scene } from '../model/scene';
import type { SceneJson } from '../model/json';
import { Refused, type Client } from '../net/client';
import type { Editor } from './editor';
import { forgetEdits, keepEdits, versionOf } from './kept-edits';
import type { SceneFile } from './scene-file';
import type { SceneList } from './scene-list';

/** `local`: kept in this browser only. `full`: there was no room even for that. */
export type SaveState = 'example' | 'saved' | 'saving' | 'local' | 'conflict' | 'full';

const DELAY_MS = 300;

export class Saving {
  readonly #state = signal<SaveState>('example');
  readonly #conflict = signal<{ etag: string | null } | null>(null);
  /** The document as it was opened: nothing to save yet. */
  #opened: Scene | null = null;
  #etag: string | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #busy = false;
  #again = false;

  readonly state: ReadonlySignal<SaveState> = this.#state;
  /** The version on the server that is not ours. */
  readonly conflict: ReadonlySignal<{ etag: string | null } | null> = this.#conflict;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
    private readonly list: SceneList,
    private readonly client: Client,
  ) {}

  /** Another scene is open; `withEdits` when changes kept in this browser were put in. */
  opened(scene: Scene, etag: string | null, withEdits: boolean): void {
    this.#etag = etag;
    this.#conflict.value = null;
    this.#opened = withEdits ? null : scene;
    this.#state.value = withEdits ? 'local' : this.list.isOwn(scene.id) ? 'saved' : 'example';
  }

  /** A document change was committed. */
  changed(scene: Scene): void {
    if (!this.file.raw || scene === this.#opened) return;
    const kept = keepEdits(scene, this.file.raw);
    const own = this.list.isOwn(scene.id);
    if (kept === 'full') this.#state.value = 'full';
    else if (!own) this.#state.value = kept === 'kept' ? 'local' : 'example';
    if (!own || !this.file.stored) return;
    this.#state.value = 'saving';
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#save(), DELAY_MS);
  }

  /** The server is back: what could not be saved is saved now. */
  retry(): void {
    const { raw, stored } = this.file;
    if (raw && stored && this.list.isOwn(raw.id ?? '') && this.#state.peek() !== 'saved') void this.#save();
  }

  /** Conflict: this version replaces the other one. */
  async keepMine(): Promise<void> {
    await this.#save(true);
    if (this.#state.peek() === 'saved') this.#conflict.value = null;
  }

  async #save(force = false): Promise<void> {
    if (this.#busy) {
      this.#again = true;
      return;
    }
    const scene = this.editor.scene.peek();
    const body = this.file.current();
    if (!scene || !body) return;
    this.#busy = true;
    this.#again = false;
    try {
      this.#etag = await this.#put(scene.id, body, force);
      this.#saved(scene, body);
    } catch (e) {
      this.#failed(e);
    } finally {
      this.#busy = false;
      if (this.#again && this.#state.peek() !== 'conflict') void this.#save();
    }
  }

  #saved(scene: Scene, body: SceneJson): void {
    this.file.noteStored(body);
    const now = this.editor.scene.peek();
    if (now && versionOf(now) === versionOf(scene)) {
      forgetEdits(scene.id);
      this.#state.value = 'saved';
    }
    void this.list.refresh().catch(() => undefined);
  }

  #failed(e: unknown): void {
    const conflict = e instanceof Refused && e.status === 412;
    if (conflict) this.#conflict.value = { etag: e.problem.etag ?? null };
    this.#state.value = conflict ? 'conflict' : 'local';
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
