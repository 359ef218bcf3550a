// The pointer as a state chart: exactly one state is live, and it alone answers what the pointer does. States know
// nothing of the page; `pointer.ts` hands them the page's events, a test hands them its own. What states, tools and
// what lies under the pointer look like stands here too, for each of them speaks of the others.
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

/** What a menu is asked for. */
export type MenuOn = 'road-user' | 'several' | 'goal' | 'future' | 'ground';

/** What a state is told and may do. Every method is optional: what is left out is not answered. */
export interface State {
  readonly name: string;
  enter?(): void;
  leave?(): void;
  /** The first button or finger went down. */
  down?(p: PointerDown): void;
  /**
   * The pointer moved: called once a frame with the newest place in `chart.at`. Who asks the generator for each place
   * does so when `asks` is set.
   */
  move?(asks?: boolean): void;
  /** Is it told of a move before the next frame comes? So what it asks is under way the sooner. */
  readonly hurries?: boolean;
  /** One of several fingers moved; called at once. */
  moveFinger?(from: Point, to: Point, other: Point): void;
  up?(timeStamp: number): void;
  /** The pointer is over a panel, or off the page. */
  outside?(): void;
  /** Time for what goes on by itself; true when the picture moved under the pointer. */
  frame?(seconds: number): boolean;
  /** Does the state follow a wheel that moves the picture under the pointer? */
  readonly followsView?: boolean;
  /** Does it answer to a change of the modifier keys? */
  readonly followsModifiers?: boolean;
  /** Esc, a second finger, a pointer taken away: true when there was something to put back. */
  cancel?(): boolean;
}

/** What lies under the pointer. */
export type Hit =
  | { kind: 'grip'; grip: Grip }
  | { kind: 'future'; index: number }
  /** A pinned one that is none of the futures. */
  | { kind: 'pinned'; pin: Pin }
  | { kind: 'by-road' }
  | { kind: 'handle'; handle: ToolHandle }
  /** `beside`: a finger came down near it, and not on it. */
  | { kind: 'agent'; id: string; pile: string[]; beside?: true }
  | { kind: 'frame'; handle: FrameHandle }
  /** The small flag at the goal of somebody who is not selected. */
  | { kind: 'pennant'; id: string }
  | { kind: 'none' };

/** What one can do with the frame around several: move them, turn them, spread them. */
export type FrameHandle = 'move' | 'turn' | 'spread';

/** What a tool painted to be taken hold of. */
export interface ToolHandle {
  /** The pointer over it. */
  readonly cursor: string;
  /** What a press on it becomes once it moves. */
  drag(chart: Chart, press: Press): State;
  /** A press on it that did not move. */
  click(): void;
}

export const NOTHING: Hit = { kind: 'none' };

/** A press, as the states after it need it. */
export interface Press extends Point {
  readonly touch: boolean;
  readonly hit: Hit;
  /** Where the picture looked at the press. */
  readonly camera: Camera;
}

/** A button of the rail. Its key, its entry in the palette and its line in the shortcut sheet are made from it too. */
export interface RailEntry {
  readonly name: string;
  readonly label: string;
  readonly key: string;
  readonly icon: string;
  readonly help: Help;
  /** What is placed by it; the rail keeps these together. */
  readonly places?: PlacedKind;
}

/** What the pointer does with a button of the rail chosen. */
export interface Tool extends RailEntry {
  /** The pointer over the picture where nothing is under it; empty for the plain one. */
  readonly cursor: string;
  /** Does a press take hold of what lies under it? */
  readonly picks: boolean;
  /** The pointer moves over the picture with nothing pressed. */
  hover?(chart: Chart): void;
  /** What a press becomes once it moves. */
  drag(chart: Chart, press: Press): State;
  /** A press that did not move. */
  click(chart: Chart, press: Press, timeStamp: number): void;
}

/** Where the picture is, as gestures see it; the stage is one. */
export interface Surface {
  readonly view: View;
  invalidate(...layers: ('map' | 'agents' | 'overlay')[]): void;
  viewChanged(): void;
  /** The shape of the pointer over the picture; empty for the plain one. */
  setCursor(name: string): void;
  /** Shows the surroundings of a place larger, away from the finger that covers it; null for no longer. */
  magnify(place: Point | null): void;
}

