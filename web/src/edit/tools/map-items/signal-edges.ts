// The phases of the picked signal. Signals with the same states are one group and change together; a change of theirs
// is one step, after which all road users are computed again.
import { computed, signal } from '@preact/signals-core';
import { STEP_S } from '../../../model/base/motion';
import { setSignals } from '../../../model/document/commands';
import {
  addedEdge,
  groupOf,
  movedEdge,
  nextLight,
  phasesOf,
  removedEdge,
  withStates,
  type Phase,
  type SignalStates,
} from '../../../model/physics/signal-phases';
import type { Editor } from '../../session/editor';
import type { SessionPart } from '../../session/part';

const stepOf = (time: number): number => Math.round(time / STEP_S);

export class SignalEdges implements SessionPart {
  /** The states while an edge is dragged. */
  readonly #dragged = signal<SignalStates | null>(null);

  constructor(private readonly editor: Editor) {}

  /** Lanes of the picked group; empty while no signal is picked. */
  readonly lanes = computed<readonly string[]>(() => {
    const item = this.editor.mapItem.value;
    const scene = this.editor.resting.value;
    return item?.kind === 'signal' && scene ? groupOf(scene, item.lane) : [];
  });

  readonly #states = computed<SignalStates>(() => {
    const [lane] = this.lanes.value;
    return this.#dragged.value ?? this.editor.resting.value?.signals.find((s) => s.lane === lane)?.states ?? [];
  });

  /** Its phases, during a drag as dragged. */
  readonly phases = computed<readonly Phase[]>(() =>
    phasesOf(this.#states.value, this.editor.resting.value?.duration ?? 0),
  );

  opened(): void {
    this.#drop();
  }

  followed(): void {
    this.#drop();
  }

  /** The edge before phase `i`, at a time in seconds; shown until `release` or `cancel`. */
  drag(i: number, time: number): void {
    if (this.editor.commits.refused()) return;
    const states = this.#moved(i, time);
    this.#dragged.value = states;
    const signals = this.editor.resting.peek()?.signals ?? [];
    // The stop lines show it, too.
    this.editor.view.trySignals(withStates(signals, this.lanes.peek(), states));
  }

  release(): void {
    const states = this.#dragged.peek();
    this.#drop();
    if (states) this.#commit(states);
  }

  /** True when a drag ended. */
  cancel(): boolean {
    const was = this.#dragged.peek() !== null;
    this.#drop();
    return was;
  }

  #drop(): void {
    if (this.#dragged.peek() === null) return;
    this.#dragged.value = null;
    this.editor.view.trySignals(null);
  }

  /** The edge before phase `i`, as a step. Steps of a repeating key are one. */
  set(i: number, time: number): void {
    this.#commit(this.#moved(i, time), true);
  }

  /** The next light of the cycle begins at a time, seconds. */
  add(time: number): void {
    const states = this.lanes.peek().length ? addedEdge(this.#states.peek(), stepOf(time)) : null;
    if (states) this.#commit(states);
  }

  /** The light that `add` would begin after this one. */
  readonly after = nextLight;

  remove(i: number): void {
    this.#commit(removedEdge(this.#states.peek(), i));
  }

  #moved(i: number, time: number): SignalStates {
    return movedEdge(this.#states.peek(), i, stepOf(time), stepOf(this.editor.resting.peek()?.duration ?? 0));
  }

  #commit(states: SignalStates, repeats = false): void {
    const scene = this.editor.resting.peek();
    const lanes = this.lanes.peek();
    const now = scene?.signals.find((s) => s.lane === lanes[0]);
    if (!scene || !now || JSON.stringify(now.states) === JSON.stringify(states)) return;
    const fold = repeats ? `signal:${lanes[0]}` : undefined;
    this.editor.commits.run(setSignals(scene, withStates(scene.signals, lanes, states), fold));
  }
}
