// A short code of a scene's result: recorded and placed road users, conditions, options, seed, engine, and the motions
// that are followed. Road users keep motions from earlier changes, so motions do not follow from the scene alone.
// The same code in two windows means the same scene and motions; name, notes and view do not affect it.
import { VERSION } from '../base/domain';
import type { Motion } from '../base/motion';
import type { LaneMap } from './lanemap';
import type { MotionSet } from './futures';
import { shortFor, sceneKey, touchedIn, type Scene } from './scene';

/** Digits and letters without ambiguous ones. */
const DIGITS = '0123456789ABCDEFGHJKMNPQRSTVWXYZ';
const LENGTH = 6;
const BITS = 5;

/** FNV-1a over the bits of numbers. */
class Mill {
  #a = 0x811c9dc5;
  #b = 0x9dc5811c;
  readonly #float = new Float64Array(1);
  readonly #bits = new Uint32Array(this.#float.buffer);

  add(v: number): void {
    this.#float[0] = v;
    for (const word of this.#bits) {
      this.#a = Math.imul(this.#a ^ word, 0x01000193);
      this.#b = Math.imul(this.#b ^ (word + 7), 0x01000193);
    }
  }

  get text(): string {
    return `${this.#a >>> 0}.${this.#b >>> 0}`;
  }
}

const known = new WeakMap<object, string>();

function once<T extends object>(of: T, make: (of: T, mill: Mill) => void): string {
  let text = known.get(of);
  if (text === undefined) {
    const mill = new Mill();
    make(of, mill);
    known.set(of, (text = mill.text));
  }
  return text;
}

const ofMotion = (m: Motion): string =>
  once(m, ({ first, x, y, heading, speed, valid }, mill) => {
    mill.add(first);
    for (const column of [x, y, heading, speed]) column.forEach((v) => mill.add(v));
    for (const [from, to] of valid) {
      mill.add(from);
      mill.add(to);
    }
  });

const ofMap = (map: LaneMap): string =>
  once(map, ({ lanes, edges, lines, crosswalks }, mill) => {
    const all = [...[...lanes.values(), ...edges, ...lines].map((l) => l.line.pts), ...crosswalks];
    for (const points of all) {
      mill.add(points.length);
      for (const [x, y] of points) {
        mill.add(x);
        mill.add(y);
      }
    }
  });

/** Without conditions no motion was computed, so the engine's weights do not count. */
function engineOf(scene: Scene, set: MotionSet): unknown {
  return touchedIn(scene).length || scene.drawn ? [VERSION, set.head?.weights ?? null] : [VERSION];
}

/** Positions alone: those of a stored motion are exact, its speeds are not. */
const ofPath = ({ first, x, y }: Motion): string => {
  const mill = new Mill();
  mill.add(first);
  for (const column of [x, y]) column.forEach((v) => mill.add(v));
  return mill.text;
};

/** The motions in playback; those of the recording are in the cast. */
function followedIn(scene: Scene, { futures, driving }: MotionSet): unknown {
  return [...driving].sort().map((id) => {
    const f = futures.get(id);
    const mode = f?.modes[scene.agents.get(id)?.chosen ?? f.chosen];
    return [id, mode && ofPath(mode.motion)];
  });
}

export function resultCode(scene: Scene, set: MotionSet): string {
  // For placed road users the conditions are complete.
  const cast = [...scene.agents.values()].map((a) => [a.id, a.logSize, a.placed ? '' : ofMotion(a.log)]);
  const asked = sceneKey({ ...scene, id: '' });
  const text = JSON.stringify([
    asked,
    cast,
    ofMap(scene.map),
    scene.signals,
    engineOf(scene, set),
    followedIn(scene, set),
  ]);
  let bits = parseInt(shortFor(text).slice(0, 8), 16);
  let code = '';
  for (let i = 0; i < LENGTH; i++) {
    code += DIGITS[bits & 31];
    bits >>>= BITS;
  }
  return code;
}
