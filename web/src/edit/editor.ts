// The editing session: the document with its history, what is selected, and what is on screen. Everything a
// panel shows is a signal here; everything that changes the document goes through `run` or a drag.
import { batch, computed, signal, type Signal } from '@preact/signals-core';
import { History } from '../model/history';
import type { Command } from '../model/commands';
import { canChange, sceneKey, startPose, touched, type Agent, type Scene } from '../model/scene';
import { emptyMotion, MotionCache, type Futures, type MotionSet, type Reach } from '../model/futures';
import { findChanges, motionOf, type Change } from '../model/changes';
import { readEvents, type TrafficEvent } from '../model/events';
import { endPose, poseAtStep } from '../model/motion';
import { wrapAngle, type OnLine, type Pose, type Vec } from '../model/geometry';
import { localReach, type LocalReach } from '../model/reach';
import type { SpeedUnit } from '../model/units';
import { keep, recall } from '../net/storage';

export type Part = 'start' | 'goal';
export type HandleName = 'body' | 'heading' | 'speed' | 'time';
export interface Grip {
  readonly part: Part;
  readonly handle: HandleName;
}
export interface Layers {
  readonly futures: boolean;
  readonly log: boolean;
  readonly lanes: boolean;
  readonly labels: boolean;
}
export type Tool = 'select' | 'pan' | 'measure';
export interface Toast {
  readonly text: string;
  readonly undo?: boolean;
  readonly action?: { label: string; run: () => void };
}

export type Status =
  | { kind: 'loading' }
  | { kind: 'ready' }
  | {
      kind: 'refining';
      step: number;
      steps: number;
      ms: number;
      /** Seconds that a later window is about. */ part?: string;
    }
  | { kind: 'slow'; ms: number }
  | { kind: 'settled'; ms: number; adapted: number | null }
  | { kind: 'away' }
  | { kind: 'refused'; words: string };

/** Futures on their way: the latest draft and the ones before it, which stay behind as trails. */
export interface Draft {
  readonly id: string;
  readonly futures: Futures;
  readonly earlier: readonly Futures[];
}

export interface DragInfo {
  readonly grip: Grip;
  readonly laneName: string | null;
  readonly laneId: string | null;
  readonly stop: OnLine | null;
}

export class Editor {
  readonly scene: Signal<Scene | null> = signal(null);
  readonly selection = signal<string | null>(null);
  readonly hover = signal<string | null>(null);
  readonly hoverFuture = signal<number | null>(null);
  readonly hoverGrip = signal<Grip | null>(null);
  readonly focusPart = signal<Part>('start');
  readonly lastField = signal<{ part: Part; field: 'pos' | 'heading' | 'speed' }>({ part: 'goal', field: 'speed' });
  readonly layers = signal<Layers>({ futures: true, log: false, lanes: false, labels: false });
  readonly follow = signal(false);
  readonly tool = signal<Tool>('select');
  /** Ends of the measuring line, in metres. */
  readonly measure = signal<{ a: Vec; b: Vec } | null>(null);

  readonly motion = signal<MotionSet>(emptyMotion(''));
  readonly draft = signal<Draft | null>(null);
  readonly changes = signal<readonly Change[]>([]);
  readonly showBefore = signal(true);
  readonly drag = signal<DragInfo | null>(null);
  readonly liveReach = signal<{ id: string; reach: Reach } | null>(null);
  readonly selectedEvent = signal<TrafficEvent | null>(null);

  readonly time = signal(0);
  readonly playing = signal(false);
  readonly rate = signal(1);
  readonly loop = signal(true);

  readonly status = signal<Status>({ kind: 'loading' });
  readonly away = signal<{ retryIn: number; waiting: number } | null>(null);
  /** Something broke: the words for the banner, and what to save for whoever mends it. */
  readonly crash = signal<string | null>(null);
  readonly toast = signal<Toast | null>(null);
  readonly spoken = signal<{ text: string; urgent: boolean }>({ text: '', urgent: false });
  readonly historyTick = signal(0);
  readonly speedUnit = signal<SpeedUnit>(recall<SpeedUnit>('speed-unit') ?? 'km/h');

  /** Goal headings that came from a lane and may follow the next one. */
  readonly snappedHeadings = new Set<string>();
  readonly cache = new MotionCache();
  history: History | null = null;

