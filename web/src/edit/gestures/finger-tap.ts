// Several fingers that tap at once without moving: two undo, three redo.
import type { Point } from '../../model/base/geometry';

/** From the first touch to the last release, milliseconds. */
const WITHIN_MS = 450;
/** Movement beyond this is not a tap, pixels. */
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

  /** The last finger is up: returns the number of tapped fingers; 1 when it was not a tap of several. */
  up(timeStamp: number): number {
    return this.#still && timeStamp - this.#since <= WITHIN_MS ? this.#from.size : 1;
  }
}
