// Changes of one road user or many, each one step of the history.
import { wrapAngle, type Vec } from '../../model/base/geometry';
import {
  addAgents,
  nameAs,
  patchAgents,
  removeAgents,
  withoutGoal,
  type AgentPatch,
  type Command,
} from '../../model/document/commands';
import { MOST_AGENTS, topSpeed } from '../../model/base/domain';
import { countWords, PRESETS, typeOfKind, type PlacedKind, type Preset } from '../../model/base/kinds';
import { copyOf, settle, type Newcomer } from '../../model/document/newcomer';
import {
  canMove,
  hasGoal,
  newIds,
  startPose,
  type Agent,
  type GoalSpec,
  type Others,
  type Scene,
  type StartSpec,
} from '../../model/document/scene';
import { shiftedVias } from '../../model/document/vias';
import { fixedWords } from './moves';
import { freeShift, standing } from './room';
import { shifted } from '../../model/document/newcomer';
import { TEXTS } from '../../texts/editing/moves';
import { inSentence } from '../../texts/language';

/** The server computes no more at once. */
export const MOST_AT_ONCE = 128;

/** `Car 7`, or `10 road users`; where all are of one kind, `10 pedestrians`. */
export function whoWords(all: readonly Pick<Agent, 'name' | 'kind'>[]): string {
  if (all.length === 1) return all[0].name;
  const { kind } = all[0] ?? {};
  return kind && all.every((a) => a.kind === kind) ? countWords(kind, all.length) : TEXTS.roadUsers(all.length);
}

/** The road users that may be moved and changed. */
export const movable = (all: readonly Agent[]): Agent[] => all.filter(canMove);

type Make = (a: Agent) => AgentPatch | null;

/** One change for all of them; null where no road user changes. `fold`: repeats within a short time are one step. */
function changeAll(all: readonly Agent[], name: string, make: Make, fold?: string): Command | null {
  const patches = new Map(all.flatMap((a) => (make(a) ? [[a.id, make(a)!] as const] : [])));
  if (!patches.size) return null;
  return patchAgents(name, patches, fold && `${fold}:${[...patches.keys()].join()}`);
}

const at = (x: number, y: number): Vec => Object.freeze([x, y] as const);

/** New conditions make an earlier pick among six futures meaningless. */
const started = (a: Agent, patch: Partial<StartSpec>): AgentPatch => ({
  start: Object.freeze({ pos: a.start.pos, heading: a.start.heading, speed: a.start.speed, ...patch }),
  chosen: null,
});
const aimed = (a: Agent, patch: Partial<GoalSpec>): AgentPatch => ({
  goal: Object.freeze({ ...a.goal, ...patch }),
  chosen: null,
});

// -------------------------------------------------------------- positions

/** Moves all by the same distance; on request their goals too. */
export function moveAll(all: readonly Agent[], dx: number, dy: number, goals = false, fold?: string): Command | null {
  return changeAll(
    all,
    TEXTS.moved(whoWords(all)),
    (a) => {
      const p = startPose(a);
      if (!p) return null;
      const patch = started(a, { pos: at(p.x + dx, p.y + dy) });
      const g = a.goal.pos;
      if (!goals || (!g && !a.goal.via.length)) return patch;
      const via = shiftedVias(a.goal.via, (x, y) => [x + dx, y + dy]);
      return { ...patch, goal: Object.freeze({ ...a.goal, pos: g && at(g[0] + dx, g[1] + dy), via }) };
    },
    fold,
  );
}

/** Centre of the bounding box of their starts. */
export function middleOf(all: readonly Agent[]): Vec {
  const ps = all.flatMap((a) => startPose(a) ?? []);
  const mid = (v: number[]): number => (Math.min(...v) + Math.max(...v)) / 2;
  return ps.length ? [mid(ps.map((p) => p.x)), mid(ps.map((p) => p.y))] : [0, 0];
}

/** Turns all about one point, or each about itself. */
export function turnAll(
  all: readonly Agent[],
  angle: number,
  about: Vec | null,
  goals = false,
  fold?: string,
): Command | null {
  const c = Math.cos(angle),
    s = Math.sin(angle);
  const turned = ([x, y]: Vec): Vec =>
    about
      ? at(about[0] + (x - about[0]) * c - (y - about[1]) * s, about[1] + (x - about[0]) * s + (y - about[1]) * c)
      : at(x, y);
  return changeAll(
    all,
    TEXTS.turned(whoWords(all)),
    (a) => {
      const p = startPose(a);
      if (!p) return null;
      const patch = started(a, { pos: turned([p.x, p.y]), heading: wrapAngle(p.heading + angle) });
      const g = a.goal;
      if (!goals || !g.pos) return patch;
      const heading = g.heading === null ? null : wrapAngle(g.heading + angle);
      return { ...patch, goal: Object.freeze({ ...g, pos: turned(g.pos), heading }) };
    },
    fold,
  );
}

