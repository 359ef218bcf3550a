// The page's pointer and keys, passed to the state chart. Moves are collected and handled once a frame.
import { Emitter } from '../../model/base/emitter';
import type { Point } from '../../model/base/geometry';
import type { Stage } from '../../draw/stage';
import type { Placement } from '../moves/placement';
import type { Editor } from '../session/editor';
import { agentsAt, hitTest, type HitContext } from './hit';
import type { Overlay } from '../overlay/overlay';
import { PAN } from './panning';
import type { Picture } from '../overlay/picture';
import { Chart, type MenuOn, type Modifiers, type Previews, type Tool, type ToolHandle } from './chart';
import { Idle } from './idle';
import { twoFingers } from './turning';

const MODIFIER_KEYS = ['Alt', 'Shift', 'Control', 'Meta'];
/** Zoom for each pixel of wheel; pinching on a trackpad arrives as a wheel with Ctrl. */
const WHEEL_ZOOM = 0.0016;
const TRACKPAD_ZOOM = 0.006;
const PX_PER_LINE = 33;
const NOTCH_PX = 50;
/** On, off, on. */
const TICKS_MS = [10, 40, 10];

const modifiersOf = (e: MouseEvent | KeyboardEvent): Modifiers => ({
  alt: e.altKey,
  shift: e.shiftKey,
  ctrl: e.ctrlKey || e.metaKey,
});

/** Pointer behaviour of a feature. */
export interface PointerTools {
  /** Tools of its rail buttons. */
  readonly tools?: readonly Tool[];
  /** Overrides the chosen tool; null for no override. */
  takesOver?(): Tool | null;
  /** Its handle painted at a place, in pixels. */
  handleAt?(x: number, y: number, touch: boolean): ToolHandle | null;
}

function firstOf<T, R>(all: readonly T[], of: (each: T) => R | null | undefined): R | null {
  for (const each of all) {
    const found = of(each);
    if (found) return found;
  }
  return null;
}

export class Gestures {
  readonly chart: Chart;
  /** A menu is requested. */
  readonly menu = new Emitter<[at: Point, on: MenuOn, future: number | null]>();
  /** Several fingers were tapped at once. */
  readonly tapped = new Emitter<[fingers: number]>();
  /** Did the finger that is down open a menu? */
  #asked = false;
  #inside = false;
  /** Position of the picture on the page while a pointer is down; measuring it at every move would force a layout. */
  #held: DOMRect | null = null;
  #lastFrame = 0;

