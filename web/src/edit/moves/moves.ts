// Changes of start and goal, shared by handles, keys and typed values.
import { deg, rad, wrapAngle, type Pose, type Vec } from '../../model/base/geometry';
import { nearestLanes } from '../../model/document/lanemap';
import { choose, setGoal, setSize, setStart, type Command } from '../../model/document/commands';
import { LETTERS } from '../../model/document/futures';
import { topSpeed } from '../../model/base/domain';
import { degrees, seconds, speedInUse } from '../../model/base/units';
import { poseAt } from '../../model/base/motion';
import {
  GOAL_TIME,
  startPose,
  type Agent,
  type GoalSpec,
  type Scene,
  type StartSpec,
} from '../../model/document/scene';
import type { Editor, Field } from '../session/editor';
import type { HandlePart } from '../session/drag';
import { lanesFor } from './snap';
import { TEXTS } from '../../texts/editing/moves';

/** The goal at the recorded position at the goal time; null where it was absent, or did not move. */
export function goalFromLog(a: Agent): Command | null {
  const p = logEnd(a);
  return (
    p && {
      ...setGoal(a, { ...a.goal, pos: freeze([p.x, p.y]), heading: p.heading }),
      name: TEXTS.goalAsInLog(a.name),
    }
  );
}

/** Is its goal at the recorded position? */
export function isGoalOfLog(a: Agent): boolean {
  const p = a.goal.pos && logEnd(a);
  return !!p && Math.hypot(p.x - a.goal.pos![0], p.y - a.goal.pos![1]) < 0.05;
}

function logEnd(a: Agent): Pose | null {
  const start = startPose(a);
  const p = a.placed ? null : poseAt(a.log, a.goal.time);
  return start && p && Math.hypot(p.x - start.x, p.y - start.y) > 1 ? p : null;
}

/** Possible goal times in seconds: up to the end of the planned time. */
export const timeRange = (s: Scene | null): readonly [number, number] => [1, s?.length ?? GOAL_TIME];
export const goalTime = (s: Scene | null, t: number): number => Math.min(timeRange(s)[1], Math.max(timeRange(s)[0], t));
const FIELD_WORDS = { pos: TEXTS.position, heading: TEXTS.headingWithin, speed: TEXTS.speedWithin } as const;

/** Words for a field of one or several that is now fixed, or free. */
export function fixedWords(part: HandlePart, field: Field, who: string, fixed: boolean): string {
  const word = FIELD_WORDS[field];
  if (part === 'goal') return fixed ? TEXTS.goalOfFixed(word, who) : TEXTS.goalOfFree(word, who);
  return fixed ? TEXTS.startOfFixed(word, who) : TEXTS.startOfFree(word, who);
}

const freeze = (p: Vec): Vec => Object.freeze([p[0], p[1]] as const);

/** The shown pose of a part: fixed values, and the generator's for free ones. */
export const shownPose = (e: Editor, a: Agent, part: HandlePart): Pose | null =>
  part === 'start' ? startPose(a) : e.reading.goalPose(a);

/** To which value, so that several steps in a row differ by name. */
function changedTo(a: Agent, { heading, speed, time }: Partial<GoalSpec>): string {
  if (time !== undefined) return TEXTS.changedTo(seconds(time));
  if (heading != null) return TEXTS.changedTo(degrees(heading));
  return speed == null ? TEXTS.changed : TEXTS.changedTo(speedInUse(speed, a.type === 'pedestrian'));
}

export function withField(a: Agent, part: HandlePart, patch: Partial<GoalSpec>, fold = false): Command {
  const words =
    'pos' in patch
      ? part === 'goal'
        ? TEXTS.goal
        : TEXTS.start
      : 'heading' in patch
        ? `${part === 'goal' ? TEXTS.goalHeading : TEXTS.heading}`
        : 'speed' in patch
          ? `${part === 'goal' ? TEXTS.goalSpeed : TEXTS.speed}`
          : TEXTS.goalTime;
  const done = 'pos' in patch ? TEXTS.movedWord : changedTo(a, patch);
  const c =
    part === 'goal'
      ? setGoal(a, { ...a.goal, ...patch })
      : setStart(a, { pos: a.start.pos, heading: a.start.heading, speed: a.start.speed, ...patch } as StartSpec);
  const field = Object.keys(patch)[0];
  return { ...c, name: TEXTS.of(words, a.name, done), fold: fold ? `${part}:${field}:${a.id}` : undefined };
}

/** Switches one field between Fixed, at the shown value, and Free. */
export function toggleField(e: Editor, a: Agent, part: HandlePart, field: Field): Command | null {
  const spec = part === 'goal' ? a.goal : a.start;
  const shown = shownPose(e, a, part);
  e.touchField(part, field);
  const free = spec[field] !== null;
  // The start position of a placed road user is known only from the user.
  if (free && a.placed && part === 'start' && field === 'pos') return null;
  const value = free || !shown ? null : field === 'pos' ? freeze([shown.x, shown.y]) : shown[field];
  if (!free && value === null) return null;
  const c = withField(a, part, { [field]: value } as Partial<GoalSpec>);
  return {
    ...c,
    name: fixedWords(part, field, a.name, !free),
  };
}

