// A road user driven by keys: acceleration and turning, within its motion limits.
import { limitsOf, topSpeed, type Typed } from '../base/domain';
import { clamp, wrapAngle, type Pose } from '../base/geometry';

/** Held controls. */
export interface Controls {
  /** 1 accelerates, -1 brakes, 0 keeps the speed. */
  readonly pace: -1 | 0 | 1;
  /** 1 steers left, -1 right. */
  readonly turn: -1 | 0 | 1;
  /** Brakes as hard as possible. */
  readonly hard: boolean;
}

/** A driven road user; a negative acceleration brakes. */
export interface DrivenPose extends Pose {
  /** m/s². */
  readonly accel: number;
  /** Of the path, 1/m; for a pedestrian the rate of turning, rad/s. Positive to the left. */
  readonly bend: number;
}

/** Length of a step of the integration, seconds. */
const DT_S = 0.01;
/** A pressed pedal works at once, but not in no time, m/s³. */
const JERK_MPS3 = 12;
/** Time from straight on to the tightest bend at this speed, seconds. */
const FULL_TURN_S = 0.6;
/** A pedestrian turns no faster than this, rad/s. */
const TURN_RADPS = 2.5;

const towards = (from: number, to: number, most: number): number => from + clamp(to - from, -most, most);

/** The tightest bend at a speed, in the unit of `DrivenPose.bend`. */
function tightest(a: Typed, speed: number): number {
  const { curvature_per_m: curvature, hurried } = limitsOf(a);
  if (curvature === null) return Math.min(TURN_RADPS, hurried.lateral_mps2 / Math.max(speed, 0.1));
  return Math.min(curvature, hurried.lateral_mps2 / Math.max(speed, 0.1) ** 2);
}

/** The same road user some time later. Hurried accelerations, and for hard braking the limit; it never reverses. */
export function driveOn(a: Typed, from: DrivenPose, { pace, turn, hard }: Controls, seconds: number): DrivenPose {
  const { brake_mps2, curvature_per_m, hurried } = limitsOf(a);
  const top = topSpeed(a);
  const wanted = hard ? -brake_mps2 : pace > 0 ? hurried.accel_mps2 : pace < 0 ? -hurried.brake_mps2 : 0;
  let { x, y, heading, speed, accel, bend } = from;
  for (let left = seconds; left > 1e-9; left -= DT_S) {
    const dt = Math.min(DT_S, left);
    accel = towards(accel, wanted, JERK_MPS3 * dt);
    const next = clamp(speed + accel * dt, 0, top);
    // At rest and at top speed nothing is left of a held pedal.
    if (next === 0 || next === top) accel = 0;
    const most = tightest(a, next);
    bend = clamp(towards(bend, turn * most, (most / FULL_TURN_S) * dt), -most, most);
    const mean = (speed + next) / 2;
    const turned = bend * (curvature_per_m === null ? dt : mean * dt);
    x += mean * dt * Math.cos(heading + turned / 2);
    y += mean * dt * Math.sin(heading + turned / 2);
    heading += turned;
    speed = next;
  }
  return { x, y, heading: wrapAngle(heading), speed, accel, bend };
}
