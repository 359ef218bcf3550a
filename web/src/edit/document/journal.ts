// What was done in the open scene, kept on this computer step by step, so that undo and redo outlive the page.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import {
  History,
  isSameDocument,
  replay,
  type Committed,
  type HistoryChange,
  type KeptHistory,
} from '../../model/document/history';
import { isComplete, stateOf, withState, type SceneState } from '../../model/document/scene-diff';
import { sceneKey, shortFor, type Scene } from '../../model/document/scene';
import type { GeneratedJson } from '../../model/document/scene-json';
import { ofAgents, variantsJson } from '../../model/document/scene-writer';
import { isFull, type KeptScene, type Place, type StepStore, type Synced } from '../../net/step-store';
import { TEXTS } from '../../texts/editing/keeping';

/** `kept`: on this computer. `full`: there is no room. `off`: this browser keeps nothing for this page. */
export type Keeping = 'kept' | 'full' | 'off';

/** Scenes whose steps are kept; of more, those looked at longest ago are forgotten once the server has them. */
const MOST_SCENES = 60;
/** So many versions that were sent without a reply are remembered of a scene. */
const MOST_SENT = 20;

/**
 * How a scene goes on from what is kept of it. `ahead`: with changes that the server does not have. `conflict`: with
 * such, and the server has others. `behind`: with the newer version of the server, as a step.
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

/** Names what is to be saved of a scene, shortly. */
const digestOf = (scene: Scene): string => shortFor(versionOf(scene));

/** Does the server have the document that the kept steps lead to, with no other one on its way there? */
const isSynced = ({ head, revision, synced, sent = [] }: Place): boolean =>
  synced !== null && !sent.length && isSameDocument(synced, { step: head, revision });

/** What all road users do in the document that the kept steps lead to, as far as it is kept. */
export function keptAnswers(kept: KeptScene | null): GeneratedJson | null {
  const at = kept && { step: kept.place.head, revision: kept.place.revision };
  return at && kept.answers && isSameDocument(kept.answers, at) ? kept.answers.generated : null;
}

/** Does every step lead back to the first? */
function isWhole({ steps, place }: KeptScene): boolean {
  const there = new Set<number | null>([null, ...steps.map((s) => s.id)]);
  return there.has(place.head) && steps.every((s) => there.has(s.parent));
}

/** What is to be saved of a scene: what is asked, and what people call things. */
export const versionOf = (scene: Scene): string =>
  sceneKey(scene) + scene.name + JSON.stringify([ofAgents(scene.agents.values()), variantsJson(scene), scene.feedback]);

/** A version that was sent from here, or a document that undo leads back to, is no other version. */
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
  #history: History | null = null;
  #scene = '';
  /** The document before the first step, where the file is another by now. */
  #base: SceneState | null = null;
  #synced: Synced | null = null;
  /** Digests of the versions of each scene that were sent since the last one that the server is known to hold. */
  readonly #sent = new Map<string, readonly string[]>();
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
    this.#sent.set(scene, [...(kept?.place.sent ?? []), ...(this.#sent.get(scene) ?? [])].slice(-MOST_SENT));
    this.#base = kept?.base ?? (own ? stateOf(history.first()) : null);
    this.#gap = kept === null;
    history.onChange = (change) => this.#changed(change);
  }

  /** What everybody does where one is now. */
  keepAnswers(generated: GeneratedJson | null): void {
    const history = this.#history;
    if (!history?.kept().steps.length) return;
    const scene = this.#scene;
    const answers = generated && { ...history.ref, generated };
    // They can be worked out anew: where there is no room for them the steps matter more.
    this.#writing = this.#writing.then(() => this.store.keepAnswers(scene, answers)).catch(() => undefined);
  }

  /** Another tab keeps them now. */
  letGo(): void {
    if (this.#history) this.#history.onChange = null;
    this.#history = null;
  }

  /** A committed document is about to be sent to the server: ends when this is kept, with all steps before it. */
  async sending({ scene }: Committed): Promise<void> {
    const digest = digestOf(scene);
    const sent = [...(this.#sent.get(scene.id) ?? []).filter((d) => d !== digest), digest].slice(-MOST_SENT);
    this.#sent.set(scene.id, sent);
    this.#note(scene.id, (place) => ({ ...place, sent }));
    await this.#writing;
  }

  /** Was this document sent from here since the last one that the server is known to hold? */
  wasSent(scene: Scene): boolean {
    return (this.#sent.get(scene.id) ?? []).includes(digestOf(scene));
  }

  /** The server holds a committed document under an ETag; its scene need not be open any more. */
  synced({ scene, step, revision }: Committed, etag: string): void {
    const synced = { etag, step, revision };
    const sent = this.#sent.get(scene.id);
    if (this.#history && scene.id === this.#scene) {
      this.#synced = synced;
      this.#changed({});
    } else this.#note(scene.id, (place) => ({ ...place, synced, sent }));
  }

  /** The same by a save that was answered: what was sent before it cannot arrive any more. */
  saved(committed: Committed, etag: string): void {
    this.#sent.delete(committed.scene.id);
    this.synced(committed, etag);
  }

  #note(scene: string, change: (place: Place) => Place): void {
    this.#writing = this.#writing.then(() => this.store.update(scene, change)).catch(() => undefined);
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

  /** A scene that is not open has another version on the server, with the same in it; `was`: its ETag before. */
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

  /** Forgets the steps of scenes that the server has as they are, but for the open one; says how many. */
  async makeRoom(isOwn: (scene: string) => boolean, least = 0): Promise<number> {
    const places = (await this.store.places()).sort((a, b) => a.at - b.at);
    const saved = places.filter((p) => p.scene !== this.#scene && isOwn(p.scene) && isSynced(p));
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
        this.onKept?.();
      },
      (e: unknown) => {
        this.#gap = true;
        this.#keeping.value = isFull(e) ? 'full' : 'off';
      },
    );
  }
}