/**
 * Left and right change sides, as seen by the first of them, about the centre of all; goals too. A single one stays,
 * and only its goal changes sides.
 */
export function mirrorAll(all: readonly Agent[]): Command | null {
  const axis = all[0] && startPose(all[0])?.heading;
  if (axis === undefined) return null;
  const about = middleOf(all);
  const c = Math.cos(2 * axis),
    s = Math.sin(2 * axis);
  const over = ([x, y]: Vec): Vec => {
    const [dx, dy] = [x - about[0], y - about[1]];
    return at(about[0] + dx * c + dy * s, about[1] + dx * s - dy * c);
  };
  const across = (heading: number): number => wrapAngle(2 * axis - heading);
  return changeAll(all, TEXTS.mirrored(whoWords(all)), (a) => {
    const p = startPose(a);
    if (!p) return null;
    const g = a.goal;
    const heading = g.heading === null ? null : across(g.heading);
    const via = shiftedVias(g.via, (x, y) => over([x, y]));
    const aim = g.pos || via.length ? aimed(a, { pos: g.pos && over(g.pos), heading, via }) : null;
    const start = all.length > 1 ? started(a, { pos: over([p.x, p.y]), heading: across(p.heading) }) : null;
    return start || aim ? { ...start, ...aim } : null;
  });
}

/** Swaps two: each starts at the other's place, with its heading. */
export function swapTwo([a, b, ...more]: readonly Agent[]): Command | null {
  const [p, q] = [a && startPose(a), b && startPose(b)];
  if (!p || !q || more.length) return null;
  return changeAll([a, b], TEXTS.swapped(a.name, b.name), (one) => {
    const to = one === a ? q : p;
    return started(one, { pos: at(to.x, to.y), heading: to.heading });
  });
}

/** Moves them nearer to a point or further from it, along two axes: east and north by default. */
export function spreadAll(
  all: readonly Agent[],
  kx: number,
  ky: number,
  about: Vec,
  [ex, ey]: Vec = [1, 0],
): Command | null {
  return changeAll(all, TEXTS.spread(whoWords(all)), (a) => {
    const p = startPose(a);
    if (!p) return null;
    const [dx, dy] = [p.x - about[0], p.y - about[1]];
    const x = (dx * ex + dy * ey) * kx,
      y = (dy * ex - dx * ey) * ky;
    return started(a, { pos: at(about[0] + x * ex - y * ey, about[1] + x * ey + y * ex) });
  });
}

// -------------------------------------------------------------- values

export type StartOrGoal = 'start' | 'goal';
/** A field of the shared inspector. */
export type SharedField = 'heading' | 'speed' | 'time' | 'length' | 'width';

/** A value for all of them, each derived from its own. */
export function setAll(
  all: readonly Agent[],
  part: StartOrGoal,
  field: SharedField,
  value: (a: Agent) => number | null,
  what: string,
  fold?: string,
): Command | null {
  return changeAll(
    all,
    TEXTS.ofChanged(what, whoWords(all)),
    (a) => {
      const v = value(a);
      if (field === 'length' || field === 'width') return v === null ? null : { [field]: v, chosen: null };
      if (field === 'time') return v === null ? null : aimed(a, { time: v });
      return part === 'start' ? started(a, { [field]: v }) : aimed(a, { [field]: v });
    },
    fold && `${part}:${field}:${fold}`,
  );
}

/** Fixes a field of all at its current value; where all are fixed already, frees it. */
export function fixAll(
  all: readonly Agent[],
  part: StartOrGoal,
  field: 'heading' | 'speed',
  shown: (a: Agent) => number | null,
): Command | null {
  const free = all.every((a) => a[part][field] !== null);
  return changeAll(all, fixedWords(part, field, whoWords(all), !free), (a) => {
    const v = free ? null : (a[part][field] ?? shown(a));
    if (v === a[part][field]) return null;
    return part === 'start' ? started(a, { [field]: v }) : aimed(a, { [field]: v });
  });
}

