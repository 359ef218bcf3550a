// The editing session: what is selected and pointed at, and its parts (document, answers, playhead, notices). What a
// panel shows is a signal here, to be read; it changes by the named methods alone.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { HistoryStep, KeptHistory } from '../model/document/history';
import type { Command } from '../model/document/commands';
import { startPose, touched, touchedIn, type Agent, type Scene } from '../model/document/scene';
import type { Futures, MotionSet } from '../model/document/futures';
import { endPose, poseAtStep } from '../model/base/motion';
import type { Way } from '../model/document/scene-diff';
import { wrapAngle, type OnLine, type Pose, type Vec } from '../model/base/geometry';
import { motionOf } from '../model/physics/playback';
import { eventsOf, readEvents, type TrafficEvent } from '../model/words/event-words';
import { localReach, type LocalReach } from '../model/words/reach-words';
import { type SpeedUnit, toldIn, walkingUnit } from '../model/base/units';
import { keep, recall } from '../net/storage';
import { Answers } from './answers';
import { Calm } from './calm';
import { Document, type Commit, type Lock, type Travel } from './document/document';
import { onlyPicked, stepOf, type Step } from './document/step';
import { Filling } from './filling';
import { Layouts } from './layouts';
import type { ToolName } from './gestures/tools';
import { Layers, type LayerName } from './layers';
import { Notices } from './notices';
import { Placement } from './placement';
import { SpeedCurve } from './speed-curve';
import { Playhead } from './playhead';
import { Deck } from './rounds/deck';
import { TEXTS } from '../texts/editing/generation';

/** A handle of the selected road user: of its start, of its goal, or a via point by its index. */
export interface Keyed {
  readonly part: Part;
  readonly via: number | null;
}

export type Part = 'start' | 'goal';
export type Field = 'pos' | 'heading' | 'speed';
export type HandleName = 'body' | 'heading' | 'speed' | 'time' | 'via' | 'ring';
export interface Grip {
  readonly part: Part;
  readonly handle: HandleName;
  /** Which of the via points. */
  readonly index?: number;
}
/** What the pointer is over: one of the three, or nothing. */
export interface Pointed {
  readonly agent?: string | null;
  readonly future?: number | null;
  readonly grip?: Grip | null;
}

/** How far the flag lags behind the hand while a kerb holds it back: from where it is held to the pointer, metres. */
export interface Lag {
  readonly from: Vec;
  readonly to: Vec;
  readonly touch: boolean;
}

/** The lane under what is dragged, in words and by id, the stop line it holds to, and what holds it back. */
export interface DragPlace {
  readonly laneName: string | null;
  readonly laneId: string | null;
  readonly stop: OnLine | null;
  readonly lag: Lag | null;
}
export interface DragInfo extends DragPlace {
  readonly grip: Grip;
}

export interface MeasuredLine {
  readonly a: Vec;
  readonly b: Vec;
}

/** What a marquee or a lasso goes round, in metres, and whom it takes. */
export interface Sweep {
  readonly outline: readonly Vec[];
  readonly ids: readonly string[];
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

const NOBODY: readonly string[] = Object.freeze([]);
const NO_TRIES: Tries = Object.freeze([]);
const NO_EVENTS: readonly TrafficEvent[] = [];

export class Editor {
  readonly document = new Document();
  readonly answers = new Answers();
  readonly playhead = new Playhead();
  readonly notices = new Notices();
  readonly placement = new Placement();
  readonly filling = new Filling();
  /** A map that is being made. */
  readonly layouts = new Layouts();
  /** Speeds drawn by hand. */
  readonly curve: SpeedCurve = new SpeedCurve(this);
  readonly deck = new Deck();
  readonly #layers = new Layers();

