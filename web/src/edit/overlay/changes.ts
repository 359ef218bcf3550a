// Part of the overlay about all road users: reactions to the last change.
import type { Pen } from '../../draw/pen';
import type { Pose } from '../../model/base/geometry';
import { poseAt } from '../../model/base/motion';
import type { Agent } from '../../model/document/scene';
import { pill, type Labels } from '../../draw/labels';
import { paintGhost, paintRing } from '../../draw/handles';
import { colourKey, stamp } from '../../draw/sprites';
import { trail } from '../../draw/strokes';
import { colours } from '../../draw/theme';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';
import { labelledChanges } from './picture';

export class ChangesOverlay {
  constructor(
    private readonly editor: Editor,
    private readonly labels: Labels,
    private readonly poseNow: (a: Agent) => Pose | null,
  ) {}

  /** Dashed: paths of the others before the last change. */
  paintBefore(g: Pen, v: View): void {
    const { editor: e } = this;
    const scene = e.scene.value!;
    const c = colours();
    const t = e.playhead.time.value;
    for (const ch of e.answers.changes.value.slice(0, 8)) {
      const a = scene.agents.get(ch.id);
      if (!a) continue;
      trail(g, v, ch.before, {
        colour: c['ink-2'],
        width: 1.4,
        dash: [5, 4],
        alpha: 0.75,
        halo: true,
        from: t,
        cap: 'butt',
      });
      trail(g, v, e.reading.motionFor(a), { colour: c[colourKey(a)], width: 2.4, halo: true, dots: true, from: t });
      const p = poseAt(ch.before, t),
        q = this.poseNow(a);
      if (p && t > 0.05) paintGhost(g, v, a, p, c['ink-2'], null, [3, 3], 1.4);
      if (q) {
        stamp(g, v, a, q);
        g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
        paintRing(g, v, a, q, c.select, 1.4, 3, [3, 3]);
      }
    }
  }

  /** Ids of the labelled ones. */
  paintChangeLabels(g: Pen, v: View): string[] {
    const { editor: e } = this;
    const labelled: string[] = [];
    for (const ch of labelledChanges(e)) {
      const a = e.scene.value!.agents.get(ch.id);
      const p = a && this.poseNow(a);
      const style = { leader: colours().ink, radii: [44, 60, 84, 110], must: false };
      if (p && v.shows(p.x, p.y) && pill(g, this.labels, ...v.to(p.x, p.y), `${ch.name} ${ch.words}`, style))
        labelled.push(ch.id);
    }
    return labelled;
  }
}
