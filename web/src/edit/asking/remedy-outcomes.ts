// Outcomes of the remedies for an event, before the user takes one: each is tried separately, in order.
import { effect, signal, untracked } from '@preact/signals-core';
import { compareMarks, type Mark } from '../../model/document/future-facts';
import { counted } from '../../model/physics/events';
import { readEvents, type TrafficEvent } from '../../model/words/event-words';
import type { MotionSet } from '../../model/document/futures';
import type { Scene } from '../../model/document/scene';
import type { Editor } from '../session/editor';
import { eventRemedies } from '../moves/event-remedies';
import type { Remedy } from '../moves/remedies';
import { triedChange, type WhatIf } from './what-if';
import { TEXTS } from '../../texts/panels/events-panel';

/** The outcome of a remedy: `ok` where the event is gone and no new one replaces it. */
export interface Outcome {
  readonly mark: Mark;
  readonly words: string;
}

export class RemedyOutcomes {
  readonly #known = signal<ReadonlyMap<string, Outcome>>(new Map());

  constructor(
    private readonly editor: Editor,
    private readonly whatIf: WhatIf,
  ) {}

  /** Tries the remedies of the selected event until the returned function is called. */
  begin(): () => void {
    const { editor, whatIf } = this;
    const end = effect(() => {
      const event = editor.selectedEvent.value;
      const idle = !editor.drag.active.value && !editor.answers.motion.value.stale && !editor.answers.away.value;
      const ways = event && idle ? eventRemedies(editor, event) : [];
      untracked(() => {
        whatIf.cancel();
        if (this.#known.peek().size) this.#known.value = new Map();
        const scene = editor.scene.peek();
        if (event && scene) this.#next(event, scene, ways);
      });
    });
    return () => {
      end();
      whatIf.cancel();
    };
  }

  /** Undefined until it is known. */
  of(way: Remedy): Outcome | undefined {
    return this.#known.value.get(keyOf(way));
  }

  #next(event: TrafficEvent, scene: Scene, [way, ...rest]: readonly Remedy[]): void {
    if (!way) return;
    const supposed = triedChange(scene, way.command);
    const next = () => this.#next(event, scene, rest);
    const answered = (set: MotionSet | null): void => {
      if (set) this.#say(way, this.#outcome(event, supposed!.scene, set));
      next();
    };
    if (!supposed || !this.whatIf.ask(supposed, answered)) next();
  }

  #say(way: Remedy, outcome: Outcome): void {
    this.#known.value = new Map(this.#known.peek()).set(keyOf(way), outcome);
  }

  #outcome(event: TrafficEvent, scene: Scene, set: MotionSet): Outcome {
    const unit = this.editor.view.speedUnit.peek();
    const before = this.editor.reading.events.peek();
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

/** A remedy is created again at each draw; its texts stay the same and identify it. */
const keyOf = ({ label, note }: Remedy): string => `${label} ${note}`;

/** Do both events concern the same pair? */
const samePair = (p: TrafficEvent, q: TrafficEvent): boolean => {
  const [a, b] = [p.b?.id ?? '', q.b?.id ?? ''];
  return (p.a.id === q.a.id && a === b) || (p.a.id === b && a === q.a.id);
};
