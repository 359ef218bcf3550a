// The editing session: selection, pointer target, and the shared parts. Panels read signals; only named methods change
// them.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { KeptHistory } from '../../model/document/history';
import type { Agent, Scene } from '../../model/document/scene';
import type { MotionSet } from '../../model/document/futures';
import type { Vec } from '../../model/base/geometry';
import type { TrafficEvent } from '../../model/words/event-words';
import { Document, type Lock } from '../document/document';
import { TEXTS } from '../../texts/editing/generation';
import { Answers } from './answers';
import { Commits } from './commits';
import { Drag, type Grip, type HandlePart } from './drag';
import type { MapItem } from './map-item';
import { Notices } from './notices';
import type { SessionPart } from './part';
import { Playhead } from './playhead';
import { Reading } from './reading';
import { ViewSettings } from './view-settings';

/** A handle of the selected road user: of its start, of its goal, or a via point by its index. */
export interface Keyed {
  readonly part: HandlePart;
  readonly via: number | null;
}

export type Field = 'pos' | 'heading' | 'speed';

/** The pointer's target: one of the three, or none. */
export interface Pointed {
  readonly agent?: string | null;
  readonly future?: number | null;
  readonly grip?: Grip | null;
}

export interface MeasuredLine {
  readonly a: Vec;
  readonly b: Vec;
}

/** Outline of a marquee or a lasso, in metres, and the ids inside. */
export interface AreaSelection {
  readonly outline: readonly Vec[];
  readonly ids: readonly string[];
}

const NOBODY: readonly string[] = Object.freeze([]);

export class Editor {
  readonly #selected = signal<readonly string[]>(NOBODY);
  readonly #hover = signal<string | null>(null);
  readonly #hoverFuture = signal<number | null>(null);
  readonly #hoverGrip = signal<Grip | null>(null);
  readonly #keyed = signal<Keyed | null>(null);
  readonly #focusPart = signal<HandlePart>('start');
  readonly #viaInHand = signal<number | null>(null);
  readonly #lastField = signal<{ part: HandlePart; field: Field }>({ part: 'goal', field: 'speed' });
  readonly #tool = signal('select');
  readonly #measure = signal<MeasuredLine | null>(null);
  readonly #sweep = signal<AreaSelection | null>(null);
  readonly #selectedEvent = signal<TrafficEvent | null>(null);
  readonly #mapItem = signal<MapItem | null>(null);

  readonly document = new Document();
  readonly scene: ReadonlySignal<Scene | null> = this.document.shown;
  /** The committed scene: during a drag it stays unchanged, and so do all values computed from it. */
  readonly resting: ReadonlySignal<Scene | null> = this.document.scene;
  /** Is a scene open? Changes less often than the scene does. */
  readonly isOpen = computed(() => this.resting.value !== null);
  /** Ids of all selected ones, in the order of selection. */
  readonly selected: ReadonlySignal<readonly string[]> = this.#selected;
  /** Id of the selected road user; null where none is selected, or several. */
  readonly selection = computed(() => (this.selected.value.length === 1 ? this.selected.value[0] : null));
  readonly agent = computed<Agent | null>(() => {
    const id = this.selection.value;
    return (id && this.scene.value?.agents.get(id)) || null;
  });
  /** The same before the running drag, for values that a drag does not change. */
  readonly restingAgent = computed<Agent | null>(() => {
    const id = this.selection.value;
    return (id && this.resting.value?.agents.get(id)) || null;
  });
  readonly hover: ReadonlySignal<string | null> = this.#hover;
  readonly hoverFuture: ReadonlySignal<number | null> = this.#hoverFuture;
  readonly hoverGrip: ReadonlySignal<Grip | null> = this.#hoverGrip;
  /** The handle that keys move now: it has the focus, which is visible. */
  readonly keyed: ReadonlySignal<Keyed | null> = this.#keyed;
  /** The part that keys move. */
  readonly focusPart: ReadonlySignal<HandlePart> = this.#focusPart;
  /** The via point that keys act on; null where there is none. */
  readonly viaInHand = computed<number | null>(() => {
    const i = this.#viaInHand.value;
    return i !== null && i < (this.agent.value?.goal.via.length ?? 0) ? i : null;
  });
  readonly lastField: ReadonlySignal<{ part: HandlePart; field: Field }> = this.#lastField;
  /** Name of the active tool of the rail. */
  readonly tool: ReadonlySignal<string> = this.#tool;
  /** Ends of the measuring line, in metres. */
  readonly measure: ReadonlySignal<MeasuredLine | null> = this.#measure;
  readonly sweep: ReadonlySignal<AreaSelection | null> = this.#sweep;
  readonly selectedEvent: ReadonlySignal<TrafficEvent | null> = this.#selectedEvent;
  /** The clicked part of the map; null while a road user is selected. */
  readonly mapItem: ReadonlySignal<MapItem | null> = this.#mapItem;

