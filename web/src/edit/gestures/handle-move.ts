// The command for a handle dragged to a place, computed for each place from the state at the start of the drag.
import { clamp, project, wrapAngle, type Point, type Pose, type Vec } from '../../model/base/geometry';
import { setBoth, setGoal, setStart, type Command } from '../../model/document/commands';
import { topSpeed } from '../../model/base/domain';
import { seconds } from '../../model/base/units';
import { startPose, type Agent, type GoalSpec, type StartSpec } from '../../model/document/scene';
import { PENNANT, speedForTip } from '../../draw/handles';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';
import type { Grip } from '../session/drag';
import { goalTime } from '../moves/moves';
import {
  alongLane,
  lanesAhead,
  lanesFor,
  laneNameAt,
  snapHeading,
  snapToLane,
  softStop,
  type Snapped,
} from '../moves/snap';
import { edgesInTheWay } from '../moves/ways-out';
import type { Modifiers, Press } from './chart';
import type { Move } from './dragging-handle';
import { Resistance } from './resistance';
import { TEXTS } from '../../texts/desk/gestures';

/** Pixels of drag on the time tag for one second. */
const PX_PER_SECOND = 40;
/** A dragged time within this of a whole second snaps to it. */
const WHOLE_SECOND_S = 0.15;
/** A goal further from the start than this prefers lanes that lead away from the start, in metres. */
const LEADS_AWAY_M = 6;

/** The tag at the edge is dragged as the flag itself: its pennant comes to the hand. */
function pennantOf(view: View, { x, y }: Pose): Vec {
  const [dx, dy] = view.way(PENNANT[0] * view.grip, PENNANT[1] * view.grip);
  return [x + dx, y + dy];
}

interface Beginning {
  readonly grip: Grip;
  readonly agent: Agent;
  readonly start: Pose;
  readonly goal: Pose;
  readonly press: Press;
}

export class HandleMove implements Move {
  readonly grip: Grip;
  readonly agent: Agent;
  readonly #start: Pose;
  readonly #goal: Pose;
  /** Where the handle was grabbed, in metres. */
  readonly #grab: Vec;
  /** May a lane set the heading? A heading set by the user is never overwritten. */
  readonly #laneSetsHeading: boolean;
  /** Kerbs hold back the flag of road users that keep to lanes. */
  readonly #resistance: Resistance | null;
  /** Lanes that the road user can drive to; null for its start, and without any. */
  readonly #ahead: ReadonlySet<string> | null;
  readonly #touch: boolean;
  #lane: string | null = null;
  #mayCross: readonly string[];

  constructor(
    private readonly editor: Editor,
    private readonly view: View,
    { grip, agent, start, goal, press }: Beginning,
  ) {
    const fits = grip.part === 'goal' && grip.handle === 'body' ? lanesFor(agent) : null;
    this.#resistance = fits && new Resistance(editor.scene.peek()!.map, start, fits, goal);
    this.#ahead = fits && lanesAhead(editor.scene.peek()!.map, agent, start);
    this.#touch = press.touch;
    this.#mayCross = agent.goal.mayCross;
    this.grip = grip;
    this.agent = agent;
    this.#start = start;
    this.#goal = goal;
    this.#grab = grip.edge ? pennantOf(view, goal) : view.from(press.x, press.y);
    const free = (grip.part === 'goal' ? agent.goal : agent.start).heading === null;
    this.#laneSetsHeading = free || editor.drag.headingFollows(grip.part, agent) || this.#startsOnLane();
  }

