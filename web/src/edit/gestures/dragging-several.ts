// Several are moved, turned or spread together: the document follows as a preview, the release is one step.
import { batch } from '@preact/signals-core';
import { clamp, deg, rad, type Vec } from '../../model/base/geometry';
import type { View } from '../../draw/view';
import type { Command } from '../../model/document/commands';
import { startPose, type Agent } from '../../model/document/scene';
import { sayLocked } from '../moves/copying';
import { middleOf, moveAll, spreadAll, turnAll } from '../moves/several';
import type { Chart, FrameHandle, Press, State } from './chart';

const TURN_STEP_DEG = 15;
/** Limits of the spread factor. */
const SPREAD = [0.1, 10] as const;

export class DraggingSeveral implements State {
  readonly name = 'dragging several';
  readonly followsView = true;
  readonly followsModifiers = true;
  #command: Command | null = null;
  readonly #grab: Vec;
  readonly #middle: Vec;
  /** The picture at the press, which defines left, right, up and down. */
  readonly #view: View;
  /** The corner opposite the dragged one, about which they are spread. */
  readonly #anchor: Vec;

  constructor(
    private readonly chart: Chart,
    press: Press,
    private readonly all: readonly Agent[],
    private readonly what: FrameHandle,
  ) {
    const v = (this.#view = chart.surface.view.copy());
    this.#grab = v.from(press.x, press.y);
    this.#middle = middleOf(all);
    const ps = all.flatMap((a) => {
      const p = startPose(a);
      return p ? [v.across(p.x, p.y)] : [];
    });
    const grab = v.across(...this.#grab);
    const far = (grab: number, v: number[]): number => {
      const [lo, hi] = [Math.min(...v), Math.max(...v)];
      return Math.abs(grab - lo) < Math.abs(grab - hi) ? hi : lo;
    };
    const [right, up] = ([0, 1] as const).map((i) =>
      far(
        grab[i],
        ps.map((p) => p[i]),
      ),
    );
    this.#anchor = v.along(right, up);
  }

  enter(): void {
    const { editor, surface } = this.chart;
    editor.drag.begin({ part: 'start', handle: this.what === 'turn' ? 'heading' : 'body' });
    sayLocked(editor);
    surface.setCursor({ move: 'grabbing', turn: 'crosshair', spread: 'resize' }[this.what]);
    surface.invalidate('agents');
  }

  leave(): void {
    this.chart.surface.setCursor('');
  }

  move(): void {
    const { chart } = this;
    const command = this.#to(chart.surface.view.from(chart.at.x, chart.at.y));
    if (!command) return;
    this.#command = command;
    batch(() => chart.editor.drag.preview(command));
    chart.surface.invalidate('overlay');
  }

  #to(at: Vec): Command | null {
    const { shift, alt, ctrl } = this.chart.modifiers;
    const all = this.all;
    const v = this.#view;
    if (this.what === 'move') {
      let by: Vec = [at[0] - this.#grab[0], at[1] - this.#grab[1]];
      if (shift) {
        const [right, up] = v.across(...by);
        by = Math.abs(right) > Math.abs(up) ? v.along(right, 0) : v.along(0, up);
      }
      return moveAll(all, ...by, ctrl);
    }
    if (this.what === 'turn') {
      const [mx, my] = this.#middle;
      const now = Math.atan2(at[1] - my, at[0] - mx),
        then = Math.atan2(this.#grab[1] - my, this.#grab[0] - mx);
      const step = shift ? TURN_STEP_DEG : 1;
      const angle = rad(Math.round(deg(now - then) / step) * step);
      return turnAll(all, angle, alt ? null : this.#middle, ctrl);
    }
    const [to, grab, anchor] = [at, this.#grab, this.#anchor].map((p) => v.across(...p));
    const k = (now: number, from: number, about: number): number =>
      Math.abs(from - about) < 1 ? 1 : clamp((now - about) / (from - about), ...SPREAD);
    const [kx, ky] = [k(to[0], grab[0], anchor[0]), k(to[1], grab[1], anchor[1])];
    return spreadAll(all, kx, ky, this.#anchor, v.along(1, 0));
  }

  up(): void {
    this.move();
    this.chart.endDrag(this.#command);
  }

  cancel(): boolean {
    return this.chart.dropDrag();
  }
}