/** Faster or slower by speed steps of its kind. */
export function fasterAll(all: readonly Agent[], steps: number): Command | null {
  return changeAll(
    all,
    TEXTS.speedOfChanged(whoWords(all)),
    (a) => {
      const p = startPose(a);
      const step = a.type === 'pedestrian' ? 0.1 : 1 / 3.6;
      return (
        p && started(a, { speed: Math.min(topSpeed(a), Math.max(0, (Math.round(p.speed / step) + steps) * step)) })
      );
    },
    'faster',
  );
}

export const clearGoals = (all: readonly Agent[]): Command | null =>
  changeAll(all, TEXTS.goalsOfCleared(all.length, whoWords(all)), (a) =>
    hasGoal(a.goal) ? { goal: withoutGoal(a), chosen: null } : null,
  );

export const lockAll = (all: readonly Agent[], locked: boolean): Command | null =>
  changeAll(all, `${whoWords(all)} ${locked ? TEXTS.locked : TEXTS.unlocked}`, (a) =>
    a.locked === locked ? null : { locked },
  );

const DOES: Record<Others, string> = { react: TEXTS.reacts, log: TEXTS.replaysTheLog, still: TEXTS.holdsStill };
const DO: Record<Others, string> = { react: TEXTS.react, log: TEXTS.replayTheLog, still: TEXTS.holdStill };

/** Their behaviour when others change. The scene's default is not stored. */
export const setDoes = (scene: Scene, all: readonly Agent[], does: Others): Command | null =>
  changeAll(all, `${whoWords(all)} ${all.length === 1 ? DOES[does] : DO[does]}`, (a) => {
    const own = does === scene.others ? null : does;
    return a.does === own ? null : { does: own };
  });

export function callIt(a: Agent, called: string | null): Command {
  const name = called ?? nameAs({ ...a, called: null, name: a.name }, a.kind);
  return patchAgents(TEXTS.named(a.name, name), new Map([[a.id, { called, name: called ?? plainName(a) }]]));
}

const plainName = (a: Agent): string => nameAs({ called: null, name: /\d+$/.exec(a.id)?.[0] ?? a.id }, a.kind);

export const noteOn = (a: Agent, note: string): Command =>
  patchAgents(TEXTS.noteOn(a.name), new Map([[a.id, { note }]]));

/** Changes the kind, in its usual size; the generator uses the expert of that kind. */
export function setKind(all: readonly Agent[], kind: PlacedKind, size: Preset = PRESETS[kind][0]): Command | null {
  const type = typeOfKind(kind);
  const { label, subtype, length, width } = size;
  return changeAll(all, TEXTS.kindChanged(whoWords(all), inSentence(label)), (a) => {
    if (a.kind === kind && a.length === length && a.width === width && a.subtype === subtype) return null;
    const top = topSpeed({ type, subtype });
    const start = a.start.speed !== null && a.start.speed > top ? started(a, { speed: top }) : { chosen: null };
    const goal = a.goal.speed !== null && a.goal.speed > top ? { goal: Object.freeze({ ...a.goal, speed: top }) } : {};
    return { ...start, ...goal, type, kind, subtype, length, width, name: nameAs(a, kind) };
  });
}

// -------------------------------------------------------------- adding and removing

export function removeThem(scene: Scene, all: readonly Agent[]): Command {
  return removeAgents(
    scene,
    all.map((a) => a.id),
    TEXTS.removed(whoWords(all)),
  );
}

/** Why this many more cannot be added to a scene; null where they can. */
export function tooMany(scene: Scene, n: number): string | null {
  const room = MOST_AGENTS - scene.agents.size;
  if (n <= room) return null;
  return room > 0 ? TEXTS.aSceneHoldsRoad(MOST_AGENTS, room) : TEXTS.aSceneHoldsRoadUsers(MOST_AGENTS);
}

/** Adds them to the scene; `done`: the participle in the step's title, such as `placed`. `name` replaces the title. */
export function addThem(scene: Scene, all: readonly Newcomer[], done: string, name: string | null = null): Command {
  const ids = newIds(scene, all.length);
  const agents = all.map((n, i) => settle(n, ids[i]));
  return addAgents(scene, agents, name ?? `${whoWords(agents)} ${done}`);
}

/** Copies of road users in their start state. */
export const copiesOf = (all: readonly Agent[]): Newcomer[] =>
  all.flatMap((a) => {
    const pose = startPose(a);
    return (pose && copyOf(a, pose)) ?? [];
  });

/** The same at the nearest place without overlaps. */
export function withRoom(scene: Scene, all: readonly Newcomer[]): readonly Newcomer[] {
  const shift = freeShift(all, standing(scene));
  return shift && (shift[0] || shift[1]) ? all.map((n) => shifted(n, shift[0], shift[1])) : all;
}
