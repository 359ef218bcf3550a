// Operations on whole scenes: create, copy, rename, delete, restore.
import { emptyScene, withoutRoadUsers } from '../../model/document/blank-scene';
import { rename } from '../../model/document/commands';
import { isMapRef, type SceneJson } from '../../model/document/scene-json';
import { Refused, type Client } from '../../net/client';
import type { SceneShare } from '../../net/types';
import { carriedSteps, carrySteps } from './carried-steps';
import type { Journal } from './journal';
import type { Library } from './library';
import type { Saving } from './saving';
import type { SceneFile } from './scene-file';
import type { SceneList } from './scene-list';
import type { Session } from './session';
import { TEXTS } from '../../texts/editing/keeping';

/** Time in which a deleted scene can be restored from the toast. */
const UNDELETE_MS = 20_000;

export class SceneCare {
  constructor(
    private readonly session: Session,
    private readonly file: SceneFile,
    private readonly library: Library,
    private readonly list: SceneList,
    private readonly client: Client,
    private readonly journal: Journal,
    private readonly saving: Saving,
  ) {}

  /** The road of the open scene without road users. */
  newOnThisRoad(): Promise<void> {
    const body = this.file.complete();
    return body ? this.#begin(withoutRoadUsers(body)) : Promise.resolve();
  }

  /** A map made in the editor, or a scene with another map. */
  newOnMap(body: SceneJson, name: string, more = ''): Promise<void> {
    const free = this.#freeName(name);
    return this.#create(body, free, more || TEXTS.mapAdded(free));
  }

  newOnPlainGround(): Promise<void> {
    return this.#begin(emptyScene());
  }

  #begin(body: SceneJson): Promise<void> {
    const name = this.#freeName(TEXTS.newScene);
    return this.#create(body, name, TEXTS.noRoadUsersYet(name));
  }

  /** An own copy of the shown scene, saved from then on. */
  saveCopy(): Promise<void> {
    const scene = this.session.document.scene.peek();
    const body = this.file.complete();
    if (!scene || !body) return Promise.resolve();
    const own = this.list.isOwn(scene.id) && this.file.stored;
    return this.saveAs(this.#freeName(own ? TEXTS.copy(scene.name) : TEXTS.edited(scene.name)));
  }

  saveAs(name: string): Promise<void> {
    const body = this.file.complete();
    if (!body) return Promise.resolve();
    const parent = this.file.stored ? (this.file.raw?.id ?? null) : null;
    const said = TEXTS.savedAs(name);
    return this.#create({ ...body, meta: { ...body.meta, parent_id: parent } }, name, said, true);
  }

  /** `isCopy`: view, selection, time and steps stay. */
  async #create(body: SceneJson, name: string, said: string, isCopy = false): Promise<void> {
    const { session } = this;
    const { history } = session.document;
    const steps = isCopy && history ? carriedSteps(history, name) : null;
    try {
      const { id, etag } = await this.client.create({ ...body, id: undefined, name });
      if (steps && etag) await carrySteps(this.journal.store, id, steps, etag);
      await this.list.refresh().catch(() => undefined);
      await this.library.open(id, isCopy);
      session.notices.show({ text: said });
    } catch (e) {
      this.#failed(TEXTS.notSaved, e);
    }
  }

  /** Copies any scene; the open one in its shown state. */
  async duplicate(id: string): Promise<void> {
    if (id === this.session.document.scene.peek()?.id) return this.saveCopy();
    const name = this.#freeName(TEXTS.copy(this.list.find(id)?.name ?? TEXTS.scene));
    try {
      const { id: copy } = await this.client.duplicate(id, name);
      await this.list.refresh().catch(() => undefined);
      const action = { label: TEXTS.open, run: () => void this.library.open(copy) };
      this.session.notices.show({ text: TEXTS.copiedAs(name), action });
    } catch (e) {
      this.#failed(TEXTS.notCopied, e);
    }
  }

  async rename(id: string, name: string): Promise<void> {
    const { session, list } = this;
    const scene = session.document.scene.peek();
    if (scene?.id === id) {
      if (scene.name !== name) session.commits.run(rename(name));
      return;
    }
    try {
      const etag = list.find(id)?.etag ?? '*';
      const now = await this.client.patch(id, { name }, etag);
      await this.journal.noteVersion(id, etag, now);
      await list.refresh();
    } catch (e) {
      this.#failed(TEXTS.notRenamed, e);
    }
  }

  /**
   * Says what others may do with the open scene, on a server whose scenes have owners. The new version of the server is
   * that of this tab, unless the scene was changed here meanwhile: then saving finds the conflict.
   */
  async share(shared: SceneShare): Promise<void> {
    const { committed } = this.session.document;
    try {
      await this.library.written();
      const now = committed.peek();
      const was = now && this.saving.etagOf(now.scene.id);
      if (!now || !was) return;
      const etag = await this.client.patch(now.scene.id, { shared }, was);
      if (etag && committed.peek() === now) {
        this.saving.tookTheirs(etag);
        this.journal.synced(now, etag);
      }
      await this.list.refresh();
    } catch (e) {
      this.#failed(TEXTS.accessNotChanged, e);
    }
  }

  /** Deletes a scene; the toast restores it unchanged, under its old address. */
  async remove(id: string): Promise<void> {
    const { session, library, list } = this;
    const name = list.find(id)?.name ?? id;
    const open = session.document.scene.peek()?.id === id;
    try {
      if (open) await library.written();
      const { json, etag } = await this.client.scene(id);
      const map = isMapRef(json.map) ? await this.client.map(json.map.ref) : json.map;
      await this.client.remove(id, etag ?? '*');
      await list.refresh().catch(() => undefined);
      const next = list.list.peek().find((s) => s.id !== id);
      if (open && next) await library.open(next.id);
      const action = { label: TEXTS.undo, run: () => void this.#bringBack(id, { ...json, map }, open) };
      session.notices.show({ text: TEXTS.deleted(name), action }, UNDELETE_MS);
    } catch (e) {
      this.#failed(TEXTS.notDeleted, e);
    }
  }

  async #bringBack(id: string, body: SceneJson, open: boolean): Promise<void> {
    try {
      const etag = await this.client.save(id, body, null);
      if (etag) await this.journal.noteVersion(id, null, etag);
      await this.list.refresh().catch(() => undefined);
      if (open) await this.library.open(id);
      this.session.notices.show({ text: TEXTS.restored(body.name) });
    } catch (e) {
      this.#failed(TEXTS.notRestored, e);
    }
  }

  /** The name, with a number after it where it is taken. */
  #freeName(name: string): string {
    const taken = new Set(this.list.list.peek().map((s) => s.name));
    if (!taken.has(name)) return name;
    let n = 2;
    while (taken.has(`${name} ${n}`)) n++;
    return `${name} ${n}`;
  }

  #failed(what: string, e: unknown): void {
    const why = e instanceof Refused ? e.message : TEXTS.theServerIsNotAnswering;
    this.session.notices.show({ text: `${what}: ${why}` });
  }
}
