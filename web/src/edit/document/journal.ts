// Steps of the open scene, stored on this computer one by one, so that undo and redo survive a reload.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import { Emitter } from '../../model/base/emitter';
import {
  History,
  isSameDocument,
  replay,
  type Committed,
  type HistoryChange,
  type KeptHistory,
  type ReadonlyHistory,
} from '../../model/document/history';
import { isComplete, stateOf, withState, type SceneState } from '../../model/document/scene-diff';
import { sceneKey, shortFor, type Scene } from '../../model/document/scene';
import type { GeneratedJson } from '../../model/document/scene-json';
import { ofAgents, variantsJson } from '../../model/document/scene-writer';
import { isFull, type KeptScene, type Place, type StepStore, type Synced } from '../../net/step-store';
import { TEXTS } from '../../texts/editing/opening';

/** `kept`: stored on this computer. `full`: the storage is full. `off`: this browser stores nothing for this page. */
export type Keeping = 'kept' | 'full' | 'off';

/** Scenes with stored steps; beyond this, the least recently opened are removed once the server has them. */
const MOST_SCENES = 60;
/** Versions sent without a reply that are remembered for each scene. */
const MOST_SENT = 20;

/**
 * How a scene continues from its stored steps. `ahead`: with changes that the server lacks. `conflict`: with such
 * changes, while the server has others. `behind`: with the newer version of the server, as a step.
 */
export type Standing = 'fresh' | 'same' | 'ahead' | 'behind' | 'conflict';

export interface Resumed {
  readonly scene: Scene;
  readonly history: KeptHistory | null;
  readonly standing: Standing;
}

/** From a file and the stored steps of the scene; `own` scenes are saved to the server after each step. */
export function resume(file: Scene, kept: KeptScene | null, own: boolean, etag: string | null): Resumed {
  const fresh: Resumed = { scene: file, history: null, standing: 'fresh' };
  if (!kept?.steps.length || !isWhole(kept)) return fresh;
  const { head, revision, ahead, synced } = kept.place;
  const history = { steps: kept.steps, head, revision, ahead };
  const scene = replay(kept.base ? withState(file, kept.base) : file, history);
  if (!isComplete(scene)) return fresh;
  if (!own) return { scene, history, standing: head === null ? 'same' : 'ahead' };
  const unsaved = !isSynced(kept.place);
  if (synced !== null && synced.etag === etag) return { scene, history, standing: unsaved ? 'ahead' : 'same' };
  if (!unsaved) {
    const newer = new History(scene, undefined, history);
    newer.adopt(TEXTS.changedElsewhere, file);
    return { scene: file, history: newer.kept(), standing: 'behind' };
  }
  return { scene, history, standing: standingOf(file, scene, { history, sent: kept.place.sent ?? [] }) };
}

/** Short digest of the saved content of a scene. */
const digestOf = (scene: Scene): string => shortFor(versionOf(scene));

/** Does the server have the document after the stored steps, with no other version under way? */
const isSynced = ({ head, revision, synced, sent = [] }: Place): boolean =>
  synced !== null && !sent.length && isSameDocument(synced, { step: head, revision });

/** The stored motions of all road users in the document after the stored steps; null where there are none. */
export function keptAnswers(kept: KeptScene | null): GeneratedJson | null {
  const at = kept && { step: kept.place.head, revision: kept.place.revision };
  return at && kept.answers && isSameDocument(kept.answers, at) ? kept.answers.generated : null;
}

/** Do the steps form an unbroken chain to the first? */
function isWhole({ steps, place }: KeptScene): boolean {
  const there = new Set<number | null>([null, ...steps.map((s) => s.id)]);
  return there.has(place.head) && steps.every((s) => there.has(s.parent));
}

/** The saved content of a scene: conditions, names and notes. */
export const versionOf = (scene: Scene): string =>
  sceneKey(scene) + scene.name + JSON.stringify([ofAgents(scene.agents.values()), variantsJson(scene), scene.feedback]);

/** A version sent from here, or a document that undo leads back to, is not another version. */
function standingOf(
  file: Scene,
  scene: Scene,
  { history, sent }: { history: KeptHistory; sent: readonly string[] },
): Standing {
  const theirs = versionOf(file);
  if (versionOf(scene) === theirs) return 'same';
  const back = new History(scene, undefined, history);
  if (sent.includes(digestOf(file))) return 'ahead';
  while (back.undo()) if (versionOf(back.scene) === theirs) return 'ahead';
  return 'conflict';
}

export class Journal {
  readonly #keeping = signal<Keeping>('kept');
  #history: ReadonlyHistory | null = null;
  #unfollow: (() => void) | null = null;
  #scene = '';
  /** The document before the first step, where the file has changed since. */
  #base: SceneState | null = null;
  #synced: Synced | null = null;
  /** Digests of the versions of each scene sent since the last one that the server is known to hold. */
  readonly #sent = new Map<string, readonly string[]>();
  #writing: Promise<void> = Promise.resolve();
  /** Entries are missing because storage was full: all are written again once there is room. */
  #gap = true;

  readonly keeping: ReadonlySignal<Keeping> = this.#keeping;
  /** A step is stored. */
  readonly stored = new Emitter();

  constructor(readonly store: StepStore) {}

