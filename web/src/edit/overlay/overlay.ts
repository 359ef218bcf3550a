// The overlay: selection, handles, futures, labels, ghosts, events. A drag frame paints only this canvas.
import type { Pen } from '../../draw/pen';
import type { Pose } from '../../model/base/geometry';
import { endPose, endsBefore, poseAt } from '../../model/base/motion';
import { comparedWithLog } from '../../model/words/change-words';
import type { Futures } from '../../model/document/futures';
import { canChange, canMove, isPlaced, startPose, touched, type Agent, type Scene } from '../../model/document/scene';
import { metres, seconds, speedLabel } from '../../model/base/units';
import { Labels, pill, tag, type Rect, type Taken } from '../../draw/labels';
import { paintGhost, paintHandles, paintRing } from '../../draw/handles';
import { colourKey, sizeOnScreen, stamp } from '../../draw/sprites';
import { paintChips, paintFutures, polyline, trail, type Chip } from '../../draw/strokes';
import { colours } from '../../draw/theme';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';
import { outOfReach, verdictsHold } from '../moves/goal-verdict';
import { paintBeside, paintMeeting, paintTried, paintTries } from './beside';
import { ChangesOverlay } from './changes';
import { EventsOverlay } from './events';
import { GhostOverlay } from './ghosts';
import { GoalOverlay } from './goal';
import { HoveredOverlay } from './hovered';
import { NamesOverlay } from './named';
import { shownPose } from '../moves/moves';
import { paintPins, paintPinWords } from './pins';
import { QuietDrag } from './quiet-drag';
import { SeveralOverlay } from './several';
import type { ToolOverlay } from './tool-overlay';
import { VerdictOverlay } from './verdicts';
import { paintVias } from './via';
import { pinsApart } from '../moves/pins';
import { TEXTS } from '../../texts/editing/picture';

/** Alpha of earlier refinement steps, newest first. */
const TRAIL_ALPHA = [0.34, 0.22, 0.16];

/** Radius of the ring around the handle that keys move, outside the handle itself, pixels. */
const KEYED_PX = 15;

/** Cards over the picture, in its pixels: labels never cover the fixed ones, and passing ones only for want of room. */
export interface CardsOver {
  readonly fixed: readonly Rect[];
  readonly passing: readonly Rect[];
}

export class Overlay {
  /** Painted places of the letters, for the pointer. */
  chips: Chip[] = [];
  private readonly labels = new Labels();
  private readonly goal: GoalOverlay;
  private readonly changes: ChangesOverlay;
  private readonly verdicts: VerdictOverlay;
  private readonly events: EventsOverlay;
  private readonly ghosts: GhostOverlay;
  private readonly several: SeveralOverlay;
  private readonly hovered: HoveredOverlay;
  private readonly names: NamesOverlay;
  private readonly quiet: QuietDrag;

  constructor(
    private readonly editor: Editor,
    private readonly tools: readonly ToolOverlay[],
    private readonly poseNow: (a: Agent) => Pose | null,
    /** Areas of the picture underneath to be kept free. */
    private readonly below: () => Taken,
    private readonly cards: () => CardsOver,
  ) {
    this.goal = new GoalOverlay(editor, this.labels, () => this.isDecided);
    this.events = new EventsOverlay(editor, this.labels, poseNow);
    this.verdicts = new VerdictOverlay(editor, this.labels);
    this.changes = new ChangesOverlay(editor, this.labels, poseNow);
    this.ghosts = new GhostOverlay(editor, this.labels, poseNow);
    this.several = new SeveralOverlay(editor, this.labels, poseNow);
    this.hovered = new HoveredOverlay(editor);
    this.names = new NamesOverlay(editor, this.labels, poseNow);
    this.quiet = new QuietDrag(editor);
  }

  /** Painted place of the time tag, for the pointer. */
  get timeTag(): GoalOverlay['timeTag'] {
    return this.goal.timeTag;
  }

  /** Painted place of the flag's tag at the edge, for the pointer. */
  get edgeTag(): GoalOverlay['edgeTag'] {
    return this.goal.edgeTag;
  }

  /** Painted place of the road route's sign, for the pointer. */
  get roadSign(): VerdictOverlay['roadSign'] {
    return this.verdicts.roadSign;
  }

  /** Is an animation running or a part still loading? Then the overlay needs another frame. */
  get moving(): boolean {
    return this.ghosts.fading || this.hovered.running || this.tools.some((t) => t.coming);
  }

