// Scenes are opened here: from the server, with what this computer keeps of them, if it is this tab's turn.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';
import { Away, Refused, type Client } from '../../net/client';
import { keep } from '../../net/storage';
import { SceneTurns } from '../../net/scene-lock';
import { isMapRef, type MapJson, type SceneJson } from '../../model/json';
import { readGenerated, readScene, SceneError } from '../../model/read';
import { touched, type Scene } from '../../model/scene';
import type { Editor, Lock } from '../editor';
import { resume, type Journal } from './journal';
import type { Saving } from './saving';
import type { SceneFile } from './scene-file';
import type { SceneList } from './scene-list';
import { TEXTS } from '../../texts/keeping';

const WELCOME_BACK_MS = 9000;
/** Less than a tab that waits for its turn has patience. */
const WRITTEN_WITHIN_MS = 2000;

/** Text and etag of a scene with its map. */
interface Fetched {
  readonly json: SceneJson;
  readonly map: MapJson;
  readonly etag: string | null;
}

/** Whose answers a scene that was opened lacks: of none it is judged alone. */
export type Missing = 'none' | 'changed' | 'everybody';

export class Library {
  readonly #openError = signal<string | null>(null);
  readonly #turns = new SceneTurns({
    got: () => void this.again(),
    leaving: () => this.#handOver(),
    lost: () => this.#elsewhere(),
    changed: () => void this.again(),
  });
  /** Counts what was opened, so that of two on their way the later one stays. */
  #opening = 0;

  /** Why the last scene could not be opened. */
  readonly openError: ReadonlySignal<string | null> = this.#openError;
  /** Called when another scene is on screen; `again` when it is the same one, newer. */
  onOpen: ((scene: Scene, again: boolean) => void) | null = null;
  /** Asks for what is missing of the scene that is on screen. */
  #ask: ((missing: Missing) => void) | null = null;
  #missing: Missing | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
    private readonly saving: Saving,
    private readonly list: SceneList,
    private readonly client: Client,
    private readonly journal: Journal,
  ) {
    journal.onKept = () => this.#turns.tellChanged();
  }

  async open(id: string): Promise<void> {
    await this.written();
    this.#openError.value = null;
    const turn = ++this.#opening;
    try {
      const fetched = await this.#fetch(id);
      const mine = await this.#turns.goTo(id);
      if (turn === this.#opening) await this.#adopt(fetched, mine, false);
    } catch (e) {
      this.#failed(e);
    }
  }

  /** The same scene anew, as it is by now: it was changed in another tab, or it is this tab's turn again. */
  async again(): Promise<void> {
    const id = this.editor.scene.peek()?.id;
    const { raw, map, stored } = this.file;
    if (!id || !raw || !map || !stored) return;
    const turn = ++this.#opening;
    // Without the server what is kept on this computer is enough.
    const fetched = await this.#fetch(id).catch(() => ({ json: raw, map, etag: this.saving.etag }));
    const mine = await this.#turns.goTo(id);
    if (turn === this.#opening) await this.#adopt(fetched, mine, true);
  }

  /** Shows a scene that is not on the server, to be looked at. */
  async show(json: SceneJson, lock: Lock): Promise<void> {
    await this.written();
    this.#opening++;
    this.#turns.leave();
    this.journal.letGo();
    const scene = readScene(json);
    this.file.adopt(json, json.map as MapJson, false);
    const saved = readGenerated(json, scene);
    batch(() => {
      this.editor.open(scene, saved);
      this.editor.lockWith(lock);
    });
    this.saving.opened(scene, null, 'same');
    this.#show(scene, saved !== null, false);
  }

  /** Asks the tab that has this scene for it. */
  editHere(): void {
    this.#turns.takeOver();
  }

  dismissError(): void {
    this.#openError.value = null;
  }

  #failed(e: unknown): void {
    const known = e instanceof SceneError || e instanceof Refused;
    this.#openError.value = known ? e.message : TEXTS.theSceneCould;
    if (!known && !(e instanceof Away)) throw e;
  }

  async #fetch(id: string): Promise<Fetched> {
    const { json, etag } = await this.client.scene(id);
    const map = isMapRef(json.map) ? await this.client.map(json.map.ref) : json.map;
    return { json: { ...json, id: json.id ?? id }, map, etag };
  }

  #mapRefOf(json: SceneJson): string | null {
    if (isMapRef(json.map)) return json.map.ref;
    const sha = this.list.find(json.id ?? '')?.map_sha256;
    return sha ? (sha.startsWith('sha256:') ? sha : `sha256:${sha}`) : null;
  }

  async #adopt({ json, map, etag }: Fetched, mine: boolean, again: boolean): Promise<void> {
    const { editor, journal } = this;
    const plain = readScene(json, map);
    const own = this.list.isOwn(plain.id);
    journal.letGo();
    const kept = await journal.read(plain.id);
    const { scene, history, standing } = resume(plain, kept, own, etag);
    this.file.adopt(json, map, true);
    this.file.mapRef = this.#mapRefOf(json);
    keep('last-scene', scene.id);
    this.list.noteOpened(scene.id);
    const current = standing === 'fresh' || standing === 'same';
    const answers = kept?.answers?.step === kept?.place.head ? kept?.answers?.generated : null;
    const generated = current ? json.generated : answers;
    const saved = generated ? readGenerated({ ...json, generated }, scene) : null;
    const { selection, time } = editor;
    const seen = { who: selection.peek(), when: time.peek() };
    batch(() => {
      editor.open(scene, saved, history);
      if (mine && standing === 'behind') editor.history!.adopt(TEXTS.changedElsewhere, plain);
      if (!mine) this.#elsewhere();
    });
    this.saving.opened(scene, etag, standing === 'ahead' || standing === 'conflict' ? standing : 'same');
    if (mine) {
      journal.follow(editor.history!, scene.id, history && kept, own);
      if (standing === 'behind') void journal.retry();
      if (own && etag && (current || standing === 'behind')) journal.synced(etag, editor.history!.head);
      void journal.tidy((id) => this.list.isOwn(id));
    }
    this.#show(scene, saved !== null, again);
    if (again) this.#asSeen(seen.who, seen.when);
    else if (standing === 'ahead' && !own) this.#welcomeBack();
    if (mine) this.saving.retry();
  }

  /** Answers that are missing are asked for. */
  #show(scene: Scene, answered: boolean, again: boolean): void {
    const { editor } = this;
    const unanswered = !answered && (scene.drawn > 0 || [...scene.agents.values()].some(touched));
    if (unanswered) editor.answers.outdate();
    this.onOpen?.(scene, again);
    this.#missing = !unanswered ? 'none' : scene.drawn > 0 ? 'everybody' : 'changed';
    this.#askNow();
  }

  /** Who asks may come after the first scene is on screen. */
  askBy(ask: (missing: Missing) => void): void {
    this.#ask = ask;
    this.#askNow();
  }

  #askNow(): void {
    const missing = this.#missing;
    if (!this.#ask || !missing) return;
    this.#missing = null;
    this.#ask(missing);
  }

  #asSeen(who: string | null, when: number): void {
    const { editor } = this;
    if (who && editor.scene.peek()?.agents.has(who)) editor.select(who);
    editor.setTime(when);
  }

  #welcomeBack(): void {
    const action = { label: TEXTS.startFresh, run: () => this.editor.goTo(null) };
    this.editor.notices.show({ text: TEXTS.yourChangesFrom, action }, WELCOME_BACK_MS);
  }

  // -------------------------------------------------------------- tabs

  #elsewhere(): void {
    this.journal.letGo();
    this.#lock();
  }

  #lock(): void {
    const lock: Lock = {
      words: TEXTS.thisSceneIsOpen,
      label: TEXTS.editHere,
      run: () => this.editHere(),
    };
    this.editor.lockWith(lock);
  }

  /** Before another tab takes over, everything is written, and nothing new begins. */
  async #handOver(): Promise<void> {
    this.#lock();
    await this.written();
  }

  /** Steps are kept and saved, unless the server takes its time: then they are saved the next time. */
  async written(): Promise<void> {
    const late = new Promise((resolve) => setTimeout(resolve, WRITTEN_WITHIN_MS));
    await Promise.race([this.saving.flush(), late]);
    await this.journal.flush();
  }

  // -------------------------------------------------------------- conflict

  /** The version on the server replaces the one on screen; undo brings that back. */
  async takeTheirs(): Promise<void> {
    const id = this.editor.scene.peek()?.id;
    if (!id) return;
    try {
      const { json, map, etag } = await this.#fetch(id);
      this.editor.adopt(TEXTS.theOtherVersion, readScene(json, map));
      this.saving.tookTheirs(etag);
      if (etag) this.journal.synced(etag, this.editor.history?.head ?? null);
    } catch (e) {
      this.#failed(e);
    }
  }
}