/** Live futures during a drag; the generation is one. */
export interface Previews {
  preview(id: string): void;
  cancelPreviews(): void;
}

export interface ChartParts {
  readonly surface: Surface;
  readonly editor: Editor;
  readonly placement: Placement;
  readonly previews: Previews;
  /** The state in which nothing is pressed, and that of two fingers. */
  idle(chart: Chart): State;
  twoFingers(chart: Chart, p1: Point, p2: Point): State;
  hitAt(p: Point, touch: boolean): Hit;
  agentsAt(p: Point): string[];
  /** Is motion to be kept small? */
  calm(): boolean;
  /** A menu is asked for at a place of the picture. */
  menu(at: Point, on: MenuOn, future: number | null): void;
  /** So many fingers were tapped at once: two, or three. */
  tapped(fingers: number): void;
  /** Two short ticks under the finger. */
  ticks(): void;
  tool(name: string): Tool;
}

/** A hand that tells of itself once a frame is asked about each time, one that does so more often, once a frame. */
const BETWEEN_QUESTIONS_MS = 12;

export class Chart {
  /** The newest place of the pointer, in pixels of the picture. */
  at: Point = { x: 0, y: 0 };
  modifiers: Modifiers = { alt: false, shift: false, ctrl: false };
  spaceHeld = false;
  /** How often the picture was taken hold of with Space held. */
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
  /** The state was told of the newest place ahead of the next frame. */
  #ahead = false;
  /** When a state that hurries asked last, milliseconds. */
  #askedAt = -Infinity;
  /** The newest place was not asked about. */
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

  /** Where the only finger is that is down. */
  get finger(): Point | null {
    return this.#fingers.size === 1 ? this.#fingers.values().next().value! : null;
  }

  /** The one way from state to state. */
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

  /** A drag that changes the document is let go: what it came to is one step. */
  endDrag(command: Command | null): void {
    this.rest();
    this.editor.drag.end(command);
  }

  /** The same is given up: everything as it was. */
  dropDrag(): true {
    this.editor.drag.cancel();
    this.previews.cancelPreviews();
    this.surface.invalidate('agents', 'overlay');
    return true;
  }

  // -------------------------------------------------------------- what the pointer does

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

  /** The same before the frame in which the page hears of it, unless there was a question just now. */
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

  /** More questions than pictures would only take the time that the pictures need. */
  #mayAsk(now: number): boolean {
    return !this.#state.hurries || now - this.#askedAt >= BETWEEN_QUESTIONS_MS;
  }

  #tell(now: number): void {
    const asks = this.#mayAsk(now);
    if (asks) this.#askedAt = now;
    this.#owes = !asks;
    this.#state.move?.(asks);
  }

  /** The pointer's place is to be worked off with the next frame. */
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

  /** The page took the pointer away. */
  lost(id: number): void {
    this.#fingers.delete(id);
    this.#tap.lost();
    this.cancel();
  }

  outside(): void {
    this.#state.outside?.();
  }

  /** `now`: when the frame began, milliseconds, by the clock of the page's events. */
  frame(seconds: number, now: number): void {
    if (this.#state.frame?.(seconds)) this.#moved = true;
    this.#ahead = false;
    if (!this.#moved && !this.#owes) return;
    this.#moved = false;
    this.#tell(now);
    // Without a frame no time passes.
    if (this.#owes) this.surface.invalidate();
  }

  /** A wheel or a double click moved the picture. */
  viewMoved(): void {
    if (this.#state.followsView) this.#moved = true;
    this.surface.viewChanged();
  }

  /** True when a state answers to the modifier keys. */
  modified(modifiers: Modifiers): boolean {
    if (!this.#state.followsModifiers) return false;
    this.modifiers = modifiers;
    this.again();
    return true;
  }

  /** Esc: everything back to where it was before the press. */
  cancel(): boolean {
    const done = this.#state.cancel?.() ?? false;
    this.rest();
    return done;
  }
}

const isSamePlace = (a: Point, b: Point): boolean => a.x === b.x && a.y === b.y;
const isSameKeys = (a: Modifiers, b: Modifiers): boolean => a.alt === b.alt && a.shift === b.shift && a.ctrl === b.ctrl;
