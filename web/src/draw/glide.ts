// The picture goes over from one place to another in a moment, so that one sees where one comes from. Without motion,
// where that is asked for, it is there at once.
import type { View } from './view';

const GLIDE_MS = 180;

interface Camera {
  readonly cx: number;
  readonly cy: number;
  readonly z: number;
}

const cameraOf = ({ cx, cy, z }: View): Camera => ({ cx, cy, z });

export class Glide {
  #from: Camera | null = null;
  #to: Camera | null = null;
  #began = 0;
  /** Where the last frame left the picture: elsewhere, somebody else has moved it. */
  #left: Camera | null = null;
  readonly #calm = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(
    private readonly view: View,
    private readonly moved: () => void,
  ) {}

  get going(): boolean {
    return this.#to !== null;
  }

  /** Moves the view as `move` does, in a while. While it glides already `move` starts from where that would end. */
  by(move: (v: View) => void): void {
    const { view } = this;
    const end = view.copy();
    if (this.#to) Object.assign(end, this.#to);
    move(end);
    this.to(cameraOf(end));
  }

  to(camera: Camera): void {
    if (this.#calm.matches) {
      Object.assign(this.view, cameraOf(Object.assign(this.view.copy(), camera)));
      this.stop();
      this.moved();
      return;
    }
    this.#from = this.#left = cameraOf(this.view);
    this.#to = cameraOf(Object.assign(this.view.copy(), camera));
    this.#began = performance.now();
    this.moved();
  }

  stop(): void {
    this.#to = this.#from = this.#left = null;
  }

  /** Called once a frame before painting. */
  frame(): void {
    const { view: v } = this;
    const from = this.#from,
      to = this.#to,
      left = this.#left;
    if (!from || !to || !left) return;
    if (v.cx !== left.cx || v.cy !== left.cy || v.z !== left.z) return this.stop();
    const t = Math.min(1, (performance.now() - this.#began) / GLIDE_MS);
    const k = 1 - (1 - t) ** 3;
    v.z = t === 1 ? to.z : from.z * (to.z / from.z) ** k;
    // Along 1 / zoom a place that is under the pointer at both ends stays there on the way.
    const u = from.z === to.z ? k : (1 / v.z - 1 / from.z) / (1 / to.z - 1 / from.z);
    v.cx = t === 1 ? to.cx : from.cx + (to.cx - from.cx) * u;
    v.cy = t === 1 ? to.cy : from.cy + (to.cy - from.cy) * u;
    this.#left = cameraOf(v);
    if (t === 1) this.stop();
    this.moved();
  }
}
