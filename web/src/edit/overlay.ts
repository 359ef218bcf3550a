// The overlay: selection, handles, futures, labels, ghosts, events. The only canvas a drag frame paints.
import type { OnLine, Pose } from '../model/geometry';
import { endPose, endsBefore, poseAt } from '../model/motion';
import { shortfall } from '../model/reach';
import { reachWords } from '../model/futures';
import { comparedWithLog } from '../model/changes';
import { canChange, startPose, touched, type Agent } from '../model/scene';
import { metres, num, seconds, speedLabel } from '../model/units';
import { Labels, paintIcon, pill, type PillStyle } from '../draw/labels';
import { paintFlag, paintGhost, paintHandles, paintRing } from '../draw/handles';
import { colourKey, sizeOnScreen, stamp } from '../draw/sprites';
import { paintChips, paintFutures, polyline, trail, type Chip } from '../draw/strokes';
import { colours } from '../draw/theme';
import type { View } from '../draw/view';
import type { Editor } from './editor';

type G = CanvasRenderingContext2D;

/** Alpha of the refinement steps left behind, newest first. */
const TRAIL_ALPHA = [0.34, 0.22, 0.16];

export class Overlay {
  /** Where the letters and the time tag were painted, for the pointer. */
  chips: Chip[] = [];
  timeTag: { x: number; y: number; w: number; h: number } | null = null;
  private readonly labels = new Labels();

  constructor(
    private readonly editor: Editor,
    private readonly poseNow: (a: Agent) => Pose | null,
  ) {}

  paint(g: G, v: View): void {
    const { editor: e } = this;
    const scene = e.scene.value;
    this.chips = [];
    this.timeTag = null;
    if (!scene) return;
    const { left, right } = v.inset;
    this.labels.reset(v.w, v.h, {
      left: left > 20 ? left - 12 : 0,
      right: right > 20 ? right - 12 : 0,
      top: 0,
      bottom: 0,
    });
    for (const r of this.panels(v)) this.labels.block(...r);
    this.paintHover(g, v);
    const a = e.agent.value;
    if (e.showBefore.value) this.paintBefore(g, v);
    if (a) this.paintSelected(g, v, a);
    this.paintEvents(g, v);
    this.paintChangeLabels(g, v);
    this.paintMeasure(g, v);
  }

  /** Rectangles of the panels over the picture, which labels keep clear of. */
  private panels(v: View): [number, number, number, number][] {
    const left = v.inset.left > 100 ? v.inset.left - 12 : 0;
    return [
      [left, v.h - 52, 400, 52],
      [v.w - 160, v.h - 52, 160, 52],
      [v.w - 260, 0, 260, 52],
      [0, 0, 62, 170],
      [left ? 62 : 0, 0, left, left ? v.h : 0],
    ];
  }

  private paintMeasure(g: G, v: View): void {
    const m = this.editor.measure.value;
    if (!m) return;
    const c = colours();
    polyline(g, v, [m.a, m.b], c.halo, 5, 1, [], 'round');
    polyline(g, v, [m.a, m.b], c.ink, 2, 1, [], 'round');
    this.tag(
      g,
      v.to((m.a[0] + m.b[0]) / 2, (m.a[1] + m.b[1]) / 2),
      metres(Math.hypot(m.a[0] - m.b[0], m.a[1] - m.b[1]), 1),
      {
        tries: [
          [-24, -28],
          [-24, 10],
        ],
      },
    );
  }

  private paintHover(g: G, v: View): void {
    const { editor: e } = this;
    const id = e.hover.value;
    const a = id && id !== e.selection.value ? e.scene.value!.agents.get(id) : null;
    const p = a && this.poseNow(a);
    if (!a || !p || e.drag.value) return;
    const t = e.time.value;
    trail(g, v, e.motionFor(a), { colour: colours()[colourKey(a)], width: 2.5, halo: true, dots: true, from: t });
    stamp(g, v, a, p, true);
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    paintRing(g, v, a, p, colours().select, 1.5);
  }

