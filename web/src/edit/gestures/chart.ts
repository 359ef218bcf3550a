// The pointer as a state chart: exactly one state is active and handles the pointer. States do not know the page;
// `pointer.ts` or a test passes events in. The types of states, tools and hits are here too, since they refer to each
// other.
import type { Point } from '../../model/base/geometry';
import type { View } from '../../draw/view';
import type { PlacedKind } from '../../model/base/kinds';
import type { Command } from '../../model/document/commands';
import type { Camera } from '../../model/document/history';
import type { Pin } from '../../model/document/scene';
import type { Placement } from '../moves/placement';
import type { Grip } from '../session/drag';
import type { Editor } from '../session/editor';
import { FingerTap } from './finger-tap';
import type { Help } from '../../texts/desk/helps';
import { Pile } from './pile';

export interface Modifiers {
  readonly alt: boolean;
  readonly shift: boolean;
  readonly ctrl: boolean;
}

/** A button or finger that went down. */
export interface PointerDown extends Point {
  readonly id: number;
  readonly touch: boolean;
  /** 0 the main button, 1 the middle one, 2 the right one. */
  readonly button: number;
  readonly modifiers?: Modifiers;
  /** When it happened, milliseconds. */
  readonly timeStamp?: number;
}

/** Targets of a context menu. */
export type MenuOn = 'road-user' | 'several' | 'goal' | 'future' | 'ground';

/** Events and actions of a state. Every method is optional: missing ones are ignored. */
export interface State {
  readonly name: string;
  enter?(): void;
  leave?(): void;
  /** The first button or finger went down. */
  down?(p: PointerDown): void;
  /**
   * The pointer moved: called once a frame with the newest place in `chart.at`. With `asks`, a state that sends a
   * request for each place sends one.
   */
  move?(asks?: boolean): void;
  /** Does the state handle a move before the next frame? Its request is sent sooner. */
  readonly hurries?: boolean;
  /** One of several fingers moved; called at once. */
  moveFinger?(from: Point, to: Point, other: Point): void;
  up?(timeStamp: number): void;
  /** The pointer is over a panel, or off the page. */
  outside?(): void;
  /** Called with the seconds since the last frame; true when the picture moved under the pointer. */
  frame?(seconds: number): boolean;
  /** Does the state follow a wheel that moves the picture under the pointer? */
  readonly followsView?: boolean;
  /** Does it react to a change of the modifier keys? */
  readonly followsModifiers?: boolean;
  /** Esc, a second finger, a lost pointer: true when there was something to restore. */
  cancel?(): boolean;
}

/** The object under the pointer. */
export type Hit =
  | { kind: 'grip'; grip: Grip }
  | { kind: 'future'; index: number }
  /** A pinned future that is none of the shown ones. */
  | { kind: 'pinned'; pin: Pin }
  | { kind: 'by-road' }
  | { kind: 'handle'; handle: ToolHandle }
  /** `beside`: a finger touched near it, not on it. */
  | { kind: 'agent'; id: string; pile: string[]; beside?: true }
  | { kind: 'frame'; handle: FrameHandle }
  /** The small flag at the goal of an unselected road user. */
  | { kind: 'pennant'; id: string }
  | { kind: 'none' };

/** Actions of the frame around several: move, turn, spread. */
export type FrameHandle = 'move' | 'turn' | 'spread';

/** A handle painted by a tool. */
export interface ToolHandle {
  /** The cursor over it. */
  readonly cursor: string;
  /** The state after a press on it that moves. */
  drag(chart: Chart, press: Press): State;
  /** A press on it without movement. */
  click(): void;
}

export const NOTHING: Hit = { kind: 'none' };

/** A press, as later states need it. */
export interface Press extends Point {
  readonly touch: boolean;
  readonly hit: Hit;
  /** The camera at the press. */
  readonly camera: Camera;
}

/** A button of the rail, which also defines its key, its entry in the palette and its line in the shortcut sheet. */
export interface RailEntry {
  readonly name: string;
  readonly label: string;
  readonly key: string;
  readonly icon: string;
  readonly help: Help;
  /** The kind that it places; the rail groups these. */
  readonly places?: PlacedKind;
}

