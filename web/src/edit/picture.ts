// What is on the canvases for the present state of the editor. A drag frame paints the overlay alone.
import type { Pen } from '../draw/pen';
import { effect } from '@preact/signals-core';
import { mixPose, type Pose } from '../model/base/geometry';
import { isStill, poseAt } from '../model/base/motion';
import { motionOf } from '../model/physics/playback';
import { conflictZones, type Zone } from '../model/physics/conflicts';
import type { MotionSet } from '../model/document/futures';
import type { LaneMap } from '../model/document/lanemap';
import { isRecorded, startPose, type Agent, type Scene } from '../model/document/scene';
import { speedLabel } from '../model/base/units';
import { paintLimits, paintZones } from '../draw/ground';
import { Labels, pill, Taken, type Rect } from '../draw/labels';
import { paintLock, paintPennant, type Pennant } from '../draw/marks';
import { boxOnScreen, colourKey, sizeOnScreen, stamp } from '../draw/sprites';
import { trail } from '../draw/strokes';
import { paintSignals } from '../draw/signals';
import { colours } from '../draw/theme';
import { MapPicture } from '../draw/paint-map';
import type { Stage } from '../draw/stage';
import type { View } from '../draw/view';
import type { Editor } from './editor';
import { laneWords } from './snap';
import { TEXTS } from '../texts/editing/picture';

const REACT_MS = 320;

