// The future under the pointer, replayed in place: a box runs along it in a loop, while all others stand.
import type { Pen } from '../../draw/pen';
import { endPose, lastStep, poseAt, STEP_S, type Motion } from '../../model/base/motion';
import type { Agent } from '../../model/document/scene';
import { paintGhost } from '../../draw/handles';
import { colours, modeColour } from '../../draw/theme';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';

/** Scene seconds per second. */
const RATE = 4;
/** Pause at the end before the next run, seconds. */
const REST_S = 0.6;

/** Scene time of the box, this many seconds after the pointer entered. */
export function replayed(seconds: number, end: number): number {
  const round = end / RATE + REST_S;
  return Math.min(end, (seconds % round) * RATE);
}

export class HoveredOverlay {
  private readonly reducedMotion =
    typeof matchMedia === 'undefined' ? { matches: false } : matchMedia('(prefers-reduced-motion: reduce)');
  private of: { readonly motion: Motion; readonly since: number } | null = null;

  constructor(private readonly editor: Pick<Editor, 'drag' | 'hoverFuture' | 'playhead' | 'reading'>) {}

  /** Does a box run? Then the overlay needs another frame. */
  get running(): boolean {
    return this.of !== null && !this.reducedMotion.matches;
  }

  paint(g: Pen, v: View, a: Agent): void {
    const { editor: e } = this;
    const i = e.hoverFuture.value;
    const motion =
      i === null || e.drag.info.value || e.playhead.playing.value
        ? undefined
        : e.reading.futures.value?.modes[i]?.motion;
    if (!motion) {
      this.of = null;
      return;
    }
    if (this.of?.motion !== motion) this.of = { motion, since: performance.now() };
    const end = lastStep(motion) * STEP_S;
    const t = this.reducedMotion.matches ? end : replayed((performance.now() - this.of.since) / 1000, end);
    const p = poseAt(motion, t) ?? endPose(motion);
    const c = colours();
    paintGhost(g, v, a, p, c.halo, null, [], 5);
    g.globalAlpha = 0.8;
    paintGhost(g, v, a, p, modeColour(i!), c.halo, [4, 3], 2);
    g.globalAlpha = 1;
  }

  /** No road user is selected: nothing runs. */
  stop(): void {
    this.of = null;
  }
}
