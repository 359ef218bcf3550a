// What is on the canvases for the present state of the editor. A drag frame paints the overlay alone.
import { effect } from '@preact/signals-core';
import { mixPose, type OnLine, type Pose } from '../model/geometry';
import { endPose, poseAt } from '../model/motion';
import { comparedWithLog, motionOf } from '../model/changes';
import { canChange, startPose, touched, type Agent } from '../model/scene';
import { metres, num, seconds, speedLabel } from '../model/units';
import { Labels, paintIcon, pill, type PillStyle } from '../draw/labels';
import { paintFlag, paintGhost, paintHandles, paintRing } from '../draw/handles';
import { colourKey, sizeOnScreen, stamp } from '../draw/sprites';
import { paintChips, paintFutures, polyline, trail, type Chip } from '../draw/strokes';
import { paintSignals } from '../draw/signals';
import { colours } from '../draw/theme';
import { MapPicture } from '../draw/paint-map';
import type { Stage } from '../draw/stage';
import type { View } from '../draw/view';
import type { Editor } from './editor';
import { laneWords } from './snap';

type G = CanvasRenderingContext2D;

/** Alpha of the refinement steps left behind, newest first. */
const TRAIL_ALPHA = [0.34, 0.22, 0.16];
const REACT_MS = 320;

export class Picture {
  chips: Chip[] = [];
  timeTag: { x: number; y: number; w: number; h: number } | null = null;
  private map: MapPicture | null = null;
  private readonly labels = new Labels();
  private reactFrom: { motion: Editor['motion']['value']; at: number } | null = null;

  constructor(private readonly stage: Stage, private readonly editor: Editor) {
    stage.painter('map', (g, v) => this.paintMap(g, v));
    stage.painter('agents', (g, v) => this.paintAgents(g, v));
    stage.painter('overlay', (g, v) => this.paintOverlay(g, v));
    this.watch();
  }

  private watch(): void {
    const { editor: e, stage } = this;
    let mapOf: unknown = null;
    let lastMotion = e.motion.peek();
    effect(() => {
      const s = e.scene.value;
      if (s && s.map !== mapOf) {
        mapOf = s.map;
        this.map = new MapPicture(s.map, !['drawn', 'placed', 'synthetic', 'sumo', 'demo', 'generated'].includes(s.source));
        stage.invalidate('map');
      }
      stage.invalidate('overlay');
      // While a handle is dragged the others do not move, so their canvas is left alone.
      if (!e.drag.peek()) stage.invalidate('agents');
    });
    effect(() => { void e.layers.value.lanes; stage.invalidate('map'); });
    effect(() => {
      void [e.selection.value, e.layers.value, e.time.value, e.drag.value === null, e.playing.value, e.selectedEvent.value];
      stage.invalidate('agents', 'overlay');
    });
    effect(() => {
      const m = e.motion.value;
      if (m !== lastMotion && m.driving !== lastMotion.driving) this.reactFrom = { motion: lastMotion, at: performance.now() };
      lastMotion = m;
      stage.invalidate('agents', 'overlay');
    });
    effect(() => {
      void [e.draft.value, e.changes.value, e.showBefore.value, e.hover.value, e.hoverFuture.value, e.hoverGrip.value, e.localReach.value, e.liveReach.value, e.measure.value];
      stage.invalidate('overlay');
    });
  }

  private paintMap(g: G, v: View): void {
    if (this.map) this.map.paint(g, v, this.editor.layers.value.lanes);
    else {
      g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
      g.fillStyle = colours()['map-ground'];
      g.fillRect(0, 0, v.w, v.h);
    }
  }

  /** Where a road user stands at the playhead; moving over from the old answer to the new one within 320 ms. */
  poseNow(a: Agent): Pose | null {
    const { editor: e } = this;
    const t = e.time.value;
    if (t < 0.05) return startPose(a) ?? poseAt(a.log, t);
    const p = poseAt(e.motionFor(a), t);
    if (!p || !this.reactFrom) return p;
    const k = (performance.now() - this.reactFrom.at) / REACT_MS;
    if (k >= 1) { this.reactFrom = null; return p; }
    const old = poseAt(motionOf(e.scene.value!, this.reactFrom.motion, a), t);
    this.stage.invalidate('agents');
    return old ? mixPose(old, p, 1 - (1 - k) ** 3) : p;
  }

