// What the others would do if one let go now: asked beside the drag's own question, on a line of its own, so that it
// neither overtakes nor holds up the six futures. The last answer is the one that a release takes over.
import { sceneKey, type Scene } from '../model/scene';
import type { Generator, Handlers, Question } from '../net/generator';
import type { FinalEvent } from '../net/types';

/** Time between two questions, and how old one may get before a newer pose drops it. */
const GAP_MS = 100;
const OLDEST_MS = 250;

export interface Asking {
  /** The question that a release would ask of a document; null when none would be asked. */
  question(scene: Scene, on: Handlers): Question | null;
  /** An answer came. */
  foresee(scene: Scene, e: FinalEvent): void;
  /** Something is open until what this gives back is called. */
  begin(): () => void;
}

/** An answer to exactly this document. */
export interface Known {
  readonly key: string;
  readonly final: FinalEvent;
  readonly ms: number;
}

interface Running {
  readonly scene: Scene;
  readonly key: string;
  readonly old: ReturnType<typeof setTimeout>;
  readonly end: () => void;
  /** The release waits for it. */
  awaited: ((known: Known | null) => void) | null;
}

export class Foresight {
  /** The newest pose, until it has been asked about. */
  #wanted: Scene | null = null;
  #endWait: (() => void) | null = null;
  /** Has the drag's own question about the newest pose been answered so far that this one is not in its way? */
  #free = false;
  #running: Running | null = null;
  #gap: ReturnType<typeof setTimeout> | undefined;
  #known: Known | null = null;

  constructor(
    private readonly generator: Generator,
    private readonly asking: Asking,
  ) {}

  /** The hand is at another pose; its own question goes first. */
  moved(scene: Scene): void {
    this.#wanted = scene;
    this.#free = false;
    this.#endWait ??= this.asking.begin();
  }

  /** The drag's own question has shown something, or has ended. */
  yielded(): void {
    this.#free = true;
    this.#next();
  }

  /** Nobody wants to know any more. */
  drop(): void {
    this.#forget();
    this.#known = null;
    this.#stop();
  }

  /**
   * The release: `take` gets the answer to exactly this document, at once or as soon as it is there, or null when it
   * does not come. False when there is none: it is to be asked for as any other.
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
    this.#wanted = null;
    this.#endWait?.();
    this.#endWait = null;
  }

  #stop(): void {
    const was = this.#running;
    if (!was) return;
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
    const old = setTimeout(() => this.#aged(running), OLDEST_MS);
    const running: Running = { scene, key, old, end: this.asking.begin(), awaited: null };
    this.#running = running;
    this.#gap = setTimeout(() => {
      this.#gap = undefined;
      this.#next();
    }, GAP_MS);
    this.generator.ask(question);
  }

  #answered(running: Running, known: Known): void {
    if (this.#running !== running) return;
    this.#over(running);
    if (running.awaited) {
      running.awaited(known);
      return;
    }
    this.#known = known;
    this.asking.foresee(running.scene, known.final);
    this.#next();
  }

  #failed(running: Running): void {
    if (this.#running !== running) return;
    this.#over(running);
    running.awaited?.(null);
    this.#next();
  }

  /** It has taken long. Where the hand has moved on meanwhile, the newer pose is asked about instead. */
  #aged(running: Running): void {
    if (this.#running !== running || !this.#wanted) return;
    this.#stop();
    this.#next();
  }

  #over(running: Running): void {
    clearTimeout(running.old);
    running.end();
    if (this.#running === running) this.#running = null;
  }
}
