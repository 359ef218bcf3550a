// The goal of the selected road user on the overlay: flag, handles, reach, and labels of a drag.
import type { Pen } from '../../draw/pen';
import type { Pose } from '../../model/base/geometry';
import { reachableWays, reachBetween, shortfall } from '../../model/physics/reach';
import { canChange, startPose, type Agent } from '../../model/document/scene';
import { metres, seconds, speedLabel } from '../../model/base/units';
import { pill, tag, type Labels, type Rect } from '../../draw/labels';
import { FLAG, paintFlag, paintGhost, paintHandles, paintString } from '../../draw/handles';
import { paintRing, paintWays } from '../../draw/ground';
import { polyline } from '../../draw/strokes';
import { colours } from '../../draw/theme';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';
import type { Lag } from '../session/drag';
import { outOfReach, type OutOfReach } from '../moves/goal-verdict';
import { TEXTS } from '../../texts/editing/picture';

/** Distance of the tag's place from the edge of the picture, and its height. */
const EDGE_PX = 30;
const EDGE_TAG_PX = 26;
/** Places of the tag: off the path, which goes on to the flag; on it only for want of room. */
const EDGE_TRIES = {
  across: [
    [-32, -43],
    [-32, 17],
    [-32, -13],
  ],
  up: [
    [16, -13],
    [-80, -13],
    [-32, -13],
  ],
} as const;

/** Is the foot of a flag or its pennant in the uncovered part of the picture? */
function isFlagClear(v: View, { x, y }: Pose): boolean {
  const [px, py] = v.to(x, y);
  return v.isClear(x, y) || v.isClear(...v.from(px, py - (FLAG.height * v.grip) / 2));
}

export class GoalOverlay {
  /** Painted place of the time tag, for the pointer. */
  timeTag: Rect | null = null;

