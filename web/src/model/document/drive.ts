// A drive becomes the recording of the scene: all tracks are what was seen in it, as one step.
import { motionFrom, poseAtStep, STEP_S, trackJson, type Columns, type Motion } from '../base/motion';
import { num } from '../base/units';
import { inOneStep, patchScene, recast, type Command } from './commands';
import type { AgentJson } from './scene-json';
import { durationOf, freeGoal, LENGTHS, logStartSpec, shortFor, type Agent, type Scene } from './scene';
import { TEXTS } from '../../texts/scene/steps';

/** States of all that were there in a drive, by id: one every 0.1 s, from `first_step` on without a gap. */
export type DriveTracks = ReadonlyMap<string, Columns>;

/**
 * Replaces all recordings by the tracks of a drive of so many states. Goals and choices end, or the generator would
 * move their road users otherwise. Who was not there yet leaves the scene.
 */
export function recordDrive(scene: Scene, driven: Agent, tracks: DriveTracks, steps: number): Command {
  const put: Agent[] = [];
  const drop: string[] = [];
  for (const a of scene.agents.values()) {
    const track = tracks.get(a.id);
    if (track) put.push(recordedAs(a, motionFrom(track)));
    else if (a.log.first >= steps || a.placed) drop.push(a.id);
    else if (a.log.first + a.log.x.length > steps) put.push(cut(a, steps));
  }
  const seconds = (steps - 1) * STEP_S;
  const length = LENGTHS.find((s) => s >= seconds - 1e-6) ?? scene.length;
  const drive = shortFor(JSON.stringify([...tracks].map(([id, { x_m, y_m }]) => [id, x_m, y_m])));
  const times = { steps, length, duration: durationOf(length, steps), drive };
  const name = TEXTS.driven(driven.name, num(seconds, 1));
  return inOneStep(recast(name, { put, drop, issued: scene.issued }), patchScene(name, times));
}

/** The road user with this motion as its recording, and nothing asked of it. */
function recordedAs(a: Agent, log: Motion): Agent {
  const logStart = poseAtStep(log, 0);
  return {
    ...a,
    logSize: [a.length, a.width],
    logType: a.type,
    logSubtype: a.subtype,
    placed: false,
    source: sourceOf(a, log),
    log,
    logStart: logStart && Object.freeze(logStart),
    start: logStartSpec(logStart),
    goal: freeGoal(),
    chosen: null,
    profile: null,
    dealt: null,
  };
}

/** The same up to a step, for one that only stands by. */
function cut(a: Agent, steps: number): Agent {
  const n = steps - a.log.first;
  const { first, x, y, heading, speed, valid } = a.log;
  const [cx, cy, ch, cs] = [x, y, heading, speed].map((column) => column.slice(0, n));
  const known = valid.flatMap(([from, to]) => (from < steps ? [[from, Math.min(to, steps)] as const] : []));
  const log: Motion = { first, x: cx, y: cy, heading: ch, speed: cs, valid: known };
  return { ...a, source: sourceOf(a, log), log };
}

function sourceOf(a: Agent, log: Motion): AgentJson {
  const valid = log.valid.map(([from, to]): [number, number] => [from, to]);
  return {
    ...a.source,
    id: a.id,
    type: a.type,
    ...(a.subtype ? { subtype: a.subtype } : {}),
    length_m: a.length,
    width_m: a.width,
    track: { ...trackJson(log), valid },
    conditions: {},
  };
}
