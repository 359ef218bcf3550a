// Scenes as a whole: opened, copied, removed.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import { Away, Refused, type Client } from '../net/client';
import { keep } from '../net/storage';
import { isMapRef, type MapJson, type SceneJson } from '../model/json';
import { readGenerated, readScene, SceneError } from '../model/read';
import { touched, type Scene } from '../model/scene';
import type { Editor } from './editor';
import { forgetEdits, withKeptEdits } from './kept-edits';
import type { Saving } from './saving';
import type { SceneFile } from './scene-file';
import type { SceneList } from './scene-list';

const WELCOME_BACK_MS = 9000;

export class Library {
  readonly #openError = signal<string | null>(null);
  /** Why the last scene could not be opened. */
  readonly openError: ReadonlySignal<string | null> = this.#openError;
  /** Called when another scene is on screen. */
  onOpen: ((scene: Scene) => void) | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
    private readonly saving: Saving,
    private readonly list: SceneList,
    private readonly client: Client,
  ) {}

  async open(id: string): Promise<void> {
    this.#openError.value = null;
    try {
      const { json, etag } = await this.client.scene(id);
      const map = isMapRef(json.map) ? await this.client.map(json.map.ref) : json.map;
      this.#adopt({ ...json, id: json.id ?? id }, map, etag);
      this.file.mapRef = await this.#mapRef(id, json);
    } catch (e) {
      const known = e instanceof SceneError || e instanceof Refused;
      this.#openError.value = known ? e.message : 'The scene could not be loaded. The server is not answering.';
      if (!known && !(e instanceof Away)) throw e;
    }
  }

  dismissError(): void {
    this.#openError.value = null;
  }

  async #mapRef(id: string, json: SceneJson): Promise<string | null> {
    if (isMapRef(json.map)) return json.map.ref;
    const sha = this.list.find(id)?.map_sha256;
    if (sha) return sha.startsWith('sha256:') ? sha : `sha256:${sha}`;
    return this.client.mapRef(id).catch(() => null);
  }

  #adopt(json: SceneJson, map: MapJson, etag: string | null): void {
    const { editor } = this;
    const plain = readScene(json, map);
    const kept = withKeptEdits(plain);
    const scene = kept ?? plain;
    this.file.adopt(json, map, true);
    this.saving.opened(scene, etag, kept !== null);
    keep('last-scene', scene.id);
    const saved = kept ? null : readGenerated(json, scene);
    editor.open(scene, saved);
    const unanswered = !saved && [...scene.agents.values()].some(touched);
    if (unanswered) editor.answers.outdate();
    this.onOpen?.(scene);
    if (unanswered) editor.onCommit?.(scene, { name: 'Scene opened', agent: null, undo: true });
    if (!kept) return;
    const action = { label: 'Start fresh', run: () => void this.startFresh(scene.id) };
    editor.notices.show({ text: 'Your changes from last time are back.', action }, WELCOME_BACK_MS);
  }

  /** The scene as the server has it, without the changes kept in this browser. */
  async startFresh(id: string): Promise<void> {
    forgetEdits(id);
    await this.open(id);
  }

  /** Conflict: the version on the server replaces the one on screen. */
  async takeTheirs(): Promise<void> {
    const id = this.editor.scene.peek()?.id;
    if (id) await this.startFresh(id);
  }

  /** An own copy of what is on screen; from then on it saves itself. */
  async saveCopy(): Promise<void> {
    const { editor } = this;
    const scene = editor.scene.peek();
    const body = this.file.complete();
    if (!scene || !body) return;
    const name = this.list.isOwn(scene.id) ? `${scene.name}, copy` : `${scene.name}, edited`;
    try {
      const { id } = await this.client.create({ ...body, name });
      await this.list.refresh().catch(() => undefined);
      forgetEdits(scene.id);
      await this.open(id);
      editor.notices.show({ text: `Saved as “${name}”.` });
    } catch (e) {
      const why =
        e instanceof Refused ? e.message : 'the server is not answering. Your changes are kept on this computer.';
      editor.notices.show({ text: `Not saved: ${why}` });
    }
  }

  async remove(id: string): Promise<void> {
    const { editor, list } = this;
    const item = list.find(id);
    try {
      const etag = item?.etag ?? (await this.client.scene(id)).etag ?? '*';
      await this.client.remove(id, etag);
      forgetEdits(id);
      await list.refresh();
      editor.notices.show({ text: `“${item?.name ?? id}” deleted.` });
      const next = list.list.peek()[0];
      if (editor.scene.peek()?.id === id && next) await this.open(next.id);
    } catch (e) {
      editor.notices.show({ text: `Not deleted: ${(e as Error).message}` });
    }
  }
}
