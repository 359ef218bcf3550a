// A plain curve for the time the generator is away: along the lanes where they lead there, at an even change of
// speed. It is marked as a sketch everywhere and never becomes part of the scene's motion.
import { pointAt, type Pose } from '../model/base/geometry';
import { limitsOf } from '../model/base/domain';
import { pathTo } from '../model/physics/reach';
import type { Futures } from '../model/document/futures';
import type { Motion } from '../model/base/motion';
import { GOAL_TIME, startPose, type Agent, type Scene } from '../model/document/scene';
import { TEXTS } from '../texts/desk/hud';

export function sketchFutures(scene: Scene, a: Agent): Futures | null {
  const start = startPose(a);
  if (!start) return null;
  const goal = a.goal.pos
    ? {
        x: a.goal.pos[0],
        y: a.goal.pos[1],
        heading: a.goal.heading ?? Math.atan2(a.goal.pos[1] - start.y, a.goal.pos[0] - start.x),
      }
    : {
        x: start.x + Math.cos(start.heading) * Math.max(1, start.speed * GOAL_TIME),
        y: start.y + Math.sin(start.heading) * Math.max(1, start.speed * GOAL_TIME),
        heading: start.heading,
      };
  const { line } = pathTo(scene.map, a, start, goal);
  return {
    modes: [{ probability: 1, motion: along(a, line, start, a.goal.time), name: TEXTS.sketchNotWorked }],
    chosen: 0,
    step: 0,
    steps: 0,
    sketch: true,
  };
}

function along(a: Agent, line: ReturnType<typeof pathTo>['line'], start: Pose, time: number): Motion {
  const n = Math.round(time * 10) + 1;
  const l = limitsOf(a);
  // Distance = v t + b t^2 / 2, with b held inside what the road user can do.
  const b = Math.max(-l.brake_mps2, Math.min(l.accel_mps2, (2 * (line.length - start.speed * time)) / (time * time)));
  const m = {
    x: new Float64Array(n),
    y: new Float64Array(n),
    heading: new Float64Array(n),
    speed: new Float64Array(n),
  };
  let s = 0,
    v = start.speed;
  for (let i = 0; i < n; i++) {
    const p = pointAt(line, Math.min(s, line.length));
    m.x[i] = p.x;
    m.y[i] = p.y;
    m.heading[i] = p.heading;
    m.speed[i] = v;
    s += Math.max(0, v * 0.1 + b * 0.005);
    v = Math.max(0, Math.min(l.speed_mps, v + b * 0.1));
  }
  return { first: 0, ...m, valid: [[0, n]] };
}
