// Opens scenes from the server, with the steps stored on this computer, once this tab holds the scene's lock.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';
import { Away, Refused, type Client } from '../../net/client';
import { keep } from '../../net/storage';
import type { KeptScene } from '../../net/step-store';
import { SceneTurns, type TurnEvents } from '../../net/scene-lock';
import { Emitter } from '../../model/base/emitter';
import type { Committed } from '../../model/document/history';
import { isMapRef, type MapJson, type SceneJson } from '../../model/document/scene-json';
import { readScene, SceneError } from '../../model/document/scene-reader';
import { readGenerated } from '../../model/words/named-futures';
import { touched, type Scene } from '../../model/document/scene';
import type { Lock } from './document';
import { keptAnswers, resume, type Journal } from './journal';
import { atMost, type Saving } from './saving';
import type { SceneFile } from './scene-file';
import type { SceneList } from './scene-list';
import type { Session } from './session';
import { TEXTS } from '../../texts/editing/opening';

const WELCOME_BACK_MS = 9000;
/** Shorter than the time that a waiting tab allows. */
const WRITTEN_WITHIN_MS = 2000;

/** A scene from the server, with its map and as a document. */
interface Fetched {
  readonly json: SceneJson;
  readonly map: MapJson;
  readonly plain: Scene;
  readonly etag: string | null;
  /** The server was unreachable when the newest version was read. */
  readonly away?: true;
}

/** Road users without a known motion in an opened scene; with `none`, only the score is missing. */
export type Missing = 'none' | 'changed' | 'everybody';

export class Library {
  readonly #openError = signal<string | null>(null);
  readonly #turns: SceneTurns;
  /** Counts requests to open a scene; the later of two wins. */
  #asked = 0;
  /** The last of these requests that asked other tabs for the scene. */
  #reached = 0;

  /** Why the last scene could not be opened. */
  readonly openError: ReadonlySignal<string | null> = this.#openError;
  /** Another scene is shown; `again` when it is a newer version or a copy of the one before. */
  readonly opened = new Emitter<[scene: Scene, again: boolean]>();
  /** Requests the missing answers of the shown scene. */
  #ask: ((missing: Missing) => void) | null = null;
  #missing: Missing | null = null;

  constructor(
    private readonly session: Session,
    private readonly file: SceneFile,
    private readonly saving: Saving,
    private readonly list: SceneList,
    private readonly client: Client,
    private readonly journal: Journal,
    turns: (on: TurnEvents) => SceneTurns = (on) => new SceneTurns(on),
  ) {
    this.#turns = turns({
      got: (id) => void (this.#isOpen(id) && this.again()),
      leaving: (id) => (this.#isOpen(id) ? this.#handOver() : Promise.resolve()),
      lost: (id) => this.#isOpen(id) && this.#elsewhere(),
      // A scene left here may wait to be saved: the tab that has it now saves it, with the stored steps.
      changed: (id) => (this.#isOpen(id) ? void this.again() : this.saving.letGo(id)),
    });
    journal.stored.listen(() => this.#turns.tellChanged());
  }

  /** While another scene is being opened the tab waits for its lock, with this one still open. */
  #isOpen(id: string): boolean {
    return this.session.document.scene.peek()?.id === id;
  }

  async open(id: string, again = false): Promise<void> {
    await this.written(id);
    this.#openError.value = null;
    try {
      await this.#bring(id, () => this.#fetch(id), again);
    } catch (e) {
      this.#failed(e);
    }
  }

  /** Opens the same scene again in its current version: another tab changed it, or this tab has its lock again. */
  async again(): Promise<void> {
    const plain = this.session.document.scene.peek();
    const { raw, map, stored } = this.file;
    if (!plain || !raw || !map || !stored) return;
    // Without the server the copy on this computer is enough.
    const here: Fetched = { json: raw, map, plain: readScene(raw, map), etag: null, away: true };
    await this.#bring(plain.id, () => this.#fetch(plain.id).catch(() => here), true);
  }

  /** Shows a scene that is not on the server, read-only. */
  async show(json: SceneJson, lock: Lock): Promise<void> {
    const scene = readScene(json);
    await this.written();
    this.#reached = ++this.#asked;
    this.#turns.leave();
    this.journal.letGo();
    this.file.adopt(json, json.map as MapJson, false);
    const saved = readGenerated(json, scene);
    batch(() => {
      this.session.open(scene, saved, null);
      this.session.lockWith(lock);
    });
    void this.saving.opened(this.session.document.committed.peek()!, null, 'same');
    this.#show(scene, saved !== null, false);
  }

  /** Asks the tab that holds this scene to release it. */
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
    const reply = await this.client.scene(id);
    const json = { ...reply.json, id: reply.json.id ?? id };
    const map = isMapRef(json.map) ? await this.client.map(json.map.ref) : json.map;
    return { json, map, plain: readScene(json, map), etag: reply.etag };
  }