/** Behaviour of the pointer while a button of the rail is chosen. */
export interface Tool extends RailEntry {
  /** The cursor over the empty picture; empty for the default one. */
  readonly cursor: string;
  /** Does a press take the object under it? */
  readonly picks: boolean;
  /** The pointer moves over the picture without a pressed button. */
  hover?(chart: Chart): void;
  /** The state after a press that moves. */
  drag(chart: Chart, press: Press): State;
  /** A press without movement. */
  click(chart: Chart, press: Press, timeStamp: number): void;
}

/** The picture as gestures see it; the stage implements it. */
export interface Surface {
  readonly view: View;
  invalidate(...layers: ('map' | 'agents' | 'overlay')[]): void;
  viewChanged(): void;
  /** Sets the cursor over the picture; empty for the default one. */
  setCursor(name: string): void;
  /** Magnifies the surroundings of a place, away from the covering finger; null ends it. */
  magnify(place: Point | null): void;
}

/** Live futures during a drag; the generation implements it. */
export interface Previews {
  preview(id: string): void;
  cancelPreviews(): void;
}

export interface ChartParts {
  readonly surface: Surface;
  readonly editor: Editor;
  readonly placement: Placement;
  readonly previews: Previews;
  /** The idle state, and that of two fingers. */
  idle(chart: Chart): State;
  twoFingers(chart: Chart, p1: Point, p2: Point): State;
  hitAt(p: Point, touch: boolean): Hit;
  agentsAt(p: Point): string[];
  /** Is reduced motion preferred? */
  reducedMotion(): boolean;
  /** A menu is requested at a place of the picture. */
  menu(at: Point, on: MenuOn, future: number | null): void;
  /** Number of fingers tapped at once: two or three. */
  tapped(fingers: number): void;
  /** Two short vibrations. */
  ticks(): void;
  tool(name: string): Tool;
}

/** Pointers that report once a frame get a request for each report; faster ones get one a frame. */
const BETWEEN_QUESTIONS_MS = 12;

export class Chart {
  /** The newest pointer position, in pixels of the picture. */
  at: Point = { x: 0, y: 0 };
  modifiers: Modifiers = { alt: false, shift: false, ctrl: false };
  spaceHeld = false;
  /** Number of pans with Space held. */
  pannedWithSpace = 0;
  readonly pile = new Pile();
  readonly surface: Surface;
  readonly editor: Editor;
  readonly placement: Placement;
  readonly previews: Previews;
  readonly #fingers = new Map<number, Point>();
  readonly #tap = new FingerTap();
  #state: State;
  #moved = false;
  /** The state has handled the newest place before the next frame. */
  #ahead = false;
  /** Time of the last request of a hurrying state, milliseconds. */
  #askedAt = -Infinity;
  /** No request was sent for the newest place. */
  #owes = false;

  constructor(readonly parts: ChartParts) {
    this.surface = parts.surface;
    this.editor = parts.editor;
    this.placement = parts.placement;
    this.previews = parts.previews;
    this.#state = parts.idle(this);
  }

  get state(): State {
    return this.#state;
  }

  /** Place of the finger, if exactly one is down. */
  get finger(): Point | null {
    return this.#fingers.size === 1 ? this.#fingers.values().next().value! : null;
  }

  /** The only transition between states. */
  go(next: State): void {
    this.#state.leave?.();
    this.#state = next;
    this.#ahead = false;
    this.#owes = false;
    this.#askedAt = -Infinity;
    next.enter?.();
  }

  rest(): void {
    this.go(this.parts.idle(this));
  }

  /** Ends a drag that changes the document: its result is one step. */
  endDrag(command: Command | null): void {
    this.rest();
    this.editor.drag.end(command);
  }

  /** Cancels the drag: everything is restored. */
  dropDrag(): true {
    this.editor.drag.cancel();
    this.previews.cancelPreviews();
    this.surface.invalidate('agents', 'overlay');
    return true;
  }

  // -------------------------------------------------------------- pointer events