  async read(scene: string): Promise<KeptScene | null> {
    try {
      return await this.store.read(scene);
    } catch {
      this.#keeping.value = 'off';
      return null;
    }
  }

  /**
   * Stores the steps of this history from now on; for an own scene also the document they start from. `kept`: what was
   * stored before, null to discard it.
   */
  follow(history: ReadonlyHistory, scene: string, kept: KeptScene | null, own: boolean): void {
    this.#history = history;
    this.#scene = scene;
    this.#synced = kept?.place.synced ?? null;
    this.#sent.set(scene, [...(kept?.place.sent ?? []), ...(this.#sent.get(scene) ?? [])].slice(-MOST_SENT));
    this.#base = kept?.base ?? (own ? stateOf(history.first()) : null);
    this.#gap = kept === null;
    this.#unfollow?.();
    this.#unfollow = history.changed.listen((change) => this.#changed(change));
  }

  /** Stores the motion of all road users for the current step. */
  keepAnswers(generated: GeneratedJson | null): void {
    const history = this.#history;
    if (!history?.kept().steps.length) return;
    const scene = this.#scene;
    const answers = generated && { ...history.ref, generated };
    // Answers can be computed again: where storage is short the steps matter more.
    this.#writing = this.#writing.then(() => this.store.keepAnswers(scene, answers)).catch(() => undefined);
  }

  /** Another tab stores them now. */
  letGo(): void {
    this.#unfollow?.();
    this.#history = null;
  }

  /** A committed document is about to be sent to the server: resolves when it is stored, with all steps before it. */
  async sending({ scene }: Committed): Promise<void> {
    const digest = digestOf(scene);
    const sent = [...(this.#sent.get(scene.id) ?? []).filter((d) => d !== digest), digest].slice(-MOST_SENT);
    this.#sent.set(scene.id, sent);
    this.#note(scene.id, (place) => ({ ...place, sent }));
    await this.#writing;
  }

  /** Was this document sent from here since the last version that the server is known to hold? */
  wasSent(scene: Scene): boolean {
    return (this.#sent.get(scene.id) ?? []).includes(digestOf(scene));
  }

  /** The server holds a committed document under an ETag; its scene may be closed by now. */
  synced({ scene, step, revision }: Committed, etag: string): void {
    const synced = { etag, step, revision };
    const sent = this.#sent.get(scene.id);
    if (this.#history && scene.id === this.#scene) {
      this.#synced = synced;
      this.#changed({});
    } else this.#note(scene.id, (place) => ({ ...place, synced, sent }));
  }

  /** The same after an answered save: requests sent before it cannot arrive any more. */
  saved(committed: Committed, etag: string): void {
    this.#sent.delete(committed.scene.id);
    this.synced(committed, etag);
  }

  #note(scene: string, change: (place: Place) => Place): void {
    this.#writing = this.#writing.then(() => this.store.update(scene, change)).catch(() => undefined);
  }

  /** Resolves when all is written. */
  flush(): Promise<void> {
    return this.#writing;
  }

  /** Writes all of it again after room was made. */
  retry(): Promise<void> {
    this.#gap = true;
    if (this.#history) this.#changed({});
    return this.#writing;
  }

  /** A scene that is not open has a new version on the server with the same content; `was`: its ETag before. */
  noteVersion(scene: string, was: string | null, etag: string | null): Promise<void> {
    this.#note(scene, (place) =>
      !place.synced || !etag || (was !== null && place.synced.etag !== was)
        ? place
        : { ...place, synced: { ...place.synced, etag } },
    );
    return this.#writing;
  }

  forget(scene: string): Promise<void> {
    return this.store.forget(scene).catch(() => undefined);
  }

  /** Removes the stored steps of scenes that the server has unchanged, except the open one; returns their number. */
  async makeRoom(isOwn: (scene: string) => boolean, least = 0): Promise<number> {
    const places = (await this.store.places()).sort((a, b) => a.at - b.at);
    const saved = places.filter((p) => p.scene !== this.#scene && isOwn(p.scene) && isSynced(p));
    const dropped = saved.slice(0, Math.max(0, places.length - least));
    for (const p of dropped) await this.store.forget(p.scene);
    return dropped.length;
  }

  /** Keeps the number of stored scenes within bounds. */
  async tidy(isOwn: (scene: string) => boolean): Promise<void> {
    await this.makeRoom(isOwn, MOST_SCENES).catch(() => 0);
  }

  #changed({ added, shorter }: HistoryChange): void {
    const history = this.#history;
    if (!history) return;
    if (shorter) this.#base = stateOf(history.first());
    const { steps, ...at } = history.kept();
    const place: Place = {
      scene: this.#scene,
      ...at,
      synced: this.#synced,
      sent: this.#sent.get(this.#scene),
      at: Date.now(),
    };
    const whole = this.#gap || shorter;
    if (whole && !steps.length && !this.#synced) return;
    const base = this.#base;
    this.#gap = false;
    const write = () => (whole ? this.store.rewrite({ place, steps, base }) : this.store.append(place, added ?? null));
    this.#writing = this.#writing.then(write).then(
      () => {
        this.#keeping.value = 'kept';
        this.stored.emit();
      },
      (e: unknown) => {
        this.#gap = true;
        this.#keeping.value = isFull(e) ? 'full' : 'off';
      },
    );
  }
}
