// Locks a scene among tabs of one browser: one tab holds the lock, the others wait. A waiting tab may ask for it; the
// holder then finishes writing and releases it. A closed or killed tab releases it automatically.

interface LockMessage {
  readonly kind: 'ask' | 'changed';
  readonly scene: string;
}

/** Time for a holder to finish; after it the lock is stolen. */
const PATIENCE_MS = 4000;

const nameOf = (scene: string): string => `dragtraffic:scene:${scene}`;

export interface TurnEvents {
  /** This tab holds the lock now: after a wait, or at once. */
  got(scene: string): void;
  /** Another tab asks for it: pending writes must finish now. */
  leaving(scene: string): Promise<void>;
  /** Another tab holds it now. */
  lost(scene: string): void;
  /** Another tab holds the scene, shown here or not, and has changed it. */
  changed(scene: string): void;
}

export class SceneTurns {
  readonly #channel: BroadcastChannel | null;
  readonly #locks: LockManager | null;
  #scene: string | null = null;
  #holds = false;
  #waiting: AbortController | null = null;
  #letGo: (() => void) | null = null;
  /** Former scenes with a lock still held, each with its release function. */
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
    channel?.addEventListener('message', (e) => void this.#heard((e as MessageEvent<LockMessage>).data));
  }

  /** Does this tab hold the lock? Without lock support every tab does. */
  get holds(): boolean {
    return this.#holds || !this.#locks;
  }

  /** Switches to a scene; true when this tab holds its lock at once. The former one stays locked until `left`. */
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

  /** Releases the locks of former scenes for other tabs, except of the one still shown while the next one comes. */
  left(shown?: string): void {
    for (const [scene, letGo] of this.#before) {
      if (scene === shown) continue;
      letGo();
      this.#before.delete(scene);
    }
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

  /** Asks the holder to release it. A holder that does not release in time is hung, and the lock is stolen. */
  takeOver(): void {
    const scene = this.#scene;
    if (!scene || this.#holds) return;
    this.#channel?.postMessage({ kind: 'ask', scene } satisfies LockMessage);
    setTimeout(() => {
      if (this.#scene !== scene || this.#holds) return;
      this.#waiting?.abort();
      void this.#request(scene, { steal: true }, true);
    }, PATIENCE_MS);
  }

  /** Notifies tabs that show the scene of a change. */
  tellChanged(): void {
    if (this.#scene && this.#holds)
      this.#channel?.postMessage({ kind: 'changed', scene: this.#scene } satisfies LockMessage);
  }

  /** Waits for the lock. */
  #queue(scene: string): void {
    this.#waiting = new AbortController();
    void this.#request(scene, { signal: this.#waiting.signal }, true);
  }

  /** True once the lock is held, which lasts until `#letGo`. */
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
        // Released, or stolen by a tab after its timeout.
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

  async #heard({ kind, scene }: LockMessage): Promise<void> {
    const mine = scene === this.#scene ? this.#holds : this.#before.has(scene);
    if (kind === 'changed') {
      if (!mine) this.on.changed(scene);
      return;
    }
    if (scene !== this.#scene || !mine) return;
    const letGo = this.#letGo;
    await this.on.leaving(scene);
    if (this.#scene !== scene) return;
    letGo?.();
    this.#lose(scene);
  }
}
