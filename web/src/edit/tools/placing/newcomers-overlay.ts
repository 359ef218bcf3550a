// Overlay of the road users about to be placed.
import { typeOfKind } from '../../../model/base/kinds';
import type { Newcomer } from '../../../model/document/newcomer';
import { speedLabel, walkingUnit } from '../../../model/base/units';
import { paintRing, paintSpeed } from '../../../draw/handles';
import { tag, type Labels } from '../../../draw/labels';
import type { Pen } from '../../../draw/pen';
import { sizeOnScreen, stamp, type Sized } from '../../../draw/sprites';
import { polyline } from '../../../draw/strokes';
import { colours } from '../../../draw/theme';
import type { View } from '../../../draw/view';
import type { Placement } from '../../moves/placement';
import type { ToolOverlay } from '../../overlay/tool-overlay';
import type { Editor } from '../../session/editor';
import { TEXTS } from '../../../texts/editing/picture';

const boxOfNewcomer = (n: Newcomer): Sized => ({ ...n, type: typeOfKind(n.kind), parked: false });

export class NewcomersOverlay implements ToolOverlay {
  constructor(
    private readonly editor: Pick<Editor, 'scene' | 'sweep' | 'view'>,
    private readonly placement: Placement,
  ) {}

  watch(): void {
    void this.placement.ghosts.value;
  }

  paint(g: Pen, v: View, labels: Labels): void {
    const { editor: e } = this;
    const ghosts = this.placement.ghosts.value;
    if (!ghosts) return;
    const { all, words, lane } = ghosts;
    const c = colours();
    const scene = e.scene.value!;
    const on = lane ? scene.map.lanes.get(lane) : null;
    if (on) polyline(g, v, on.line.pts, c.vehicle, Math.min(3.2, on.width) * v.z, 0.2);
    for (const { who, fits } of all) {
      const box = boxOfNewcomer(who);
      g.globalAlpha = 0.8;
      stamp(g, v, box, who.pose, true);
      g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
      g.globalAlpha = 1;
      paintRing(g, v, box, who.pose, fits ? c.select : c.collision, 1.6, 4, [4, 3]);
    }
    const first = all[0];
    if (!first) {
      const sweep = e.sweep.value?.outline.at(-1);
      if (sweep) tag(g, labels, v.to(sweep[0], sweep[1]), words, {});
      return;
    }
    const one = all.length === 1;
    if (one && first.who.pose.speed > 0.2) {
      const box = boxOfNewcomer(first.who);
      const tip = paintSpeed(g, v, box, first.who.pose, c.select, false);
      const unit = box.type === 'pedestrian' ? walkingUnit(e.view.speedUnit.value) : e.view.speedUnit.value;
      tag(g, labels, tip, speedLabel(first.who.pose.speed, unit), {
        tries: [
          [14, -10],
          [-20, -34],
          [-20, 14],
        ],
      });
    }
    const last = all.at(-1)!.who;
    const half = sizeOnScreen(boxOfNewcomer(last), v.z)[0] / 2;
    const [x, y] = v.to(last.pose.x, last.pose.y);
    const blocked = all.some((n) => !n.fits);
    tag(g, labels, [x, y], one && blocked ? TEXTS.occupied : words, {
      tries: [
        [-60, 26],
        [-60, -half - 40],
        [20, 30],
      ],
      ...(one ? {} : { bg: c.focus, fg: c.surface }),
      ...(one && blocked ? { bg: c.collision, fg: c['on-collision'] } : {}),
    });
  }
}
