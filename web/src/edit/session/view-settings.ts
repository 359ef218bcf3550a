// What of the picture is shown, and in which unit: switches that are remembered from one visit to the next, and what
// stands beside the scene.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Vec } from '../../model/base/geometry';
import { type SpeedUnit, toldIn, walkingUnit } from '../../model/base/units';
import type { MotionSet } from '../../model/document/futures';
import type { Agent, Scene } from '../../model/document/scene';
import { keep, recall } from '../../net/storage';

export const LAYER_NAMES = ['futures', 'log', 'lanes', 'labels', 'signals', 'limits', 'reach', 'conflicts'] as const;
export type LayerName = (typeof LAYER_NAMES)[number];
export type Shown = Readonly<Record<LayerName, boolean>>;

const AT_FIRST: Shown = {
  futures: true,
  log: false,
  lanes: false,
  labels: false,
  signals: true,
  limits: false,
  reach: false,
  conflicts: false,
};

const STORED = 'layers';

function remembered(): Shown {
  const kept = recall<Partial<Shown>>(STORED);
  const of = (name: LayerName): boolean => {
    const was = kept?.[name];
    return typeof was === 'boolean' ? was : AT_FIRST[name];
  };
  return Object.fromEntries(LAYER_NAMES.map((name) => [name, of(name)])) as Shown;
}

/** A document with what everybody does in it, and who of them does another thing than on the picture. */
export interface Beside {
  readonly scene: Scene;
  readonly set: MotionSet;
  readonly parted: readonly string[];
  /** A change that is tried: it stands before what is shown of the road user that it is about. */
  readonly tried?: true;
  /** A moment in it that is pointed out: who is in it, where and when, and its words. */
  readonly meeting?: {
    readonly words: string;
    readonly at: Vec;
    readonly time: number;
    readonly who: readonly string[];
    /** What it is called in a sentence. */
    readonly called: string;
  };
}

/** Ways that were tried, one stroke each. */
export type Tries = readonly (readonly Vec[])[];

const NO_TRIES: Tries = Object.freeze([]);

/** A map that is being made: it is shown in place of the scene. */
export interface MapDraft {
  readonly isOpen: ReadonlySignal<boolean>;
  /** Null until it is drawn. */
  readonly scene: ReadonlySignal<Scene | null>;
}

const NO_MAP: MapDraft = { isOpen: signal(false), scene: signal(null) };

export class ViewSettings {
  readonly #layers = signal<Shown>(remembered());
  readonly #showBefore = signal(true);
  readonly #showPreviewed = signal(true);
  readonly #speedUnit = signal<SpeedUnit>(toldIn(recall<SpeedUnit>('speed-unit') ?? 'km/h'));
  readonly #beside = signal<Beside | null>(null);
  readonly #tries = signal<Tries>(NO_TRIES);
  readonly #mapDraft = signal(NO_MAP);

  readonly layers: ReadonlySignal<Shown> = this.#layers;
  /** Are the paths before the last change shown beside the new ones? */
  readonly showBefore: ReadonlySignal<boolean> = this.#showBefore;
  /** Are the others' answers shown on the picture while a handle is dragged? */
  readonly showPreviewed: ReadonlySignal<boolean> = this.#showPreviewed;
  readonly speedUnit: ReadonlySignal<SpeedUnit> = this.#speedUnit;
  /** Another way that the scene could go, shown dashed beside the one on the picture. */
  readonly beside: ReadonlySignal<Beside | null> = this.#beside;
  /** Ways that a search has tried so far, pale on the picture. */
  readonly tries: ReadonlySignal<Tries> = this.#tries;

  /** Read in a computation, it follows. */
  get mapDraft(): MapDraft {
    return this.#mapDraft.value;
  }

  /** Maps are made here from now on. */
  showMapsOf(draft: MapDraft): void {
    this.#mapDraft.value = draft;
  }

  opened(): void {
    this.#beside.value = null;
    this.#tries.value = NO_TRIES;
  }

  toggleLayer(name: LayerName): void {
    const now = this.#layers.peek();
    this.#layers.value = { ...now, [name]: !now[name] };
    keep(STORED, this.#layers.peek());
  }

  toggleBefore(): void {
    this.#showBefore.value = !this.#showBefore.peek();
  }

  togglePreviewed(): void {
    this.#showPreviewed.value = !this.#showPreviewed.peek();
  }

  showBeside(beside: Beside | null): void {
    this.#beside.value = beside;
  }

  showTries(tries: Tries): void {
    this.#tries.value = tries;
  }

  setUnit(unit: SpeedUnit): void {
    batch(() => {
      this.#speedUnit.value = unit;
      toldIn(unit);
    });
    keep('speed-unit', unit);
  }

  unitOf(a: Agent): SpeedUnit {
    return a.type === 'pedestrian' ? walkingUnit(this.speedUnit.value) : this.speedUnit.value;
  }
}