  constructor(
    private readonly stage: Stage,
    private readonly editor: Editor,
    placement: Placement,
    private readonly picture: Picture,
    private readonly overlay: Overlay,
    previews: Previews,
    private readonly tools: readonly PointerTools[],
  ) {
    const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');
    this.chart = new Chart({
      surface: stage,
      editor,
      placement,
      previews,
      idle: (chart) => new Idle(chart),
      twoFingers,
      hitAt: (p, touch) => hitTest(this.#context(touch), p.x, p.y),
      agentsAt: (p) => agentsAt(this.#context(false), p.x, p.y),
      reducedMotion: () => reducedMotion.matches,
      ticks: () => {
        // Not every browser has it.
        navigator.vibrate?.(TICKS_MS);
      },
      menu: (at, on, future) => {
        this.#asked = true;
        this.menu.emit(at, on, future);
      },
      tapped: (fingers) => this.tapped.emit(fingers),
      tool: (name) => this.#tool(name),
    });
    this.#listen(stage.element);
  }

  #tool(name: string): Tool {
    const chosen = this.tools.flatMap((t) => t.tools ?? []).find((t) => t.name === name)!;
    return (chosen !== PAN && this.#takenOver()) || chosen;
  }

  /** The tool of a feature that overrides the chosen one. */
  #takenOver(): Tool | null {
    return firstOf(this.tools, (t) => t.takesOver?.());
  }

  #listen(el: HTMLElement): void {
    const { chart } = this;
    el.addEventListener('pointerdown', (e) => this.#down(e));
    el.addEventListener('pointermove', (e) => {
      this.#inside = true;
      chart.move(e.pointerId, this.#place(e), modifiersOf(e), this.#onPicture(e));
    });
    el.addEventListener('pointerup', (e) => {
      this.#letGo();
      chart.up(e.pointerId, this.#place(e), e.timeStamp);
      this.#held = null;
    });
    el.addEventListener('pointercancel', (e) => {
      this.#letGo();
      chart.lost(e.pointerId);
      this.#held = null;
    });
    el.addEventListener('pointerleave', () => {
      this.#inside = false;
      this.#held = null;
      chart.outside();
    });
    // The menu opens under the finger: without this its release would press the entry there.
    el.addEventListener('touchend', (e) => {
      if (this.#asked && e.cancelable) e.preventDefault();
    });
    el.addEventListener('wheel', (e) => this.#wheel(e), { passive: false });
    // The menu is the editor's own; it opens on release, since the right button also moves the picture.
    el.addEventListener('contextmenu', (e) => e.preventDefault());
    // The middle button moves the picture; on Linux the browser would also paste.
    for (const up of ['mouseup', 'auxclick'] as const)
      el.addEventListener(up, (e) => {
        if (e.button === 1) e.preventDefault();
      });
    el.addEventListener('dblclick', (e) => this.#doubleClick(e));
    addEventListener('keydown', (e) => this.#key(e, true));
    addEventListener('keyup', (e) => this.#key(e, false));
  }

  /** Raw pointer moves, before the frame that delivers them; used only while an object is held. */
  readonly #hurry = (e: Event): void => {
    const p = e as PointerEvent;
    if (this.#held) this.chart.moveAhead(p.pointerId, this.#place(p), modifiersOf(p), p.timeStamp);
  };

  #letGo(): void {
    this.stage.element.removeEventListener('pointerrawupdate', this.#hurry);
  }

  /** Called by the stage before it paints. */
  frame(now: number): void {
    const seconds = this.#lastFrame ? Math.min(0.05, (now - this.#lastFrame) / 1000) : 0.016;
    this.#lastFrame = now;
    this.chart.frame(seconds, now);
  }

  /** Number of pans with Space held. */
  get pannedWithSpace(): number {
    return this.chart.pannedWithSpace;
  }

  cancel(): boolean {
    return this.chart.cancel();
  }

  /** Pointer position for the hover card; null outside the stage. */
  get pointer(): Point | null {
    return this.#inside ? this.chart.at : null;
  }

  #place(e: MouseEvent): Point {
    const r = this.#held ?? this.stage.element.getBoundingClientRect();
    return { x: e.clientX - r.left, y: e.clientY - r.top };
  }

  #onPicture(e: Event): boolean {
    return e.target instanceof HTMLCanvasElement || e.target === this.stage.element;
  }

  #context(touch: boolean): HitContext {
    const { editor, stage, picture } = this;
    const { chips, timeTag, edgeTag, roadSign } = this.overlay;
    const toolHandleAt = (x: number, y: number): ToolHandle | null =>
      firstOf(this.tools, (t) => t.handleAt?.(x, y, touch));
    const { pennants } = picture;
    return { editor, view: stage.view, chips, timeTag, edgeTag, roadSign, toolHandleAt, pennants, touch };
  }

  #down(e: PointerEvent): void {
    if (!this.#onPicture(e)) return;
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    try {
      this.stage.element.setPointerCapture(e.pointerId);
    } catch {
      // The pointer may already be released.
    }
    this.#asked = false;
    this.stage.element.addEventListener('pointerrawupdate', this.#hurry);
    this.#held = this.stage.element.getBoundingClientRect();
    this.chart.down({
      id: e.pointerId,
      ...this.#place(e),
      touch: e.pointerType === 'touch',
      timeStamp: e.timeStamp,
      button: e.button,
      modifiers: modifiersOf(e),
    });
  }

  #wheel(e: WheelEvent): void {
    if (!this.#onPicture(e)) return;
    e.preventDefault();
    const v = this.stage.view;
    if (e.shiftKey && !e.ctrlKey) v.panBy(-(e.deltaX || e.deltaY), 0);
    else {
      const { x, y } = this.#place(e);
      const pixels = e.deltaY * (e.deltaMode === 1 ? PX_PER_LINE : 1);
      const factor = Math.exp(-pixels * (e.ctrlKey ? TRACKPAD_ZOOM : WHEEL_ZOOM));
      // A trackpad is smooth already; the notches of a wheel are not.
      if (e.ctrlKey || Math.abs(pixels) < NOTCH_PX) v.zoomAt(x, y, factor);
      else this.stage.glide.by((end) => end.zoomAt(x, y, factor));
    }
    this.chart.viewMoved();
  }

  #doubleClick(e: MouseEvent): void {
    // Placing and measuring use fast clicks; on a map being made a double click adds an arm.
    if (this.#takenOver()) return;
    if (!this.#onPicture(e) || !['select', 'pan'].includes(this.editor.tool.peek())) return;
    const { x, y } = this.#place(e);
    const { kind } = hitTest(this.#context(false), x, y);
    // On a road user, or where its first click has selected it, it zooms in there, too.
    if (kind !== 'none' && kind !== 'agent' && kind !== 'grip') return;
    this.stage.glide.by((v) => v.zoomAt(x, y, 1.6));
    this.chart.viewMoved();
  }

  #key(e: KeyboardEvent, down: boolean): void {
    const { chart } = this;
    if (e.key === ' ') {
      chart.spaceHeld = down;
      // Space would press the focused button, or scroll.
      if (down && chart.state.followsModifiers) e.preventDefault();
    }
    if (MODIFIER_KEYS.includes(e.key) && chart.modified(modifiersOf(e))) e.preventDefault();
  }
}
