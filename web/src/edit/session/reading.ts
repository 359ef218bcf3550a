// What follows from the document, what is selected, and what is answered: the futures of the selected road user, the
// one in force, and the events.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Verdict } from '../../model/document/feedback';
import type { Futures, MotionSet } from '../../model/document/futures';
import { startPose, touched, type Agent, type Scene } from '../../model/document/scene';
import { endPose, poseAtStep } from '../../model/base/motion';
import { wrapAngle, type Pose } from '../../model/base/geometry';
import { motionOf } from '../../model/physics/playback';
import { eventsOf, readEvents, type TrafficEvent } from '../../model/words/event-words';
import { localReach, type LocalReach } from '../../model/words/reach-words';
import type { Answers } from './answers';
import type { Drag } from './drag';
import { Throttle } from './throttle';
import type { ViewSettings } from './view-settings';

/** Cards on the table: futures that are looked at in place of the answers, and that nobody follows yet. */
export interface Cards {
  /** Futures of one road user, or what everybody does by card; null where no cards lie there. */
  readonly hand: ReadonlySignal<
    | { readonly id: string; readonly futures: Futures }
    | { readonly id: null; readonly sets: readonly MotionSet[] }
    | null
  >;
  /** Index of the card that is looked at. */
  readonly current: ReadonlySignal<number>;
  /** The cards, where they are those of this road user. */
  ofAgent(id: string): { readonly futures: Futures } | null;
  /** What everybody does on the card that is looked at, where the cards are of everybody. */
  shownSet(): MotionSet | null;
  /** What was said of each; null where it is open. */
  verdicts(): readonly (Verdict | null)[];
  point(index: number): void;
}

const NO_CARDS: Cards = {
  hand: signal(null),
  current: signal(0),
  ofAgent: () => null,
  shownSet: () => null,
  verdicts: () => [],
  point: () => undefined,
};

const NO_EVENTS: readonly TrafficEvent[] = [];

/** What it follows from. */
export interface Sources {
  readonly scene: ReadonlySignal<Scene | null>;
  /** Id of the selected road user. */
  readonly selection: ReadonlySignal<string | null>;
  readonly agent: ReadonlySignal<Agent | null>;
  readonly answers: Answers;
  readonly drag: Drag;
  readonly view: ViewSettings;
}

export class Reading {
  readonly #cards = signal(NO_CARDS);

  constructor(private readonly of: Sources) {
    const { answers, drag, scene, view } = of;
    this.throttle = new Throttle(drag.active, () => {
      void [answers.draft.value, answers.status.value, scene.value, answers.motion.value, view.layers.value];
    });
  }

  /** Cards on the table; read in a computation, it follows. */
  get cards(): Cards {
    return this.#cards.value;
  }

  /** Cards are laid from here from now on. */
  layCards(cards: Cards): void {
    this.#cards.value = cards;
  }

