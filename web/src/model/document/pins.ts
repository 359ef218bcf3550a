// Pinned futures: ways of a road user that stay while others are drawn anew. Their motion is part of the document, with
// the start and the goal that it was made for. One that is taken is picked like any other of its futures.
import type { Future, Futures } from './futures';
import { wrapAngle } from '../base/geometry';
import {
  endPose,
  endsBefore,
  motionFrom,
  poseAt,
  poseAtStep,
  type Columns,
  type Motion,
  trackJson,
} from '../base/motion';
import { patchAgents, type AgentPatch, type Command } from './commands';
import { shortFor, AT_GOAL_M, startPose, type Agent, type Pin, type Scene } from './scene';
import { passed } from './vias';
import type { AgentType } from '../base/kinds';
import { TEXTS } from '../../texts/editing/pins';

/** So many a road user has at most: with six beside them more are not told apart on the picture. */
export const MOST_PINS = 3;

/** Names the pick of a pinned future where rounds name theirs. */
const MARK = 'pin-';

/** Names a motion for a road user of a kind. */
export const keyOfPin = (type: AgentType, track: Columns): string => shortFor(JSON.stringify([type, track]));

const motions = new WeakMap<Pin, Motion>();

export function motionOfPin(pin: Pin): Motion {
  let m = motions.get(pin);
  if (!m) motions.set(pin, (m = motionFrom(pin.track)));
  return m;
}

/** Two motions are the same where they are nowhere further apart than this, metres; one may go on for longer. */
const SAME_M = 0.05;

function sameWay(a: Motion, b: Motion): boolean {
  const from = Math.max(a.first, b.first);
  const to = Math.min(a.first + a.x.length, b.first + b.x.length);
  for (let step = from; step < to; step++) {
    const [i, k] = [step - a.first, step - b.first];
    if (Math.hypot(a.x[i] - b.x[k], a.y[i] - b.y[k]) > SAME_M) return false;
  }
  return to > from;
}

/** Which of the futures a pinned one is; -1 where it is none of them. */
export const indexOfPin = (f: Futures | null | undefined, pin: Pin): number =>
  f && !f.sketch ? f.modes.findIndex((m) => sameWay(m.motion, motionOfPin(pin))) : -1;

/** The pinned one that a future is. */
export const pinOf = (a: Agent, m: Future | undefined): Pin | null =>
  (m && a.pins.find((p) => sameWay(m.motion, motionOfPin(p)))) ?? null;

/** The pinned one that it takes; null where it takes none. */
export const takenPin = (a: Agent): Pin | null =>
  a.chosen !== 0 ? null : (a.pins.find((p) => a.dealt === MARK + p.key) ?? null);

// -------------------------------------------------------------- does it fit?

const SAME_PLACE_M = 0.3;
const SAME_HEADING_RAD = 0.09;
const SAME_SPEED_MPS = 0.3;
const GOAL_HEADING_RAD = 0.17;
const GOAL_SPEED_MPS = 1;

/** Why a pinned future no longer answers what is asked: metres, m/s. */
export type PinMisfit =
  | { readonly what: 'kind' | 'start-heading' | 'goal-heading' | 'via' }
  | { readonly what: 'start' | 'goal'; readonly metres: number }
  | { readonly what: 'start-speed' | 'goal-speed'; readonly speed: number };

/** The first reason why a pinned future no longer answers what is asked of its road user; null where it does. */
export function pinMisfit(a: Agent, pin: Pin): PinMisfit | null {
  const m = motionOfPin(pin);
  const start = startPose(a);
  const first = poseAtStep(m, m.first);
  if (pin.type !== a.type || !start || !first) return { what: 'kind' };
  const away = Math.hypot(start.x - first.x, start.y - first.y);
  if (away > SAME_PLACE_M) return { what: 'start', metres: away };
  if (Math.abs(wrapAngle(start.heading - first.heading)) > SAME_HEADING_RAD) return { what: 'start-heading' };
  const speedAt = Math.abs(first.speed);
  if (Math.abs(start.speed - speedAt) > SAME_SPEED_MPS) return { what: 'start-speed', speed: speedAt };
  const { pos, heading, speed, time, via } = a.goal;
  const end = (endsBefore(m, time) ? null : poseAt(m, time)) ?? endPose(m);
  const short = pos ? Math.hypot(end.x - pos[0], end.y - pos[1]) : 0;
  if (short > AT_GOAL_M) return { what: 'goal', metres: short };
  if (heading !== null && Math.abs(wrapAngle(heading - end.heading)) > GOAL_HEADING_RAD)
    return { what: 'goal-heading' };
  const arrives = Math.abs(end.speed);
  if (speed !== null && Math.abs(speed - arrives) > GOAL_SPEED_MPS) return { what: 'goal-speed', speed: arrives };
  return passed(via, m).every((p) => p.ok) ? null : { what: 'via' };
}

// -------------------------------------------------------------- commands

const put = (name: string, a: Agent, patch: AgentPatch): Command => patchAgents(name, new Map([[a.id, patch]]));

/** A future stays from now on, with what it was made for. */
export function pinFuture(a: Agent, m: Future, letter: string): Command {
  const track = Object.freeze(trackJson(m.motion));
  const pin: Pin = Object.freeze({
    key: keyOfPin(a.type, track),
    name: m.name,
    track,
    type: a.type,
    start: a.start,
    goal: a.goal,
  });
  return put(TEXTS.pinned(letter, a.name), a, { pins: Object.freeze([...a.pins, pin]) });
}

/** It does not stay any more; a road user that takes it is free again. */
export function unpin(a: Agent, pin: Pin): Command {
  const pins = Object.freeze(a.pins.filter((p) => p !== pin));
  const free = takenPin(a) === pin ? { chosen: null, profile: null, dealt: null } : {};
  return put(TEXTS.unpinned(pin.name, a.name), a, { pins, ...free });
}

/** The road user goes the pinned way. Where that does not fit, what it was made for comes back with it. */
export function takePin(a: Agent, pin: Pin): Command {
  const fits = pinMisfit(a, pin) === null;
  const asked = fits ? {} : { start: pin.start, goal: pin.goal };
  const patch = { ...asked, chosen: 0, profile: null, dealt: MARK + pin.key };
  return put(TEXTS.taken(pin.name, a.name), a, patch);
}

// -------------------------------------------------------------- among the futures

/**
 * Whoever takes a pinned future has it among its futures, whatever was drawn since: in place of the first, and alone
 * where the others answer something else. `fresh`: of this one the others still hold.
 */
export function withTaken(
  scene: Scene,
  futures: ReadonlyMap<string, Futures>,
  fresh: string | null = null,
): ReadonlyMap<string, Futures> {
  let out: Map<string, Futures> | null = null;
  for (const a of scene.agents.values()) {
    const pin = takenPin(a);
    const f = pin && futures.get(a.id);
    if (!pin || (f && indexOfPin(f, pin) === a.chosen)) continue;
    out ??= new Map(futures);
    const others = a.id === fresh && f && !f.sketch ? f.modes.filter((m) => !sameWay(m.motion, motionOfPin(pin))) : [];
    const own: Future = {
      probability: others[0]?.probability ?? 1,
      motion: motionOfPin(pin),
      name: pin.name,
      about: null,
    };
    out.set(a.id, { modes: [own, ...others].slice(0, 6), chosen: 0, step: 1, steps: 1 });
  }
  return out ?? futures;
}
