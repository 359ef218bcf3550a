// Settings and preview of an area to fill: where, how dense, and which kinds.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import { boxOf, insideBox, type Vec } from '../../../model/base/geometry';
import { topSpeed } from '../../../model/base/domain';
import { comesLater, type Newcomer } from '../../../model/document/newcomer';
import type { Editor } from '../../session/editor';
import type { SessionPart } from '../../session/part';
import { EVEN_MIX, type FillKind, type Mix } from './fill-mix';

/** All settings that decide a placement. */
export interface FillWish {
  /** Corners of the area in metres; null for the whole map. */
  readonly region: readonly Vec[] | null;
  /** Road users for each 100 m of lane. */
  readonly density: number;
  readonly mix: Mix;
  /** Range of start speeds for moving motor vehicles, m/s. */
  readonly speeds: SpeedRange;
  /** Vehicles per hour by arm. */
  readonly rates: Readonly<Record<string, number>>;
  /** Share of parking places at kerbs and in lots that is taken. */
  readonly parked: number;
  readonly seed: number;
  /** Do present road users stay? */
  readonly keep: boolean;
  /** Road users of the preview that stay when the others are drawn again. */
  readonly pinned: readonly Newcomer[];
}

export type SpeedRange = readonly [min: number, max: number];

/** An arm of the map, where a road enters. */
export interface EntryArm {
  /** Its compass point, with a number where several share it. */
  readonly id: string;
  /** `North-west 2`, in the language of the page. */
  readonly title: string;
  readonly at: Vec;
  /** Driving direction at the entry, radians. */
  readonly heading: number;
  /** Capacity of its lanes, vehicles per hour. */
  readonly most: number;
  /** Number of its vehicles present at the start, and of later arrivals. */
  readonly placed: number;
  readonly later: number;
}

/** The answer to the settings. */
export interface FillAnswer {
  readonly all: readonly Newcomer[];
  /** Why fewer than requested were placed; null where all were. */
  readonly reason: string | null;
  /** Ids that are removed when it is added. */
  readonly replaced: readonly string[];
  readonly arms: readonly EntryArm[];
  /** Parking places at kerbs and in lots; null while unknown. */
  readonly parkingPlaces: number | null;
}

/** Stands for a missing answer. */
export const NO_ANSWER: FillAnswer = { all: [], reason: null, replaced: [], arms: [], parkingPlaces: null };

export const LEAST_DENSITY = 0;
export const MOST_DENSITY = 12.5;
const USUAL_DENSITY = 3;
/** Without bounds. */
export const ANY_SPEED: SpeedRange = Object.freeze([0, topSpeed({ type: 'vehicle', subtype: 'car' })] as const);
/** The largest random seed: short enough to read. */
const LARGEST_SEED = 9999;
/** A click may miss a small road user by this, metres. */
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

export class Filling implements SessionPart {
  readonly #open = signal(false);
  readonly #wish = signal<FillWish>(first(0));
  readonly #drawn = signal<readonly Vec[] | null>(null);
  readonly #answer = signal<FillAnswer | null>(null);
  readonly #asking = signal(false);

  /** The settings while an area is being filled; null at other times. */
  readonly wish: ReadonlySignal<FillWish | null> = computed(() => (this.#open.value ? this.#wish.value : null));
  /** Corners of an outline that is not closed yet. */
  readonly drawn: ReadonlySignal<readonly Vec[] | null> = this.#drawn;
  readonly answer: ReadonlySignal<FillAnswer | null> = this.#answer;
  readonly asking: ReadonlySignal<boolean> = this.#asking;

  /** Road users that would be added now: pinned ones first. */
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
    // Density and kinds stay from the last time; the place does not.
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

  // -------------------------------------------------------------- area

  /** The outline so far; null when it is cancelled. */
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

  // -------------------------------------------------------------- traffic

  setDensity(density: number): void {
    this.#wish.value = { ...this.#wish.peek(), density };
  }

  setShare(kind: FillKind, share: number): void {
    const wish = this.#wish.peek();
    const mix = { ...wish.mix, [kind]: share };
    if (Object.values(mix).some((v) => v > 0)) this.#wish.value = { ...wish, mix };
  }

  /** Both ends within the speed range of cars, the lower one first. */
  setSpeeds([min, max]: SpeedRange): void {
    this.#wish.value = { ...this.#wish.peek(), speeds: [Math.min(min, max), Math.max(min, max)] };
  }

  /** Sets the arrivals of an arm, in vehicles per hour. */
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

  /** Draws again; pinned ones stay. */
  shuffle(): void {
    this.setSeed(1 + Math.floor(Math.random() * LARGEST_SEED));
  }

  isPinned(n: Newcomer): boolean {
    return this.#wish.value.pinned.includes(n);
  }

  /** The previewed road user at a place. */
  at([x, y]: Vec): Newcomer | null {
    const there = this.all.peek().filter((n) => !comesLater(n));
    return there.find((n) => insideBox(n.pose, n.length, n.width, x, y, MISS_M)) ?? null;
  }

  /** Pins or unpins a road user of the preview. The others keep their places. */
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

  // -------------------------------------------------------------- answer

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

/** A smaller area is accidental, metres. */
const LEAST_SIDE_M = 1;

function hasInside(outline: readonly Vec[]): boolean {
  const { x0, y0, x1, y1 } = boxOf(outline);
  return outline.length >= 3 && x1 - x0 > LEAST_SIDE_M && y1 - y0 > LEAST_SIDE_M;
}