  readonly futures = computed<Futures | null>(() => {
    const id = this.of.selection.value;
    if (!id) return null;
    const cards = this.cards.ofAgent(id);
    if (cards) return cards.futures;
    const d = this.of.answers.draft.value;
    return d && d.id === id ? d.futures : (this.of.answers.motion.value.futures.get(id) ?? null);
  });
  /** The quick verdict on the goal of the selected road user, worked out here without asking anybody. */
  readonly localReach = computed<LocalReach | null>(() => {
    const a = this.of.agent.value;
    const s = this.of.scene.value;
    const start = a && startPose(a);
    if (!a || !s || !start || !a.goal.pos) return null;
    return localReach(s.map, a, start, a.goal, this.of.view.unitOf(a), s.length);
  });
  /** Index of the future in force for the selected road user. */
  readonly chosen = computed<number>(() => {
    const f = this.futures.value;
    const a = this.of.agent.value;
    if (!f || !a) return 0;
    if (this.cards.ofAgent(a.id)) return this.cards.current.value;
    return Math.min(f.modes.length - 1, a.chosen ?? f.chosen);
  });
  /** The selected one does what was recorded: of its futures none is in force. */
  readonly replays = computed(() => {
    const a = this.of.agent.value;
    return a !== null && !touched(a) && !this.of.answers.motion.value.driving.has(a.id) && !this.cards.ofAgent(a.id);
  });
  /** Index of the future that stands out on the picture and in the plot; -1 where none is in force. */
  readonly bold = computed(() => (this.replays.value ? -1 : this.chosen.value));
  /** What panels say follows a drag now and then. */
  readonly throttle: Throttle;
  /** The futures and the one in force, as panels say them. */
  readonly toldFutures = computed(() => this.throttle.read(() => this.futures.value));
  readonly toldChosen = computed(() => this.throttle.read(() => this.chosen.value));
  readonly events = computed<readonly TrafficEvent[]>(() => {
    const s = this.of.scene.value;
    if (!s || this.of.drag.active.value) return NO_EVENTS;
    // On the table lies something else than the scene does.
    const hand = this.cards.hand.value;
    const card = this.cards.current.value;
    const motion = this.of.answers.motion.value;
    const unit = this.of.view.speedUnit.value;
    if (hand && hand.id !== null) return eventsOf(s, motion, hand.id, hand.futures, card, unit);
    return readEvents(s, hand?.sets[card] ?? motion, unit);
  });
  /**
   * What the timeline shows: the events, while a hand moves what is wrong with the future that is shown, and of a case
   * that is looked at what happens in it.
   */
  readonly shownEvents = computed<readonly TrafficEvent[]>(() => {
    const { answers, drag, scene, view } = this.of;
    const s = scene.value;
    const b = view.beside.value;
    const unit = view.speedUnit.value;
    if (b?.meeting) return readEvents(b.scene, b.set, unit);
    const d = drag.active.value ? answers.draft.value : null;
    if (!s || !d) return this.events.value;
    return eventsOf(s, answers.motion.value, d.id, d.futures, this.chosen.value, unit);
  });
  /** Are the futures of the selected road user from before the last change? */
  readonly outdated = computed(() => {
    const { draft, motion } = this.of.answers;
    return motion.value.stale && !draft.value && motion.value.fresh !== this.of.selection.value;
  });

  /** The motion of a road user: what it does now, or the card of it that is looked at. */
  motionFor(a: Agent): ReturnType<typeof motionOf> {
    const cards = this.cards.ofAgent(a.id);
    if (cards) return cards.futures.modes[this.cards.current.value].motion;
    return motionOf(this.of.scene.value!, this.cards.shownSet() ?? this.of.answers.motion.value, a);
  }

  /** Where the goal of a road user stands on screen: fixed fields as set, free ones as the generator chose. */
  goalPose(a: Agent): (Pose & { set: boolean }) | null {
    const g = a.goal;
    const { draft, motion } = this.of.answers;
    const d = draft.value;
    const cards = this.cards.ofAgent(a.id)?.futures ?? null;
    const f = cards ?? (d?.id === a.id ? d.futures : motion.value.futures.get(a.id));
    const index = cards ? this.cards.current.value : f ? Math.min(f.modes.length - 1, a.chosen ?? f.chosen) : -1;
    const m = f && index >= 0 ? f.modes[index].motion : null;
    const end = m ? (poseAtStep(m, Math.round(g.time * 10)) ?? endPose(m)) : null;
    if (!g.pos && !end) return null;
    const [x, y] = g.pos ?? [end!.x, end!.y];
    const start = startPose(a);
    const travel = start ? Math.atan2(y - start.y, x - start.x) : 0;
    return {
      x,
      y,
      heading: wrapAngle(g.heading ?? end?.heading ?? travel),
      speed: g.speed ?? Math.abs(end?.speed ?? start?.speed ?? 0),
      set: g.pos !== null,
    };
  }
}
