// Reactions of the others if the drag ended now. Requested on a connection of its own, so that it neither overtakes nor
// delays the six futures. A release takes over the last answer.
import { sceneKey, type Scene } from '../../model/document/scene';
import type { Generator, Handlers, Question } from '../../net/generator';
import type { FinalEvent } from '../../net/types';
import { RestTimer } from './rest-timer';

/** Time between two requests. */
const GAP_MS = 150;
const LONGEST_GAP_MS = 250;
/** A drag paused for this long is at rest: a request about an older pose is dropped for the current one. */
const REST_MS = 120;
/** Longest age of a request while the drag moves on. */
const OLDEST_MS = 500;

export interface Asking {
  /** The request that a release would send for a document; null where none is needed. */
  question(scene: Scene, on: Handlers): Question | null;
  /** An answer arrived. */
  preview(scene: Scene, e: FinalEvent): void;
  /** Marks a request as open; the returned function ends it. */
  begin(): () => void;
}

/** An answer to exactly this document. */
export interface Known {
  readonly key: string;
  readonly final: FinalEvent;
  readonly ms: number;
}

interface RunningPreview {
  readonly scene: Scene;
  readonly key: string;
  readonly old: ReturnType<typeof setTimeout>;
  readonly end: () => void;
  /** Set while a release waits for it. */
  awaited: ((known: Known | null) => void) | null;
}

export class ReactionPreview {
  /** The newest pose without a request yet. */
  #wanted: Scene | null = null;
  #endWait: (() => void) | null = null;
  /** Has a request of the drag's own shown a result since the last preview request? The drag's own futures go first. */
  #free = false;
  #running: RunningPreview | null = null;
  #gap: ReturnType<typeof setTimeout> | undefined;
  readonly #rest = new RestTimer(REST_MS);
  #known: Known | null = null;

  constructor(
    private readonly generator: Generator,
    private readonly asking: Asking,
  ) {}

  /** The drag is at another pose. */
  moved(scene: Scene): void {
    this.#wanted = scene;
    this.#rest.begin(() => this.#drop());
    this.#endWait ??= this.asking.begin();
  }

  /** A request of the drag's own has shown a result. The waiting preview request goes before the next one. */
  yielded(): void {
    this.#free = true;
    if (this.#wanted) queueMicrotask(() => this.#next());
  }

  /** The answer is no longer needed. */
  drop(): void {
    this.#forget();
    this.#known = null;
    this.#stop();
  }

  /**
   * The release: `take` gets the answer to exactly this document, at once or when it arrives, or null when it fails.
   * False when none is known or under way: the caller must request it.
   */
  release(scene: Scene, take: (known: Known | null) => void): boolean {
    const key = sceneKey(scene);
    const known = this.#known?.key === key ? this.#known : null;
    this.#forget();
    this.#known = null;
    if (known) {
      this.#stop();
      take(known);
      return true;
    }
    if (this.#running?.key !== key) {
      this.#stop();
      return false;
    }
    this.#running.awaited = take;
    return true;
  }

  #forget(): void {
    this.#rest.stop();
    this.#wanted = null;
    this.#endWait?.();
    this.#endWait = null;
  }

  #stop(): void {
    const was = this.#running;
    if (!was) return;
    this.#free = true;
    this.#over(was);
    this.generator.cancel();
    was.awaited?.(null);
  }

  #next(): void {
    const scene = this.#wanted;
    if (!scene || !this.#free || this.#running || this.#gap !== undefined) return;
    const key = sceneKey(scene);
    this.#wanted = null;
    if (this.#known?.key !== key) this.#ask(scene, key);
    this.#endWait?.();
    this.#endWait = null;
  }

  #ask(scene: Scene, key: string): void {
    const question = this.asking.question(scene, {
      draft: () => undefined,
      final: (final, ms) => this.#answered(running, { key, final, ms }),
      refused: () => this.#failed(running),
      away: () => this.#failed(running),
      dropped: () => this.#failed(running),
    });
    if (!question) return;
    const old = setTimeout(() => this.#drop(), OLDEST_MS);
    const running: RunningPreview = { scene, key, old, end: this.asking.begin(), awaited: null };
    this.#running = running;
    this.#free = false;
    this.#pause(GAP_MS);
    this.generator.ask(question);
  }

  #pause(ms: number): void {
    clearTimeout(this.#gap);
    this.#gap = setTimeout(() => {
      this.#gap = undefined;
      this.#next();
    }, ms);
  }

  #answered(running: RunningPreview, known: Known): void {
    if (this.#running !== running) return;
    this.#over(running);
    // If previews take long, at least half of the time is left to the drag's own requests.
    if (known.ms > GAP_MS / 2) this.#pause(Math.min(known.ms, LONGEST_GAP_MS));
    if (running.awaited) {
      running.awaited(known);
      return;
    }
    this.#known = known;
    this.asking.preview(running.scene, known.final);
    this.#next();
  }

  #failed(running: RunningPreview): void {
    if (this.#running !== running) return;
    this.#over(running);
    running.awaited?.(null);
    this.#next();
  }

  /** Cancels the running request if a newer pose waits. */
  #drop(): void {
    if (!this.#wanted) return;
    this.#stop();
    this.#next();
  }

  #over(running: RunningPreview): void {
    clearTimeout(running.old);
    running.end();
    if (this.#running === running) this.#running = null;
  }
}