  readonly #selected = signal<readonly string[]>(NOBODY);
  readonly #hover = signal<string | null>(null);
  readonly #hoverFuture = signal<number | null>(null);
  readonly #hoverGrip = signal<Grip | null>(null);
  readonly #keyed = signal<Keyed | null>(null);
  readonly #focusPart = signal<Part>('start');
  readonly #viaInHand = signal<number | null>(null);
  readonly #lastField = signal<{ part: Part; field: Field }>({ part: 'goal', field: 'speed' });
  readonly #tool = signal<ToolName>('select');
  readonly #measure = signal<MeasuredLine | null>(null);
  readonly #sweep = signal<Sweep | null>(null);
  readonly #showBefore = signal(true);
  readonly #showForeseen = signal(true);
  readonly #drag = signal<DragInfo | null>(null);
  readonly #selectedEvent = signal<TrafficEvent | null>(null);
  readonly #speedUnit = signal<SpeedUnit>(toldIn(recall<SpeedUnit>('speed-unit') ?? 'km/h'));
  readonly #beside = signal<Beside | null>(null);
  readonly #tries = signal<Tries>(NO_TRIES);
  /** Goal headings that came from a lane and may follow the next one, as `part:id`. */
  readonly #snappedHeadings = new Set<string>();

  readonly scene: ReadonlySignal<Scene | null> = this.document.shown;
  /** The committed one: while a hand moves it stays as it was, and so does what is worked out from it. */
  readonly resting: ReadonlySignal<Scene | null> = this.document.scene;
  /** Is there a scene? It changes less often than the scene does. */
  readonly isOpen = computed(() => this.resting.value !== null);
  /** Ids of all that are selected, in the order in which they were taken. */
  readonly selected: ReadonlySignal<readonly string[]> = this.#selected;
  /** Id of the selected road user; null where none is selected, or several. */
  readonly selection = computed(() => (this.selected.value.length === 1 ? this.selected.value[0] : null));
  readonly hover: ReadonlySignal<string | null> = this.#hover;
  readonly hoverFuture: ReadonlySignal<number | null> = this.#hoverFuture;
  readonly hoverGrip: ReadonlySignal<Grip | null> = this.#hoverGrip;
  /** The handle that keys move now: it has the focus, and one sees where it is. */
  readonly keyed: ReadonlySignal<Keyed | null> = this.#keyed;
  /** The part that keys move. */
  readonly focusPart: ReadonlySignal<Part> = this.#focusPart;
  /** The via point that keys are about; null where there is none. */
  readonly viaInHand = computed<number | null>(() => {
    const i = this.#viaInHand.value;
    return i !== null && i < (this.agent.value?.goal.via.length ?? 0) ? i : null;
  });
  readonly lastField: ReadonlySignal<{ part: Part; field: Field }> = this.#lastField;
  readonly tool: ReadonlySignal<ToolName> = this.#tool;
  /** Ends of the measuring line, in metres. */
  readonly measure: ReadonlySignal<MeasuredLine | null> = this.#measure;
  readonly sweep: ReadonlySignal<Sweep | null> = this.#sweep;
  /** Are the paths before the last change shown beside the new ones? */
  readonly showBefore: ReadonlySignal<boolean> = this.#showBefore;
  /** Are the others' answers shown on the picture while a handle is dragged? */
  readonly showForeseen: ReadonlySignal<boolean> = this.#showForeseen;
  readonly drag: ReadonlySignal<DragInfo | null> = this.#drag;
  readonly selectedEvent: ReadonlySignal<TrafficEvent | null> = this.#selectedEvent;
  readonly speedUnit: ReadonlySignal<SpeedUnit> = this.#speedUnit;
  /** Another way that the scene could go, shown dashed beside the one on the picture. */
  readonly beside: ReadonlySignal<Beside | null> = this.#beside;
  /** Ways that a search has tried so far, pale on the picture. */
  readonly tries: ReadonlySignal<Tries> = this.#tries;

  // The parts' signals under short names, for reading.
  readonly undoName = this.document.undoName;
  readonly redoName = this.document.redoName;
  readonly lock = this.document.lock;
  readonly motion = this.answers.motion;
  readonly draft = this.answers.draft;
  readonly changes = this.answers.changes;
  readonly foreseen = this.answers.foreseen;
  readonly liveReach = this.answers.liveReach;
  readonly status = this.answers.status;
  readonly away = this.answers.away;
  readonly time = this.playhead.time;
  readonly layers = this.#layers.shown;
  readonly playing = this.playhead.playing;

