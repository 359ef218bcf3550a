// Overlay of several: the frame around them, and the road users inside a sweep.
import type { Pose, Vec } from '../../model/base/geometry';
import { kindsWords } from '../../model/base/kinds';
import type { Agent } from '../../model/document/scene';
import { paintRing, paintSpeed } from '../../draw/handles';
import { tag, type Labels } from '../../draw/labels';
import type { Pen } from '../../draw/pen';
import { stamp } from '../../draw/sprites';
import { traceLine, trail } from '../../draw/strokes';
import { colours } from '../../draw/theme';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';
import { frameAround, type Frame } from './frame';

const CORNER_PX = 8;
/** Beyond this number each one's path would hide the others'. */
const MOST_WAYS = 24;
/** Beyond this number arrows are kept short, pixels. */
const CROWD = 8;
const SHORT_PX = 14;

export class SeveralOverlay {
  constructor(
    private readonly editor: Editor,
    private readonly labels: Labels,
    private readonly poseNow: (a: Agent) => Pose | null,
  ) {}

  paint(g: Pen, v: View): void {
    const { editor: e } = this;
    if (e.selected.value.length > 1) this.#paintMembers(g, v);
    if (e.sweep.value) this.#paintSweep(g, v, e.sweep.value.outline, e.sweep.value.ids);
  }

  #paintMembers(g: Pen, v: View): void {
    const { editor: e } = this;
    const c = colours();
    const all = e.chosenOnes;
    const atStart = e.playhead.time.value < 0.05;
    const shown = all.flatMap((a) => {
      const p = this.poseNow(a);
      return p && v.shows(p.x, p.y, 60) ? [[a, p] as const] : [];
    });
    if (!e.drag.info.value && e.view.layers.value.futures && all.length <= MOST_WAYS)
      for (const [a] of shown)
        trail(g, v, e.reading.motionFor(a), {
          colour: c['ink-2'],
          width: 1.4,
          alpha: 0.6,
          dash: [2, 3.5],
          from: e.playhead.time.value,
          cap: 'butt',
        });
    for (const [a, p] of shown) {
      stamp(g, v, a, p, true);
      g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
      paintRing(g, v, a, p, a.locked ? c['ink-3'] : c.select, 1.6, 3, a.locked ? [3, 3] : []);
    }
    if (atStart && v.z > 3)
      for (const [a, p] of shown)
        if (p.speed > 0.2)
          paintSpeed(g, v, a, p, c.select, a.start.speed === null, all.length > CROWD ? SHORT_PX : Infinity);
    const frame = frameAround(e, v);
    if (frame && !e.playhead.playing.value) this.#paintFrame(g, frame, kindsWords(all.map((a) => a.kind)), atStart);
  }

  #paintFrame(g: Pen, { box, corners, knob }: Frame, words: string, handles: boolean): void {
    const c = colours();
    g.lineWidth = 1.5;
    g.strokeStyle = c.focus;
    g.setLineDash([5, 4]);
    square(g, box.x, box.y, box.w, box.h);
    g.stroke();
    g.setLineDash([]);
    this.labels.block(box.x, box.y - 2, box.w, 4);
    if (handles) {
      g.beginPath();
      g.moveTo(knob[0], box.y);
      g.lineTo(knob[0], knob[1]);
      g.stroke();
      g.fillStyle = c.surface;
      for (const [x, y] of corners) {
        square(g, x - CORNER_PX / 2, y - CORNER_PX / 2, CORNER_PX, CORNER_PX);
        g.fill();
        g.stroke();
      }
      g.beginPath();
      g.arc(knob[0], knob[1], 6, 0, Math.PI * 2);
      g.fill();
      g.stroke();
      g.beginPath();
      g.arc(knob[0], knob[1], 2.5, 0, Math.PI * 2);
      g.fillStyle = c.focus;
      g.fill();
    }
    tag(g, this.labels, [box.x, box.y + box.h], words, {
      bg: c.focus,
      fg: c.surface,
      tries: [
        [0, 8],
        [0, -28],
        [0, -box.h - 34],
      ],
    });
  }

  #paintSweep(g: Pen, v: View, outline: readonly Vec[], ids: readonly string[]): void {
    const { editor: e } = this;
    const c = colours();
    g.beginPath();
    traceLine(g, v, outline);
    if (outline.length > 2) g.closePath();
    g.fillStyle = c.focus;
    g.globalAlpha = 0.09;
    g.fill();
    g.globalAlpha = 1;
    g.strokeStyle = c.focus;
    g.lineWidth = 1.5;
    g.setLineDash([5, 4]);
    g.stroke();
    g.setLineDash([]);
    const scene = e.scene.value!;
    for (const id of ids) {
      const a = scene.agents.get(id);
      const p = a && this.poseNow(a);
      if (a && p && v.shows(p.x, p.y, 60)) paintRing(g, v, a, p, c.focus, 1.6, 3);
    }
  }
}

/** The outline of a rectangle, to be filled or stroked. */
function square(g: Pen, x: number, y: number, w: number, h: number): void {
  g.beginPath();
  g.moveTo(x, y);
  g.lineTo(x + w, y);
  g.lineTo(x + w, y + h);
  g.lineTo(x, y + h);
  g.closePath();
}
