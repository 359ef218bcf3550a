// Whose scene is open, on a server whose scenes have owners. One that others may only view is read-only for them.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import { Refused, type Client } from '../../net/client';
import type { SceneListItem } from '../../net/types';
import type { Library } from './library';
import type { SceneCare } from './scene-care';
import type { SceneFile } from './scene-file';
import type { SceneList } from './scene-list';
import type { Session } from './session';
import { TEXTS } from '../../texts/editing/keeping';

/** An ETag that no scene has, and the status of a change that names another version than the stored one. */
const NO_VERSION = '"0"';
const STALE = 412;

/**
 * Does a scene belong to this user? Setting the access that it has, for a version that no scene has, changes nothing:
 * the owner is refused for the version, others for their right.
 */
async function isMine({ id, shared }: SceneListItem, client: Client): Promise<boolean> {
  try {
    await client.patch(id, { shared: shared! }, NO_VERSION);
  } catch (e) {
    if (e instanceof Refused && e.problem.code === 'forbidden') return false;
    if (!(e instanceof Refused && e.status === STALE)) throw e;
  }
  return true;
}

export class Ownership {
  /** Scenes that belong to others. */
  readonly #foreign = signal<ReadonlySet<string>>(new Set());
  /** Scenes about which the server was asked. */
  readonly #asked = new Set<string>();

  constructor(
    private readonly session: Session,
    private readonly file: SceneFile,
    private readonly list: SceneList,
    private readonly care: SceneCare,
    private readonly client: Client,
    opened: Library['opened'],
  ) {
    opened.listen(() => this.#look());
    list.list.subscribe(() => this.#look());
  }

  /** Ids of the opened scenes that belong to other users. */
  get foreign(): ReadonlySignal<ReadonlySet<string>> {
    return this.#foreign;
  }

  #look(): void {
    const id = this.session.document.scene.peek()?.id;
    const item = id === undefined || !this.file.stored ? undefined : this.list.find(id);
    if (!item?.shared) return;
    if (this.#foreign.peek().has(item.id)) this.#protect(item);
    else if (!this.#asked.has(item.id)) void this.#ask(item);
  }

  async #ask(item: SceneListItem): Promise<void> {
    this.#asked.add(item.id);
    try {
      if (await isMine(item, this.client)) return;
    } catch {
      // Unknown as yet: the next opening asks again.
      this.#asked.delete(item.id);
      return;
    }
    this.#foreign.value = new Set([...this.#foreign.peek(), item.id]);
    this.#protect(item);
  }

  #protect({ id, owner, shared }: SceneListItem): void {
    const { document } = this.session;
    if (shared !== 'read' || document.scene.peek()?.id !== id || document.lock.peek()) return;
    this.session.lockWith({
      words: TEXTS.onlyOwnerChanges(owner ?? ''),
      label: TEXTS.makeACopy,
      run: () => void this.care.saveCopy(),
    });
  }
}
