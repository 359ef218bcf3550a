// Animates the picture from one view to another, so that the user sees where it comes from. With reduced motion the
// change is immediate.
import { wrapAngle, type Vec } from '../model/base/geometry';
import type { Camera } from '../model/document/history';
import type { View } from './view';

const GLIDE_MS = 180;

export class Glide {
  #from: Required<Camera> | null = null;
  #to: Required<Camera> | null = null;
  #began = 0;
  /** The camera after the last frame: a different one means that another change moved it. */
  #left: Required<Camera> | null = null;
  readonly #reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(
    private readonly view: View,
    private readonly moved: () => void,
  ) {}

  get going(): boolean {
    return this.#to !== null;
  }

  /** The current camera, or the one at the end of the animation. */
  get end(): Required<Camera> {
    return this.#to ?? this.view.camera;
  }

  /** Animates the change that `move` makes. During an animation `move` starts from its end. */
  by(move: (v: View) => void): void {
    const { view } = this;
    const end = view.copy();
    end.look(this.end);
    move(end);
    this.to(end.camera);
  }

  to(camera: Camera): void {
    if (this.#reducedMotion.matches) {
      this.view.look(camera);
      this.stop();
      this.moved();
      return;
    }
    this.#from = this.#left = this.view.camera;
    this.#to = { turn: 0, ...camera };
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
    if (v.cx !== left.cx || v.cy !== left.cy || v.z !== left.z || v.turn !== left.turn) return this.stop();
    const t = Math.min(1, (performance.now() - this.#began) / GLIDE_MS);
    const k = 1 - (1 - t) ** 3;
    if (t === 1) v.look(to);
    else onTheWay(v, from, to, k);
    this.#left = v.camera;
    if (t === 1) this.stop();
    this.moved();
  }
}

/** A point under the pointer at both ends stays there throughout. */
function onTheWay(v: View, from: Required<Camera>, to: Required<Camera>, k: number): void {
  const z = from.z * (to.z / from.z) ** k;
  const by = wrapAngle(to.turn - from.turn);
  if (by) {
    const [x, y] = fixedPoint(from, to);
    v.look({ cx: x, cy: y, z, turn: from.turn + by * k });
    // Its offset from the middle stays constant, in pixels.
    const [right, up] = turned([x - from.cx, y - from.cy], from.turn, from.z);
    const [dx, dy] = v.way(right, -up);
    v.cx -= dx;
    v.cy -= dy;
    return;
  }
  const u = from.z === to.z ? k : (1 / z - 1 / from.z) / (1 / to.z - 1 / from.z);
  v.look({ cx: from.cx + (to.cx - from.cx) * u, cy: from.cy + (to.cy - from.cy) * u, z, turn: from.turn });
}

const turned = ([x, y]: Vec, angle: number, scale: number): Vec => {
  const [c, s] = [Math.cos(angle) * scale, Math.sin(angle) * scale];
  return [x * c - y * s, x * s + y * c];
};

/** The world point that two views of different turns show at the same screen position. */
function fixedPoint(from: Required<Camera>, to: Required<Camera>): Vec {
  const [ax, ay] = turned([1, 0], from.turn, from.z);
  const [bx, by] = turned([1, 0], to.turn, to.z);
  const [px, py] = turned([from.cx, from.cy], from.turn, from.z);
  const [qx, qy] = turned([to.cx, to.cy], to.turn, to.z);
  const [dx, dy] = [ax - bx, ay - by];
  const d2 = dx * dx + dy * dy;
  return [((px - qx) * dx + (py - qy) * dy) / d2, ((py - qy) * dx - (px - qx) * dy) / d2];
}