  readonly answers = new Answers();
  readonly notices = new Notices();
  readonly view = new ViewSettings();
  readonly playhead = new Playhead(() => this.scene.peek()?.duration ?? null);
  /** The parts that follow the session, in this order. */
  readonly #parts: SessionPart[] = [{ followed: ({ before, after }) => this.#follow(before, after) }, this.answers];
  readonly commits = new Commits(this.document, this.notices, this.#parts, () => !this.answers.motion.peek().stale);
  readonly drag = new Drag(this);
  readonly reading = new Reading(this);

  /** A part follows the session from now on. */
  join(part: SessionPart): void {
    this.#parts.push(part);
  }

  /** Does any part wait for an answer? */
  readonly asking = (): boolean => this.#parts.some((part) => part.asking?.value);

  open(scene: Scene, saved: MotionSet | null = null, kept: KeptHistory | null = null): void {
    batch(() => {
      this.document.open(scene, kept);
      this.#selected.value = NOBODY;
      this.#hover.value = null;
      this.#selectedEvent.value = this.#mapItem.value = null;
      this.#sweep.value = null;
      this.answers.open(scene, saved);
      this.playhead.rewind();
      this.drag.opened();
      this.view.opened();
      this.notices.hide();
      for (const part of this.#parts) part.opened?.(scene);
    });
  }

  /** Makes the document read-only; a running drag is cancelled. */
  lockWith(lock: Lock | null): void {
    if (lock) this.drag.cancel();
    this.document.lockWith(lock);
  }

  /** Selects added road users, deselects removed ones. */
  #follow(before: Scene, after: Scene): void {
    this.#selectedEvent.value = null;
    // A scene may have become shorter.
    this.playhead.moveTo(this.playhead.time.peek());
    if (before.castKey === after.castKey) return;
    const came = [...after.agents.keys()].filter((id) => !before.agents.has(id));
    const stay = this.#selected.peek().filter((id) => after.agents.has(id));
    if (came.length) this.#selected.value = came;
    else if (stay.length < this.#selected.peek().length) this.#selected.value = stay.length ? stay : NOBODY;
    const hovered = this.#hover.peek();
    if (hovered && !after.agents.has(hovered)) this.#hover.value = null;
  }

  // -------------------------------------------------------------- selection

  select(id: string | null): void {
    this.selectAll(id === null ? NOBODY : [id]);
  }

  selectAll(wanted: readonly string[]): void {
    this.#mapItem.value = null;
    const now = this.#selected.peek();
    const here = this.scene.peek()?.agents;
    const ids = wanted.filter((id) => here?.has(id));
    if (ids.length === now.length && ids.every((id, i) => id === now[i])) return;
    batch(() => {
      this.#selected.value = Object.freeze([...ids]);
      this.#hoverFuture.value = null;
      this.#selectedEvent.value = null;
      this.activate('start');
      this.#keyed.value = null;
      this.answers.forgetLook();
    });
    const a = this.agent.peek();
    if (a) this.notices.say(TEXTS.selected(a.name));
    else if (ids.length) this.notices.say(TEXTS.roadUsersSelected(ids.length));
    for (const part of this.#parts) part.selected?.(this.selection.peek());
  }

  /** Adds one to the selection, or removes it. */
  toggleSelected(id: string): void {
    const now = this.#selected.peek();
    this.selectAll(now.includes(id) ? now.filter((o) => o !== id) : [...now, id]);
  }

  /** The selected road users, as the document has them. */
  get chosenOnes(): Agent[] {
    return this.#chosenIn(this.scene.value);
  }

  /** The same before the running drag. */
  get restingOnes(): Agent[] {
    return this.#chosenIn(this.resting.value);
  }

  #chosenIn(scene: Scene | null): Agent[] {
    return this.selected.value.flatMap((id) => scene?.agents.get(id) ?? []);
  }

  pickOnMap(item: MapItem | null): void {
    this.#mapItem.value = item;
  }

  pickEvent(event: TrafficEvent | null): void {
    this.#selectedEvent.value = event;
  }

  // -------------------------------------------------------------- pointer target, and the part that keys move

  pointAt({ agent = null, future = null, grip = null }: Pointed): void {
    batch(() => {
      this.#hover.value = agent;
      this.#hoverFuture.value = future;
      this.#hoverGrip.value = grip;
    });
  }

  /** A handle has the keyboard focus; null when none has. */
  focusHandle(handle: Keyed | null): void {
    this.#keyed.value = handle;
  }

  /** Keys move this part from now on. */
  activate(part: HandlePart): void {
    this.#focusPart.value = part;
    this.#viaInHand.value = null;
  }

  /** Keys act on this via point from now on, or on none. */
  takeVia(index: number | null): void {
    this.#viaInHand.value = index;
  }

  takeGrip({ part, index = null }: Pick<Grip, 'part'> & { index?: number | null }): void {
    this.activate(part);
    this.takeVia(index);
  }

  /** The field that "fixed or free" acts on from now on. */
  touchField(part: HandlePart, field: Field): void {
    this.#lastField.value = { part, field };
  }

  chooseTool(tool: string): void {
    batch(() => {
      this.#tool.value = tool;
      this.#measure.value = null;
      for (const part of this.#parts) part.toolChosen?.(tool);
    });
  }

  measureBetween(line: MeasuredLine | null): void {
    this.#measure.value = line;
  }

  sweepOver(sweep: AreaSelection | null): void {
    this.#sweep.value = sweep;
  }
}
