// Several are moved, turned or spread together: the document follows as a preview, the release is one step.
import { batch } from '@preact/signals-core';
import { clamp, deg, rad, type Vec } from '../../model/geometry';
import type { Command } from '../../model/commands';
import { startPose, type Agent } from '../../model/scene';
import { sayLocked } from '../copying';
import type { FrameHandle } from '../hit';
import { middleOf, moveAll, spreadAll, turnAll } from '../several';
import type { Chart, State } from './chart';
import type { Press } from './pressed';

const TURN_STEP_DEG = 15;
/** Nobody is spread to nothing, nor out of the world. */
const SPREAD = [0.1, 10] as const;

export class DraggingSeveral implements State {
  readonly name = 'dragging several';
  readonly followsView = true;
  readonly followsModifiers = true;
  #command: Command | null = null;
  readonly #grab: Vec;
  readonly #middle: Vec;
  /** The corner across from the one in hand, about which they are spread. */
  readonly #anchor: Vec;

  constructor(
    private readonly chart: Chart,
    press: Press,
    private readonly all: readonly Agent[],
    private readonly what: FrameHandle,
  ) {
    this.#grab = chart.surface.view.from(press.x, press.y);
    this.#middle = middleOf(all);
    const ps = all.flatMap((a) => startPose(a) ?? []);
    const far = (grab: number, v: number[]): number => {
      const [lo, hi] = [Math.min(...v), Math.max(...v)];
      return Math.abs(grab - lo) < Math.abs(grab - hi) ? hi : lo;
    };
    this.#anchor = [
      far(
        this.#grab[0],
        ps.map((p) => p.x),
      ),
      far(
        this.#grab[1],
        ps.map((p) => p.y),
      ),
    ];
  }

  enter(): void {
    const { editor, surface } = this.chart;
    editor.beginDrag({ part: 'start', handle: this.what === 'turn' ? 'heading' : 'body' });
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
    batch(() => chart.editor.previewDrag(command));
    chart.surface.invalidate('overlay');
  }

  #to(at: Vec): Command | null {
    const { shift, alt, ctrl } = this.chart.modifiers;
    const { all } = this;
    if (this.what === 'move') {
      let [dx, dy] = [at[0] - this.#grab[0], at[1] - this.#grab[1]];
      if (shift && Math.abs(dx) > Math.abs(dy)) dy = 0;
      else if (shift) dx = 0;
      return moveAll(all, dx, dy, ctrl);
    }
    if (this.what === 'turn') {
      const [mx, my] = this.#middle;
      const now = Math.atan2(at[1] - my, at[0] - mx),
        then = Math.atan2(this.#grab[1] - my, this.#grab[0] - mx);
      const step = shift ? TURN_STEP_DEG : 1;
      const angle = rad(Math.round(deg(now - then) / step) * step);
      return turnAll(all, angle, alt ? null : this.#middle, ctrl);
    }
    const [ax, ay] = this.#anchor;
    const k = (to: number, from: number, about: number): number =>
      Math.abs(from - about) < 1 ? 1 : clamp((to - about) / (from - about), ...SPREAD);
    return spreadAll(all, k(at[0], this.#grab[0], ax), k(at[1], this.#grab[1], ay), this.#anchor);
  }

  up(): void {
    this.move();
    this.chart.endDrag(this.#command);
  }

  cancel(): boolean {
    return this.chart.dropDrag();
  }
}
