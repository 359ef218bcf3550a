// Via points on the picture: a diamond at the place, and a dashed ring as wide as its tolerance.
import { ringRadius, viaRing } from '../draw/marks';
import { pill, tag, type Labels } from '../draw/labels';
import type { Pen } from '../draw/pen';
import { colours } from '../draw/theme';
import type { View } from '../draw/view';
import type { Agent } from '../model/document/scene';
import { metres, seconds } from '../model/base/units';
import { passed } from '../model/document/vias';
import type { Editor } from './editor';
import { verdictsHold } from './goal-verdict';
import { TEXTS } from '../texts/editing/via';

/** Diamonds of those that are missed are hollow, and say by how much. */
export function paintVias(g: Pen, labels: Labels, v: View, e: Editor, a: Agent): void {
  const all = a.goal.via;
  if (!all.length) return;
  const c = colours();
  const motion = e.futures.value?.modes[e.chosen.value]?.motion;
  const known = motion && verdictsHold(e) ? passed(all, motion) : null;
  const drag = e.drag.value?.grip;
  all.forEach((via, i) => {
    const [x, y] = v.to(...via.pos);
    const at = known?.[i];
    const missed = at?.ok === false;
    const colour = missed ? c['near-text'] : c.goal;
    const inHand = e.viaInHand.value === i;
    viaRing(g, [x, y], ringRadius(v, via.tolerance), { colour, hollow: missed, inHand, k: v.grip });
    labels.block(x - 10 * v.grip, y - 10 * v.grip, 20 * v.grip, 20 * v.grip);
    if (drag?.handle === 'ring' && drag.index === i) {
      tag(g, labels, [x + ringRadius(v, via.tolerance), y], `± ${metres(via.tolerance, 1)}`, {
        tries: [
          [8, -10],
          [8, 10],
        ],
      });
      return;
    }
    const when = via.time ?? (at && !missed ? at.time : null);
    const name = all.length > 1 ? TEXTS.viaOf(i + 1) : TEXTS.via;
    const far = missed ? TEXTS.missedBy(name, metres(Math.max(0.1, at.away - via.tolerance), 1)) : null;
    const text = far ?? (when === null ? name : `${name} · ${via.time === null ? '≈ ' : ''}${seconds(when)}`);
    const look = missed ? { bg: c.near, fg: c['on-near'], icon: 'triangle' as const } : { fg: c['goal-text'] };
    pill(g, labels, x, y, text, {
      ...look,
      tries: [
        [-110, -12],
        [16, -34],
        [16, 12],
        [-110, 14],
      ],
    });
  });
}
