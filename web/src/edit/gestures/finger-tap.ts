// Several fingers that come down and go up again at once, without moving: two undo, three do again.
import type { Point } from '../../model/base/geometry';

/** From the first finger that comes to the last that goes, milliseconds. */
const WITHIN_MS = 450;
/** A finger that moves further is no tap, pixels. */
const STILL_PX = 10;

export class FingerTap {
  readonly #from = new Map<number, Point>();
  #since = 0;
  #still = true;

  down(id: number, at: Point, alone: boolean, timeStamp: number): void {
    if (alone) {
      this.#from.clear();
      this.#since = timeStamp;
      this.#still = true;
    }
    this.#from.set(id, at);
  }

  move(id: number, at: Point): void {
    const from = this.#from.get(id);
    if (from && Math.hypot(at.x - from.x, at.y - from.y) > STILL_PX) this.#still = false;
  }

  lost(): void {
    this.#still = false;
  }

  /** The last finger is gone: with how many it was tapped; 1 when it was no tap of several. */
  up(timeStamp: number): number {
    return this.#still && timeStamp - this.#since <= WITHIN_MS ? this.#from.size : 1;
  }
}
