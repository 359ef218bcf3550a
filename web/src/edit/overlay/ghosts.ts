// Reactions of the others during a drag: where each would wait or be slowest if the drag ended now.
import type { Pen } from '../../draw/pen';
import type { Change } from '../../model/words/change-words';
import type { Pose } from '../../model/base/geometry';
import { STEP_S } from '../../model/base/motion';
import type { Agent } from '../../model/document/scene';
import { Fades, type Faded } from '../../draw/fades';
import { paintWaiting, paintWay, type GhostStyle } from '../../draw/ghosts';
import { tag, type Labels } from '../../draw/labels';
import { boxOnScreen, colourKey, stamp } from '../../draw/sprites';
import { colours } from '../../draw/theme';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';
import { LABELS } from './picture';

/** Nearer to its own box than this share of its length, a ghost is only an outline. */
const OVER_ITSELF = 0.6;

export class GhostOverlay {
  private readonly fades = new Fades<Change>();
  private readonly reducedMotion =
    typeof matchMedia === 'undefined' ? { matches: false } : matchMedia('(prefers-reduced-motion: reduce)');
  private shown: Faded<Change>[] = [];

  constructor(
    private readonly editor: Editor,
    private readonly labels: Labels,
    private readonly poseNow: (a: Agent) => Pose | null,
  ) {}

  get fading(): boolean {
    return this.fades.fading;
  }

  private agentOf(c: Change): Agent | undefined {
    return this.editor.scene.value?.agents.get(c.id);
  }

  /** Paths, real boxes and ghosts, the most affected on top. */
  paint(g: Pen, v: View): void {
    const { editor: e } = this;
    const previewed = e.view.showPreviewed.value ? (e.answers.previewed.value ?? []) : [];
    this.shown = this.fades.next(previewed, performance.now(), this.reducedMotion.matches);
    const t = e.playhead.time.value;
    for (const { ghost: c, alpha, here } of [...this.shown].reverse()) {
      const a = this.agentOf(c);
      if (!a) continue;
      const now = this.poseNow(a);
      const away = now ? Math.hypot(now.x - c.place.x, now.y - c.place.y) : Infinity;
      const style: GhostStyle = {
        colour: colours()[colourKey({ ...a, parked: false })],
        alpha,
        brakes: c.reaction?.kind === 'waits' || c.reaction?.kind === 'slows',
        filled: away > OVER_ITSELF * a.length,
      };
      // A late arrival moves from where it first appears.
      paintWay(g, v, c.after, Math.max(t, (c.after.valid[0]?.[0] ?? 0) * STEP_S), c.at, style);
      if (now && here) {
        // The real box stays in place, at full strength.
        stamp(g, v, a, now);
        g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
        this.block(v, a, now);
      }
      paintWaiting(g, v, a, c.place, style);
      if (here) this.block(v, a, c.place);
    }
  }

  private block(v: View, a: Agent, p: Pose): void {
    const { x, y, w, h } = boxOnScreen(v, a, p);
    this.labels.block(x - 2, y - 2, w + 4, h + 4);
  }

  /** A short cause for each of the most affected. */
  paintLabels(g: Pen, v: View): void {
    for (const { ghost: c, alpha } of this.shown.filter((s) => s.here).slice(0, LABELS)) {
      const at = v.to(c.place.x, c.place.y);
      g.globalAlpha = alpha;
      tag(g, this.labels, at, c.words, { leader: colours().ink, radii: [38, 52, 70, 92, 120] });
      g.globalAlpha = 1;
    }
  }
}
