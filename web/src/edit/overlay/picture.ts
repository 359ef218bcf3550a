// Paints the canvases for the current state of the editor. A drag frame paints only the overlay.
import type { Pen } from '../../draw/pen';
import { effect } from '@preact/signals-core';
import { mixPose, type Pose } from '../../model/base/geometry';
import { isStill, poseAt } from '../../model/base/motion';
import { motionOf } from '../../model/physics/playback';
import { conflictZones, type Zone } from '../../model/physics/conflicts';
import type { MotionSet } from '../../model/document/futures';
import type { LaneMap } from '../../model/document/lanemap';
import { isRecorded, startPose, type Agent, type Scene } from '../../model/document/scene';
import { speedLabel } from '../../model/base/units';
import { paintLimits, paintZones } from '../../draw/ground';
import { Labels, pill, Taken, type Rect } from '../../draw/labels';
import { paintLock, paintPennant, type Pennant } from '../../draw/marks';
import { boxOnScreen, colourKey, sizeOnScreen, stamp } from '../../draw/sprites';
import { trail } from '../../draw/strokes';
import { paintSignals } from '../../draw/signals';
import { colours } from '../../draw/theme';
import { MapPicture } from '../../draw/paint-map';
import type { Stage } from '../../draw/stage';
import type { View } from '../../draw/view';
import type { Change } from '../../model/words/change-words';
import type { Editor } from '../session/editor';
import { laneWords } from '../moves/snap';
import { TEXTS } from '../../texts/editing/picture';

const REACT_MS = 320;

/** More labels would cover the road users; the list is complete. */
export const LABELS = 3;

/** Reactions with a label, which has the name of the road user, too. */
export const labelledChanges = (e: Pick<Editor, 'answers' | 'playhead' | 'view'>): readonly Change[] =>
  e.view.showBefore.value && !e.view.beside.value && !e.playhead.playing.value
    ? e.answers.changes.value.slice(0, LABELS)
    : [];

/** Are all moving road users named? By the layer, or from a near view. */
export const namesAll = (e: Pick<Editor, 'view'>, v: View): boolean =>
  v.z > 16 || (v.z >= 5 && e.view.layers.value.labels);

