// Overlay of an area being filled: its outline with corners, and the previewed road users.
import { boxOf, type Vec } from '../../../model/base/geometry';
import { typeOfKind } from '../../../model/base/kinds';
import { comesLater, type Newcomer } from '../../../model/document/newcomer';
import { metres } from '../../../model/base/units';
import { paintRing } from '../../../draw/handles';
import { pill, tag, type Labels } from '../../../draw/labels';
import type { Pen } from '../../../draw/pen';
import { sizeOnScreen, stamp, type Sized } from '../../../draw/sprites';
import { traceLine } from '../../../draw/strokes';
import { colours } from '../../../draw/theme';
import type { View } from '../../../draw/view';
import { armHandles, type ArmHandle } from './arm-handles';
import type { Filling } from './filling';
import type { Editor } from '../../session/editor';
import { TEXTS } from '../../../texts/editing/picture';

const CORNER_PX = 8;
const DASH = [6, 4];
const KNOB_PX = 8;
const HEAD_PX = 9;
/** Offsets of an arm's words from its knob, pixels. */
const RIGHT: [number, number] = [14, -10];
const BELOW: [number, number] = [-60, 14];
const ABOVE: [number, number] = [-60, -34];

const boxOfNewcomer = (n: Newcomer): Sized => ({ ...n, type: typeOfKind(n.kind), parked: n.parked });

export class FillOverlay {
  constructor(
    private readonly editor: Pick<Editor, 'scene'>,
    private readonly filling: Filling,
    private readonly labels: Labels,
  ) {}

  paint(g: Pen, v: View): void {
    const { filling } = this;
    const wish = filling.wish.value;
    if (!wish) return;
    const drawn = filling.drawn.value;
    const outline = drawn ?? wish.region;
    if (outline) this.#paintOutline(g, v, outline, drawn === null);
    this.#paintGoing(g, v);
    // Late arrivals are counted at their arm: at the start they are not present.
    for (const n of filling.all.value) if (!comesLater(n)) this.#paintOne(g, v, n, wish.pinned.includes(n));
    if (drawn) return;
    const handles = armHandles(filling.answer.value?.arms ?? [], wish.rates, v);
    for (const h of handles) this.#paintArm(g, v, h);
    for (const h of handles) this.#paintRate(g, h);
    const n = filling.all.value.length;
    if (wish.region) this.#paintCount(g, v, wish.region, filling.asking.value && !n ? '…' : TEXTS.toAdd(n));
  }