  /** Called after a document change has been committed; the generator and the saving hang on here. */
  onCommit: ((scene: Scene, step: Step) => void) | null = null;
  onSelect: ((id: string | null) => void) | null = null;
  /** Undo and redo went over a step. */
  onTravel: ((step: HistoryStep, way: Way) => void) | null = null;
  /** A map that was being made has given way to a scene; what is handed over goes on with it. */
  onMapPutAway: ((reopen: () => void) => void) | null = null;
  readonly agent = computed<Agent | null>(() => {
    const id = this.selection.value;
    return (id && this.scene.value?.agents.get(id)) || null;
  });
  /** The same as it was before the drag that goes on, for what a drag does not change. */
  readonly restingAgent = computed<Agent | null>(() => {
    const id = this.selection.value;
    return (id && this.resting.value?.agents.get(id)) || null;
  });
  readonly futures = computed<Futures | null>(() => {
    const id = this.selection.value;
    if (!id) return null;
    const cards = this.deck.ofAgent(id);
    if (cards) return cards.futures;
    const d = this.draft.value;
    return d && d.id === id ? d.futures : (this.motion.value.futures.get(id) ?? null);
  });
  /** The quick verdict on the goal of the selected road user, worked out here without asking anybody. */
  readonly localReach = computed<LocalReach | null>(() => {
    const a = this.agent.value;
    const s = this.scene.value;
    const start = a && startPose(a);
    if (!a || !s || !start || !a.goal.pos) return null;
    return localReach(s.map, a, start, a.goal, this.unitOf(a), s.length);
  });
  /** Index of the future in force for the selected road user. */
  readonly chosen = computed<number>(() => {
    const f = this.futures.value;
    const a = this.agent.value;
    if (!f || !a) return 0;
    if (this.deck.ofAgent(a.id)) return this.deck.current.value;
    return Math.min(f.modes.length - 1, a.chosen ?? f.chosen);
  });
  /** The selected one does what was recorded: of its futures none is in force. */
  readonly replays = computed(() => {
    const a = this.agent.value;
    return a !== null && !touched(a) && !this.motion.value.driving.has(a.id) && !this.deck.ofAgent(a.id);
  });
  /** Index of the future that stands out on the picture and in the plot; -1 where none is in force. */
  readonly bold = computed(() => (this.replays.value ? -1 : this.chosen.value));
  /** Changes only when a drag begins or ends. */
  readonly dragging = computed(() => this.drag.value !== null);
  /** What panels say follows a drag now and then. */
  readonly calm = new Calm(this.dragging, () => {
    void [this.draft.value, this.status.value, this.scene.value, this.motion.value, this.layers.value];
  });
  /** The futures and the one in force, as panels say them. */
  readonly toldFutures = computed(() => this.calm.read(() => this.futures.value));
  readonly toldChosen = computed(() => this.calm.read(() => this.chosen.value));
  readonly events = computed<readonly TrafficEvent[]>(() => {
    const s = this.scene.value;
    if (!s || this.dragging.value) return NO_EVENTS;
    // On the table lies something else than the scene does.
    const hand = this.deck.hand.value;
    const card = this.deck.current.value;
    if (hand && hand.id !== null)
      return eventsOf(s, this.motion.value, hand.id, hand.futures, card, this.speedUnit.value);
    return readEvents(s, hand?.sets[card] ?? this.motion.value, this.speedUnit.value);
  });
  /**
   * What the timeline shows: the events, while a hand moves what is wrong with the future that is shown, and of a case
   * that is looked at what happens in it.
   */
  readonly shownEvents = computed<readonly TrafficEvent[]>(() => {
    const s = this.scene.value;
    const b = this.beside.value;
    if (b?.meeting) return readEvents(b.scene, b.set, this.speedUnit.value);
    const d = this.dragging.value ? this.draft.value : null;
    return s && d
      ? eventsOf(s, this.motion.value, d.id, d.futures, this.chosen.value, this.speedUnit.value)
      : this.events.value;
  });
  /** Are the futures of the selected road user from before the last change? */
  readonly outdated = computed(
    () => this.motion.value.stale && !this.draft.value && this.motion.value.fresh !== this.selection.value,
  );