export class Picture {
  private map: MapPicture | null = null;
  /** Last painted places of road users and their names, in pixels: labels avoid them. */
  taken = new Taken([]);
  /** Last painted places of pennants, for the pointer. */
  pennants: Pennant[] = [];
  private zones: { map: LaneMap; scene: Scene; set: MotionSet; all: readonly Zone[] } | null = null;
  private reactFrom: { motion: MotionSet; at: number } | null = null;

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
    let lastMotion = e.answers.motion.peek();
    effect(() => {
      const s = e.view.mapDraft.scene.value ?? e.scene.value;
      if (s && s.map !== mapOf) {
        mapOf = s.map;
        this.map = new MapPicture(s.map, isRecorded(s.source));
        stage.invalidate('map');
      }
      stage.invalidate('overlay');
      // During a drag the others do not move, so their canvas is not repainted.
      if (!e.drag.info.peek()) stage.invalidate('agents');
    });
    effect(() => {
      void [e.view.layers.value.lanes, e.view.layers.value.limits && e.view.speedUnit.value];
      stage.invalidate('map');
    });
    effect(() => {
      void [
        e.selected.value,
        e.view.layers.value,
        e.playhead.time.value,
        e.drag.active.value,
        e.playhead.playing.value,
        e.selectedEvent.value,
      ];
      stage.invalidate('agents', 'overlay');
    });
    effect(() => {
      const m = e.answers.motion.value;
      if (m !== lastMotion && m.driving !== lastMotion.driving)
        this.reactFrom = { motion: lastMotion, at: performance.now() };
      lastMotion = m;
      stage.invalidate('agents', 'overlay');
    });
    effect(() => {
      void [e.reading.cards.hand.value, e.reading.cards.current.value];
      stage.invalidate('agents', 'overlay');
    });
    effect(() => {
      void [e.reading.live.isOn.value, e.reading.live.frames.value, e.view.triedSignals.value];
      stage.invalidate('agents', 'overlay');
    });
    effect(() => {
      void e.answers.draft.value;
      stage.soon('overlay');
    });
    effect(() => {
      void [
        e.answers.changes.value,
        e.answers.previewed.value,
        e.view.showPreviewed.value,
        e.view.showBefore.value,
        e.hover.value,
        e.hoverFuture.value,
        e.hoverGrip.value,
        e.keyed.value,
        e.reading.localReach.value,
        e.answers.liveReach.value,
        e.measure.value,
        e.sweep.value,
        e.view.beside.value,
        e.view.tries.value,
        e.notices.toast.value,
        e.view.speedUnit.value,
      ];
      stage.invalidate('overlay');
    });
  }

  private paintMap(g: Pen, v: View): void {
    const { scene, view } = this.editor;
    const { layers, speedUnit } = view;
    if (this.map) this.map.paint(g, v, layers.value.lanes);
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    if (this.map && layers.value.limits) paintLimits(g, v, scene.value!.map, speedUnit.value);
    if (!this.map) {
      g.fillStyle = colours()['map-ground'];
      g.fillRect(0, 0, v.w, v.h);
    }
  }

  /** Pose of a road user at the playhead; blends from the old answer to the new one within 320 ms. */
  poseNow(a: Agent): Pose | null {
    const { editor: e } = this;
    const { live } = e.reading;
    if (live.isOn.value) return live.poseOf(a.id);
    const t = e.playhead.time.value;
    if (t < 0.05) return startPose(a) ?? poseAt(a.log, t);
    const p = poseAt(e.reading.motionFor(a), t);
    if (!p || !this.reactFrom) return p;
    const k = (performance.now() - this.reactFrom.at) / REACT_MS;
    if (k >= 1) {
      this.reactFrom = null;
      return p;
    }
    const old = poseAt(motionOf(e.scene.value!, this.reactFrom.motion, a), t);
    // Rings and labels move too.
    this.stage.invalidate('agents', 'overlay');
    return old ? mixPose(old, p, 1 - (1 - k) ** 3) : p;
  }

  private paintAgents(g: Pen, v: View): void {
    const { editor: e } = this;
    const making = e.view.mapDraft.scene.value;
    if (making) {
      this.taken = new Taken([]);
      this.pennants = [];
      paintSignals(g, v, making, e.playhead.time.value);
      return;
    }
    const scene = e.scene.value;
    if (!scene) return;
    const dragging = e.drag.info.value !== null;
    if (e.view.layers.value.conflicts) paintZones(g, v, this.conflicts(scene));
    if (e.view.layers.value.signals)
      paintSignals(g, v, { ...scene, signals: e.view.triedSignals.value ?? scene.signals }, e.playhead.time.value);
    const live = e.reading.live.isOn.value;
    const selected = new Set(live ? [] : e.selected.value);
    const shown: [Agent, Pose][] = [];
    for (const a of scene.agents.values()) {
      if (selected.has(a.id)) continue;
      const p = this.poseNow(a);
      if (p && v.shows(p.x, p.y, 40)) shown.push([a, p]);
    }
    // Parked below, large before small, so that no pedestrian is hidden under a bus.
    shown.sort(
      (p, q) => Number(q[0].parked) - Number(p[0].parked) || q[0].length * q[0].width - p[0].length * p[0].width,
    );
    const ways = e.view.layers.value.futures && (!selected.size || e.reading.cards.shownSet() !== null);
    if (ways && !live && !e.playhead.playing.value) for (const [a] of shown) this.softTrail(g, v, a);
    g.globalAlpha = dragging ? 0.62 : 1;
    for (const [a, p] of shown) stamp(g, v, a, p, a.parked && this.drives(a));
    g.globalAlpha = 1;
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    this.paintMarks(g, v, shown);
    const names = namesAll(e, v) ? this.nameLabels(g, v, shown) : [];
    this.taken = new Taken([...shown.map(([a, p]) => boxOnScreen(v, a, p)), ...names]);
  }

  /** Computed again when a motion changes; during a drag they stay. */
  private conflicts(scene: Scene): readonly Zone[] {
    const { answers, drag } = this.editor;
    const set = answers.motion.peek();
    if (this.zones?.map === scene.map && (drag.active.peek() || (this.zones.set === set && this.zones.scene === scene)))
      return this.zones.all;
    this.zones = { map: scene.map, scene, set, all: conflictZones(scene, set) };
    return this.zones.all;
  }

  /** Pennants at the goals of all except the single selected one, and locks. */
  private paintMarks(g: Pen, v: View, shown: [Agent, Pose][]): void {
    const { editor: e } = this;
    this.pennants = [];
    if (v.z < 2 || e.reading.live.isOn.value) return;
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

  /** Parked in the recording, and driving now. */
  private drives(a: Agent): boolean {
    const m = this.editor.reading.motionFor(a);
    return m !== a.log && !isStill(m);
  }

  private softTrail(g: Pen, v: View, a: Agent): void {
    if (a.parked || v.z < 3) return;
    const t = this.editor.playhead.time.value;
    trail(g, v, this.editor.reading.motionFor(a), {
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
    const reacting = new Set(labelledChanges(this.editor).map((c) => c.id));
    const spoken = this.editor.reading.named.value;
    const labels = new Labels(v);
    for (const [, p] of shown) {
      const [x, y] = v.to(p.x, p.y);
      labels.block(x - 9, y - 7, 18, 14);
    }
    for (const [a, p] of shown) {
      if (a.parked || reacting.has(a.id) || a.id === spoken) continue;
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
    if (!a || !p || e.drag.info.value) return null;
    const where = a.parked ? TEXTS.parked : laneWords(e.scene.value!.map, a, p.x, p.y, p.heading);
    const next = e.reading.events.value.find(
      (v) => (v.a.id === a.id || v.b?.id === a.id) && v.time >= e.playhead.time.value,
    );
    const todo =
      a.type === 'other'
        ? TEXTS.notEditable
        : a.logStart
          ? e.playhead.time.value < 0.05
            ? TEXTS.clickToEditDrag
            : TEXTS.clickToEdit
          : TEXTS.appearsLater;
    return {
      title: `${a.name} · ${speedLabel(p.speed, e.view.unitOf(a))} · ${where}`,
      line: next ? `${next.label} · ${todo}` : todo,
    };
  }
}