  private paintSelected(g: G, v: View, a: Agent): void {
    const { editor: e } = this;
    const c = colours();
    const start = startPose(a);
    const now = this.poseNow(a);
    const atStart = e.time.value < 0.05;
    const goal = canChange(a) ? e.goalPose(a) : null;
    this.paintLaneGlow(g, v);
    this.paintReach(g, v, a);
    if (e.layers.value.futures) this.paintSix(g, v, a);
    if (e.layers.value.log) this.paintLog(g, v, a, now);
    if (!atStart && start) paintGhost(g, v, a, start, c['ink-2'], null, [], 1.25);
    if (goal) this.paintGoal(g, v, a, goal);
    if (now) {
      stamp(g, v, a, now, true);
      g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
      paintRing(g, v, a, now, c.select);
      const [l] = sizeOnScreen(a, v.z);
      this.labels.block(v.x(now.x) - l / 2 - 4, v.y(now.y) - 14, l + 8, 28);
    }
    if (atStart && start && canChange(a)) {
      const h = paintHandles(g, this.labels, v, a, start, {
        colour: c.select,
        freeHeading: a.start.heading === null,
        freeSpeed: a.start.speed === null,
        tick: a.type === 'pedestrian' ? 1 : 10 / 3.6,
      });
      const unit = e.unitOf(a);
      const drag = e.drag.value?.grip;
      if (drag?.part === 'start' && drag.handle === 'heading')
        this.tag(g, h.knob, `${Math.round((start.heading * 180) / Math.PI)}°`, {});
      this.tag(g, h.tip, (a.start.speed === null ? '≈ ' : '') + speedLabel(start.speed, unit), {
        tries: [
          [-22, -32],
          [-22, 14],
          [14, -10],
        ],
      });
    }
    if (!atStart && now && !e.playing.value)
      this.tag(g, [v.x(now.x), v.y(now.y)], speedLabel(now.speed, e.unitOf(a)), { radii: [30, 42, 56] });
    const bad = goal ? this.unreachable(a) : null;
    if (bad?.nearest) this.labelNearest(g, v, a, bad.nearest);
    this.paintLetters(g, v, a);
    this.dragLabels(g, v, a, goal);
  }

  private tag(g: G, [x, y]: readonly [number, number], text: string, s: PillStyle): void {
    pill(g, this.labels, x, y, text, s);
  }