  #startsOnLane(): boolean {
    const { x, y, heading } = this.#start;
    const map = this.editor.scene.peek()!.map;
    return this.grip.part === 'start' && snapToLane(map, this.agent, x, y, heading, this.view.z, null).lane !== null;
  }

  /** Does a kerb hold the flag back? */
  get held(): boolean {
    return this.#resistance?.held ?? false;
  }

  passKerbs(): void {
    this.#resistance?.pass();
  }

  /** The pose of the dragged part at the start of the drag. */
  get #pose(): Pose {
    return this.grip.part === 'goal' ? this.#goal : this.#start;
  }

  /** The command for the pointer at a place of the picture. */
  to(at: Point, mods: Modifiers, press: Point): Command {
    const [x, y] = this.view.from(at.x, at.y);
    switch (this.grip.handle) {
      case 'body':
        return this.#put(this.#position(x, y, mods), mods);
      case 'heading':
        return this.#named('heading', this.#put({ heading: this.#heading(x, y, mods), ...this.#keptGoal() }, mods));
      case 'speed':
        return this.#named('speed', this.#put({ speed: this.#speed(x, y, mods), ...this.#keptPlace() }, mods));
      default:
        return this.#time(at.x - press.x, mods);
    }
  }

  #named(what: 'heading' | 'speed', c: Command): Command {
    const words = { heading: [TEXTS.goalHeading, TEXTS.heading], speed: [TEXTS.goalSpeed, TEXTS.speed] }[what];
    return { ...c, name: TEXTS.ofChanged(words[this.grip.part === 'goal' ? 0 : 1], this.agent.name) };
  }

  #put(patch: Partial<GoalSpec>, mods: Modifiers): Command {
    const { agent: a } = this;
    if (mods.ctrl) return this.#both(patch);
    if (this.grip.part === 'goal') return setGoal(a, { ...a.goal, ...patch });
    return { ...setStart(a, { ...a.start, ...patch } as StartSpec), name: TEXTS.startOfMoved(a.name) };
  }

  /** A relation holds at another speed, or time. */
  #keptPlace(): Partial<GoalSpec> {
    return this.agent.goal.relation ? {} : this.#keptGoal();
  }

  /** Turning a goal's tiller fixes a free position too: the goal is wanted here. */
  #keptGoal(): Partial<GoalSpec> {
    if (this.grip.part !== 'goal' || this.agent.goal.pos) return {};
    return { pos: Object.freeze([this.#goal.x, this.#goal.y] as const) };
  }

  // -------------------------------------------------------------- the four handles

  #position(wx: number, wy: number, mods: Modifiers): Partial<GoalSpec> {
    const { editor, agent: a, grip } = this;
    const wanted: Vec = [this.#pose.x + wx - this.#grab[0], this.#pose.y + wy - this.#grab[1]];
    const place = this.#heldBack(wanted, mods);
    const s = this.#snapped(place[0], place[1], mods);
    const scene = editor.scene.peek()!;
    const held = s.lane && !mods.alt && a.type === 'vehicle' ? s.lane : null;
    const stop = held && softStop(scene, held, a, project(held.line, s.x, s.y).s, this.view.z);
    const at = stop ? { x: stop.x, y: stop.y, laneHeading: stop.heading } : s;
    this.#lane = s.lane?.id ?? null;
    const lane = laneNameAt(scene.map, a, at.x, at.y, at.laneHeading);
    // The pointer holds the flag, not its foot.
    const from: Vec = [wx + at.x - wanted[0], wy + at.y - wanted[1]];
    const lag = this.held ? { from, to: [wx, wy] as const, touch: this.#touch } : null;
    editor.drag.over({ laneId: this.#lane, lane, stop: stop ?? null, lag });

    const pos = Object.freeze([at.x, at.y] as const);
    const leave = this.#leave([at.x, at.y], mods);
    if (this.#laneSetsHeading && at.laneHeading !== null) {
      editor.drag.setHeadingFollows(grip.part, a, true);
      return { pos, heading: wrapAngle(at.laneHeading), ...leave };
    }
    if (this.#laneSetsHeading && grip.part === 'goal') {
      editor.drag.setHeadingFollows(grip.part, a, false);
      return { pos, heading: null, ...leave };
    }
    return { pos, ...leave };
  }

  /** Alt passes all kerbs for the rest of the drag; along the lane with Shift there are none. */
  #heldBack(wanted: Vec, mods: Modifiers): Vec {
    if (mods.alt) this.passKerbs();
    if (!this.#resistance || (mods.shift && this.#lane)) return wanted;
    return this.#resistance.to(wanted, this.view.z);
  }

  /** With Alt the goal may cross what the shown future crosses on its way past the kerb. */
  #leave(at: Vec, mods: Modifiers): Partial<GoalSpec> {
    if (!this.#resistance) return {};
    if (!mods.alt || !this.#resistance.passesKerb(at)) this.#mayCross = this.agent.goal.mayCross;
    else {
      const now = this.editor.agent.peek();
      const edges = now ? edgesInTheWay(this.editor, now).filter((id) => !this.#mayCross.includes(id)) : [];
      if (edges.length) this.#mayCross = Object.freeze([...this.#mayCross, ...edges]);
    }
    return { mayCross: this.#mayCross };
  }

  /** Shift keeps to the lane, Alt disables snapping, else the best lane near by. */
  #snapped(x: number, y: number, mods: Modifiers): Snapped {
    const { agent: a, grip } = this;
    const map = this.editor.scene.peek()!.map;
    const kept = mods.shift ? alongLane(map, this.#lane, x, y) : null;
    if (kept) return kept;
    if (mods.alt) return { x, y, laneHeading: null, lane: null };
    const start = startPose(a)!;
    // A start prefers lanes in its own direction; a goal takes any lane, best one that leads away from the start.
    const away = grip.part === 'goal' && Math.hypot(x - start.x, y - start.y) > LEADS_AWAY_M;
    const travel = away ? Math.atan2(y - start.y, x - start.x) : null;
    const ownHeading = !this.#laneSetsHeading || grip.part === 'start';
    const heading = ownHeading ? this.#pose.heading : this.#lane ? null : travel;
    return snapToLane(map, a, x, y, heading, this.view.z, this.#lane, travel, this.#ahead);
  }

  #heading(wx: number, wy: number, mods: Modifiers): number {
    const { editor, agent: a, grip } = this;
    const { x, y } = this.#pose;
    editor.drag.setHeadingFollows(grip.part, a, false);
    const mode = mods.alt ? 'fine' : mods.shift ? 'steps' : 'lane';
    return snapHeading(editor.scene.peek()!.map, a, x, y, Math.atan2(y - wy, x - wx), mode);
  }

  #speed(wx: number, wy: number, mods: Modifiers): number {
    const { agent: a } = this;
    const raw = speedForTip(this.view, a, this.#pose, wx, wy);
    const unit = a.type === 'pedestrian' ? 0.1 : 1 / 3.6;
    const step = mods.shift ? unit * 10 : unit;
    return clamp(mods.alt ? raw : Math.round(raw / step) * step, 0, topSpeed(a));
  }

  #time(dx: number, mods: Modifiers): Command {
    const { agent: a } = this;
    const raw = a.goal.time + dx / PX_PER_SECOND;
    const grid = mods.alt ? 0.01 : mods.shift || Math.abs(raw - Math.round(raw)) < WHOLE_SECOND_S ? 1 : 0.1;
    const time = goalTime(this.editor.scene.peek(), Math.round(raw / grid) * grid);
    const patch = { time: Math.round(time * 100) / 100, ...this.#keptPlace() };
    return { ...setGoal(a, { ...a.goal, ...patch }), name: TEXTS.goalTimeOfChanged(a.name, seconds(patch.time)) };
  }

  /** Ctrl: start and goal move, turn or change speed together. */
  #both(patch: Partial<GoalSpec>): Command {
    const { agent: a } = this;
    const from = this.#pose;
    const s = { pos: a.start.pos, heading: a.start.heading, speed: a.start.speed };
    const g = { ...a.goal };
    if (patch.pos) {
      const dx = patch.pos[0] - from.x;
      const dy = patch.pos[1] - from.y;
      s.pos = Object.freeze([this.#start.x + dx, this.#start.y + dy] as const);
      g.pos = Object.freeze([this.#goal.x + dx, this.#goal.y + dy] as const);
    } else if (patch.heading != null) {
      const turn = patch.heading - from.heading;
      s.heading = wrapAngle(this.#start.heading + turn);
      g.heading = wrapAngle(this.#goal.heading + turn);
    } else if (patch.speed != null) s.speed = g.speed = patch.speed;
    return setBoth(a, s, g);
  }
}
