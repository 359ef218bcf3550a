// History of scenes on this computer: one entry for each step, written as it is made; plus the current step, the
// document before the first, and the motions of all at the current step.
import type { GeneratedJson } from '../model/document/scene-json';
import type { DocumentRef, HistoryStep, KeptHistory } from '../model/document/history';
import type { SceneState } from '../model/document/scene-diff';

/** The document known to equal a version on the server. */
export interface Synced extends DocumentRef {
  readonly etag: string;
}

export interface Place extends Omit<KeptHistory, 'steps'> {
  readonly scene: string;
  /** Time of the last write, milliseconds since 1970. */
  readonly at: number;
  readonly synced: Synced | null;
  /** Digests of the versions sent to the server after that one. */
  readonly sent?: readonly string[];
}

/** Motions of all road users in a document. */
export interface KeptAnswers extends DocumentRef {
  readonly generated: GeneratedJson;
}

export interface KeptScene {
  readonly place: Place;
  readonly steps: readonly HistoryStep[];
  /** Null where the file itself is the document before the first step. */
  readonly base: SceneState | null;
  readonly answers: KeptAnswers | null;
}

export interface StepStore {
  read(scene: string): Promise<KeptScene | null>;
  /** Adds a step, or none, and updates the current one. */
  append(place: Place, step: HistoryStep | null): Promise<void>;
  /** Changes the place of a scene where it has one, as one transaction. */
  update(scene: string, change: (place: Place) => Place): Promise<void>;
  /** Writes everything again, except the answers. */
  rewrite(kept: Omit<KeptScene, 'answers'>): Promise<void>;
  keepAnswers(scene: string, answers: KeptAnswers | null): Promise<void>;
  forget(scene: string): Promise<void>;
  places(): Promise<Place[]>;
}

/** Storage is full, as opposed to forbidden. */
export const isFull = (e: unknown): boolean => e instanceof DOMException && e.name === 'QuotaExceededError';

const NAME = 'dragtraffic';
const VERSION = 2;
const PLACES = 'places',
  STEPS = 'steps',
  BASES = 'bases',
  ANSWERS = 'answers';
const ALL = [PLACES, STEPS, BASES, ANSWERS];

interface StoredStep extends HistoryStep {
  readonly scene: string;
}

export class BrowserStepStore implements StepStore {
  #opening: Promise<IDBDatabase> | null = null;