  paint(g: Pen, v: View): void {
    const { editor: e } = this;
    const scene = e.scene.value;
    this.chips = [];
    this.goal.timeTag = this.goal.edgeTag = null;
    this.verdicts.roadSign = null;
    const alone = this.tools.find((t) => t.isAlone);
    if (!scene && !alone) return;
    const { left, right } = v.inset;
    this.labels.reset(v, {
      left: left > 20 ? left - 12 : 0,
      right: right > 20 ? right - 12 : 0,
      top: 0,
      bottom: 0,
    });
    const cards = this.cards();
    for (const { x, y, w, h } of cards.fixed) this.labels.block(x, y, w, h);
    if (alone || !scene) {
      alone?.paint?.(g, v, this.labels);
      return;
    }
    this.labels.hold();
    this.labels.keepOffAll(this.below());
    for (const card of cards.passing) this.labels.keepOff(card);
    this.paintScene(g, v, scene);
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    g.globalAlpha = 1;
    this.labels.release();
  }

  private paintScene(g: Pen, v: View, scene: Scene): void {
    const { editor: e } = this;
    this.paintHover(g, v);
    const a = e.agent.value;
    const beside = e.view.beside.value;
    // The many tries are hidden during a drag, which goes first.
    if (!e.drag.info.value) paintTries(g, v, e.view.tries.value);
    if (beside) paintBeside(g, v, beside, e.playhead.time.value);
    if (e.view.showBefore.value && !beside) this.changes.paintBefore(g, v);
    this.ghosts.paint(g, v);
    const quiet = this.quiet.is(a);
    if (a) this.paintSelected(g, v, a, quiet);
    else this.hovered.stop();
    if (beside?.tried) paintTried(g, v, this.labels, beside, scene, (of) => e.view.unitOf(of));
    if (beside) paintMeeting(g, v, this.labels, beside, e.playhead.time.value);
    if (!beside?.meeting) {
      this.several.paint(g, v);
      for (const tool of this.tools) tool.paint?.(g, v, this.labels);
    }
    if (!quiet) this.ghosts.paintLabels(g, v);
    this.events.paint(g, v);
    const labelled = this.changes.paintChangeLabels(g, v);
    if (!beside) this.names.paint(g, v, labelled);
    this.paintMeasure(g, v);
  }

