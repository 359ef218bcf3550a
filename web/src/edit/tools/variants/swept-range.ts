// The range of a number that new variants sweep, and why it cannot be swept.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Agent, Scene } from '../../../model/document/scene';
import { countOf, limitsOfSweep, usualSweep, valueOf, type Over, type Sweep } from '../../../model/physics/sweep';
import { MOST_VARIANTS } from '../../../model/document/variants';
import type { Editor } from '../../session/editor';
import { TEXTS } from '../../../texts/editing/variants';

export class SweptRange {
  readonly #sweep = signal<Sweep | null>(null);

  /** Null where new variants differ by seed. */
  readonly sweep: ReadonlySignal<Sweep | null> = this.#sweep;
  /** Why the range cannot be swept; null where it can. */
  readonly obstacle: ReadonlySignal<string | null>;

  /** `subject`: the road user whose number is swept. */
  constructor(
    private readonly editor: Editor,
    private readonly subject: ReadonlySignal<Agent | null>,
  ) {
    this.obstacle = computed(() => {
      const [sweep, scene] = [this.#sweep.value, editor.scene.value];
      return sweep && scene && obstacleOf(sweep, scene, subject.value);
    });
  }

  /** New variants sweep a range of a number; null: they differ by seed. */
  over(over: Over | null): void {
    const scene = this.editor.scene.peek();
    const a = this.subject.peek();
    this.#sweep.value = over && scene && a ? usualSweep(a, scene, over, this.editor.view.unitOf(a)) : null;
  }

  set(patch: Partial<Omit<Sweep, 'over'>>): void {
    const now = this.#sweep.peek();
    if (now) this.#sweep.value = Object.freeze({ ...now, ...patch });
  }
}

function obstacleOf(sweep: Sweep, scene: Scene, a: Agent | null): string | null {
  if (!a) return TEXTS.selectToVary;
  if (sweep.over === 'time' && valueOf(a, 'time') === null) return TEXTS.hasNoGoalYet(a.name);
  const [least, most] = limitsOfSweep(a, scene, sweep.over);
  const beyond = (v: number): boolean => v < least - 1e-6 || v > most + 1e-6;
  if (beyond(sweep.from) || beyond(sweep.to)) return TEXTS.exceedsLimits(a.name);
  const room = MOST_VARIANTS - scene.variants.filter((v) => v.kept || v.starred).length;
  const n = countOf(sweep);
  return n > room ? TEXTS.valuesThereIs(n, room) : null;
}
