// Tabs of one browser take turns at a scene: one holds it, the others wait in line. Who waits may ask for it; the
// holder then finishes its writing and lets go. A tab that is closed or killed lets go by itself.

interface Word {
  readonly kind: 'ask' | 'changed';
  readonly scene: string;
}

/** So long a holder may take to finish; then it is taken for dead. */
const PATIENCE_MS = 4000;

const nameOf = (scene: string): string => `dragtraffic:scene:${scene}`;

export interface TurnEvents {
  /** It is this tab's turn: after it had to wait, or at once. */
  got(scene: string): void;
  /** Another tab wants it: what is not written yet is to be written now. */
  leaving(scene: string): Promise<void>;
  /** It is another tab's turn. */
  lost(scene: string): void;
  /** The holder has changed it. */
  changed(scene: string): void;
}

export class SceneTurns {
  readonly #channel: BroadcastChannel | null;
  readonly #locks: LockManager | null;
  #scene: string | null = null;
  #holds = false;
  #waiting: AbortController | null = null;
  #letGo: (() => void) | null = null;
  /** Scenes that were gone over from and are held yet, each with what releases it. */
  readonly #before = new Map<string, () => void>();

  constructor(
    private readonly on: TurnEvents,
    locks: LockManager | null = globalThis.navigator?.locks ?? null,
    channel: BroadcastChannel | null = typeof BroadcastChannel === 'undefined'
      ? null
      : new BroadcastChannel('dragtraffic:scenes'),
  ) {
    this.#locks = locks;
    this.#channel = channel;
    channel?.addEventListener('message', (e) => void this.#heard((e as MessageEvent<Word>).data));
  }

  /** Is it this tab's turn? Without locks every tab has a turn. */
  get holds(): boolean {
    return this.#holds || !this.#locks;
  }

  /** Goes over to a scene; true when it is this tab's turn at once. The one before stays held until `left`. */
  async goTo(scene: string): Promise<boolean> {
    if (scene === this.#scene) return this.holds;
    this.#waiting?.abort();
    this.#waiting = null;
    if (this.#letGo && this.#scene) this.#before.set(this.#scene, this.#letGo);
    this.#letGo = this.#before.get(scene) ?? null;
    this.#before.delete(scene);
    this.#holds = this.#letGo !== null;
    this.#scene = scene;
    if (this.holds) return true;
    const free = await this.#request(scene, { ifAvailable: true });
    if (!free && this.#scene === scene) this.#queue(scene);
    return free;
  }

  /** Nothing of the scenes before this one is open any more: other tabs may have them. */
  left(): void {
    for (const letGo of this.#before.values()) letGo();
    this.#before.clear();
  }

  leave(): void {
    this.#waiting?.abort();
    this.#waiting = null;
    this.#letGo?.();
    this.#letGo = null;
    this.#holds = false;
    this.#scene = null;
    this.left();
  }

  /** Asks the holder for it. One that does not let go in time has hung, and is passed over. */
  takeOver(): void {
    const scene = this.#scene;
    if (!scene || this.#holds) return;
    this.#channel?.postMessage({ kind: 'ask', scene } satisfies Word);
    setTimeout(() => {
      if (this.#scene !== scene || this.#holds) return;
      this.#waiting?.abort();
      void this.#request(scene, { steal: true }, true);
    }, PATIENCE_MS);
  }

  /** Says that the scene was changed, to those who look at it. */
  tellChanged(): void {
    if (this.#scene && this.#holds) this.#channel?.postMessage({ kind: 'changed', scene: this.#scene } satisfies Word);
  }

  /** Waits in line. */
  #queue(scene: string): void {
    this.#waiting = new AbortController();
    void this.#request(scene, { signal: this.#waiting.signal }, true);
  }

  /** True once the lock is held; it stays so until `#letGo`. */
  #request(scene: string, options: LockOptions, tell = false): Promise<boolean> {
    return new Promise((resolve) => {
      let granted = false;
      const held = (lock: Lock | null): Promise<void> | undefined => {
        if (!lock || this.#scene !== scene) {
          resolve(false);
          return undefined;
        }
        granted = true;
        this.#holds = true;
        this.#waiting = null;
        const until = new Promise<void>((done) => (this.#letGo = done));
        if (tell) this.on.got(scene);
        resolve(true);
        return until;
      };
      this.#locks!.request(nameOf(scene), options, held).catch(() => {
        // Given up, or taken away by a tab that lost its patience.
        if (granted && this.#holds && this.#scene === scene) this.#lose(scene);
        resolve(false);
      });
    });
  }

  #lose(scene: string): void {
    this.#holds = false;
    this.#letGo = null;
    this.on.lost(scene);
    this.#queue(scene);
  }

  async #heard({ kind, scene }: Word): Promise<void> {
    if (scene !== this.#scene) return;
    if (kind === 'changed') {
      if (!this.#holds) this.on.changed(scene);
      return;
    }
    if (!this.#holds) return;
    const letGo = this.#letGo;
    await this.on.leaving(scene);
    if (this.#scene !== scene) return;
    letGo?.();
    this.#lose(scene);
  }
}
