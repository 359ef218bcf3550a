// What of the picture is shown: switches that are remembered from one visit to the next.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import { keep, recall } from '../net/storage';

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

export class Layers {
  readonly #shown = signal<Shown>(remembered());

  readonly shown: ReadonlySignal<Shown> = this.#shown;

  toggle(name: LayerName): void {
    const now = this.#shown.peek();
    this.#shown.value = { ...now, [name]: !now[name] };
    keep(STORED, this.#shown.peek());
  }
}
