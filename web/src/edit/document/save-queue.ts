// Saves one scene to the server: one request at a time; the newest version waits, and each request names the version it
// replaces. The queue continues when another scene is opened.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { SceneJson } from '../../model/document/scene-json';
import { Away, Refused, type Client } from '../../net/client';
import type { Snapshot } from './scene-file';

/** `behind`: the server lacks the newest version, without a conflict. `conflict`: it has another one. */
export type QueueState = 'saved' | 'saving' | 'behind' | 'conflict';

/** A foreign version on the server; without an ETag where the scene was deleted there. */
export interface Conflict {
  readonly etag: string | null;
}

export interface SaveEvents {
  /** The server holds a snapshot under an ETag. */
  saved(snapshot: Snapshot, etag: string | null): void;
  /** A snapshot is about to be sent; sending waits for this. */
  sending(snapshot: Snapshot): Promise<void>;
  /** Is a version found on the server this one, another one sent from here, or foreign? */
  compare(theirs: SceneJson, snapshot: Snapshot): 'same' | 'ours' | 'theirs';
}

/** Delay after a change, in which further changes are collected. */
const DELAY_MS = 300;
/** Delays of the retries without an answer; the last one repeats. */
const RETRY_MS = [2000, 5000, 15_000, 30_000];

export class SaveQueue {
  readonly #state = signal<QueueState>('saved');
  readonly #conflict = signal<Conflict | null>(null);
  /** The newest version, while the server lacks it. */
  #newest: Snapshot | null = null;
  #etag: string | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;
  /** The newest version is due as soon as no request is under way. */
  #due = false;
  #running: Promise<void> | null = null;
  /** Increases when the running request no longer counts. */
  #turn = 0;
  #tries = 0;

  readonly state: ReadonlySignal<QueueState> = this.#state;
  readonly conflict: ReadonlySignal<Conflict | null> = this.#conflict;

  constructor(
    private readonly id: string,
    private readonly client: Client,
    private readonly on: SaveEvents,
  ) {}

  /** The version on the server that the next request replaces. */
  get etag(): string | null {
    return this.#etag;
  }

  /** The newest version, where the server lacks it. */
  get unsaved(): Snapshot | null {
    return this.#newest;
  }

  get isSending(): boolean {
    return this.#running !== null;
  }

  /** The scene was opened, and its start was compared with the server. */
  opened(etag: string | null, state: QueueState): void {
    this.stop();
    this.#etag = etag;
    this.#conflict.value = state === 'conflict' ? { etag } : null;
    this.#state.value = state;
  }

  /** Queues a version. In a conflict it waits for the decision. */
  push(snapshot: Snapshot): void {
    this.#newest = snapshot;
    if (this.#conflict.peek()) return;
    this.#state.value = 'saving';
    this.#sendIn(DELAY_MS);
  }

  /** The server may be back: sends the newest version at once. */
  retry(): void {
    if (this.#state.peek() === 'behind' && this.#newest) void this.#send();
  }

  /** Sends the newest version; resolves when it is saved, or cannot be. */
  async flush(): Promise<void> {
    while (this.#state.peek() === 'saving') await this.#send();
  }

  /** Another tab saves the scene from now on. A running request may still arrive at the server. */
  stop(): void {
    clearTimeout(this.#timer);
    this.#turn++;
    this.#running = this.#newest = null;
    this.#due = false;
    this.#tries = 0;
    if (this.#state.peek() === 'saving') this.#state.value = 'behind';
  }

  /** Resolves the conflict: this version replaces the one on the server, or creates the scene again. */
  async keep(snapshot: Snapshot): Promise<void> {
    const conflict = this.#conflict.peek();
    if (!conflict) return;
    this.#newest ??= snapshot;
    this.#etag = conflict.etag;
    this.#conflict.value = null;
    await this.#send();
  }

  /** Resolves the conflict: the version on the server is the document now. */
  tookTheirs(etag: string | null): void {
    this.stop();
    this.#etag = etag;
    this.#conflict.value = null;
    this.#state.value = 'saved';
  }

  #sendIn(ms: number): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#send(), ms);
  }

  #send(): Promise<void> {
    clearTimeout(this.#timer);
    if (!this.#newest || this.#conflict.peek()) return Promise.resolve();
    this.#due = true;
    this.#state.value = 'saving';
    this.#running ??= this.#sendAll(this.#turn);
    return this.#running;
  }

  async #sendAll(turn: number): Promise<void> {
    while (this.#due && this.#newest && !this.#conflict.peek()) {
      this.#due = false;
      const snapshot = this.#newest;
      await this.on.sending(snapshot);
      if (turn !== this.#turn) return;
      const end = await this.#try(snapshot);
      if (turn !== this.#turn) return;
      end();
    }
    this.#running = null;
  }

  /** Sends a request; the returned function applies the result if it still counts. */
  async #try(snapshot: Snapshot): Promise<() => void> {
    try {
      const etag = await this.#put(snapshot, this.#etag);
      return () => this.#saved(snapshot, etag);
    } catch (e) {
      if (e instanceof Refused && (e.status === 412 || e.status === 404)) return this.#compare(snapshot);
      return () => this.#away(e);
    }
  }

  #saved(snapshot: Snapshot, etag: string | null): void {
    this.#etag = etag;
    this.#tries = 0;
    if (this.#newest === snapshot) {
      this.#newest = null;
      this.#state.value = 'saved';
    }
    this.on.saved(snapshot, etag);
  }

  async #put(snapshot: Snapshot, etag: string | null): Promise<string | null> {
    try {
      return await this.client.save(this.id, snapshot.body(), etag);
    } catch (e) {
      const unknownMap = e instanceof Refused && e.problem.code === 'unknown-map';
      if (unknownMap) return this.client.save(this.id, snapshot.complete(), etag);
      throw e;
    }
  }

  /** The server has another version than expected: it may be ours, with its reply lost. */
  async #compare(snapshot: Snapshot): Promise<() => void> {
    try {
      const { json, etag } = await this.client.scene(this.id);
      return () => {
        const found = this.on.compare(json, snapshot);
        if (found === 'theirs') return this.#contradicted(etag);
        if (found === 'same') return this.#saved(snapshot, etag);
        this.#etag = etag;
        this.#due = true;
      };
    } catch (e) {
      return () => (e instanceof Refused && e.status === 404 ? this.#contradicted(null) : this.#away(e));
    }
  }

  #contradicted(etag: string | null): void {
    this.#conflict.value = { etag };
    this.#state.value = 'conflict';
  }

  /** An unreachable or busy server is retried; after a refusal the next change is sent. */
  #away(e: unknown): void {
    if (!this.#newest || this.#due) return;
    this.#state.value = 'behind';
    const passes = e instanceof Away || (e instanceof Refused && (e.status === 503 || e.status === 429));
    if (passes) this.#sendIn(RETRY_MS[Math.min(this.#tries++, RETRY_MS.length - 1)]);
  }
}