  private paintLaneGlow(g: G, v: View): void {
    const d = this.editor.drag.value;
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

  /** How far it gets, and what lies beyond. */
  private paintReach(g: G, v: View, a: Agent): void {
    const { editor: e } = this;
    const r = e.localReach.value;
    if (!r || r.kind === 'ok' || !a.goal.pos || !this.unreachable(a)) return;
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

  private paintSix(g: G, v: View, a: Agent): void {
    const { editor: e } = this;
    const f = e.futures.value;
    if (!f) return;
    const chosen = e.chosen.value;
    const d = e.draft.value;
    const outdated = e.outdated.value;
    if (d && d.id === a.id)
      d.earlier.forEach((old, i) => paintFutures(g, v, old, { chosen, alpha: TRAIL_ALPHA[i] ?? 0.1 }));
    const committed = this.committed(a);
    paintFutures(g, v, f, {
      chosen,
      only: e.hoverFuture.value,
      outdated,
      alpha: outdated ? 0.6 : 1,
      onlyChosen: committed,
    });
    if (f.sketch) {
      const m = f.modes[0].motion,
        i = m.x.length >> 1;
      pill(g, this.labels, v.x(m.x[i]), v.y(m.y[i]), 'sketch', { fg: colours()['ink-2'] });
      return;
    }
  }

  /** Away from the start only the future in force is shown: it is what happens. */
  private committed(a: Agent): boolean {
    const { editor: e } = this;
    return touched(a) && !e.drag.value && e.time.value > 0.05 && e.hoverFuture.value === null;
  }

  private paintLetters(g: G, v: View, a: Agent): void {
    const f = this.editor.futures.value;
    if (f && !f.sketch && this.editor.layers.value.futures)
      this.chips = paintChips(
        g,
        this.labels,
        v,
        f,
        this.chipIndexes(a, f.modes.length, this.committed(a)),
        this.editor.chosen.value,
      );
  }

  /** With a goal all futures end together, so only those that miss it carry their letter. */
  private chipIndexes(a: Agent, n: number, committed: boolean): number[] {
    const { editor: e } = this;
    const hovered = e.hoverFuture.value;
    if (hovered !== null && hovered < n) return [hovered];
    if (e.drag.value || committed) return [];
    const all = [...Array(n).keys()];
    const pos = a.goal.pos;
    if (!pos) return all;
    const f = e.futures.value!;
    return all.filter((i) => {
      const m = f.modes[i].motion;
      if (endsBefore(m, a.goal.time)) return true;
      const p = poseAt(m, a.goal.time) ?? endPose(m);
      return Math.hypot(p.x - pos[0], p.y - pos[1]) > 5;
    });
  }

  private paintLog(g: G, v: View, a: Agent, now: Pose | null): void {
    const { editor: e } = this;
    const c = colours();
    const m = e.motionFor(a);
    trail(g, v, a.log, { colour: c.log, width: 2, dash: [5, 4], halo: true, dots: true });
    const t = e.time.value;
    const ghost = poseAt(a.log, t);
    const cmp = comparedWithLog(a, m, e.scene.value!.duration);
    if (!cmp || !ghost || !now) return;
    for (let s = 1; s < e.scene.value!.duration; s++) {
      const p = poseAt(m, s),
        q = poseAt(a.log, s);
      if (p && q)
        polyline(
          g,
          v,
          [
            [p.x, p.y],
            [q.x, q.y],
          ],
          c.log,
          1,
          0.45,
        );
    }
    if (t < 0.05) return;
    polyline(
      g,
      v,
      [
        [now.x, now.y],
        [ghost.x, ghost.y],
      ],
      c.log,
      2,
    );
    paintGhost(g, v, a, ghost, c.log, 'rgba(255,255,255,.5)', [4, 3], 2);
    const d = Math.hypot(now.x - ghost.x, now.y - ghost.y);
    this.tag(g, [v.x(ghost.x), v.y(ghost.y)], 'Log', {
      fg: c.log,
      border: c.log,
      tries: [
        [-16, 16],
        [-16, -36],
      ],
    });
    if (d > 1)
      this.tag(g, [v.x((now.x + ghost.x) / 2), v.y((now.y + ghost.y) / 2)], `${num(d, 1)} m apart at ${seconds(t)}`, {
        leader: c.log,
        radii: [52, 72, 96],
      });
  }

  private paintGoal(g: G, v: View, a: Agent, goal: Pose & { set: boolean }): void {
    const { editor: e } = this;
    const c = colours();
    const [x, y] = v.to(goal.x, goal.y);
    const bad = this.unreachable(a);
    const colour = bad ? c['near-text'] : c.goal;
    paintGhost(g, v, a, goal, colour, bad ? c['near-soft'] : c['goal-soft'], goal.set && !bad ? [] : [4, 3]);
    const drag = e.drag.value?.grip;
    const unit = e.unitOf(a);
    if (goal.set) {
      const h = paintHandles(g, this.labels, v, a, goal, {
        colour,
        freeHeading: a.goal.heading === null,
        freeSpeed: a.goal.speed === null,
        tick: a.type === 'pedestrian' ? 1 : 10 / 3.6,
      });
      if (a.goal.speed !== null || (drag?.part === 'goal' && drag.handle === 'speed'))
        this.tag(g, h.tip, speedLabel(goal.speed, unit), {
          tries: [
            [14, -10],
            [-22, 14],
            [-22, -32],
          ],
          bg: colour,
          fg: c.surface,
        });
    }
    paintFlag(g, this.labels, x, y, colour, !goal.set);
    if (bad) this.paintNearest(g, v, a, bad.nearest);
    const text = bad ? bad.title : goal.set ? `Goal · ${seconds(a.goal.time)}` : 'Goal · free';
    if (drag?.part === 'goal' && drag.handle === 'body') return;
    const r = pill(
      g,
      this.labels,
      x,
      y,
      text,
      bad
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

  /** The verdict on the goal: the generator's where it is known, the local one during the drag. */
  private unreachable(a: Agent): { title: string; nearest: OnLine | null } | null {
    const { editor: e } = this;
    const live =
      e.liveReach.value?.id === a.id
        ? e.liveReach.value.reach
        : !e.drag.value && !e.motion.value.stale
          ? e.motion.value.reach.get(a.id)
          : null;
    const local = e.localReach.value;
    if (live)
      return live.status === 'unreachable'
        ? { title: reachWords(live, a.goal.time).title, nearest: live.nearest }
        : null;
    return local && local.kind !== 'ok' && a.goal.pos ? { title: local.title, nearest: local.nearest } : null;
  }

  private paintNearest(g: G, v: View, a: Agent, nearest: OnLine | null): void {
    if (!nearest) return;
    const c = colours();
    paintGhost(g, v, a, nearest, c.goal, c['goal-soft'], [], 2);
    const x = v.x(nearest.x),
      y = v.y(nearest.y);
    paintFlag(g, this.labels, x, y, c.goal, true);
  }

  /** After the handles, which would cover it. */
  private labelNearest(g: G, v: View, a: Agent, nearest: OnLine): void {
    const c = colours();
    const x = v.x(nearest.x),
      y = v.y(nearest.y);
    const start = startPose(a);
    const far = start && a.goal.pos ? shortfall(start, a.goal.pos, nearest, this.editor.localReach.value) : null;
    this.tag(g, [x, y], far ? `Nearest reachable · ${metres(far.gets, 0)}` : 'Nearest reachable', {
      tries: [
        [34, -26],
        [-170, -26],
        [34, 8],
        [-170, 8],
      ],
      bg: c.goal,
      fg: c.surface,
    });
    if (far && far.beyond > 1 && a.goal.pos)
      this.tag(
        g,
        [(x + v.x(a.goal.pos[0])) / 2, (y + v.y(a.goal.pos[1])) / 2],
        `${metres(far.beyond, 0)} beyond reach`,
        { weight: 500, must: false },
      );
  }

  private dragLabels(g: G, v: View, a: Agent, goal: Pose | null): void {
    const d = this.editor.drag.value;
    if (!d || d.grip.handle !== 'body') return;
    const c = colours();
    const p = d.grip.part === 'goal' ? goal : startPose(a);
    if (!p) return;
    const [x, y] = v.to(p.x, p.y);
    const r = this.editor.localReach.value;
    if (d.laneName)
      this.tag(
        g,
        [x, y],
        `on ${d.laneName}`.replace('on on foot', 'on foot').replace('on off', 'off').replace('on inside', 'inside'),
        {
          tries: [
            [34, -46],
            [-150, -46],
            [34, 12],
          ],
          bg: d.grip.part === 'goal' ? c.goal : c.select,
          fg: d.grip.part === 'goal' ? c.surface : c.halo,
        },
      );
    if (d.grip.part === 'goal' && r)
      this.tag(g, [x, y], `at ${seconds(a.goal.time)} · ${metres(r.along, 0)} along the way`, {
        weight: 500,
        tries: [
          [34, -22],
          [-170, -22],
          [34, 36],
        ],
      });
  }

  /** Dashed: where the others would have gone before the last change. */
  private paintBefore(g: G, v: View): void {
    const { editor: e } = this;
    const scene = e.scene.value!;
    const c = colours();
    const t = e.time.value;
    for (const ch of e.changes.value.slice(0, 8)) {
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
      trail(g, v, e.motionFor(a), { colour: c[colourKey(a)], width: 2.4, halo: true, dots: true, from: t });
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

  private paintChangeLabels(g: G, v: View): void {
    const { editor: e } = this;
    if (!e.showBefore.value || e.playing.value) return;
    for (const ch of e.changes.value.slice(0, 5)) {
      const a = e.scene.value!.agents.get(ch.id);
      const p = a && this.poseNow(a);
      const x = p ? v.x(p.x) : -1,
        y = p ? v.y(p.y) : -1;
      if (x > 0 && x < v.w && y > 0 && y < v.h)
        this.tag(g, [x, y], `${ch.name}: ${ch.short}`, {
          leader: colours().ink,
          radii: [44, 60, 84, 110],
          must: false,
        });
    }
  }

  private paintEvents(g: G, v: View): void {
    const { editor: e } = this;
    const c = colours();
    const picked = e.selectedEvent.value;
    const t = e.time.value;
    for (const ev of e.events.value) {
      if (ev !== picked && Math.abs(ev.time - t) > 0.45) continue;
      const hit = ev.kind === 'collision';
      for (const a of [ev.a, ev.b]) {
        const p = this.poseNow(e.scene.value!.agents.get(a.id) ?? a);
        if (p && Math.abs(ev.time - t) < 0.5) paintRing(g, v, a, p, hit ? c.collision : c['near-edge'], 2, 3);
      }
      const x = v.x(ev.at[0]),
        y = v.y(ev.at[1]);
      if (hit) {
        g.beginPath();
        g.arc(x, y, 10, 0, Math.PI * 2);
        g.fillStyle = c.collision;
        g.strokeStyle = c.halo;
        g.lineWidth = 2.5;
        g.stroke();
        g.fill();
        paintIcon(g, 'cross', x, y, c['on-collision']);
        this.labels.block(x - 12, y - 12, 24, 24);
      }
      const text = hit ? `Collision · ${ev.title}` : `${seconds(ev.time)} · ${ev.short}`;
      this.tag(g, [x, y], text, {
        leader: hit ? c.collision : c['near-text'],
        radii: [44, 60, 84],
        bg: hit ? c.collision : c.near,
        fg: hit ? c['on-collision'] : c['on-near'],
        height: 22,
        icon: hit ? 'cross' : 'triangle',
      });
    }
  }
}