export class Picture {
  private map: MapPicture | null = null;
  /** Where road users and their names were painted last, in pixels: words over the picture keep off them. */
  taken = new Taken([]);
  /** Where pennants were painted last, for the pointer. */
  pennants: Pennant[] = [];
  private zones: { map: LaneMap; scene: Scene; set: MotionSet; all: readonly Zone[] } | null = null;
  private reactFrom: { motion: Editor['motion']['value']; at: number } | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly editor: Editor,
  ) {
    stage.painter('map', (g, v) => this.paintMap(g, v));
    stage.painter('agents', (g, v) => this.paintAgents(g, v));
    this.watch();
  }

  private watch(): void {
    const { editor: e, stage } = this;
    let mapOf: unknown = null;
    let lastMotion = e.motion.peek();
    effect(() => {
      const s = e.layouts.made.value?.scene ?? e.scene.value;
      if (s && s.map !== mapOf) {
        mapOf = s.map;
        this.map = new MapPicture(s.map, isRecorded(s.source));
        stage.invalidate('map');
      }
      stage.invalidate('overlay');
      // While a handle is dragged the others do not move, so their canvas is left alone.
      if (!e.drag.peek()) stage.invalidate('agents');
    });
    effect(() => {
      void [e.layers.value.lanes, e.layers.value.limits && e.speedUnit.value];
      stage.invalidate('map');
    });
    effect(() => {
      void [e.selected.value, e.layers.value, e.time.value, e.dragging.value, e.playing.value, e.selectedEvent.value];
      stage.invalidate('agents', 'overlay');
    });
    effect(() => {
      const m = e.motion.value;
      if (m !== lastMotion && m.driving !== lastMotion.driving)
        this.reactFrom = { motion: lastMotion, at: performance.now() };
      lastMotion = m;
      stage.invalidate('agents', 'overlay');
    });
    effect(() => {
      void [e.deck.hand.value, e.deck.current.value];
      stage.invalidate('agents', 'overlay');
    });
    effect(() => {
      void e.draft.value;
      stage.soon('overlay');
    });
    effect(() => {
      void [
        e.changes.value,
        e.foreseen.value,
        e.showForeseen.value,
        e.showBefore.value,
        e.hover.value,
        e.hoverFuture.value,
        e.hoverGrip.value,
        e.keyed.value,
        e.localReach.value,
        e.liveReach.value,
        e.measure.value,
        e.sweep.value,
        e.beside.value,
        e.tries.value,
        e.placement.ghosts.value,
        e.filling.wish.value,
        e.filling.drawn.value,
        e.filling.answer.value,
        e.layouts.made.value,
        e.layouts.arm.value,
        e.layouts.turned.value,
        e.layouts.hands.value,
        e.layouts.way.value,
        e.layouts.drawn.value,
        e.layouts.under.value,
        e.layouts.fault.value,
        e.notices.toast.value,
        e.speedUnit.value,
      ];
      stage.invalidate('overlay');
    });
  }

  private paintMap(g: Pen, v: View): void {
    const { layers, scene, speedUnit } = this.editor;
    if (this.map) this.map.paint(g, v, layers.value.lanes);
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    if (this.map && layers.value.limits) paintLimits(g, v, scene.value!.map, speedUnit.value);
    if (!this.map) {
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
    if (k >= 1) {
      this.reactFrom = null;
      return p;
    }
    const old = poseAt(motionOf(e.scene.value!, this.reactFrom.motion, a), t);
    // Rings and labels go along.
    this.stage.invalidate('agents', 'overlay');
    return old ? mixPose(old, p, 1 - (1 - k) ** 3) : p;
  }

  private paintAgents(g: Pen, v: View): void {
    const { editor: e } = this;
    const making = e.layouts.made.value;
    if (making) {
      this.taken = new Taken([]);
      this.pennants = [];
      paintSignals(g, v, making.scene, e.time.value);
      return;
    }
    const scene = e.scene.value;
    if (!scene) return;
    const dragging = e.drag.value !== null;
    if (e.layers.value.conflicts) paintZones(g, v, this.conflicts(scene));
    if (e.layers.value.signals) paintSignals(g, v, scene, e.time.value);
    const selected = new Set(e.selected.value);
    const shown: [Agent, Pose][] = [];
    for (const a of scene.agents.values()) {
      if (selected.has(a.id)) continue;
      const p = this.poseNow(a);
      if (p && v.shows(p.x, p.y, 40)) shown.push([a, p]);
    }
    // Parked below, large before small, so that nobody on foot hides under a bus.
    shown.sort(
      (p, q) => Number(q[0].parked) - Number(p[0].parked) || q[0].length * q[0].width - p[0].length * p[0].width,
    );
    const ways = e.layers.value.futures && (!selected.size || e.deck.shownSet() !== null);
    if (ways && !e.playing.value) for (const [a] of shown) this.softTrail(g, v, a);
    g.globalAlpha = dragging ? 0.62 : 1;
    for (const [a, p] of shown) stamp(g, v, a, p, a.parked && this.drives(a));
    g.globalAlpha = 1;
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    this.paintMarks(g, v, shown);
    const names = e.layers.value.labels || v.z > 16 ? this.nameLabels(g, v, shown) : [];
    this.taken = new Taken([...shown.map(([a, p]) => boxOnScreen(v, a, p)), ...names]);
  }

  /** Worked out anew when somebody does something else; while a hand moves they stay as they were. */
  private conflicts(scene: Scene): readonly Zone[] {
    const { motion, dragging } = this.editor;
    const set = motion.peek();
    if (this.zones?.map === scene.map && (dragging.peek() || (this.zones.set === set && this.zones.scene === scene)))
      return this.zones.all;
    this.zones = { map: scene.map, scene, set, all: conflictZones(scene, set) };
    return this.zones.all;
  }

  /** Pennants at the goals of all who are not selected alone, and locks. */
  private paintMarks(g: Pen, v: View, shown: [Agent, Pose][]): void {
    const { editor: e } = this;
    this.pennants = [];
    if (v.z < 2) return;
    for (const a of e.scene.value!.agents.values()) {
      if (!a.goal.pos || a.id === e.selection.value) continue;
      const [x, y] = v.to(...a.goal.pos);
      if (x < -20 || y < -20 || x > v.w + 20 || y > v.h + 30) continue;
      const pennant = { id: a.id, x, y };
      paintPennant(g, pennant, colourKey(a));
      this.pennants.push(pennant);
    }
    if (v.z < 6) return;
    for (const [a, p] of shown) if (a.locked) paintLock(g, ...v.to(p.x, p.y));
  }

  /** One that was parked in the log, and drives now. */
  private drives(a: Agent): boolean {
    const m = this.editor.motionFor(a);
    return m !== a.log && !isStill(m);
  }

  private softTrail(g: Pen, v: View, a: Agent): void {
    if (a.parked || v.z < 3) return;
    const t = this.editor.time.value;
    trail(g, v, this.editor.motionFor(a), {
      colour: colours()[colourKey(a)],
      width: 1.4,
      alpha: 0.5,
      dash: [2, 3.5],
      from: t,
      to: t + 3.5,
      cap: 'butt',
    });
  }

  private nameLabels(g: Pen, v: View, shown: [Agent, Pose][]): Rect[] {
    const names: Rect[] = [];
    if (v.z < 5) return names;
    const labels = new Labels(v.w, v.h);
    for (const [, p] of shown) {
      const [x, y] = v.to(p.x, p.y);
      labels.block(x - 9, y - 7, 18, 14);
    }
    for (const [a, p] of shown) {
      if (a.parked) continue;
      const half = sizeOnScreen(a, v.z)[1] / 2 + 12;
      const r = pill(g, labels, ...v.to(p.x, p.y), a.name, {
        weight: 500,
        must: false,
        tries: [
          [-22, -half - 10],
          [-22, half - 8],
        ],
      });
      if (r) names.push(r);
    }
    return names;
  }

  /** Text of the hover card. */
  hoverWords(): { title: string; line: string } | null {
    const { editor: e } = this;
    const id = e.hover.value;
    const a = id && !e.selected.value.includes(id) ? e.scene.value?.agents.get(id) : null;
    const p = a && this.poseNow(a);
    if (!a || !p || e.drag.value) return null;
    const where = a.parked ? TEXTS.parked : laneWords(e.scene.value!.map, a, p.x, p.y, p.heading);
    const next = e.events.value.find((v) => (v.a.id === a.id || v.b?.id === a.id) && v.time >= e.time.value);
    const todo =
      a.type === 'other'
        ? TEXTS.shownOnly
        : a.logStart
          ? e.time.value < 0.05
            ? TEXTS.clickToEditDrag
            : TEXTS.clickToEdit
          : TEXTS.appearsLater;
    return {
      title: `${a.name} · ${speedLabel(p.speed, e.unitOf(a))} · ${where}`,
      line: next ? `${next.label} · ${todo}` : todo,
    };
  }
}