  unitOf(a: Agent): SpeedUnit {
    return a.type === 'pedestrian' ? walkingUnit(this.speedUnit.value) : this.speedUnit.value;
  }

  // -------------------------------------------------------------- the document

  open(scene: Scene, saved: MotionSet | null = null, kept: KeptHistory | null = null): void {
    const reopenMap = this.layouts.close();
    batch(() => {
      this.document.open(scene, kept);
      this.#snappedHeadings.clear();
      this.#selected.value = NOBODY;
      this.#hover.value = null;
      this.#drag.value = null;
      this.#selectedEvent.value = null;
      this.answers.open(scene, saved);
      this.playhead.rewind();
      this.placement.stop();
      this.filling.close();
      if (this.#tool.peek() === 'fill') this.#tool.value = 'select';
      this.#sweep.value = null;
      this.#beside.value = null;
      this.#tries.value = NO_TRIES;
      this.notices.hide();
    });
    if (reopenMap) this.onMapPutAway?.(reopenMap);
  }

  /** Does a command as one undo step. A drag that goes on is released first: the command may go on from its preview. */
  run(command: Command): void {
    this.#commit(null, () => this.document.run(command));
  }

  undo(): void {
    this.#travel('back', () => this.document.undo());
  }

  redo(): void {
    this.#travel('forth', () => this.document.redo());
  }

  /** To any step of the history; null for how the scene was before the first. */
  goTo(id: number | null): void {
    if (id === this.document.history?.head && !this.dragging.peek()) return;
    const name = this.document.history?.step(id)?.name ?? TEXTS.backToTheBeginning;
    const commit = this.#commit('there', () => {
      const there = this.document.goTo(id);
      return there && { ...there, name };
    });
    if (commit) this.notices.say(TEXTS.nowAt(name));
  }

  /** Another version of the same scene takes the place of this one; undo brings this one back. */
  adopt(name: string, scene: Scene): void {
    this.#commit('there', () => this.document.adopt(name, scene));
  }

  /** The document is only to be looked at from now on; a drag that goes on is put back. */
  lockWith(lock: Lock | null): void {
    if (lock && this.dragging.peek()) this.cancelDrag();
    this.document.lockWith(lock);
  }