/** A goal at the end of the chosen future: for the keyboard. */
export function goalHere(e: Editor, a: Agent): Command | null {
  const p = e.reading.goalPose(a);
  return p ? { ...setGoal(a, { ...a.goal, pos: freeze([p.x, p.y]) }), name: TEXTS.goalOfSet(a.name) } : null;
}

export function nudge(e: Editor, a: Agent, part: HandlePart, dx: number, dy: number): Command | null {
  const p = shownPose(e, a, part);
  return p ? withField(a, part, { pos: freeze([p.x + dx, p.y + dy]) }, true) : null;
}

export function nudgeAlong(e: Editor, a: Agent, part: HandlePart, metres: number): Command | null {
  const p = shownPose(e, a, part);
  const fits = lanesFor(a);
  const map = e.scene.peek()!.map;
  if (!p) return null;
  const hit = fits ? nearestLanes(map, p.x, p.y, p.heading, 4, fits)[0] : undefined;
  const h = hit?.heading ?? p.heading;
  const x = p.x + Math.cos(h) * metres,
    y = p.y + Math.sin(h) * metres;
  const on =
    hit &&
    nearestLanes(
      map,
      x,
      y,
      h,
      4,
      (l) => l === hit.lane || hit.lane.next.includes(l.id) || hit.lane.prev.includes(l.id),
    )[0];
  return withField(a, part, on ? { pos: freeze([on.x, on.y]), heading: on.heading } : { pos: freeze([x, y]) }, true);
}

/** Moves to the adjacent lane, on the left or on the right. */
export function toNextLane(e: Editor, a: Agent, part: HandlePart, side: 1 | -1): Command | null {
  const p = shownPose(e, a, part),
    fits = lanesFor(a);
  if (!p || !fits) return null;
  const hits = nearestLanes(e.scene.peek()!.map, p.x, p.y, p.heading, 7, fits)
    .map((h) => ({ h, left: -(h.x - p.x) * Math.sin(p.heading) + (h.y - p.y) * Math.cos(p.heading) }))
    .filter((c) => c.left * side > 1.2 && Math.abs(wrapAngle(c.h.heading - p.heading)) < 0.8)
    .sort((m, n) => Math.abs(m.left) - Math.abs(n.left));
  const to = hits[0]?.h;
  return to ? withField(a, part, { pos: freeze([to.x, to.y]), heading: to.heading }) : null;
}

export function turn(e: Editor, a: Agent, part: HandlePart, degrees: number): Command | null {
  const p = shownPose(e, a, part);
  return p ? withField(a, part, { heading: wrapAngle(rad(Math.round(deg(p.heading) + degrees))) }, true) : null;
}

export function snapToNearest(e: Editor, a: Agent, part: HandlePart): Command | null {
  const p = shownPose(e, a, part),
    fits = lanesFor(a);
  const hit = p && fits ? nearestLanes(e.scene.peek()!.map, p.x, p.y, p.heading, 25, fits)[0] : undefined;
  return hit ? withField(a, part, { pos: freeze([hit.x, hit.y]), heading: hit.heading }) : null;
}

export function faster(e: Editor, a: Agent, part: HandlePart, steps: number): Command | null {
  const p = shownPose(e, a, part);
  if (!p) return null;
  const step = a.type === 'pedestrian' ? 0.1 : 1 / 3.6;
  const v = Math.min(topSpeed(a), Math.max(0, (Math.round(p.speed / step) + steps) * step));
  return withField(a, part, { speed: v }, true);
}

export function later(e: Editor, a: Agent, by: number): Command {
  const t = Math.round(goalTime(e.scene.peek(), a.goal.time + by) * 10) / 10;
  return withField(a, 'goal', { time: t }, true);
}

export function pickFuture(e: Editor, a: Agent, index: number | null): Command | null {
  const f = e.reading.futures.peek();
  // Preference cards are taken, not picked: no road user follows them yet.
  if (!f || f.sketch || a.locked || e.reading.cards.hand.peek() || (index !== null && index >= f.modes.length))
    return null;
  return choose(a, index, LETTERS[index ?? 0]);
}

/** Picks another future; for a locked road user a notice explains why not. */
export function takeFuture(e: Editor, a: Agent, index: number): void {
  const command = a.chosen === index ? null : pickFuture(e, a, index);
  if (command) e.commits.run(command);
  else if (a.locked) e.notices.show({ text: TEXTS.allAreLocked(1) });
}

export const resize = (a: Agent, length: number, width: number): Command => setSize(a, length, width);
