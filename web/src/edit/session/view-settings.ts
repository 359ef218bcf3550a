// What the picture shows, and in which unit: stored settings, and the objects beside the scene.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Vec } from '../../model/base/geometry';
import { type SpeedUnit, toldIn, walkingUnit } from '../../model/base/units';
import type { MotionSet } from '../../model/document/futures';
import type { Agent, Scene } from '../../model/document/scene';
import { keep, recall } from '../../net/storage';

export const LAYER_NAMES = ['futures', 'log', 'lanes', 'labels', 'signals', 'limits', 'reach', 'conflicts'] as const;
export type LayerName = (typeof LAYER_NAMES)[number];
export type ShownLayers = Readonly<Record<LayerName, boolean>>;

const AT_FIRST: ShownLayers = {
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

function remembered(): ShownLayers {
  const kept = recall<Partial<ShownLayers>>(STORED);
  const of = (name: LayerName): boolean => {
    const was = kept?.[name];
    return typeof was === 'boolean' ? was : AT_FIRST[name];
  };
  return Object.fromEntries(LAYER_NAMES.map((name) => [name, of(name)])) as ShownLayers;
}

/** A document with the motions of all road users, and the ids with another motion than the shown one. */
export interface SceneBeside {
  readonly scene: Scene;
  readonly set: MotionSet;
  readonly diverging: readonly string[];
  /** A tried change: painted before the selected road user's own display. */
  readonly tried?: true;
  /** A pointed-out moment in it: its road users, place, time, and words. */
  readonly meeting?: {
    readonly words: string;
    readonly at: Vec;
    readonly time: number;
    readonly who: readonly string[];
    /** Its name in a sentence. */
    readonly called: string;
  };
}

/** Paths tried by a search, one stroke each. */
export type Tries = readonly (readonly Vec[])[];

const NO_TRIES: Tries = Object.freeze([]);

/** A map being made: shown in place of the scene. */
export interface MapDraft {
  readonly isOpen: ReadonlySignal<boolean>;
  /** Null until the server has drawn it. */
  readonly scene: ReadonlySignal<Scene | null>;
}

const NO_MAP: MapDraft = { isOpen: signal(false), scene: signal(null) };

export class ViewSettings {
  readonly #layers = signal<ShownLayers>(remembered());
  readonly #showBefore = signal(true);
  readonly #showPreviewed = signal(true);
  readonly #speedUnit = signal<SpeedUnit>(toldIn(recall<SpeedUnit>('speed-unit') ?? 'km/h'));
  readonly #beside = signal<SceneBeside | null>(null);
  readonly #tries = signal<Tries>(NO_TRIES);
  readonly #mapDraft = signal(NO_MAP);
  readonly #triedSignals = signal<Scene['signals'] | null>(null);

  readonly layers: ReadonlySignal<ShownLayers> = this.#layers;
  /** Are the paths before the last change shown beside the new ones? */
  readonly showBefore: ReadonlySignal<boolean> = this.#showBefore;
  /** Are the others' reactions shown on the picture during a drag? */
  readonly showPreviewed: ReadonlySignal<boolean> = this.#showPreviewed;
  readonly speedUnit: ReadonlySignal<SpeedUnit> = this.#speedUnit;
  /** An alternative motion of the scene, dashed beside the shown one. */
  readonly beside: ReadonlySignal<SceneBeside | null> = this.#beside;
  /** Paths that a search has tried so far, pale on the picture. */
  readonly tries: ReadonlySignal<Tries> = this.#tries;

  /** Signals with phases that are being dragged, in place of those of the scene. */
  readonly triedSignals: ReadonlySignal<Scene['signals'] | null> = this.#triedSignals;

  /** Tracked when read in a computation. */
  get mapDraft(): MapDraft {
    return this.#mapDraft.value;
  }

  /** Takes map drafts from here from now on. */
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

  showBeside(beside: SceneBeside | null): void {
    this.#beside.value = beside;
  }

  trySignals(signals: Scene['signals'] | null): void {
    this.#triedSignals.value = signals;
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
