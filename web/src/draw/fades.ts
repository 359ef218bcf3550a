// Fading ghosts: each fades in, and one that would jump fades out at the old place and in at the new one.
import type { Pose } from '../model/base/geometry';

/** Duration of a fade, in milliseconds. */
const FADE_MS = 90;
/** Largest distance that a ghost slides between two frames, in metres. */
const SLIDE_M = 2;

export interface PlacedGhost {
  readonly id: string;
  readonly place: Pose;
}

export interface Faded<T> {
  readonly ghost: T;
  readonly alpha: number;
  /** False for one that fades out. */
  readonly here: boolean;
}

interface Kept<T> {
  ghost: T;
  since: number;
  /** Its strength when the fade-out began. */
  from: number;
}

export class Fades<T extends PlacedGhost> {
  #here = new Map<string, Kept<T>>();
  #going: Kept<T>[] = [];
  #fading = false;

  /** Is a fade running? */
  get fading(): boolean {
    return this.#fading;
  }

  /** Ghosts to paint now; `reducedMotion` for reduced motion. */
  next(ghosts: readonly T[], now: number, reducedMotion: boolean): Faded<T>[] {
    const before = this.#here;
    this.#here = new Map(ghosts.map((ghost) => [ghost.id, this.#kept(before.get(ghost.id), ghost, now)]));
    for (const [id, k] of before) if (!this.#here.has(id)) this.#leave(k, now);
    this.#going = reducedMotion ? [] : this.#going.filter((k) => now - k.since < FADE_MS);
    const here = [...this.#here.values()].map(({ ghost, since }): Faded<T> => ({
      ghost,
      alpha: reducedMotion ? 1 : share(since, now),
      here: true,
    }));
    this.#fading = this.#going.length > 0 || here.some((g) => g.alpha < 1);
    return [
      ...this.#going.map(({ ghost, since, from }) => ({ ghost, alpha: from * (1 - share(since, now)), here: false })),
      ...here,
    ];
  }

  #kept(was: Kept<T> | undefined, ghost: T, now: number): Kept<T> {
    if (was && apart(was.ghost.place, ghost.place) <= SLIDE_M) return { ...was, ghost };
    if (was) this.#leave(was, now);
    return { ghost, since: now, from: 1 };
  }

  #leave(k: Kept<T>, now: number): void {
    this.#going.push({ ghost: k.ghost, since: now, from: share(k.since, now) });
  }
}

const share = (since: number, now: number): number => Math.min(1, Math.max(0, (now - since) / FADE_MS));
const apart = (a: Pose, b: Pose): number => Math.hypot(a.x - b.x, a.y - b.y);