  /** A change was tried that cannot be made now: says why. */
  #refused(): boolean {
    const lock = this.lock.peek();
    if (lock) this.notices.show({ text: lock.words, action: lock });
    return lock !== null;
  }

  #travel(way: Way, move: () => Travel | null): void {
    const travel = this.#commit(way, move);
    if (!travel) return;
    this.onTravel?.(travel.step, way);
    const word = way === 'back' ? TEXTS.undone : TEXTS.doneAgain;
    this.notices.show({ text: `${word}: ${travel.name}.` });
    this.notices.say(`${word}: ${travel.name}.`);
  }

  /**
   * `way`: where one travels in the history; null for a new step. A drag that goes on is released before `move`, so
   * that nothing of it is lost.
   */
  #commit<C extends Commit>(way: Way | 'there' | null, move: () => C | null): C | null {
    if (!this.document.scene.peek() || this.#refused()) return null;
    const trial = this.document.trial.peek();
    if (trial) this.endDrag(trial.command);
    return this.#follow(way, move);
  }

  /** Everything else follows a commit, all at once. */
  #follow<C extends Commit>(way: Way | 'there' | null, move: () => C | null): C | null {
    const done = batch(() => {
      const commit = move();
      if (!commit) return null;
      const { before, after } = commit;
      const counting = before.thresholds !== after.thresholds && !this.motion.peek().stale;
      const step = stepOf(commit, way, counting);
      this.#followCast(before, after);
      this.#selectedEvent.value = null;
      // A scene may have become shorter.
      this.playhead.moveTo(Math.min(this.time.peek(), after.duration));
      if (counting) this.answers.countsOtherwise(after);
      else {
        const fresh = step.agent && onlyPicked(commit, step.agent) ? step.agent : null;
        this.answers.documentChanged(after, fresh, way === 'forth' || way === null);
      }
      return { commit, step };
    });
    if (!done) return null;
    this.onCommit?.(done.commit.after, done.step);
    return done.commit;
  }

  /** Who has come is selected, who has gone is not. */
  #followCast(before: Scene, scene: Scene): void {
    if (before.roster === scene.roster) return;
    const came = [...scene.agents.keys()].filter((id) => !before.agents.has(id));
    const stay = this.#selected.peek().filter((id) => scene.agents.has(id));
    if (came.length) {
      this.#selected.value = came;
      this.placement.show(null);
    } else if (stay.length < this.#selected.peek().length) this.#selected.value = stay.length ? stay : NOBODY;
    const hovered = this.#hover.peek();
    if (hovered && !scene.agents.has(hovered)) this.#hover.value = null;
  }

  // -------------------------------------------------------------- a drag

  beginDrag(grip: Grip): void {
    if (this.#refused()) return;
    batch(() => {
      this.playhead.pause();
      this.#focusPart.value = grip.part;
      this.#viaInHand.value = grip.index ?? null;
      this.document.begin();
      this.#drag.value = { grip, laneName: null, laneId: null, stop: null, lag: null };
      this.answers.dragBegan();
      this.notices.hide();
    });
  }

  /** A frame of the drag: the document as it would be. Nothing, where the drag has ended without the hand. */
  previewDrag(command: Command): void {
    batch(() => {
      if (this.document.preview(command)) this.answers.dragMoved();
    });
  }

  dragOver(place: DragPlace): void {
    const old = this.#drag.peek();
    if (!old) return;
    const { laneId, laneName, stop, lag } = place;
    const lane = old.laneId !== laneId || old.laneName !== laneName;
    if (lane || (old.stop === null) !== (stop === null) || old.lag !== lag)
      this.#drag.value = { grip: old.grip, ...place };
  }

  /** The release: one undo step, or none where nothing was moved. */
  endDrag(command: Command | null): void {
    this.#drag.value = null;
    if (command) this.#follow(null, () => this.document.commit(command));
    else this.document.cancel();
    this.document.settle();
  }

  /** Everything back to where it was before the drag. */
  cancelDrag(): void {
    if (!this.document.trial.peek()) return;
    batch(() => {
      this.#drag.value = null;
      this.document.cancel();
      this.answers.dragPutBack();
    });
    this.notices.say(TEXTS.putBack);
    this.document.settle();
  }

  /** May a lane set this heading? It may where a lane set it before. */
  headingFollows(part: Part, a: Agent): boolean {
    return this.#snappedHeadings.has(`${part}:${a.id}`);
  }

  setHeadingFollows(part: Part, a: Agent, follows: boolean): void {
    if (follows) this.#snappedHeadings.add(`${part}:${a.id}`);
    else this.#snappedHeadings.delete(`${part}:${a.id}`);
  }

  // -------------------------------------------------------------- what one looks at

  select(id: string | null): void {
    this.selectAll(id === null ? NOBODY : [id]);
  }

  selectAll(wanted: readonly string[]): void {
    const now = this.#selected.peek();
    const here = this.scene.peek()?.agents;
    const ids = wanted.filter((id) => here?.has(id));
    if (ids.length === now.length && ids.every((id, i) => id === now[i])) return;
    batch(() => {
      this.#selected.value = Object.freeze([...ids]);
      this.#hoverFuture.value = null;
      this.#selectedEvent.value = null;
      this.#focusPart.value = 'start';
      this.#viaInHand.value = this.#keyed.value = null;
      this.answers.forgetLook();
    });
    const a = this.agent.peek();
    if (a) this.notices.say(TEXTS.selected(a.name));
    else if (ids.length) this.notices.say(TEXTS.roadUsersSelected(ids.length));
    this.onSelect?.(this.selection.peek());
  }

  /** Adds one to those that are selected, or takes it away. */
  toggleSelected(id: string): void {
    const now = this.#selected.peek();
    this.selectAll(now.includes(id) ? now.filter((o) => o !== id) : [...now, id]);
  }

  /** The road users that are selected, as the document has them. */
  get chosenOnes(): Agent[] {
    return this.#chosenIn(this.scene.value);
  }

  /** The same as they were before the drag that goes on. */
  get restingOnes(): Agent[] {
    return this.#chosenIn(this.resting.value);
  }

  #chosenIn(scene: Scene | null): Agent[] {
    return this.selected.value.flatMap((id) => scene?.agents.get(id) ?? []);
  }

  pointAt({ agent = null, future = null, grip = null }: Pointed): void {
    batch(() => {
      this.#hover.value = agent;
      this.#hoverFuture.value = future;
      this.#hoverGrip.value = grip;
    });
  }

  /** A handle has the focus of keys; null when none has. */
  focusHandle(handle: Keyed | null): void {
    this.#keyed.value = handle;
  }

  /** Keys move this part from now on. */
  activate(part: Part): void {
    this.#focusPart.value = part;
    this.#viaInHand.value = null;
  }

  /** Keys are about this via point from now on, or about none. */
  takeVia(index: number | null): void {
    this.#viaInHand.value = index;
  }

  /** The field that "fixed or free" is about from now on. */
  touchField(part: Part, field: Field): void {
    this.#lastField.value = { part, field };
  }

  toggleLayer(name: LayerName): void {
    this.#layers.toggle(name);
  }

  toggleBefore(): void {
    this.#showBefore.value = !this.#showBefore.peek();
  }

  toggleForeseen(): void {
    this.#showForeseen.value = !this.#showForeseen.peek();
  }

  chooseTool(tool: ToolName): void {
    batch(() => {
      this.#tool.value = tool;
      this.#measure.value = null;
      this.placement.stop();
      if (tool === 'fill') this.filling.open(this.scene.peek()?.seed ?? 0);
      else this.filling.close();
    });
  }

  measureBetween(line: MeasuredLine | null): void {
    this.#measure.value = line;
  }

  sweepOver(sweep: Sweep | null): void {
    this.#sweep.value = sweep;
  }

  showBeside(beside: Beside | null): void {
    this.#beside.value = beside;
  }

  showTries(tries: Tries): void {
    this.#tries.value = tries;
  }

  pickEvent(event: TrafficEvent | null): void {
    this.#selectedEvent.value = event;
  }

  setUnit(unit: SpeedUnit): void {
    batch(() => {
      this.#speedUnit.value = unit;
      toldIn(unit);
    });
    keep('speed-unit', unit);
  }

  setTime(t: number): void {
    const s = this.scene.peek();
    if (s) this.playhead.moveTo(Math.min(s.duration, Math.max(0, t)));
  }

  // -------------------------------------------------------------- what follows from it

  /** The motion of a road user: what it does now, or the card of it that is looked at. */
  motionFor(a: Agent): ReturnType<typeof motionOf> {
    const cards = this.deck.ofAgent(a.id);
    if (cards) return cards.futures.modes[this.deck.current.value].motion;
    return motionOf(this.scene.value!, this.deck.shownSet() ?? this.motion.value, a);
  }

  /** Where the goal of a road user stands on screen: fixed fields as set, free ones as the generator chose. */
  goalPose(a: Agent): (Pose & { set: boolean }) | null {
    const g = a.goal;
    const d = this.draft.value;
    const cards = this.deck.ofAgent(a.id)?.futures ?? null;
    const f = cards ?? (d?.id === a.id ? d.futures : this.motion.value.futures.get(a.id));
    const index = cards ? this.deck.current.value : f ? Math.min(f.modes.length - 1, a.chosen ?? f.chosen) : -1;
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

  /** Everybody the user asked something of. */
  touchedIds(scene = this.scene.peek()): string[] {
    return scene ? touchedIn(scene) : [];
  }
}
