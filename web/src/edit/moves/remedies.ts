// Changes that make a goal reachable, or reached without breaking rules: more time, a nearer goal, another start.
import { goalStep, inOneStep, setLength, type Command } from '../../model/document/commands';
import { leavesRoad, type FaultKind } from '../../model/document/future-facts';
import { limitsOf } from '../../model/base/domain';
import { poseAtStep, STEP_S } from '../../model/base/motion';
import { drivingTime } from '../../model/physics/driving-time';
import { pathTo, shortfall } from '../../model/physics/reach';
import { localReach } from '../../model/words/reach-words';
import { LENGTHS, startPose, type Agent } from '../../model/document/scene';
import { inTenths, metres, seconds, speedLabel, toUnit } from '../../model/base/units';
import type { Editor } from '../session/editor';
import { knownReach, outOfReach, verdictsHold } from './goal-verdict';
import { withField } from './moves';
import { TEXTS } from '../../texts/editing/moves';

/** A change that makes a goal reachable. */
export interface Remedy {
  readonly label: string;
  readonly note: string;
  readonly icon: string;
  readonly primary: boolean;
  readonly command: Command;
}

/** Kinds of faults that a late goal avoids: the way was too long, or its bends too tight, for the time. */
const OF_HASTE: readonly FaultKind[] = ['speeding', 'harsh_braking', 'harsh_steering', 'running'];
/** Time is offered in steps of half a second; less of it than this makes no difference. */
const STEPS_PER_S = 2;
const LEAST_MORE_S = 0.5;

/**
 * More time, where the way to the goal takes longer than the goal allows, and the goal is unreachable or reached only
 * by haste or by a short cut off the lanes. A goal after the end of the planned time makes that longer.
 */
export function moreTime(e: Editor, a: Agent): Remedy | null {
  const [scene, start, { pos }] = [e.scene.value, startPose(a), a.goal];
  if (!scene || !start || !pos || e.drag.active.value) return null;
  const faults = (verdictsHold(e) && e.reading.futures.value?.modes[e.reading.chosen.value]?.about?.faults) || [];
  const cannot = outOfReach(e, a) !== null;
  if (!cannot && !faults.some((f) => OF_HASTE.includes(f.kind) || leavesRoad(f))) return null;
  const heading = a.goal.heading ?? Math.atan2(pos[1] - start.y, pos[0] - start.x);
  const way = pathTo(scene.map, a, start, { x: pos[0], y: pos[1], heading });
  // A short cut off the lanes takes no longer than the way around only where that way is known.
  if (!way.lanes.length && !cannot && a.type !== 'pedestrian') return null;
  const needs = drivingTime(a, way, start.speed, a.goal.speed ?? undefined);
  const time = Math.ceil(needs * STEPS_PER_S) / STEPS_PER_S;
  const length = LENGTHS.find((l) => l >= time);
  if (needs < a.goal.time + LEAST_MORE_S || !length) return null;
  const later = withField(a, 'goal', { time });
  const longer = length > scene.length;
  return {
    label: TEXTS.allowMoreTime,
    note: longer ? TEXTS.sceneOf(seconds(time), length) : seconds(time),
    icon: 'clock',
    primary: true,
    command: longer ? inOneStep(setLength(scene, length), later, later.name) : later,
  };
}

/** A drop below both the first and the last speed that a driver would not choose, m/s. */
const DROP_MPS = 5;
/** Below this it stops, and not for the time, m/s. */
const STANDS_MPS = 1;

/**
 * An earlier goal, where the shown future has no other fault and yields to nobody, but slows on the way only because
 * the goal allows too much time.
 */
export function lessTime(e: Editor, a: Agent): Remedy | null {
  const start = startPose(a);
  const shown = verdictsHold(e) && !e.drag.active.value ? e.reading.futures.value?.modes[e.reading.chosen.value] : null;
  if (!start || !a.goal.pos || !shown?.about || shown.about.relations.length) return null;
  if (shown.about.faults.some((f) => f.kind !== 'harsh_braking')) return null;
  const { motion } = shown;
  const end = Math.round(a.goal.time / STEP_S) - motion.first;
  const goal = poseAtStep(motion, motion.first + end);
  if (!goal) return null;
  const least = Math.min(...motion.speed.subarray(0, end + 1));
  if (least < STANDS_MPS || Math.min(start.speed, goal.speed) - least < DROP_MPS) return null;
  const way = pathTo(e.scene.value!.map, a, start, { ...goal, x: a.goal.pos[0], y: a.goal.pos[1] });
  // Bends are taken no faster than usual.
  const needs = Math.max(
    drivingTime(a, way, start.speed, goal.speed),
    (2 * way.line.length) / (start.speed + goal.speed),
  );
  const time = Math.ceil(needs * STEPS_PER_S) / STEPS_PER_S;
  if (time + LEAST_MORE_S > a.goal.time) return null;
  return {
    label: TEXTS.reachItIn(seconds(time)),
    note: TEXTS.insteadOfSlowing(speedLabel(least, e.view.unitOf(a))),
    icon: 'clock',
    primary: false,
    command: withField(a, 'goal', { time }),
  };
}

export function remedies(e: Editor, a: Agent): Remedy[] {
  const scene = e.scene.value,
    start = startPose(a);
  if (!scene || !start || !a.goal.pos) return [];
  const unit = e.view.unitOf(a);
  const local = localReach(scene.map, a, start, a.goal, unit);
  const verdict = knownReach(e, a);
  const out: Remedy[] = [];
  const nearest = (verdict?.status === 'unreachable' ? verdict.nearest : null) ?? local?.nearest ?? null;
  if (nearest) {
    const gets =
      shortfall(start, a.goal.pos, nearest, local)?.gets ?? Math.hypot(nearest.x - start.x, nearest.y - start.y);
    const heading = a.goal.heading === null ? null : nearest.heading;
    const speed = a.goal.speed === null ? null : nearest.speed;
    out.push({
      label: TEXTS.useNearestReachable,
      // A fixed speed changes too, so the note reports it.
      note: [TEXTS.afterWay(metres(gets, 0)), ...(speed === null ? [] : [speedLabel(speed, unit)])].join(', '),
      icon: 'flag',
      primary: !moreTime(e, a),
      command: goalStep(
        a,
        { ...a.goal, pos: Object.freeze([nearest.x, nearest.y] as const), heading, speed },
        TEXTS.goalOfMovedTo(a.name),
      ),
    });
  }
  const bend = verdict?.limiting === 'lateral' || verdict?.limiting === 'curvature' || local?.kind === 'sharp';
  if (bend && a.goal.heading !== null)
    out.push({
      label: TEXTS.leaveTheHeading,
      note: TEXTS.anyHeading,
      icon: 'lock',
      primary: false,
      command: withField(a, 'goal', { heading: null }),
    });
  if (local?.speed != null && (local.kind === 'far' ? local.speed > start.speed : local.speed < start.speed)) {
    const faster = local.kind === 'far';
    const v = Math.min(limitsOf(a).speed_mps, local.speed);
    const note = inTenths(unit) ? speedLabel(v, unit) : `${Math.ceil(toUnit(v, unit))} ${unit}`;
    out.push({
      label: faster ? TEXTS.startFaster : TEXTS.startSlower,
      note,
      icon: 'play',
      primary: false,
      command: withField(a, 'start', { speed: faster && !inTenths(unit) ? Math.ceil(v * 3.6) / 3.6 : v }),
    });
  }
  return out;
}