  down(p: PointerDown): void {
    this.#fingers.set(p.id, { x: p.x, y: p.y });
    this.#tap.down(p.id, p, this.#fingers.size === 1, p.timeStamp ?? 0);
    if (this.#fingers.size === 1) {
      this.at = { x: p.x, y: p.y };
      if (p.modifiers) this.modifiers = p.modifiers;
      if (this.spaceHeld) this.pannedWithSpace++;
      this.#state.down?.(p);
      return;
    }
    this.cancel();
    if (this.#fingers.size !== 2) return;
    const [p1, p2] = this.#fingers.values();
    this.go(this.parts.twoFingers(this, p1, p2));
  }

  move(id: number, p: Point, modifiers: Modifiers, overPicture: boolean): void {
    const from = this.#fingers.get(id);
    this.#tap.move(id, p);
    if (from && this.#state.moveFinger) {
      const other = [...this.#fingers].find(([k]) => k !== id)![1];
      this.#fingers.set(id, p);
      this.#state.moveFinger(from, p, other);
      return;
    }
    if (from) this.#fingers.set(id, p);
    if (this.#ahead && isSamePlace(p, this.at) && isSameKeys(modifiers, this.modifiers)) return;
    this.at = p;
    this.modifiers = modifiers;
    if (!overPicture && this.#state.outside) {
      this.#state.outside();
      return;
    }
    this.again();
  }

  /** The same before the frame that delivers the event, unless a request was sent just now. */
  moveAhead(id: number, p: Point, modifiers: Modifiers, now: number): void {
    if (!this.#state.hurries || this.#fingers.size !== 1 || !this.#fingers.has(id) || !this.#mayAsk(now)) return;
    this.#fingers.set(id, p);
    this.#tap.move(id, p);
    this.at = p;
    this.modifiers = modifiers;
    this.#ahead = true;
    this.#moved = false;
    this.#tell(now);
    this.surface.invalidate();
  }

  /** Requests beyond one a frame would only take time from painting. */
  #mayAsk(now: number): boolean {
    return !this.#state.hurries || now - this.#askedAt >= BETWEEN_QUESTIONS_MS;
  }

  #tell(now: number): void {
    const asks = this.#mayAsk(now);
    if (asks) this.#askedAt = now;
    this.#owes = !asks;
    this.#state.move?.(asks);
  }

  /** Handles the pointer's place with the next frame. */
  again(): void {
    this.#moved = true;
    this.surface.invalidate();
  }

  up(id: number, p: Point, timeStamp: number): void {
    if (!this.#fingers.delete(id)) return;
    this.at = p;
    this.#state.up?.(timeStamp);
    const taps = this.#fingers.size ? 1 : this.#tap.up(timeStamp);
    if (taps > 1) this.parts.tapped(taps);
    this.surface.invalidate('agents', 'overlay');
  }

  /** The page cancelled the pointer. */
  lost(id: number): void {
    this.#fingers.delete(id);
    this.#tap.lost();
    this.cancel();
  }

  outside(): void {
    this.#state.outside?.();
  }

  /** `now`: start of the frame, milliseconds, by the clock of the page's events. */
  frame(seconds: number, now: number): void {
    if (this.#state.frame?.(seconds)) this.#moved = true;
    this.#ahead = false;
    if (!this.#moved && !this.#owes) return;
    this.#moved = false;
    this.#tell(now);
    // Without a frame the time of states does not advance.
    if (this.#owes) this.surface.invalidate();
  }

  /** A wheel or a double click moved the picture. */
  viewMoved(): void {
    if (this.#state.followsView) this.#moved = true;
    this.surface.viewChanged();
  }

  /** True when a state reacts to the modifier keys. */
  modified(modifiers: Modifiers): boolean {
    if (!this.#state.followsModifiers) return false;
    this.modifiers = modifiers;
    this.again();
    return true;
  }

  /** Esc: restores everything to before the press. */
  cancel(): boolean {
    const done = this.#state.cancel?.() ?? false;
    this.rest();
    return done;
  }
}

const isSamePlace = (a: Point, b: Point): boolean => a.x === b.x && a.y === b.y;
const isSameKeys = (a: Modifiers, b: Modifiers): boolean => a.alt === b.alt && a.shift === b.shift && a.ctrl === b.ctrl;
