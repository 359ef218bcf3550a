// Values derived from document, selection and answers: the futures of the selected road user, the one in force, and the
// events.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Verdict } from '../../model/document/feedback';
import type { Futures, MotionSet } from '../../model/document/futures';
import { isPlaced, startPose, touched, type Agent, type Scene } from '../../model/document/scene';
import { endPose, poseAtStep } from '../../model/base/motion';
import { wrapAngle, type Pose } from '../../model/base/geometry';
import { motionOf } from '../../model/physics/playback';
import { eventsOf, readEvents, type TrafficEvent } from '../../model/words/event-words';
import { otherNamed } from '../../model/words/future-names';
import type { localReach, LocalReach } from '../../model/words/reach-words';
import type { Answers } from './answers';
import type { Drag } from './drag';
import { NOT_LIVE, type LiveMotion } from './live';
import { Throttle } from './throttle';
import type { ViewSettings } from './view-settings';

/** Preference cards: futures shown in place of the answers; no road user follows them yet. */
export interface Cards {
  /** Futures of one road user, or the motions of all by card; null where there are no cards. */
  readonly hand: ReadonlySignal<
    | { readonly id: string; readonly futures: Futures }
    | { readonly id: null; readonly sets: readonly MotionSet[] }
    | null
  >;
  /** Index of the viewed card. */
  readonly current: ReadonlySignal<number>;
  /** The cards, if they belong to this road user. */
  ofAgent(id: string): { readonly futures: Futures } | null;
  /** The motions of all on the viewed card, for whole-scene cards. */
  shownSet(): MotionSet | null;
  /** Verdict on each; null where it is open. */
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

/** The signals it derives from. */
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
  readonly #reach = signal<typeof localReach | null>(null);
  readonly #live = signal(NOT_LIVE);

  constructor(private readonly of: Sources) {
    const { answers, drag, scene, view } = of;
    this.throttle = new Throttle(drag.active, () => {
      void [answers.draft.value, answers.status.value, scene.value, answers.motion.value, view.layers.value];
    });
  }

  /** The cards in use; tracked when read in a computation. */
  get cards(): Cards {
    return this.#cards.value;
  }

  /** Takes the cards from here from now on. */
  layCards(cards: Cards): void {
    this.#cards.value = cards;
  }

  /** Motion that happens now; tracked when read in a computation. */
  get live(): LiveMotion {
    return this.#live.value;
  }

  /** Takes motion that happens now from here from now on. */
  showLive(of: LiveMotion): void {
    this.#live.value = of;
  }

  readonly futures = computed<Futures | null>(() => {
    const id = this.of.selection.value;
    if (!id) return null;
    const cards = this.cards.ofAgent(id);
    if (cards) return cards.futures;
    const d = this.of.answers.draft.value;
    return d && d.id === id ? d.futures : (this.of.answers.motion.value.futures.get(id) ?? null);
  });
  /** Takes the estimate of reach from here: it loads after the picture. */
  layReach(of: typeof localReach): void {
    this.#reach.value = of;
  }

  /** A local estimate of whether the selected road user's goal is reachable, without the generator. */
  readonly localReach = computed<LocalReach | null>(() => {
    const a = this.of.agent.value;
    const s = this.of.scene.value;
    const start = a && startPose(a);
    if (!a || !s || !start || !a.goal.pos) return null;
    return this.#reach.value?.(s.map, a, start, a.goal, this.of.view.unitOf(a)) ?? null;
  });
  /** Index of the future in force for the selected road user. */
  readonly chosen = computed<number>(() => {
    const f = this.futures.value;
    const a = this.of.agent.value;
    if (!f || !a) return 0;
    if (this.cards.ofAgent(a.id)) return this.cards.current.value;
    return Math.min(f.modes.length - 1, a.chosen ?? f.chosen);
  });
  /** The selected road user replays the recording: none of its futures is in force. */
  readonly replays = computed(() => {
    const a = this.of.agent.value;
    return a !== null && !touched(a) && !this.of.answers.motion.value.driving.has(a.id) && !this.cards.ofAgent(a.id);
  });
  /** Index of the emphasised future on the picture and in the plot; -1 where none is in force. */
  readonly bold = computed(() => (this.replays.value ? -1 : this.chosen.value));
  /** Id of the road user that the name of the emphasised future contains. */
  readonly named = computed(() => otherNamed(this.futures.value?.modes[this.bold.value]?.basis));
  /** Panels follow a drag at a reduced rate. */
  readonly throttle: Throttle;
  /** The futures and the one in force, at the panels' rate. */
  readonly toldFutures = computed(() => this.throttle.read(() => this.futures.value));
  readonly toldChosen = computed(() => this.throttle.read(() => this.chosen.value));
  readonly events = computed<readonly TrafficEvent[]>(() => {
    const s = this.of.scene.value;
    if (!s || this.of.drag.active.value) return NO_EVENTS;
    // Cards replace the answers of the scene.
    const hand = this.cards.hand.value;
    const card = this.cards.current.value;
    const motion = this.of.answers.motion.value;
    const unit = this.of.view.speedUnit.value;
    if (hand && hand.id !== null) return eventsOf(s, motion, hand.id, hand.futures, card, unit);
    return readEvents(s, hand?.sets[card] ?? motion, unit);
  });
  /** Events on the timeline; during a drag the faults of the shown future, and for a viewed case its events. */
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

  /** The motion of a road user: its current one, or its viewed card. */
  motionFor(a: Agent): ReturnType<typeof motionOf> {
    const cards = this.cards.ofAgent(a.id);
    if (cards) return cards.futures.modes[this.cards.current.value].motion;
    return motionOf(this.of.scene.value!, this.cards.shownSet() ?? this.of.answers.motion.value, a);
  }

  /** The shown pose of a road user's goal: fixed fields as set, free ones as the generator chose. */
  goalPose(a: Agent): (Pose & { set: boolean; time: number }) | null {
    const g = a.goal;
    const { draft, liveReach, motion } = this.of.answers;
    const live = liveReach.value;
    const known = g.relation ? (live?.id === a.id ? live.reach : motion.value.reach.get(a.id)) : null;
    const at = known?.relative ?? null;
    const d = draft.value;
    const cards = this.cards.ofAgent(a.id)?.futures ?? null;
    const f = cards ?? (d?.id === a.id ? d.futures : motion.value.futures.get(a.id));
    const index = cards ? this.cards.current.value : f ? Math.min(f.modes.length - 1, a.chosen ?? f.chosen) : -1;
    const m = f && index >= 0 ? f.modes[index].motion : null;
    const end = at ?? (m ? (poseAtStep(m, Math.round(g.time * 10)) ?? endPose(m)) : null);
    if (!g.pos && !end) return null;
    const [x, y] = g.pos ?? [end!.x, end!.y];
    const start = startPose(a);
    const travel = start ? Math.atan2(y - start.y, x - start.x) : 0;
    return {
      x,
      y,
      heading: wrapAngle(g.heading ?? end?.heading ?? travel),
      speed: g.speed ?? Math.abs(end?.speed ?? start?.speed ?? 0),
      set: isPlaced(g),
      time: at?.time ?? g.time,
    };
  }
}