  /** Painted place of the flag's tag at the edge of the picture, for the pointer. */
  edgeTag: Rect | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly labels: Labels,
    /** Is the followed future the only answer? */
    private readonly isDecided: () => boolean,
  ) {}

  paintLaneGlow(g: Pen, v: View): void {
    const d = this.editor.drag.info.value;
    const lane = d?.laneId ? this.editor.scene.value!.map.lanes.get(d.laneId) : null;
    if (lane)
      polyline(
        g,
        v,
        lane.line.pts,
        d!.grip.part === 'goal' ? colours().goal : colours().vehicle,
        Math.min(3.2, lane.width) * v.z,
        0.22,
      );
    const bar = d?.stop;
    if (bar) {
      const half = 1.5,
        at = (k: number): [number, number] => [
          bar.x + Math.cos(bar.heading) * 2.6 - Math.sin(bar.heading) * k,
          bar.y + Math.sin(bar.heading) * 2.6 + Math.cos(bar.heading) * k,
        ];
      polyline(g, v, [at(-half), at(half)], colours().goal, 3, 1, [], 'round');
    }
  }

  /** All places it can reach by the goal time, whatever its goal. */
  paintAllReach(g: Pen, v: View, a: Agent): void {
    const { map } = this.editor.scene.value!;
    const start = startPose(a);
    if (!start || !canChange(a)) return;
    const t = a.goal.time;
    if (a.type === 'pedestrian') paintRing(g, v, [start.x, start.y], ...reachBetween(a, start, t));
    else paintWays(g, v, reachableWays(map, a, start, t));
  }

  /** The limit of its reach, and the part of the way beyond. */
  paintReach(g: Pen, v: View, a: Agent): void {
    const { editor: e } = this;
    const r = e.reading.localReach.value;
    if (!r || r.kind === 'ok' || !a.goal.pos || !outOfReach(this.editor, a)) return;
    const c = colours();
    const w = Math.max(4, a.width * 1.5 * v.z);
    const cut = r.kind === 'far' ? r.max : r.along;
    const pts = r.path.pts;
    const inside = pts.filter((_, i) => r.path.s[i] <= cut),
      beyond = pts.filter((_, i) => r.path.s[i] >= cut - 3);
    polyline(g, v, inside, c.goal, w, 0.2);
    if (r.kind === 'far') {
      polyline(g, v, beyond, c.near, w, 0.45);
      polyline(g, v, beyond, c['near-edge'], 2.5, 1, [2, 6], 'round');
    }
  }

  paintGoal(g: Pen, v: View, a: Agent, goal: Pose & { set: boolean; time: number }): void {
    const { editor: e } = this;
    const c = colours();
    const [x, y] = v.to(goal.x, goal.y);
    const bad = outOfReach(this.editor, a);
    const colour = bad ? c['near-text'] : c.goal;
    paintGhost(g, v, a, goal, colour, bad ? c['near-soft'] : c['goal-soft'], goal.set && !bad ? [] : [4, 3]);
    const drag = e.drag.info.value?.grip;
    const unit = e.view.unitOf(a);
    if (goal.set && !a.locked) {
      const h = paintHandles(g, this.labels, v, a, goal, {
        colour,
        freeHeading: a.goal.heading === null,
        freeSpeed: a.goal.speed === null,
        tick: a.type === 'pedestrian' ? 1 : 10 / 3.6,
      });
      if (a.goal.speed !== null || (drag?.part === 'goal' && drag.handle === 'speed'))
        tag(g, this.labels, h.tip, speedLabel(goal.speed, unit), {
          tries: [
            [14, -10],
            [-22, 14],
            [-22, -32],
          ],
          bg: colour,
          fg: c.surface,
        });
    }
    paintFlag(g, this.labels, [x, y], colour, !goal.set, v.grip);
    if (bad) this.paintNearest(g, v, a, bad.nearest);
    const said = bad && !bad.outranked;
    const free = a.locked ? TEXTS.noGoal : TEXTS.dragToSetAGoal;
    const text = said ? bad.title : goal.set ? TEXTS.goal(seconds(goal.time)) : free;
    if (drag?.part === 'goal' && drag.handle === 'body') return;
    // A free goal has no label beside the words of a stop.
    if (!goal.set && this.isDecided()) return;
    const r = pill(
      g,
      this.labels,
      x,
      y,
      text,
      said
        ? {
            tries: [
              [32, -44],
              [-150, -44],
            ],
            bg: c.near,
            fg: c['on-near'],
            icon: 'triangle',
          }
        : {
            fg: c['goal-text'],
            tries: [
              [30, -42],
              [30, -20],
              [-100, -42],
              [-100, 6],
              [30, 6],
            ],
          },
    );
    if (goal.set && r) this.timeTag = r;
  }

  /** A flag outside the picture has a tag at the edge, with the distance; it is dragged as the flag itself. */
  paintEdgeTag(g: Pen, v: View, a: Agent, now: Pose | null, goal: Pose & { set: boolean }): void {
    const { editor: e } = this;
    if (e.drag.info.value || e.playhead.playing.value || a.locked || isFlagClear(v, goal)) return;
    const c = colours();
    const { left, right, top, bottom } = v.inset;
    const middle = [(v.w + left - right) / 2, (v.h + top - bottom) / 2] as const;
    const from = now && v.isClear(now.x, now.y, EDGE_PX) ? v.to(now.x, now.y) : middle;
    const to = v.to(goal.x, goal.y);
    const [x, y] = v.exit(from, to, EDGE_PX);
    const tries = EDGE_TRIES[Math.abs(to[0] - from[0]) > Math.abs(to[1] - from[1]) ? 'across' : 'up'];
    const start = startPose(a) ?? goal;
    const text = metres(Math.hypot(goal.x - start.x, goal.y - start.y), 0);
    const look = goal.set ? { bg: c.goal, fg: c.surface } : { fg: c['goal-text'], border: c.goal };
    this.edgeTag = pill(g, this.labels, x, y, text, { ...look, icon: 'flag', height: EDGE_TAG_PX, tries });
  }

  private paintNearest(g: Pen, v: View, a: Agent, nearest: OutOfReach['nearest']): void {
    if (!nearest) return;
    const c = colours();
    paintGhost(g, v, a, nearest, c.goal, c['goal-soft'], [], 2);
    paintFlag(g, this.labels, v.to(nearest.x, nearest.y), c.goal, true, v.grip);
  }

  /** Painted after the handles, which would cover it. */
  labelNearest(g: Pen, v: View, a: Agent, nearest: NonNullable<OutOfReach['nearest']>, quiet: boolean): void {
    const c = colours();
    const [x, y] = v.to(nearest.x, nearest.y);
    const start = startPose(a);
    const far =
      start && a.goal.pos ? shortfall(start, a.goal.pos, nearest, this.editor.reading.localReach.value) : null;
    tag(g, this.labels, [x, y], far ? TEXTS.nearestReachable(metres(far.gets, 0)) : TEXTS.nearestReachableOnly, {
      tries: [
        [34, -26],
        [-170, -26],
        [34, 8],
        [-170, 8],
      ],
      bg: c.goal,
      fg: c.surface,
    });
    if (!quiet && far && far.beyond > 1 && a.goal.pos)
      tag(
        g,
        this.labels,
        v.to((nearest.x + a.goal.pos[0]) / 2, (nearest.y + a.goal.pos[1]) / 2),
        TEXTS.beyondReach(metres(far.beyond, 0)),
        { weight: 500, must: false },
      );
  }

  /** A dotted line from the flag to the pointer, while a kerb holds the flag back. */
  private paintLag(g: Pen, v: View, { from, to, touch }: Lag, quiet: boolean): void {
    const hand = v.to(to[0], to[1]);
    paintString(g, v.to(from[0], from[1]), hand);
    // The line of keys has it too, except for a finger.
    if (quiet && !touch) return;
    const tries = [
      [20, -10],
      [20, 12],
      [-100, -10],
    ] as const;
    tag(g, this.labels, hand, touch ? TEXTS.holdToCross : TEXTS.altToCross, { tries });
  }

  /** `quiet`: without the place and the way, which the panel has. */
  dragLabels(g: Pen, v: View, a: Agent, goal: Pose | null, quiet: boolean): void {
    const d = this.editor.drag.info.value;
    if (!d || d.grip.handle !== 'body') return;
    const c = colours();
    if (d.lag) this.paintLag(g, v, d.lag, quiet);
    if (quiet) return;
    const p = d.grip.part === 'goal' ? goal : startPose(a);
    if (!p) return;
    const [x, y] = v.to(p.x, p.y);
    const r = this.editor.reading.localReach.value;
    if (d.lane)
      tag(g, this.labels, [x, y], d.lane.place, {
        tries: [
          [34, -46],
          [-150, -46],
          [34, 12],
        ],
        bg: d.grip.part === 'goal' ? c.goal : c.select,
        fg: d.grip.part === 'goal' ? c.surface : c.halo,
      });
    if (d.grip.part === 'goal' && r)
      tag(g, this.labels, [x, y], TEXTS.atAhead(seconds(a.goal.time), metres(r.along, 0)), {
        weight: 500,
        tries: [
          [34, -22],
          [-170, -22],
          [34, 36],
        ],
      });
  }
}
