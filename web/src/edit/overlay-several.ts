// What the overlay shows of several: the frame around them, whom a sweep takes, and who is about to be placed.
import type { Pose, Vec } from '../model/base/geometry';
import { kindsWords } from '../model/base/kinds';
import type { Newcomer } from '../model/document/newcomer';
import { typeOfKind } from '../model/base/kinds';
import type { Agent } from '../model/document/scene';
import { speedLabel, walkingUnit } from '../model/base/units';
import { paintRing, paintSpeed } from '../draw/handles';
import { tag, type Labels } from '../draw/labels';
import type { Pen } from '../draw/pen';
import { sizeOnScreen, stamp, type Sized } from '../draw/sprites';
import { polyline, traceLine, trail } from '../draw/strokes';
import { colours } from '../draw/theme';
import type { View } from '../draw/view';
import type { Editor } from './editor';
import { frameAround, type Frame } from './frame';
import type { FillOverlay } from './overlay-fill';
import type { Ghosts } from './placing';
import { TEXTS } from '../texts/editing/picture';

const CORNER_PX = 8;
/** Beyond so many each one's own way would hide the others'. */
const MOST_WAYS = 24;
/** More than these are a crowd, whose arrows are kept short, pixels. */
const CROWD = 8;
const SHORT_PX = 14;

const boxOfNewcomer = (n: Newcomer): Sized => ({ ...n, type: typeOfKind(n.kind), parked: false });

export class SeveralOverlay {
  /** Comes when an area is filled; until then the picture is painted again. */
  #fill: FillOverlay | null = null;
  #coming = false;

  constructor(
    private readonly editor: Editor,
    private readonly labels: Labels,
    private readonly poseNow: (a: Agent) => Pose | null,
  ) {}

  get coming(): boolean {
    return this.#coming;
  }

  #paintFill(g: Pen, v: View): void {
    if (!this.editor.filling.wish.value) return;
    if (this.#fill) this.#fill.paint(g, v);
    else if (!this.#coming) {
      this.#coming = true;
      void import('./overlay-fill')
        .then(({ FillOverlay }) => (this.#fill = new FillOverlay(this.editor, this.labels)))
        .catch(() => this.editor.notices.show({ text: TEXTS.thePreviewDid }))
        .finally(() => (this.#coming = false));
    }
  }

  paint(g: Pen, v: View): void {
    const { editor: e } = this;
    if (e.selected.value.length > 1) this.#paintMembers(g, v);
    if (e.sweep.value) this.#paintSweep(g, v, e.sweep.value.outline, e.sweep.value.ids);
    this.#paintFill(g, v);
    const ghosts = e.placement.ghosts.value;
    if (ghosts) this.#paintGhosts(g, v, ghosts);
  }

  #paintMembers(g: Pen, v: View): void {
    const { editor: e } = this;
    const c = colours();
    const all = e.chosenOnes;
    const atStart = e.time.value < 0.05;
    const shown = all.flatMap((a) => {
      const p = this.poseNow(a);
      return p && v.shows(p.x, p.y, 60) ? [[a, p] as const] : [];
    });
    if (!e.drag.value && e.layers.value.futures && all.length <= MOST_WAYS)
      for (const [a] of shown)
        trail(g, v, e.motionFor(a), {
          colour: c['ink-2'],
          width: 1.4,
          alpha: 0.6,
          dash: [2, 3.5],
          from: e.time.value,
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
    if (frame && !e.playing.value) this.#paintFrame(g, frame, kindsWords(all.map((a) => a.kind)), atStart);
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

  #paintGhosts(g: Pen, v: View, { all, words, lane }: Ghosts): void {
    const { editor: e } = this;
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
      if (sweep) tag(g, this.labels, v.to(sweep[0], sweep[1]), words, {});
      return;
    }
    const one = all.length === 1;
    if (one && first.who.pose.speed > 0.2) {
      const box = boxOfNewcomer(first.who);
      const tip = paintSpeed(g, v, box, first.who.pose, c.select, false);
      const unit = box.type === 'pedestrian' ? walkingUnit(e.speedUnit.value) : e.speedUnit.value;
      tag(g, this.labels, tip, speedLabel(first.who.pose.speed, unit), {
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
    tag(g, this.labels, [x, y], one && blocked ? TEXTS.somebodyStands : words, {
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

/** The outline of a rectangle, to be filled or stroked. */
function square(g: Pen, x: number, y: number, w: number, h: number): void {
  g.beginPath();
  g.moveTo(x, y);
  g.lineTo(x + w, y);
  g.lineTo(x + w, y + h);
  g.lineTo(x, y + h);
  g.closePath();
}
