// A kerb holds a flag back: while one lies between it and the lane it comes from, the flag lags behind the pointer.
import type { Point, Pose, Vec } from '../../model/base/geometry';
import { firstKerb, laneLeadsTo } from '../../model/physics/kerbs';
import type { Lane, LaneMap } from '../../model/document/lanemap';

/** Longest lag of the flag, in pixels. */
const LONGEST_LAG_PX = 24;

export class Resistance {
  /** The last place before the first kerb, metres. */
  #home: Vec;
  /** Did a lane lead to the flag's starting place? A flag that is already behind a kerb is not held back again. */
  #led: boolean | null = null;
  #held = false;
  #passes = false;

  constructor(
    private readonly map: LaneMap,
    private readonly start: Pose,
    private readonly fits: (l: Lane) => boolean,
    from: Point,
  ) {
    this.#home = [from.x, from.y];
  }

  /** Does a kerb hold the flag back now? */
  get held(): boolean {
    return this.#held;
  }

  /** May the flag pass a kerb between it and its starting place? */
  passesKerb([x, y]: Vec): boolean {
    return this.#passes && firstKerb(this.map, this.#home, [x, y]) !== null;
  }

  /** Disables kerbs for the rest of the drag. */
  pass(): void {
    this.#passes = true;
    this.#held = false;
  }

  /** Position of the flag for a pointer position. `zoom` in pixels per metre. */
  to(place: Vec, zoom: number): Vec {
    const kerb = this.#passes ? null : firstKerb(this.map, this.#home, place);
    this.#held = kerb !== null && this.#comesFromLane() && !this.#leads(place);
    if (!kerb || !this.#held) {
      if (!this.#passes) this.#settle(place, kerb !== null);
      return place;
    }
    const past = Math.hypot(place[0] - kerb[0], place[1] - kerb[1]);
    const share = Math.min(past, LONGEST_LAG_PX / zoom) / Math.max(past, 1e-9);
    return [place[0] - (place[0] - kerb[0]) * share, place[1] - (place[1] - kerb[1]) * share];
  }

  #settle(place: Vec, behindKerb: boolean): void {
    this.#home = place;
    if (behindKerb || !this.#led) this.#led = null;
  }

  #comesFromLane(): boolean {
    this.#led ??= this.#leads(this.#home);
    return this.#led;
  }

  #leads([x, y]: Vec): boolean {
    return laneLeadsTo(this.map, this.start, { x, y }, this.fits);
  }
}
