// What comes of the ways out of an event, before anybody takes one: each is tried apart, one after the other.
import { effect, signal, untracked } from '@preact/signals-core';
import { compareMarks, type Mark } from '../model/document/future-facts';
import { counted } from '../model/physics/events';
import { readEvents, type TrafficEvent } from '../model/words/event-words';
import type { MotionSet } from '../model/document/futures';
import type { Scene } from '../model/document/scene';
import type { Editor } from './editor';
import { eventRemedies } from './event-remedies';
import type { Remedy } from './moves';
import { supposition, type Supposing } from './supposing';
import { TEXTS } from '../texts/panels/events-panel';

/** What comes of a way out: `ok` where the event is gone and nothing new comes in its place. */
export interface Outcome {
  readonly mark: Mark;
  readonly words: string;
}

export class Weighing {
  readonly #known = signal<ReadonlyMap<string, Outcome>>(new Map());

  constructor(
    private readonly editor: Editor,
    private readonly supposing: Supposing,
  ) {}

  /** Weighs the ways out of the event that is picked, until the function that comes back is called. */
  begin(): () => void {
    const { editor, supposing } = this;
    const end = effect(() => {
      const event = editor.selectedEvent.value;
      const idle = !editor.dragging.value && !editor.motion.value.stale && !editor.away.value;
      const ways = event && idle ? eventRemedies(editor, event) : [];
      untracked(() => {
        supposing.cancel();
        if (this.#known.peek().size) this.#known.value = new Map();
        const scene = editor.scene.peek();
        if (event && scene) this.#next(event, scene, ways);
      });
    });
    return () => {
      end();
      supposing.cancel();
    };
  }

  /** Undefined until it is known. */
  of(way: Remedy): Outcome | undefined {
    return this.#known.value.get(keyOf(way));
  }

  #next(event: TrafficEvent, scene: Scene, [way, ...rest]: readonly Remedy[]): void {
    if (!way) return;
    const supposed = supposition(scene, way.command);
    const next = () => this.#next(event, scene, rest);
    const answered = (set: MotionSet | null): void => {
      if (set) this.#say(way, this.#outcome(event, supposed!.scene, set));
      next();
    };
    if (!supposed || !this.supposing.ask(supposed, answered)) next();
  }

  #say(way: Remedy, outcome: Outcome): void {
    this.#known.value = new Map(this.#known.peek()).set(keyOf(way), outcome);
  }

  #outcome(event: TrafficEvent, scene: Scene, set: MotionSet): Outcome {
    const unit = this.editor.speedUnit.peek();
    const before = this.editor.events.peek();
    const after = counted(readEvents(scene, set, unit));
    const still = after.find((x) => samePair(x, event));
    const [worst] = after
      .filter((x) => !before.some((y) => samePair(x, y)))
      .sort((x, y) => compareMarks(x.kind, y.kind));
    if (still && !(worst && compareMarks(worst.kind, still.kind) < 0))
      return { mark: still.kind, words: TEXTS.thenStill(still.words) };
    if (worst) return { mark: worst.kind, words: TEXTS.thenInstead(worst.title, worst.words) };
    return { mark: 'ok', words: TEXTS.thenNothing };
  }
}

/** A way out is made anew whenever it is drawn; what it says stays the same. */
const keyOf = ({ label, note }: Remedy): string => `${label} ${note}`;

/** Is it about the same, whatever comes of it? */
const samePair = (p: TrafficEvent, q: TrafficEvent): boolean => {
  const [a, b] = [p.b?.id ?? '', q.b?.id ?? ''];
  return (p.a.id === q.a.id && a === b) || (p.a.id === b && a === q.a.id);
};