  #open(): Promise<IDBDatabase> {
    this.#opening ??= new Promise<IDBDatabase>((resolve, reject) => {
      const request = indexedDB.open(NAME, VERSION);
      request.onupgradeneeded = ({ oldVersion }) => {
        const db = request.result;
        if (oldVersion < 1) {
          db.createObjectStore(PLACES, { keyPath: 'scene' });
          db.createObjectStore(STEPS, { keyPath: ['scene', 'id'] });
          db.createObjectStore(BASES);
        }
        db.createObjectStore(ANSWERS);
      };
      request.onsuccess = () => {
        // A newer version in another tab may change the schema: this connection closes and reopens on demand.
        request.result.onversionchange = () => request.result.close();
        request.result.onclose = () => (this.#opening = null);
        resolve(request.result);
      };
      request.onerror = () => reject(request.error ?? new Error('no storage'));
    }).catch((e: unknown) => {
      this.#opening = null;
      throw e;
    });
    return this.#opening;
  }

  async #write(work: (t: IDBTransaction) => void): Promise<void> {
    const db = await this.#open();
    await new Promise<void>((resolve, reject) => {
      const t = db.transaction(ALL, 'readwrite');
      t.oncomplete = () => resolve();
      t.onabort = () => reject(t.error ?? new Error('not stored'));
      work(t);
    });
  }

  async read(scene: string): Promise<KeptScene | null> {
    const t = (await this.#open()).transaction(ALL, 'readonly');
    const [place, steps, base, answers] = await Promise.all([
      got<Place | undefined>(t.objectStore(PLACES).get(scene)),
      got<StoredStep[]>(t.objectStore(STEPS).getAll(stepsOf(scene))),
      got<SceneState | undefined>(t.objectStore(BASES).get(scene)),
      got<KeptAnswers | undefined>(t.objectStore(ANSWERS).get(scene)),
    ]);
    if (!place) return null;
    return { place, steps, base: base ?? null, answers: answers ?? null };
  }

  append(place: Place, step: HistoryStep | null): Promise<void> {
    return this.#write((t) => {
      if (step) t.objectStore(STEPS).put({ ...step, scene: place.scene });
      t.objectStore(PLACES).put(place);
    });
  }

  update(scene: string, change: (place: Place) => Place): Promise<void> {
    return this.#write((t) => {
      const places = t.objectStore(PLACES);
      const asked = places.get(scene);
      asked.onsuccess = () => {
        if (asked.result) places.put(change(asked.result as Place));
      };
    });
  }

  rewrite({ place, steps, base }: Omit<KeptScene, 'answers'>): Promise<void> {
    const { scene } = place;
    return this.#write((t) => {
      t.objectStore(STEPS).delete(stepsOf(scene));
      for (const s of steps) t.objectStore(STEPS).put({ ...s, scene });
      if (base) t.objectStore(BASES).put(base, scene);
      else t.objectStore(BASES).delete(scene);
      t.objectStore(PLACES).put(place);
    });
  }

  keepAnswers(scene: string, answers: KeptAnswers | null): Promise<void> {
    return this.#write((t) => {
      if (answers) t.objectStore(ANSWERS).put(answers, scene);
      else t.objectStore(ANSWERS).delete(scene);
    });
  }

  forget(scene: string): Promise<void> {
    return this.#write((t) => {
      t.objectStore(STEPS).delete(stepsOf(scene));
      t.objectStore(BASES).delete(scene);
      t.objectStore(ANSWERS).delete(scene);
      t.objectStore(PLACES).delete(scene);
    });
  }

  async places(): Promise<Place[]> {
    return got<Place[]>((await this.#open()).transaction(PLACES, 'readonly').objectStore(PLACES).getAll());
  }
}

/** In key order numbers precede lists. */
const stepsOf = (scene: string): IDBKeyRange => IDBKeyRange.bound([scene], [scene, []]);

const got = <T>(request: IDBRequest): Promise<T> =>
  new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result as T);
    request.onerror = () => reject(request.error ?? new Error('not read'));
  });

/** For pages without storage, and for tests: kept while the page is open. */
export class PassingStepStore implements StepStore {
  readonly #kept = new Map<string, KeptScene>();

  async read(scene: string): Promise<KeptScene | null> {
    return structuredClone(this.#kept.get(scene) ?? null);
  }

  async append(place: Place, step: HistoryStep | null): Promise<void> {
    const old = this.#kept.get(place.scene);
    const others = (old?.steps ?? []).filter((s) => s.id !== step?.id);
    const steps = step ? [...others, structuredClone(step)] : others;
    this.#kept.set(place.scene, { place, steps, base: old?.base ?? null, answers: old?.answers ?? null });
  }

  async update(scene: string, change: (place: Place) => Place): Promise<void> {
    const old = this.#kept.get(scene);
    if (old) this.#kept.set(scene, { ...old, place: change(old.place) });
  }

  async rewrite(kept: Omit<KeptScene, 'answers'>): Promise<void> {
    const answers = this.#kept.get(kept.place.scene)?.answers ?? null;
    this.#kept.set(kept.place.scene, structuredClone({ ...kept, answers }));
  }

  async keepAnswers(scene: string, answers: KeptAnswers | null): Promise<void> {
    const kept = this.#kept.get(scene);
    if (kept) this.#kept.set(scene, { ...kept, answers: structuredClone(answers) });
  }

  async forget(scene: string): Promise<void> {
    this.#kept.delete(scene);
  }

  async places(): Promise<Place[]> {
    return [...this.#kept.values()].map((k) => k.place);
  }
}