  #mapHashOf(json: SceneJson): string | null {
    if (isMapRef(json.map)) return json.map.ref;
    const sha = this.list.find(json.id ?? '')?.map_sha256;
    return sha ? (sha.startsWith('sha256:') ? sha : `sha256:${sha}`) : null;
  }

  /** The scene before stays locked until the other one is shown and all of its steps are written. */
  async #bring(id: string, fetch: () => Promise<Fetched>, again: boolean): Promise<void> {
    const turn = ++this.#asked;
    let known = this.#known(id);
    let fetched = await fetch();
    if (turn !== this.#asked) return;
    this.#reached = turn;
    await this.#turns.goTo(id);
    let mine = this.#turns.holds;
    // Server version and stored steps must be from one moment: both are read again if this tab or the previous owner of
    // the lock committed or saved in between.
    for (let asked = false; ; asked = true) {
      await this.journal.flush();
      const kept = await this.journal.read(id);
      if (turn !== this.#reached) return;
      const { committed, etag } = this.#known(id);
      const synced = kept?.place.synced?.etag;
      const sending = this.saving.isSending(id);
      const moved = sending || this.#turns.holds !== mine || committed !== known.committed || etag !== known.etag;
      if (!moved && (asked || !synced || synced === fetched.etag)) {
        const left = this.#adopt(fetched, kept, again);
        return void Promise.all([left, this.journal.flush()]).then(() =>
          this.#turns.left(this.session.document.scene.peek()?.id),
        );
      }
      if (sending) await this.saving.flush(id);
      [known, mine] = [this.#known(id), this.#turns.holds];
      const older = fetched;
      fetched = await fetch().catch((): Fetched => ({ ...older, away: true }));
    }
  }

  /** This tab's own state of a scene: its document, where it is open, and its version on the server. */
  #known(id: string): { readonly committed: Committed | null; readonly etag: string | null } {
    const committed = this.session.document.committed.peek();
    return { committed: committed?.scene.id === id ? committed : null, etag: this.saving.etagOf(id) };
  }

  /** Shows a scene; resolves when the one before is saved, or cannot be. */
  #adopt({ json, map, plain, etag: found, away }: Fetched, kept: KeptScene | null, again: boolean): Promise<void> {
    const { session, journal, saving } = this;
    const { document } = session;
    const mine = this.#turns.holds;
    const own = this.list.isOwn(plain.id);
    const open = this.#known(plain.id).committed;
    let etag = away ? (kept?.place.synced?.etag ?? (open ? saving.etagOf(plain.id) : found)) : found;
    let { scene, history, standing } = resume(plain, kept, own, etag);
    const unsaved = saving.unsaved(plain.id);
    if (standing === 'fresh' && unsaved) {
      // Nothing is stored on this computer: the change exists only in this tab.
      [scene, history, standing, etag] = [unsaved.committed.scene, null, 'ahead', saving.etagOf(plain.id)];
    } else if (standing === 'fresh' && away && open) scene = open.scene;
    const current = !away && standing !== 'ahead' && standing !== 'conflict';
    const generated = current ? json.generated : standing === 'fresh' && open ? this.file.answers() : keptAnswers(kept);
    // The server's version is unknown: changes are sent once it is back, and a conflict shows then.
    if (away && own && standing !== 'conflict') standing = 'ahead';
    journal.letGo();
    this.file.adopt(json, map, true);
    this.file.mapHash = () => this.#mapHashOf(json);
    keep('last-scene', scene.id);
    this.list.noteOpened(scene.id);
    const answers = generated ? readGenerated({ ...json, generated }, scene) : null;
    const seen = { who: session.selection.peek(), when: session.playhead.time.peek() };
    batch(() => {
      session.open(scene, answers, history);
      if (!mine) this.#lock();
    });
    const committed = document.committed.peek()!;
    const before = saving.opened(committed, etag, standing);
    if (mine) {
      journal.follow(document.history!, scene.id, history && kept, own);
      if (standing === 'behind') void journal.retry();
      if (own && etag && standing !== 'ahead' && standing !== 'conflict') journal.synced(committed, etag);
      if (standing === 'ahead') saving.changed();
      void journal.tidy((id) => this.list.isOwn(id));
    }
    this.#show(scene, answers !== null, again);
    if (again) this.#asSeen(seen.who, seen.when);
    else if (standing === 'ahead' && !own) this.#welcomeBack();
    return before;
  }

  /** Requests the missing answers. */
  #show(scene: Scene, answered: boolean, again: boolean): void {
    const { session } = this;
    const unanswered = !answered && (scene.drawn > 0 || [...scene.agents.values()].some(touched));
    if (unanswered) session.answers.outdate();
    this.opened.emit(scene, again);
    this.#missing = !unanswered ? 'none' : scene.drawn > 0 ? 'everybody' : 'changed';
    this.#askNow();
  }

  /** `ask` may be set after the first scene is shown. */
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
    const { session } = this;
    if (who && session.document.scene.peek()?.agents.has(who)) session.select(who);
    session.playhead.moveTo(when);
  }

  #welcomeBack(): void {
    const action = { label: TEXTS.discard, run: () => this.session.commits.goTo(null) };
    this.session.notices.show({ text: TEXTS.lastSessionRestored, action }, WELCOME_BACK_MS);
  }

  // -------------------------------------------------------------- tabs

  #elsewhere(): void {
    this.journal.letGo();
    this.saving.letGo();
    this.#lock();
  }

  #lock(): void {
    const lock: Lock = {
      words: TEXTS.thisSceneIsOpen,
      label: TEXTS.editHere,
      run: () => this.editHere(),
    };
    this.session.lockWith(lock);
  }

  /** Before another tab takes over, everything is written, and no new work begins. */
  async #handOver(): Promise<void> {
    this.#lock();
    await this.written();
  }

  /** Stores and saves all steps, also those of the next scene, within a time limit for the server. */
  async written(next?: string): Promise<void> {
    await atMost(WRITTEN_WITHIN_MS, this.saving.flush(next));
    await this.journal.flush();
  }

  // -------------------------------------------------------------- conflict

  /** Replaces the shown version with the one on the server; undo brings it back. */
  async takeTheirs(): Promise<void> {
    const { document } = this.session;
    const id = document.scene.peek()?.id;
    if (!id) return;
    try {
      const { plain, etag } = await this.#fetch(id);
      document.afterTrial(() => {
        // The other version may have changed meanwhile.
        if (document.scene.peek()?.id !== id || document.lock.peek() || !this.saving.conflict.peek()) return;
        this.session.commits.adopt(TEXTS.theOtherVersion, plain);
        this.saving.tookTheirs(etag);
        if (etag) this.journal.synced(document.committed.peek()!, etag);
      });
    } catch (e) {
      this.#failed(e);
    }
  }
}