  private paintMeasure(g: Pen, v: View): void {
    const m = this.editor.measure.value;
    if (!m) return;
    const c = colours();
    polyline(g, v, [m.a, m.b], c.halo, 5, 1, [], 'round');
    polyline(g, v, [m.a, m.b], c.ink, 2, 1, [], 'round');
    tag(
      g,
      this.labels,
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

  private paintHover(g: Pen, v: View): void {
    const { editor: e } = this;
    const id = e.hover.value;
    const a = id && !e.selected.value.includes(id) ? e.scene.value!.agents.get(id) : null;
    const p = a && this.poseNow(a);
    if (!a || !p || e.drag.info.value) return;
    const t = e.playhead.time.value;
    trail(g, v, e.reading.motionFor(a), {
      colour: colours()[colourKey(a)],
      width: 2.5,
      halo: true,
      dots: true,
      from: t,
    });
    stamp(g, v, a, p, true);
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    paintRing(g, v, a, p, colours().select, 1.5);
  }

  private paintSelected(g: Pen, v: View, a: Agent, quiet: boolean): void {
    const { editor: e } = this;
    const c = colours();
    const start = startPose(a);
    const now = this.poseNow(a);
    const atStart = e.playhead.time.value < 0.05;
    const goal = canChange(a) ? e.reading.goalPose(a) : null;
    this.goal.paintLaneGlow(g, v);
    if (e.view.layers.value.reach) this.goal.paintAllReach(g, v, a);
    this.goal.paintReach(g, v, a);
    const pins = this.six ? pinsApart(e) : [];
    paintPins(g, v, pins, e.drag.info.value !== null || e.hoverFuture.value !== null);
    if (this.six) this.paintSix(g, v, a);
    if (e.view.layers.value.log) this.paintLog(g, v, a, now);
    this.hovered.paint(g, v, a);
    if (!atStart && start) paintGhost(g, v, a, start, c['ink-2'], null, [], 1.25);
    if (now) {
      const [l] = sizeOnScreen(a, v.z);
      const [x, y] = v.to(now.x, now.y);
      this.labels.block(x - l / 2 - 4, y - 14, l + 8, 28);
    }
    if (goal) {
      this.goal.paintGoal(g, v, a, goal);
      this.goal.paintEdgeTag(g, v, a, now, goal);
    }
    if (now) {
      stamp(g, v, a, now, true);
      g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
      paintRing(g, v, a, now, c.select);
    }
    if (atStart && start && canMove(a)) {
      const h = paintHandles(g, this.labels, v, a, start, {
        colour: c.select,
        freeHeading: a.start.heading === null,
        freeSpeed: a.start.speed === null,
        tick: a.type === 'pedestrian' ? 1 : 10 / 3.6,
      });
      const unit = e.view.unitOf(a);
      const drag = e.drag.info.value?.grip;
      if (drag?.part === 'start' && drag.handle === 'heading')
        tag(g, this.labels, h.knob, `${Math.round((start.heading * 180) / Math.PI)}°`, {});
      // Under fingers the picture is small, and the sheet has the speed.
      if ((!quiet && v.grip === 1) || drag?.handle === 'speed')
        tag(g, this.labels, h.tip, (a.start.speed === null ? '≈ ' : '') + speedLabel(start.speed, unit), {
          tries: [
            [-22, -32],
            [-22, 14],
            [14, -10],
          ],
        });
    }
    if (!atStart && now && !e.playhead.playing.value)
      tag(
        g,
        this.labels,
        v.to(now.x, now.y),
        TEXTS.speedAt(speedLabel(now.speed, e.view.unitOf(a)), seconds(e.playhead.time.value)),
        { radii: [30, 42, 56] },
      );
    const bad = goal ? outOfReach(e, a) : null;
    if (bad?.nearest && !bad.outranked) this.goal.labelNearest(g, v, a, bad.nearest, quiet);
    paintVias(g, this.labels, v, e, a);
    for (const tool of this.tools) tool.paintSelected?.(g, v, this.labels, a);
    this.paintWords(g, v, a, quiet);
    this.paintLetters(g, v, a);
    if (!e.drag.info.value) paintPinWords(g, this.labels, v, pins);
    this.goal.dragLabels(g, v, a, goal, quiet);
    this.paintKeyed(g, v, a);
  }

  /** Around the handle that keys move. */
  private paintKeyed(g: Pen, v: View, a: Agent): void {
    const keyed = this.editor.keyed.value;
    const pose = keyed && keyed.via === null ? shownPose(this.editor, a, keyed.part) : null;
    const at = keyed?.via != null ? a.goal.via[keyed.via]?.pos : pose && ([pose.x, pose.y] as const);
    if (!at) return;
    g.strokeStyle = colours().focus;
    g.lineWidth = 2.5;
    g.beginPath();
    g.arc(...v.to(at[0], at[1]), KEYED_PX * v.grip, 0, 2 * Math.PI);
    g.stroke();
  }

  /** Are the futures of the selected road user shown? While whole-scene cards are shown, they are not. */
  private get six(): boolean {
    return this.editor.view.layers.value.futures && !this.editor.reading.cards.shownSet();
  }

  private get isDecided(): boolean {
    return this.tools.some((t) => t.isDecided);
  }

  /** Is a change being tried? The current state is dimmed behind it. */
  private get trying(): boolean {
    return this.editor.view.beside.value?.tried === true;
  }

  private paintSix(g: Pen, v: View, a: Agent): void {
    const { editor: e } = this;
    const f = e.reading.futures.value;
    if (!f) return;
    const chosen = e.reading.bold.value;
    const d = e.answers.draft.value;
    const outdated = e.reading.outdated.value;
    if (d && d.id === a.id)
      d.earlier.forEach((old, i) => paintFutures(g, v, old, { chosen, alpha: TRAIL_ALPHA[i] ?? 0.1 }));
    const committed = this.committed(a);
    const judged = this.judged(a, f);
    const until = this.tooFar(a) ? a.goal.time : undefined;
    this.verdicts.paintRoadBand(g, v, a);
    this.verdicts.paintGround(g, v, a, f, judged, until);
    paintFutures(g, v, f, {
      chosen,
      only: e.hoverFuture.value,
      outdated,
      alpha: this.trying ? 0.25 : outdated ? 0.6 : 1,
      onlyChosen: committed,
      until,
      said: e.reading.cards.ofAgent(a.id) ? e.reading.cards.verdicts() : [],
    });
    this.verdicts.paintStretches(g, v, f, judged, until);
    if (e.reading.replays.value)
      trail(g, v, a.log, { colour: colours().ink, width: 2, from: 0, halo: true, dash: [5, 4] });
    if (f.sketch) {
      const m = f.modes[0].motion,
        i = m.x.length >> 1;
      pill(g, this.labels, ...v.to(m.x[i], m.y[i]), TEXTS.sketch, { fg: colours()['ink-2'] });
      return;
    }
  }

  /** Futures with shown verdicts; none for futures from before a change. */
  private judged(a: Agent, f: Futures): readonly number[] {
    const { editor: e } = this;
    if (!verdictsHold(e) || this.trying) return [];
    const one = this.committed(a) || this.tooFar(a) || this.isDecided;
    const only = e.hoverFuture.value ?? (one ? e.reading.chosen.value : null);
    // A road user that nothing was asked of has only possible futures: their faults are shown one at a time.
    if (only === null && e.reading.replays.value) return [];
    if (only !== null) return only < f.modes.length ? [only] : [];
    return f.modes.map((_, i) => i);
  }

  /** Its goal is unreachable without a more serious fault: the futures end at the reachable place. */
  private tooFar(a: Agent): boolean {
    const bad = isPlaced(a.goal) ? outOfReach(this.editor, a) : null;
    return bad !== null && !bad.outranked && bad.nearest !== null;
  }

  /** Away from the start only the followed future is shown, since it is the motion of the scene. */
  private committed(a: Agent): boolean {
    const { editor: e } = this;
    if (!touched(a) || e.reading.cards.ofAgent(a.id) || e.drag.info.value || e.hoverFuture.value !== null) return false;
    // With a drawn speed profile the other futures do not apply.
    return e.playhead.time.value > 0.05 || this.isDecided;
  }

  private paintWords(g: Pen, v: View, a: Agent, quiet: boolean): void {
    const f = this.editor.reading.futures.value;
    if (!f || !this.six) return;
    this.verdicts.paintRoadWay(g, v, a, quiet);
    this.verdicts.paintWords(g, v, f, this.judged(a, f), this.tooFar(a) ? 1 : undefined);
  }

  private paintLetters(g: Pen, v: View, a: Agent): void {
    const f = this.editor.reading.futures.value;
    if (f && !f.sketch && this.six)
      this.chips = paintChips(
        g,
        this.labels,
        v,
        f,
        this.chipIndexes(a, f.modes.length, this.committed(a)),
        this.editor.reading.bold.value,
        this.tooFar(a) ? a.goal.time : undefined,
      );
  }

  /** With a goal all futures end together, so only those that miss it have their letter. */
  private chipIndexes(a: Agent, n: number, committed: boolean): number[] {
    const { editor: e } = this;
    const hovered = e.hoverFuture.value;
    if (hovered !== null && hovered < n) return [hovered];
    if (e.drag.info.value || committed) return [];
    const all = [...Array(n).keys()];
    const nearest = this.tooFar(a) ? outOfReach(e, a)!.nearest! : null;
    const pos = nearest ? ([nearest.x, nearest.y] as const) : a.goal.pos;
    if (!pos) return all;
    const f = e.reading.futures.value!;
    return all.filter((i) => {
      const m = f.modes[i].motion;
      if (endsBefore(m, a.goal.time)) return true;
      const p = poseAt(m, a.goal.time) ?? endPose(m);
      return Math.hypot(p.x - pos[0], p.y - pos[1]) > 5;
    });
  }

  private paintLog(g: Pen, v: View, a: Agent, now: Pose | null): void {
    const { editor: e } = this;
    const c = colours();
    const m = e.reading.motionFor(a);
    trail(g, v, a.log, { colour: c.log, width: 2, dash: [5, 4], halo: true, dots: true });
    const t = e.playhead.time.value;
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
    tag(g, this.labels, v.to(ghost.x, ghost.y), TEXTS.log, {
      fg: c.log,
      border: c.log,
      tries: [
        [-16, 16],
        [-16, -36],
      ],
    });
    if (d > 1)
      tag(g, this.labels, v.to((now.x + ghost.x) / 2, (now.y + ghost.y) / 2), TEXTS.apartAt(metres(d, 1), seconds(t)), {
        leader: c.log,
        radii: [52, 72, 96],
      });
  }
}
