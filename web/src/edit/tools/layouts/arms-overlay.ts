// Overlay of a map being made: knobs and names of the arms, the former place of an arm, the ways of its lanes, and
// failed checks.
import type { Vec } from '../../../model/base/geometry';
import { metres, num } from '../../../model/base/units';
import { pill, type Labels } from '../../../draw/labels';
import type { Pen } from '../../../draw/pen';
import { traceLine } from '../../../draw/strokes';
import { colours } from '../../../draw/theme';
import type { View } from '../../../draw/view';
import { knobs } from './arms';
import { exits, stops } from './ways';
import type { Layouts, DrawnMap, PlacedKnob } from './layouts';
import { TEXTS } from '../../../texts/editing/picture';

const KNOB_PX = 9;
const BUTTON_PX = 8;
const HEAD_PX = 9;
const STOP_PX = 5;

export class ArmsOverlay {
  constructor(
    private readonly layouts: Layouts,
    private readonly labels: Labels,
  ) {}

  paint(g: Pen, v: View): void {
    const { layouts } = this;
    const made = layouts.made.value;
    if (!made) return;
    const all = knobs(layouts);
    this.#paintWays(g, v, made, layouts.arm.value);
    this.#paintStops(g, v);
    this.#paintDrawn(g, v);
    this.#paintBefore(g, v, made);
    for (const k of all) if (k.kind === 'arm') this.#paintStem(g, v, made, k);
    for (const k of all) {
      const at = v.to(...k.at);
      this.labels.block(at[0] - 11, at[1] - 11, 22, 22);
      if (k.kind === 'lane') paintButton(g, at, k.by, k.arm === layouts.arm.value);
      else paintKnob(g, at, k.kind === 'arm' ? KNOB_PX : 6, k.kind === 'arm' && k.arm === layouts.arm.value);
    }
    this.#paintNames(g, v, made, all);
  }

