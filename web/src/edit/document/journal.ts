// What was done in the open scene, kept on this computer step by step, so that undo and redo outlive the page.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import { History, replay, type HistoryChange, type KeptHistory } from '../../model/history';
import { isComplete, stateOf, withState, type SceneState } from '../../model/scene-diff';
import { sceneKey, type Scene } from '../../model/scene';
import type { GeneratedJson } from '../../model/json';
import { ofAgents, variantsJson } from '../../model/write';
import { isFull, type KeptScene, type StepStore, type Synced } from '../../net/step-store';

/** `kept`: on this computer. `full`: there is no room. `off`: this browser keeps nothing for this page. */
export type Keeping = 'kept' | 'full' | 'off';

/** Scenes whose steps are kept; of more, those looked at longest ago are forgotten once the server has them. */
const MOST_SCENES = 60;

/**
 * How a scene goes on from what is kept of it. `ahead`: with changes that the server does not have. `conflict`: with
 * such, and the server has others. `behind`: the server has a newer one.
 */
export type Standing = 'fresh' | 'same' | 'ahead' | 'behind' | 'conflict';

export interface Resumed {
  readonly scene: Scene;
  readonly history: KeptHistory | null;
  readonly standing: Standing;
}

/** From a file and what was kept of the scene; `own` ones are saved to the server step by step. */
export function resume(file: Scene, kept: KeptScene | null, own: boolean, etag: string | null): Resumed {
  const fresh: Resumed = { scene: file, history: null, standing: 'fresh' };
  if (!kept?.steps.length || !isWhole(kept)) return fresh;
  const { head, ahead, synced } = kept.place;
  const history = { steps: kept.steps, head, ahead };
  const scene = replay(kept.base ? withState(file, kept.base) : file, history);
  if (!isComplete(scene)) return fresh;
  if (!own) return { scene, history, standing: head === null ? 'same' : 'ahead' };
  const unsaved = synced?.step !== head || synced === null;
  if (synced !== null && synced.etag === etag) return { scene, history, standing: unsaved ? 'ahead' : 'same' };
  if (!unsaved) return { scene, history, standing: 'behind' };
  return { scene, history, standing: standingOf(file, scene, history) };
}

/** Does every step lead back to the first? */
function isWhole({ steps, place }: KeptScene): boolean {
  const there = new Set<number | null>([null, ...steps.map((s) => s.id)]);
  return there.has(place.head) && steps.every((s) => there.has(s.parent));
}

/** What is to be saved of a scene: what is asked, and what people call things. */
const versionOf = (scene: Scene): string =>
  sceneKey(scene) + scene.name + JSON.stringify([ofAgents(scene.agents.values()), variantsJson(scene)]);

/** A page that ended right after it had saved could not note that: the server's version is then one of its steps. */
function standingOf(file: Scene, scene: Scene, history: KeptHistory): Standing {
  const theirs = versionOf(file);
  const h = new History(scene, undefined, history);
  if (versionOf(h.scene) === theirs) return 'same';
  while (h.undo()) if (versionOf(h.scene) === theirs) return 'ahead';
  return 'conflict';
}

export class Journal {
  readonly #keeping = signal<Keeping>('kept');
  #history: History | null = null;
  #scene = '';
  /** The document before the first step, where the file is another by now. */
  #base: SceneState | null = null;
  #synced: Synced | null = null;
  #writing: Promise<void> = Promise.resolve();
  /** Entries that are missing, because there was no room: all is written anew when there is. */
  #gap = true;

  readonly keeping: ReadonlySignal<Keeping> = this.#keeping;
  /** Called when a step is kept. */
  onKept: (() => void) | null = null;

  constructor(private readonly store: StepStore) {}

  async read(scene: string): Promise<KeptScene | null> {
    try {
      return await this.store.read(scene);
    } catch {
      this.#keeping.value = 'off';
      return null;
    }
  }

  /**
   * From now on the steps of this history are kept; of an own scene with the document that they start from. `kept` is
   * what was kept of it before, null where nothing of it is to stay.
   */
  follow(history: History, scene: string, kept: KeptScene | null, own: boolean): void {
    this.#history = history;
    this.#scene = scene;
    this.#synced = kept?.place.synced ?? null;
    this.#base = kept?.base ?? (own ? stateOf(history.first()) : null);
    this.#gap = kept === null;
    history.onChange = (change) => this.#changed(change);
  }

  /** What everybody does where one is now. */
  keepAnswers(generated: GeneratedJson | null): void {
    const history = this.#history;
    if (!history?.kept().steps.length) return;
    const scene = this.#scene;
    const answers = generated && { step: history.head, generated };
    // They can be worked out anew: where there is no room for them the steps matter more.
    this.#writing = this.#writing.then(() => this.store.keepAnswers(scene, answers)).catch(() => undefined);
  }

  /** Another tab keeps them now. */
  letGo(): void {
    if (this.#history) this.#history.onChange = null;
    this.#history = null;
  }

  /** The server holds what the document was at this step. */
  synced(etag: string, step: number | null): void {
    this.#synced = { etag, step };
    if (this.#history) this.#changed({});
  }

  /** Everything is written. */
  flush(): Promise<void> {
    return this.#writing;
  }

  /** Writes all of it once more, after room was made. */
  retry(): Promise<void> {
    this.#gap = true;
    if (this.#history) this.#changed({});
    return this.#writing;
  }

  /** A scene that is not open has another version on the server, with the same in it. */
  async noteVersion(scene: string, was: string | null, etag: string | null): Promise<void> {
    const kept = await this.read(scene);
    const synced = kept?.place.synced;
    if (!kept || !synced || !etag || (was !== null && synced.etag !== was)) return;
    await this.store.append({ ...kept.place, synced: { ...synced, etag } }, null).catch(() => undefined);
  }

  forget(scene: string): Promise<void> {
    return this.store.forget(scene).catch(() => undefined);
  }

  /** Forgets the steps of scenes that the server has as they are, but for the open one; says how many. */
  async makeRoom(isOwn: (scene: string) => boolean, least = 0): Promise<number> {
    const places = (await this.store.places()).sort((a, b) => a.at - b.at);
    const saved = places.filter((p) => p.scene !== this.#scene && isOwn(p.scene) && p.synced?.step === p.head);
    const dropped = saved.slice(0, Math.max(0, places.length - least));
    for (const p of dropped) await this.store.forget(p.scene);
    return dropped.length;
  }

  /** Keeps the number of scenes within bounds. */
  async tidy(isOwn: (scene: string) => boolean): Promise<void> {
    await this.makeRoom(isOwn, MOST_SCENES).catch(() => 0);
  }

  #changed({ added, shorter }: HistoryChange): void {
    const history = this.#history;
    if (!history) return;
    if (shorter) this.#base = stateOf(history.first());
    const { head, ahead, steps } = history.kept();
    const place = { scene: this.#scene, head, ahead, synced: this.#synced, at: Date.now() };
    const whole = this.#gap || shorter;
    if (whole && !steps.length && !this.#synced) return;
    const base = this.#base;
    this.#gap = false;
    const write = () => (whole ? this.store.rewrite({ place, steps, base }) : this.store.append(place, added ?? null));
    this.#writing = this.#writing.then(write).then(
      () => {
        this.#keeping.value = 'kept';
        this.onKept?.();
      },
      (e: unknown) => {
        this.#gap = true;
        this.#keeping.value = isFull(e) ? 'full' : 'off';
      },
    );
  }
}