  /** Called after a document change has been committed; the generator and the saving hang on here. */
  onCommit: ((scene: Scene, step: { name: string; agent: string | null; undo: boolean }) => void) | null = null;
  onSelect: ((id: string | null) => void) | null = null;
  private toastTimer = 0;

  readonly agent = computed<Agent | null>(() => {
    const id = this.selection.value;
    return (id && this.scene.value?.agents.get(id)) || null;
  });
  readonly futures = computed<Futures | null>(() => {
    const id = this.selection.value;
    if (!id) return null;
    const d = this.draft.value;
    return d && d.id === id ? d.futures : (this.motion.value.futures.get(id) ?? null);
  });
  /** The quick verdict on the goal of the selected road user, worked out here without asking anybody. */
  readonly localReach = computed<LocalReach | null>(() => {
    const a = this.agent.value,
      s = this.scene.value;
    const start = a && startPose(a);
    if (!a || !s || !start || !a.goal.pos) return null;
    return localReach(s.map, a, start, a.goal, this.unitOf(a), s.length);
  });
  /** Index of the future in force for the selected road user. */
  readonly chosen = computed<number>(() => {
    const f = this.futures.value,
      a = this.agent.value;
    if (!f || !a) return 0;
    return Math.min(f.modes.length - 1, a.chosen ?? f.chosen);
  });
  readonly events = computed<readonly TrafficEvent[]>(() => {
    const s = this.scene.value;
    return s && !this.drag.value ? readEvents(s, this.motion.value) : [];
  });
  /** Are the futures of the selected road user from before the last change? */
  readonly outdated = computed(
    () => this.motion.value.stale && !this.draft.value && this.motion.value.fresh !== this.selection.value,
  );
  /** Changes only when a drag begins or ends. */
  readonly dragging = computed(() => this.drag.value !== null);
  readonly undoName = computed(() => (this.historyTick.value, this.history?.undoName ?? null));
  readonly redoName = computed(() => (this.historyTick.value, this.history?.redoName ?? null));

  unitOf(a: Agent): SpeedUnit {
    return a.type === 'pedestrian' ? 'm/s' : this.speedUnit.value;
  }

  setUnit(unit: SpeedUnit): void {
    this.speedUnit.value = unit;
    keep('speed-unit', unit);
  }

  open(scene: Scene, motion?: MotionSet | null): void {
    batch(() => {
      this.history = new History(scene);
      this.cache.clear();
      this.snappedHeadings.clear();
      this.scene.value = scene;
      this.selection.value = null;
      this.hover.value = null;
      this.draft.value = null;
      this.changes.value = [];
      this.drag.value = null;
      this.liveReach.value = null;
      this.selectedEvent.value = null;
      this.motion.value = motion ?? emptyMotion(sceneKey(scene));
      if (motion) this.cache.put(motion);
      this.time.value = 0;
      this.playing.value = false;
      this.status.value = { kind: 'ready' };
      this.toast.value = null;
      this.historyTick.value++;
    });
  }

  select(id: string | null): void {
    if (id === this.selection.peek()) return;
    batch(() => {
      this.selection.value = id;
      this.draft.value = null;
      this.liveReach.value = null;
      this.hoverFuture.value = null;
      this.selectedEvent.value = null;
      this.focusPart.value = 'start';
    });
    const a = this.agent.peek();
    if (a) this.say(`${a.name} selected.`);
    this.onSelect?.(id);
  }

  /** Does a command as one undo step. */
  run(command: Command): void {
    if (!this.history) return;
    const before = this.history.scene;
    this.committed(this.history.run(command), before, command.name, false);
  }

  preview(command: Command): void {
    if (this.history) this.scene.value = this.history.preview(command);
  }

  /** The release of a drag. */
  commit(command: Command): void {
    if (!this.history) return;
    const before = this.history.scene;
    this.committed(this.history.commit(command), before, command.name, false);
  }

  cancelPreview(): void {
    if (this.history) this.scene.value = this.history.cancel();
  }

  undo(): void {
    this.step(() => this.history?.undo(), 'Undone');
  }
  redo(): void {
    this.step(() => this.history?.redo(), 'Done again');
  }

  private step(move: () => { name: string } | null | undefined, word: string): void {
    const before = this.history?.scene;
    const step = move();
    if (!step || !this.history || !before) return;
    this.committed(this.history.scene, before, step.name, true);
    this.notify({ text: `${word}: ${step.name}.` });
    this.say(`${word}: ${step.name}.`);
  }