  /** Ways of the selected arm's lanes; those of the others are dashed. */
  #paintWays(g: Pen, v: View, made: DrawnMap, inHand: number): void {
    const c = colours();
    const { layouts } = this;
    const under = layouts.under.value;
    const idOf = (way: { from: string; to: string } | null): string => (way ? `${way.from}-${way.to}` : '');
    const picked = idOf(layouts.way.value);
    const pointed = under?.kind === 'way' ? idOf(under.way) : '';
    for (const lane of made.scene.map.lanes.values()) {
      const from = /^arm(\d+)\.in\d+-(?!arm\d+\.out-cycle)/.exec(lane.id);
      if (!from) continue;
      const mine = Number(from[1]) - 1 === inHand;
      const strong = lane.id === picked || lane.id === pointed;
      g.beginPath();
      traceLine(g, v, lane.line.pts);
      if (lane.id === picked) {
        g.strokeStyle = c.surface;
        g.lineWidth = 7;
        g.stroke();
      }
      g.strokeStyle = mine ? c.ok : c['ink-3'];
      g.lineWidth = strong ? 4 : mine ? 2 : 1;
      g.globalAlpha = mine || strong ? 1 : 0.45;
      g.setLineDash(mine ? [] : [4, 4]);
      g.stroke();
      g.setLineDash([]);
      if (mine) paintHead(g, v, lane.line.pts, c.ok);
      g.globalAlpha = 1;
    }
  }

  /** Stop lines from which a way can be drawn; while one is drawn, its possible exits. */
  #paintStops(g: Pen, v: View): void {
    const { layouts } = this;
    const c = colours();
    const drawn = layouts.drawn.value;
    const under = layouts.under.value;
    for (const { arm, lane, at } of stops(layouts)) {
      const mine = arm === layouts.arm.value;
      const pointed = under?.kind === 'stop' && under.arm === arm && under.lane === lane;
      if (drawn ? String(drawn.from) !== String([arm, lane]) : !mine && !pointed) continue;
      paintDot(g, v.to(...at), pointed || drawn ? STOP_PX + 1.5 : STOP_PX, c.ok, c.surface);
    }
    if (!drawn) return;
    for (const { lane, at } of exits(layouts)) {
      const caught = String(lane) === String(drawn.to);
      paintDot(g, v.to(...at), caught ? STOP_PX + 2.5 : STOP_PX, caught ? c.ok : c.surface, caught ? c.surface : c.ok);
    }
  }

  /** The way being drawn, up to the pointer; caught by an exit it is part of the map. */
  #paintDrawn(g: Pen, v: View): void {
    const { layouts } = this;
    const drawn = layouts.drawn.value;
    const from = drawn && layouts.made.value?.arms[drawn.from[0]]?.ins_m[drawn.from[1]];
    if (!drawn || !from) return;
    const c = colours();
    const [x, y] = v.to(...drawn.at);
    if (!drawn.to) {
      g.beginPath();
      g.moveTo(...v.to(from[0], from[1]));
      g.lineTo(x, y);
      g.strokeStyle = c.ok;
      g.lineWidth = 2;
      g.setLineDash([5, 4]);
      g.stroke();
      g.setLineDash([]);
    }
    const words = drawn.to ? TEXTS.toExit(layouts.exitName(drawn.to)) : TEXTS.dropOnAnExit;
    pill(g, this.labels, x, y, words, { tries: [[14, 10]], ...(drawn.to ? { bg: c.ok, fg: c.surface } : {}) });
  }

  /** The old place of an arm that is turned, and the turn as an arc. */
  #paintBefore(g: Pen, v: View, made: DrawnMap): void {
    const turned = this.layouts.turned.value;
    const now = turned && this.layouts.arms.value[turned.index];
    const place = turned && made.arms[turned.index];
    if (!turned || !now || !place) return;
    const from = (turned.before.angle_deg * Math.PI) / 180;
    const to = (now.angle_deg * Math.PI) / 180;
    const far = Math.hypot(...place.end_m);
    const near = Math.hypot(...place.mouth_m);
    const c = colours();
    g.strokeStyle = c['ink-2'];
    g.lineWidth = 1.25;
    g.setLineDash([6, 5]);
    const side = (left: number): void => {
      const at = (out: number): Vec => [
        Math.cos(from) * out - Math.sin(from) * left,
        Math.sin(from) * out + Math.cos(from) * left,
      ];
      g.beginPath();
      traceLine(g, v, [at(near), at(far)]);
      g.stroke();
    };
    side(place.kerbs_m[0]);
    side(-place.kerbs_m[1]);
    g.setLineDash([]);
    const [x, y] = v.to(0, 0);
    const r = (near + 9) * v.z;
    const back = Math.sin(to - from) < 0;
    g.beginPath();
    g.arc(x, y, r, v.angle(from), v.angle(to), !back);
    g.strokeStyle = c.ok;
    g.lineWidth = 2;
    g.stroke();
  }

  #paintStem(g: Pen, v: View, made: DrawnMap, k: Extract<PlacedKnob, { kind: 'arm' }>): void {
    const [mx, my] = made.arms[k.arm].mouth_m;
    g.beginPath();
    traceLine(g, v, [[mx, my], k.at]);
    g.strokeStyle = k.arm === this.layouts.arm.value ? colours().ok : colours().ink;
    g.lineWidth = 2;
    g.stroke();
  }

  #paintNames(g: Pen, v: View, made: DrawnMap, all: readonly PlacedKnob[]): void {
    const { layouts } = this;
    const c = colours();
    for (const k of all) {
      const [x, y] = v.to(...k.at);
      if (k.kind === 'arm') {
        const angle = layouts.arms.value[k.arm]?.angle_deg ?? 0;
        const turned = layouts.turned.value;
        const length = layouts.arms.value[k.arm]?.length_m;
        const longer = turned?.index === k.arm && length !== turned.before.length_m ? ` · ${metres(length, 0)}` : '';
        const words = `${made.arms[k.arm].title} · ${num(angle, Number.isInteger(angle) ? 0 : 1)}°${longer}`;
        const mine = k.arm === layouts.arm.value;
        pill(g, this.labels, x, y, words, {
          ...(mine ? { bg: c.ok, fg: c.surface } : {}),
          tries: [
            [16, -10],
            [-46, 14],
            [-46, -34],
            [-110, -10],
          ],
        });
      } else if (k.kind === 'kerb' && k.corner === 0)
        pill(g, this.labels, x, y, TEXTS.kerb(metres(made.corners[0].radius_m, 1)), { must: false });
    }
    this.#paintCount(g, v);
    this.#paintFaults(g, v, made);
    const fault = layouts.fault.value;
    const [x, y] = v.to(...(all.find((k) => k.kind === 'arm' && k.arm === layouts.arm.value)?.at ?? [0, 0]));
    if (fault) pill(g, this.labels, x, y, fault, { icon: 'triangle', bg: c.surface, fg: c.ink });
  }

  /** The lane count of an arm, under a button that adds or removes one. */
  #paintCount(g: Pen, v: View): void {
    const { layouts } = this;
    const under = layouts.under.value;
    const arm = under?.kind === 'lane' && layouts.arms.value[under.arm];
    if (!arm) return;
    const [x, y] = v.to(...under.at);
    pill(g, this.labels, x, y, TEXTS.lanesInOut(arm.lanes_in, arm.lanes_out), {
      tries: [
        [-86, -10],
        [14, -10],
      ],
    });
  }

  /** Failed checks by their number in the list. */
  #paintFaults(g: Pen, v: View, made: DrawnMap): void {
    made.checks
      .filter((check) => !check.passed)
      .forEach(({ at_m }, i) => {
        if (!at_m) return;
        const [x, y] = v.to(at_m[0], at_m[1]);
        pill(g, this.labels, x, y, `${i + 1}`, { icon: 'triangle', must: false, tries: [[-15, -10]] });
      });
  }
}