  private paintAgents(g: G, v: View): void {
    const { editor: e } = this;
    const scene = e.scene.value;
    if (!scene) return;
    const dragging = e.drag.value !== null;
    paintSignals(g, v, scene, e.time.value);
    const box = v.box(40);
    const shown: [Agent, Pose][] = [];
    for (const a of scene.agents.values()) {
      if (a.id === e.selection.value) continue;
      const p = this.poseNow(a);
      if (p && p.x > box.x0 && p.x < box.x1 && p.y > box.y0 && p.y < box.y1) shown.push([a, p]);
    }
    // Parked below, large before small, so that nobody on foot hides under a bus.
    shown.sort((p, q) => Number(q[0].parked) - Number(p[0].parked) || q[0].length * q[0].width - p[0].length * p[0].width);
    if (e.layers.value.futures && !e.selection.value && !e.playing.value) for (const [a] of shown) this.softTrail(g, v, a);
    g.globalAlpha = dragging ? 0.62 : 1;
    for (const [a, p] of shown) stamp(g, v, a, p);
    g.globalAlpha = 1;
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    if (e.layers.value.labels || v.z > 16) this.nameLabels(g, v, shown);
  }

  private softTrail(g: G, v: View, a: Agent): void {
    if (a.parked || v.z < 3) return;
    const t = this.editor.time.value;
    trail(g, v, this.editor.motionFor(a), { colour: colours()[colourKey(a)], width: 1.4, alpha: 0.5, dash: [2, 3.5], from: t, to: t + 3.5, cap: 'butt' });
  }

  private nameLabels(g: G, v: View, shown: [Agent, Pose][]): void {
    if (v.z < 5) return;
    const labels = new Labels(v.w, v.h);
    for (const [, p] of shown) labels.block(v.x(p.x) - 9, v.y(p.y) - 7, 18, 14);
    for (const [a, p] of shown) {
      if (a.parked) continue;
      const half = sizeOnScreen(a, v.z)[1] / 2 + 12;
      pill(g, labels, v.x(p.x), v.y(p.y), a.name, { weight: 500, must: false, tries: [[-22, -half - 10], [-22, half - 8]] });
    }
  }

  private paintOverlay(g: G, v: View): void {
    const { editor: e } = this;
    const scene = e.scene.value;
    this.chips = [];
    this.timeTag = null;
    if (!scene) return;
    const { left, right } = v.inset;
    this.labels.reset(v.w, v.h, { left: left > 20 ? left - 12 : 0, right: right > 20 ? right - 12 : 0, top: 0, bottom: 0 });
    this.paintHover(g, v);
    const a = e.agent.value;
    if (e.showBefore.value) this.paintBefore(g, v);
    if (a) this.paintSelected(g, v, a);
    this.paintEvents(g, v);
    this.paintChangeLabels(g, v);
    this.paintMeasure(g, v);
  }

