// A handle is dragged: the document follows as a preview, the generator shows live futures, the release is one step.
import { batch } from '@preact/signals-core';
import { clamp, type Point } from '../../model/base/geometry';
import type { Command } from '../../model/document/commands';
import { startPose, type Agent } from '../../model/document/scene';
import type { Grip } from '../session/drag';
import type { Chart, Modifiers, Press, State } from './chart';

/** Within this many pixels of the edge the picture scrolls, up to this many pixels a second. */
const EDGE_PX = 32;
const EDGE_SPEED = 600;
/** It scrolls no further past the map than this, metres. */
const BEYOND_M = 30;
/** A finger that rests this long at a kerb passes it, seconds; it trembles by less than this, pixels. */
const PASSES_AFTER_S = 0.4;
const TREMBLE_PX = 8;

/** A drag: gives a command for each pointer position. */
export interface Move {
  readonly grip: Grip;
  readonly agent: Agent;
  /** Does a kerb hold it back? */
  readonly held: boolean;
  passKerbs(): void;
  to(at: Point, mods: Modifiers, press: Point): Command;
}

const CURSORS = {
  body: 'grabbing',
  heading: 'crosshair',
  speed: 'resize',
  time: 'resize',
  via: 'grabbing',
  ring: 'resize',
} as const;

export class DraggingHandle implements State {
  readonly name = 'dragging handle';
  readonly followsView = true;
  readonly followsModifiers = true;
  readonly hurries = true;
  #command: Command | null = null;
  /** Place and duration of a finger's rest at a kerb. */
  #rest: { readonly at: Point; seconds: number } | null = null;

  constructor(
    private readonly chart: Chart,
    private readonly press: Press,
    private readonly what: Move,
  ) {}

  enter(): void {
    const { editor, surface } = this.chart;
    const { grip } = this.what;
    editor.drag.begin(grip);
    surface.setCursor(CURSORS[grip.handle]);
    surface.invalidate('agents');
  }

  leave(): void {
    this.chart.surface.magnify(null);
    this.chart.surface.setCursor('');
  }

  /** The page follows a step as a whole: lane under the pointer, document, request. */
  move(asks = true): void {
    const { chart } = this;
    const wasHeld = this.what.held;
    batch(() => {
      this.#command = this.what.to(chart.at, chart.modifiers, this.press);
      chart.editor.drag.preview(this.#command);
      if (asks) chart.previews.preview(this.what.agent.id);
    });
    if (this.press.touch) chart.surface.magnify(this.#inHand());
    if (this.press.touch && this.what.held && !wasHeld) chart.parts.ticks();
    chart.surface.invalidate('overlay');
  }

  /** The place covered by the finger: the box or flag that it moves, else the place under it. */
  #inHand(): Point {
    const { editor, surface, at } = this.chart;
    const { grip } = this.what;
    const a = editor.agent.peek();
    const pose = a && (grip.part === 'goal' ? editor.reading.goalPose(a) : startPose(a));
    if (!pose || grip.handle !== 'body') return at;
    const [x, y] = surface.view.to(pose.x, pose.y);
    return { x, y };
  }

  frame(seconds: number): boolean {
    const scrolled = this.#scroll(seconds);
    return this.#pressOn(seconds) || scrolled;
  }

  /** A finger has no Alt: resting at a kerb passes it. */
  #pressOn(seconds: number): boolean {
    const { chart, what } = this;
    if (!this.press.touch || !what.held) {
      this.#rest = null;
      return false;
    }
    const { at } = chart;
    if (!this.#rest || Math.hypot(at.x - this.#rest.at.x, at.y - this.#rest.at.y) > TREMBLE_PX)
      this.#rest = { at, seconds: 0 };
    this.#rest.seconds += seconds;
    if (this.#rest.seconds < PASSES_AFTER_S) {
      // A resting finger sends no moves, and without a frame time does not advance.
      chart.surface.invalidate();
      return false;
    }
    what.passKerbs();
    return true;
  }

  /** The picture scrolls while the pointer is near its edge. */
  #scroll(seconds: number): boolean {
    const { chart } = this;
    const v = chart.surface.view;
    const dx = pull(chart.at.x, v.w);
    const dy = pull(chart.at.y, v.h);
    if ((!dx && !dy) || chart.parts.reducedMotion()) return false;
    const { x0, x1, y0, y1 } = chart.editor.scene.peek()!.map.box;
    const there = { x0: x0 - BEYOND_M, x1: x1 + BEYOND_M, y0: y0 - BEYOND_M, y1: y1 + BEYOND_M };
    if (!v.panWithin(dx * EDGE_SPEED * seconds, dy * EDGE_SPEED * seconds, there)) return false;
    chart.surface.viewChanged();
    return true;
  }

  up(): void {
    this.move();
    this.chart.endDrag(this.#command);
  }

  cancel(): boolean {
    return this.chart.dropDrag();
  }
}

/** Strength of an edge's pull: 0 away from both, up to 1 to the right or down and -1 to the left or up. */
function pull(at: number, size: number): number {
  const past = at < EDGE_PX ? EDGE_PX - at : at > size - EDGE_PX ? size - EDGE_PX - at : 0;
  return clamp(past / EDGE_PX, -1, 1);
}