  #paintOutline(g: Pen, v: View, outline: readonly Vec[], closed: boolean): void {
    const c = colours();
    g.beginPath();
    traceLine(g, v, outline);
    if (closed) g.closePath();
    g.fillStyle = c.focus;
    g.globalAlpha = 0.12;
    g.fill();
    g.globalAlpha = 1;
    g.strokeStyle = c.focus;
    g.lineWidth = 2;
    g.setLineDash(DASH);
    g.stroke();
    g.setLineDash([]);
    g.fillStyle = c.surface;
    const every = outline.length > 40 ? outline.slice(0, 1) : outline;
    for (const [x, y] of every) {
      const [px, py] = v.to(x, y);
      const h = CORNER_PX / 2;
      g.beginPath();
      g.moveTo(px - h, py - h);
      g.lineTo(px + h, py - h);
      g.lineTo(px + h, py + h);
      g.lineTo(px - h, py + h);
      g.closePath();
      g.fill();
      g.stroke();
    }
  }

  /** Road users to be replaced have a dashed ring. */
  #paintGoing(g: Pen, v: View): void {
    const { editor: e } = this;
    const scene = e.scene.value!;
    for (const id of this.filling.answer.value?.replaced ?? []) {
      const a = scene.agents.get(id);
      const p = a?.logStart && { x: a.start.pos?.[0] ?? a.logStart.x, y: a.start.pos?.[1] ?? a.logStart.y };
      if (a && p)
        paintRing(
          g,
          v,
          a,
          { ...p, heading: a.start.heading ?? a.logStart!.heading },
          colours()['ink-3'],
          1.6,
          3,
          [2, 3],
        );
    }
  }

  #paintOne(g: Pen, v: View, n: Newcomer, pinned: boolean): void {
    const c = colours();
    if (!v.shows(n.pose.x, n.pose.y, 40)) return;
    const [x, y] = v.to(n.pose.x, n.pose.y);
    const box = boxOfNewcomer(n);
    g.globalAlpha = pinned ? 1 : 0.65;
    stamp(g, v, box, n.pose, true);
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    g.globalAlpha = 1;
    paintRing(g, v, box, n.pose, c.halo, 3, 3);
    paintRing(g, v, box, n.pose, c.focus, pinned ? 2 : 1.4, 3, pinned ? [] : [3.5, 2.5]);
    if (!pinned) return;
    // A pin is drawn too: line style alone must not carry meaning.
    const [l, w] = sizeOnScreen(box, v.z);
    const r = Math.min(l, w) / 2 + 6;
    g.beginPath();
    g.arc(x + r, y - r, 4, 0, Math.PI * 2);
    g.moveTo(x + r, y - r + 4);
    g.lineTo(x + r, y - r + 10);
    g.fillStyle = c.focus;
    g.strokeStyle = c.focus;
    g.lineWidth = 2;
    g.fill();
    g.stroke();
  }

  /** A stem with an arrowhead in the direction of traffic, and a knob to drag outward. */
  #paintArm(g: Pen, v: View, { base, at, out, rate }: ArmHandle): void {
    const c = colours();
    const colour = rate > 0 ? c.focus : c['ink-3'];
    const tip: Vec = [base[0] - out[0] * HEAD_PX, base[1] - out[1] * HEAD_PX];
    const line = (width: number, style: string): void => {
      g.beginPath();
      g.moveTo(...at);
      g.lineTo(...base);
      g.strokeStyle = style;
      g.lineWidth = width;
      g.stroke();
      g.beginPath();
      g.moveTo(...tip);
      g.lineTo(base[0] - out[1] * HEAD_PX * 0.6, base[1] + out[0] * HEAD_PX * 0.6);
      g.lineTo(base[0] + out[1] * HEAD_PX * 0.6, base[1] - out[0] * HEAD_PX * 0.6);
      g.closePath();
      g.fillStyle = style;
      g.fill();
      g.stroke();
    };
    line(7, c.halo);
    line(3, colour);
    const r = KNOB_PX * v.grip;
    g.beginPath();
    g.arc(at[0], at[1], r + 2, 0, Math.PI * 2);
    g.fillStyle = c.halo;
    g.fill();
    g.beginPath();
    g.arc(at[0], at[1], r, 0, Math.PI * 2);
    // Filled means set, hollow means not.
    g.fillStyle = rate > 0 ? colour : c.surface;
    g.fill();
    g.strokeStyle = colour;
    g.lineWidth = 2;
    g.stroke();
    this.labels.block(at[0] - r, at[1] - r, 2 * r, 2 * r);
  }

  #paintRate(g: Pen, { arm, at, out, rate }: ArmHandle): void {
    const c = colours();
    const words = rate > 0 ? TEXTS.armComes(arm.title, rate, arm.placed, arm.later) : arm.title;
    pill(g, this.labels, at[0], at[1], words, {
      ...(rate > 0 ? { bg: c.focus, fg: c.surface } : {}),
      must: rate > 0,
      // Not over the arrow.
      tries: Math.abs(out[0]) > 0.5 ? [BELOW, ABOVE, RIGHT] : [RIGHT, BELOW, ABOVE],
    });
  }

  #paintCount(g: Pen, v: View, region: readonly Vec[], words: string): void {
    const c = colours();
    const b = boxOf(region);
    const size = `${metres(b.x1 - b.x0, 0)} × ${metres(b.y1 - b.y0, 0)}`;
    const seen = boxOf(region.map(([x, y]) => v.to(x, y)));
    tag(g, this.labels, [(seen.x0 + seen.x1) / 2, seen.y0], `${words} · ${size}`, {
      bg: c.focus,
      fg: c.surface,
      tries: [
        [-60, -32],
        [-60, 10],
      ],
    });
  }
}
