// What an area is to be filled with: where, how busy, which kinds, and what is seen of it before it is added.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import { boxOf, insideBox, type Vec } from '../../../model/base/geometry';
import { topSpeed } from '../../../model/base/domain';
import { comesLater, type Newcomer } from '../../../model/document/newcomer';
import type { Editor } from '../../session/editor';
import type { Part } from '../../session/part';
import { EVEN_MIX, type FillKind, type Mix } from './fill-mix';

/** Everything that decides who is placed where. */
export interface FillWish {
  /** Corners of the area in metres; null for the whole map. */
  readonly region: readonly Vec[] | null;
  /** Road users for each 100 m of lane. */
  readonly density: number;
  readonly mix: Mix;
  /** Between which speeds motor vehicles start that move, m/s. */
  readonly speeds: SpeedRange;
  /** Vehicles an hour by the names of the arms that they come in by. */
  readonly rates: Readonly<Record<string, number>>;
  /** Share of the places at kerbs and in lots that parked cars take. */
  readonly parked: number;
  readonly seed: number;
  /** Do those stay who are there already? */
  readonly keep: boolean;
  /** Those of the preview that stay while the others are drawn anew. */
  readonly pinned: readonly Newcomer[];
}

export type SpeedRange = readonly [min: number, max: number];

/** Where a road comes in. */
export interface Arm {
  /** The compass point that it comes from, with a number where several do. */
  readonly id: string;
  readonly at: Vec;
  /** Direction in which it leads, radians. */
  readonly heading: number;
  /** Vehicles an hour that its lanes take. */
  readonly most: number;
  /** Those of its traffic that are there at the start, and those that come in later. */
  readonly placed: number;
  readonly later: number;
}

/** What is known of a wish. */
export interface FillAnswer {
  readonly all: readonly Newcomer[];
  /** Why there are not more of them; null where nobody is missing. */
  readonly reason: string | null;
  /** Ids of those who go when it is added. */
  readonly replaced: readonly string[];
  readonly arms: readonly Arm[];
  /** Places at kerbs and in lots; null while nobody knows. */
  readonly parkingPlaces: number | null;
}

/** Of an answer that could not be had. */
export const NO_ANSWER: FillAnswer = { all: [], reason: null, replaced: [], arms: [], parkingPlaces: null };

export const LEAST_DENSITY = 0;
export const MOST_DENSITY = 12.5;
const USUAL_DENSITY = 3;
/** No bounds at all. */
export const ANY_SPEED: SpeedRange = Object.freeze([0, topSpeed({ type: 'vehicle', subtype: 'car' })] as const);
/** The largest seed that is drawn by the dice: short enough to be read. */
const LARGEST_SEED = 9999;
/** Around somebody small one may miss by so much, metres. */
const MISS_M = 0.8;

const first = (seed: number): FillWish => ({
  region: null,
  density: USUAL_DENSITY,
  mix: EVEN_MIX,
  speeds: ANY_SPEED,
  rates: {},
  parked: 0,
  seed,
  keep: true,
  pinned: [],
});

/** Its name in the rail. */
export const FILL_NAME = 'fill';

export class Filling implements Part {
  readonly #open = signal(false);
  readonly #wish = signal<FillWish>(first(0));
  readonly #drawn = signal<readonly Vec[] | null>(null);
  readonly #answer = signal<FillAnswer | null>(null);
  readonly #asking = signal(false);