  private paintMeasure(g: G, v: View): void {
    const m = this.editor.measure.value;
    if (!m) return;
    const c = colours();
    polyline(g, v, [m.a, m.b], c.halo, 5, 1, [], 'round');
    polyline(g, v, [m.a, m.b], c.ink, 2, 1, [], 'round');
    this.tag(g, v.to((m.a[0] + m.b[0]) / 2, (m.a[1] + m.b[1]) / 2), metres(Math.hypot(m.a[0] - m.b[0], m.a[1] - m.b[1]), 1), { tries: [[-24, -28], [-24, 10]] });
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
      const h = paintHandles(g, this.labels, v, a, start, { colour: c.select, freeHeading: a.start.heading === null, freeSpeed: a.start.speed === null, tick: a.type === 'pedestrian' ? 1 : 10 / 3.6 });
      const unit = e.unitOf(a);
      const drag = e.drag.value?.grip;
      if (drag?.part === 'start' && drag.handle === 'heading') this.tag(g, h.knob, `${Math.round((start.heading * 180) / Math.PI)}°`, {});
      this.tag(g, h.tip, (a.start.speed === null ? '≈ ' : '') + speedLabel(start.speed, unit), { tries: [[-22, -32], [-22, 14], [14, -10]] });
    }
    if (!atStart && now && !e.playing.value) this.tag(g, [v.x(now.x), v.y(now.y)], speedLabel(now.speed, e.unitOf(a)), { radii: [30, 42, 56] });
    this.dragLabels(g, v, a, goal);
  }

  private tag(g: G, [x, y]: readonly [number, number], text: string, s: PillStyle): void { pill(g, this.labels, x, y, text, s); }

  private paintLaneGlow(g: G, v: View): void {
    const d = this.editor.drag.value;
    const lane = d?.laneId ? this.editor.scene.value!.map.lanes.get(d.laneId) : null;
    if (lane) polyline(g, v, lane.line.pts, d!.grip.part === 'goal' ? colours().goal : colours().vehicle, Math.min(3.2, lane.width) * v.z, 0.22);
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
    const inside = pts.filter((_, i) => r.path.s[i] <= cut), beyond = pts.filter((_, i) => r.path.s[i] >= cut - 3);
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
    const outdated = e.motion.value.stale && !d;
    if (d && d.id === a.id) d.earlier.forEach((old, i) => paintFutures(g, v, old, { chosen, alpha: TRAIL_ALPHA[i] ?? 0.1 }));
    const committed = touched(a) && !e.drag.value && e.time.value > 0.05 && e.hoverFuture.value === null;
    paintFutures(g, v, f, { chosen, only: e.hoverFuture.value, outdated, alpha: outdated ? 0.6 : 1, onlyChosen: committed });
    if (f.sketch) {
      const m = f.modes[0].motion, i = m.x.length >> 1;
      pill(g, this.labels, v.x(m.x[i]), v.y(m.y[i]), 'sketch', { fg: colours()['ink-2'] });
      return;
    }
    this.chips = paintChips(g, this.labels, v, f, this.chipIndexes(a, f.modes.length, committed), chosen);
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
      const p = poseAt(m, s), q = poseAt(a.log, s);
      if (p && q) polyline(g, v, [[p.x, p.y], [q.x, q.y]], c.log, 1, 0.45);
    }
    if (t < 0.05) return;
    polyline(g, v, [[now.x, now.y], [ghost.x, ghost.y]], c.log, 2);
    paintGhost(g, v, a, ghost, c.log, 'rgba(255,255,255,.5)', [4, 3], 2);
    const d = Math.hypot(now.x - ghost.x, now.y - ghost.y);
    this.tag(g, [v.x(ghost.x), v.y(ghost.y)], 'Log', { fg: c.log, border: c.log, tries: [[-16, 16], [-16, -36]] });
    if (d > 1) this.tag(g, [v.x((now.x + ghost.x) / 2), v.y((now.y + ghost.y) / 2)], `${num(d, 1)} m apart at ${seconds(t)}`, { leader: c.log, radii: [52, 72, 96] });
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
      const h = paintHandles(g, this.labels, v, a, goal, { colour, freeHeading: a.goal.heading === null, freeSpeed: a.goal.speed === null, tick: a.type === 'pedestrian' ? 1 : 10 / 3.6 });
      if (a.goal.speed !== null || (drag?.part === 'goal' && drag.handle === 'speed')) this.tag(g, h.tip, speedLabel(goal.speed, unit), { tries: [[14, -10], [-22, 14], [-22, -32]], bg: colour, fg: c.surface });
    }
    paintFlag(g, this.labels, x, y, colour, !goal.set);
    if (bad) this.paintNearest(g, v, a, bad.nearest);
    const text = bad ? bad.title : goal.set ? `Goal · ${seconds(a.goal.time)}` : 'Goal · free';
    if (drag?.part === 'goal' && drag.handle === 'body') return;
    const r = pill(g, this.labels, x, y, text, bad ? { tries: [[32, -44], [-150, -44]], bg: c.near, fg: c['on-near'], icon: 'triangle' } : { fg: c['goal-text'], tries: [[30, -42], [30, -20], [-100, -42], [-100, 6], [30, 6]] });
    if (goal.set && r) this.timeTag = r;
  }

  /** The verdict on the goal: the generator's where it is known, the local one during the drag. */
  private unreachable(a: Agent): { title: string; nearest: OnLine | null } | null {
    const { editor: e } = this;
    const live = e.liveReach.value?.id === a.id ? e.liveReach.value.reach : !e.drag.value && !e.motion.value.stale ? e.motion.value.reach.get(a.id) : null;
    const local = e.localReach.value;
    if (live) return live.status === 'unreachable' ? { title: local && local.kind !== 'ok' ? local.title : `Out of reach in ${seconds(a.goal.time)}`, nearest: live.nearest } : null;
    return local && local.kind !== 'ok' && a.goal.pos ? { title: local.title, nearest: local.nearest } : null;
  }

  private paintNearest(g: G, v: View, a: Agent, nearest: OnLine | null): void {
    if (!nearest) return;
    const c = colours();
    paintGhost(g, v, a, nearest, c.goal, c['goal-soft'], [], 2);
    const x = v.x(nearest.x), y = v.y(nearest.y);
    paintFlag(g, this.labels, x, y, c.goal, true);
    const r = this.editor.localReach.value;
    this.tag(g, [x, y], r?.kind === 'far' ? `Nearest reachable · ${metres(r.max, 0)}` : 'Nearest reachable', { tries: [[34, -26], [-170, -26], [34, 8]], bg: c.goal, fg: c.surface });
    if (r?.kind === 'far' && a.goal.pos) {
      const beyond = r.along - r.max;
      this.tag(g, [(x + v.x(a.goal.pos[0])) / 2, (y + v.y(a.goal.pos[1])) / 2], `${metres(beyond, 0)} beyond reach`, { weight: 500, must: false });
    }
  }

  private dragLabels(g: G, v: View, a: Agent, goal: Pose | null): void {
    const d = this.editor.drag.value;
    if (!d || d.grip.handle !== 'body') return;
    const c = colours();
    const p = d.grip.part === 'goal' ? goal : startPose(a);
    if (!p) return;
    const [x, y] = v.to(p.x, p.y);
    const r = this.editor.localReach.value;
    if (d.laneName) this.tag(g, [x, y], `on ${d.laneName}`.replace('on on foot', 'on foot').replace('on off', 'off').replace('on inside', 'inside'), { tries: [[34, -46], [-150, -46], [34, 12]], bg: d.grip.part === 'goal' ? c.goal : c.select, fg: d.grip.part === 'goal' ? c.surface : c.halo });
    if (d.grip.part === 'goal' && r) this.tag(g, [x, y], `at ${seconds(a.goal.time)} · ${metres(r.along, 0)} along the way`, { weight: 500, tries: [[34, -22], [-170, -22], [34, 36]] });
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
      trail(g, v, ch.before, { colour: c['ink-2'], width: 1.4, dash: [5, 4], alpha: 0.75, halo: true, from: t, cap: 'butt' });
      trail(g, v, e.motionFor(a), { colour: c[colourKey(a)], width: 2.4, halo: true, dots: true, from: t });
      const p = poseAt(ch.before, t), q = this.poseNow(a);
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
      if (p) this.tag(g, [v.x(p.x), v.y(p.y)], `${ch.name} ${ch.short}`, { leader: colours().ink, radii: [44, 60, 84, 110], must: false });
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
      const x = v.x(ev.at[0]), y = v.y(ev.at[1]);
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
      const gap = ev.facts.find(([k]) => k === 'Closest gap')?.[1];
      const text = hit ? `Collision · ${ev.title}` : `${seconds(ev.time)} · ${gap ? `${gap} to ` : ''}${ev.b.name}`;
      this.tag(g, [x, y], text, { leader: hit ? c.collision : c['near-text'], radii: [44, 60, 84], bg: hit ? c.collision : c.near, fg: hit ? c['on-collision'] : c['on-near'], height: 22, icon: hit ? 'cross' : 'triangle' });
    }
  }

  /** Text of the hover card. */
  hoverWords(): { title: string; line: string } | null {
    const { editor: e } = this;
    const id = e.hover.value;
    const a = id && id !== e.selection.value ? e.scene.value?.agents.get(id) : null;
    const p = a && this.poseNow(a);
    if (!a || !p || e.drag.value) return null;
    const where = a.parked ? 'parked' : laneWords(e.scene.value!.map, a, p.x, p.y, p.heading);
    const next = e.events.value.find((v) => (v.a.id === a.id || v.b.id === a.id) && v.time >= e.time.value);
    const todo = a.type === 'other' ? 'Shown only' : a.logStart ? (e.time.value < 0.05 ? 'Click to edit · drag to move' : 'Click to edit') : 'Appears later: not editable';
    return { title: `${a.name} · ${speedLabel(p.speed, e.unitOf(a))} · ${where}`, line: next ? `${next.label} · ${todo}` : todo };
  }
}