  private committed(scene: Scene, before: Scene, name: string, undo: boolean): void {
    const agent = changedAgent(before, scene);
    batch(() => {
      this.scene.value = scene;
      this.historyTick.value++;
      this.changes.value = [];
      this.selectedEvent.value = null;
      // A scene may have become shorter.
      this.time.value = Math.min(this.time.peek(), scene.duration);
      this.adoptMotion(scene, agent && onlyPicked(before, scene, agent) ? agent : null);
    });
    this.onCommit?.(scene, { name, agent, undo });
  }

  /** Known answers appear at once; otherwise the old ones stay, marked as out of date. */
  private adoptMotion(scene: Scene, fresh: string | null): void {
    const key = sceneKey(scene);
    const known = this.cache.get(key);
    if (known) {
      this.motion.value = known;
      this.draft.value = null;
    } else {
      const m = this.motion.value;
      const keeps = fresh && m.futures.has(fresh) ? fresh : null;
      this.motion.value = {
        ...m,
        key,
        stale: true,
        fresh: keeps,
        driving: keeps ? new Set([...m.driving, keeps]) : m.driving,
      };
    }
  }

  /** Takes over what the generator worked out for the document as it is now. */
  settle(set: MotionSet, changed: { except: ReadonlySet<string> } | null): void {
    const scene = this.scene.peek();
    if (!scene) return;
    const before = this.motion.peek();
    batch(() => {
      this.cache.put(set);
      this.motion.value = set;
      this.draft.value = null;
      if (changed) this.changes.value = findChanges(scene, before, set, changed.except);
    });
  }

  /** The pose of a road user at the playhead, following what it does now. */
  motionFor(a: Agent): ReturnType<typeof motionOf> {
    return motionOf(this.scene.value!, this.motion.value, a);
  }

  /** Where the goal of a road user stands on screen: fixed fields as set, free ones as the generator chose. */
  goalPose(a: Agent): (Pose & { set: boolean }) | null {
    const g = a.goal;
    const d = this.draft.value;
    const f = d?.id === a.id ? d.futures : this.motion.value.futures.get(a.id);
    const index = f ? Math.min(f.modes.length - 1, a.chosen ?? f.chosen) : -1;
    const m = f && index >= 0 ? f.modes[index].motion : null;
    const end = m ? (poseAtStep(m, Math.round(g.time * 10)) ?? endPose(m)) : null;
    if (!g.pos && !end) return null;
    const [x, y] = g.pos ?? [end!.x, end!.y];
    const start = startPose(a);
    const travel = start ? Math.atan2(y - start.y, x - start.x) : 0;
    return {
      x,
      y,
      heading: wrapAngle(g.heading ?? end?.heading ?? travel),
      speed: g.speed ?? Math.abs(end?.speed ?? start?.speed ?? 0),
      set: g.pos !== null,
    };
  }

  notify(toast: Toast | null, ms = 6000): void {
    clearTimeout(this.toastTimer);
    this.toast.value = toast;
    if (toast)
      this.toastTimer = setTimeout(() => {
        this.toast.value = null;
      }, ms) as unknown as number;
  }

  say(text: string, urgent = false): void {
    this.spoken.value = { text, urgent };
  }

  setTime(t: number): void {
    const s = this.scene.peek();
    if (s) this.time.value = Math.min(s.duration, Math.max(0, t));
  }

  /** Everybody the user asked something of. */
  touchedIds(scene = this.scene.peek()): string[] {
    return scene ? [...scene.agents.values()].filter((a) => touched(a) && canChange(a)).map((a) => a.id) : [];
  }
}

/** Was nothing changed but the choice among its futures? */
function onlyPicked(before: Scene, after: Scene, id: string): boolean {
  const a = before.agents.get(id),
    b = after.agents.get(id);
  return (
    !!a &&
    !!b &&
    a.start === b.start &&
    a.goal === b.goal &&
    a.length === b.length &&
    a.width === b.width &&
    a.chosen !== b.chosen &&
    before.seed === after.seed &&
    before.diversity === after.diversity &&
    before.others === after.others &&
    before.length === after.length &&
    before.replan === after.replan
  );
}

function changedAgent(before: Scene, after: Scene): string | null {
  for (const [id, a] of after.agents) if (before.agents.get(id) !== a) return id;
  return null;
}