  /** What is wished for while an area is being filled; null at other times. */
  readonly wish: ReadonlySignal<FillWish | null> = computed(() => (this.#open.value ? this.#wish.value : null));
  /** Corners of an outline that is not closed yet. */
  readonly drawn: ReadonlySignal<readonly Vec[] | null> = this.#drawn;
  readonly answer: ReadonlySignal<FillAnswer | null> = this.#answer;
  readonly asking: ReadonlySignal<boolean> = this.#asking;

  /** Whoever would be added now: those that are pinned first. */
  readonly all = computed<readonly Newcomer[]>(() => [...this.#wish.value.pinned, ...(this.#answer.value?.all ?? [])]);

  constructor(private readonly editor: Editor) {}

  opened(): void {
    if (this.editor.tool.peek() === FILL_NAME) this.editor.chooseTool('select');
  }

  toolChosen(name: string): void {
    if (name === FILL_NAME) this.open(this.editor.scene.peek()?.seed ?? 0);
    else this.close();
  }

  open(seed: number): void {
    if (this.#open.peek()) return;
    // Density and kinds are as they were the last time; the place is not.
    const { density, mix } = this.#wish.peek();
    batch(() => {
      this.#wish.value = { ...first(seed), density, mix };
      this.#open.value = true;
    });
  }

  close(): void {
    batch(() => {
      this.#open.value = false;
      this.#drawn.value = null;
      this.#answer.value = null;
      this.#asking.value = false;
      this.#wish.value = { ...this.#wish.peek(), pinned: [] };
    });
  }

  // -------------------------------------------------------------- where

  /** The outline so far; null when it is given up. */
  draw(outline: readonly Vec[] | null): void {
    this.#drawn.value = outline;
  }

  /** One more corner by a click. */
  addCorner(at: Vec): void {
    this.#drawn.value = [...(this.#drawn.peek() ?? []), at];
  }

  /** The outline becomes the area; false where it has no inside. */
  closeOutline(outline = this.#drawn.peek()): boolean {
    const closed = outline && hasInside(outline) ? outline : null;
    batch(() => {
      this.#drawn.value = null;
      if (closed) this.setRegion(closed);
    });
    return closed !== null;
  }

  setRegion(region: readonly Vec[] | null): void {
    this.#wish.value = { ...this.#wish.peek(), region };
  }

  // -------------------------------------------------------------- who

  setDensity(density: number): void {
    this.#wish.value = { ...this.#wish.peek(), density };
  }

  setShare(kind: FillKind, share: number): void {
    const wish = this.#wish.peek();
    const mix = { ...wish.mix, [kind]: share };
    if (Object.values(mix).some((v) => v > 0)) this.#wish.value = { ...wish, mix };
  }

  /** Both ends within what cars can drive, the lower one first. */
  setSpeeds([min, max]: SpeedRange): void {
    this.#wish.value = { ...this.#wish.peek(), speeds: [Math.min(min, max), Math.max(min, max)] };
  }

  /** So many vehicles an hour are to come in by an arm. */
  setRate(arm: string, perHour: number): void {
    const wish = this.#wish.peek();
    if ((wish.rates[arm] ?? 0) !== perHour) this.#wish.value = { ...wish, rates: { ...wish.rates, [arm]: perHour } };
  }

  setParked(parked: number): void {
    this.#wish.value = { ...this.#wish.peek(), parked };
  }

  setKeep(keep: boolean): void {
    this.#wish.value = { ...this.#wish.peek(), keep };
  }

  setSeed(seed: number): void {
    this.#wish.value = { ...this.#wish.peek(), seed };
  }

  /** Another draw; whoever is pinned stays. */
  shuffle(): void {
    this.setSeed(1 + Math.floor(Math.random() * LARGEST_SEED));
  }

  isPinned(n: Newcomer): boolean {
    return this.#wish.value.pinned.includes(n);
  }

  /** The one of the preview that stands at a place. */
  at([x, y]: Vec): Newcomer | null {
    const there = this.all.peek().filter((n) => !comesLater(n));
    return there.find((n) => insideBox(n.pose, n.length, n.width, x, y, MISS_M)) ?? null;
  }

  /** Somebody of the preview stays from now on, or goes with the next draw. The others stand where they stood. */
  togglePin(n: Newcomer): void {
    const wish = this.#wish.peek();
    const answer = this.#answer.peek();
    const pinned = wish.pinned.includes(n);
    batch(() => {
      this.#wish.value = { ...wish, pinned: pinned ? wish.pinned.filter((p) => p !== n) : [...wish.pinned, n] };
      if (answer)
        this.#answer.value = { ...answer, all: pinned ? [...answer.all, n] : answer.all.filter((p) => p !== n) };
    });
  }

  // -------------------------------------------------------------- what comes of it

  ask(): void {
    this.#asking.value = true;
  }

  settle(answer: FillAnswer | null): void {
    batch(() => {
      this.#asking.value = false;
      this.#answer.value = answer;
    });
  }
}

/** Less than this is a slip of the hand, metres. */
const LEAST_SIDE_M = 1;

function hasInside(outline: readonly Vec[]): boolean {
  const { x0, y0, x1, y1 } = boxOf(outline);
  return outline.length >= 3 && x1 - x0 > LEAST_SIDE_M && y1 - y0 > LEAST_SIDE_M;
}