function paintDot(g: Pen, [x, y]: Vec, r: number, fill: string, rim: string): void {
  g.beginPath();
  g.arc(x, y, r, 0, Math.PI * 2);
  g.fillStyle = fill;
  g.fill();
  g.strokeStyle = rim;
  g.lineWidth = 1.5;
  g.stroke();
}

function paintKnob(g: Pen, [x, y]: Vec, r: number, inHand: boolean): void {
  const c = colours();
  g.beginPath();
  g.arc(x, y, r + 1.5, 0, Math.PI * 2);
  g.fillStyle = c.surface;
  g.fill();
  g.strokeStyle = inHand ? c.ok : c.ink;
  g.lineWidth = 2;
  g.stroke();
  g.beginPath();
  g.arc(x, y, r - 3, 0, Math.PI * 2);
  g.fillStyle = inHand ? c.ok : c.ink;
  g.fill();
}

function paintButton(g: Pen, [x, y]: Vec, by: 1 | -1, inHand: boolean): void {
  const c = colours();
  g.beginPath();
  g.arc(x, y, BUTTON_PX, 0, Math.PI * 2);
  g.fillStyle = inHand ? c.ok : c['ink-2'];
  g.fill();
  g.beginPath();
  g.moveTo(x - 4, y);
  g.lineTo(x + 4, y);
  if (by > 0) {
    g.moveTo(x, y - 4);
    g.lineTo(x, y + 4);
  }
  g.strokeStyle = c.surface;
  g.lineWidth = 1.8;
  g.stroke();
}

function paintHead(g: Pen, v: View, pts: readonly Vec[], colour: string): void {
  const [a, b] = [pts[Math.max(0, pts.length - 4)], pts.at(-1)!];
  const [x, y] = v.to(...b);
  const h = v.angle(Math.atan2(b[1] - a[1], b[0] - a[0]));
  g.beginPath();
  g.moveTo(x, y);
  g.lineTo(x - HEAD_PX * Math.cos(h - 0.42), y - HEAD_PX * Math.sin(h - 0.42));
  g.lineTo(x - HEAD_PX * Math.cos(h + 0.42), y - HEAD_PX * Math.sin(h + 0.42));
  g.closePath();
  g.fillStyle = colour;
  g.fill();
}
