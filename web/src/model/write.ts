// Document -> JSON: conditions for a request, and the whole scene for saving.
import type {
  AgentFuturesJson,
  AgentJson,
  ConditionJson,
  GeneratedJson,
  GoalJson,
  MapJson,
  MapRef,
  SceneJson,
  StartJson,
  TrackJson,
} from './json';
import { DEFAULTS } from './domain';
import type { Motion } from './motion';
import {
  GOAL_TIME,
  hasGoal,
  sameSpec,
  logStartSpec,
  sizeChanged,
  startPose,
  staysAway,
  type Agent,
  type Scene,
} from './scene';
import type { Futures } from './futures';

/** What the user asks of a road user: a number fixes a field, null leaves it free, absent means "as logged". */
export function conditionOf(a: Agent): ConditionJson {
  const c: ConditionJson = {};
  if (sizeChanged(a)) {
    c.length_m = a.length;
    c.width_m = a.width;
  }
  if (!sameSpec(a.start, logStartSpec(a.logStart))) {
    const s: StartJson = { heading_rad: a.start.heading, speed_mps: a.start.speed };
    s.x_m = a.start.pos?.[0] ?? null;
    s.y_m = a.start.pos?.[1] ?? null;
    c.start = s;
  }
  if (hasGoal(a.goal) || a.goal.time !== GOAL_TIME) {
    const g: GoalJson = { time_s: a.goal.time };
    if (a.goal.pos) {
      g.x_m = a.goal.pos[0];
      g.y_m = a.goal.pos[1];
      if (a.goal.mayCross.length) g.may_cross = [...a.goal.mayCross];
    }
    if (a.goal.heading !== null) g.heading_rad = a.goal.heading;
    if (a.goal.speed !== null) g.speed_mps = a.goal.speed;
    c.goal = g;
  }
  return c;
}

export const isEmptyCondition = (c: ConditionJson): boolean => Object.keys(c).length === 0;

const round = (v: number, k: number): number => Math.round(v * k) / k;
const column = (a: Float64Array, k: number): number[] => Array.from(a, (v) => round(v, k));

export function trackJson(m: Motion, skip = 0): TrackJson & { first_step: number; vx_mps: number[]; vy_mps: number[] } {
  const x = column(m.x.subarray(skip), 1000),
    y = column(m.y.subarray(skip), 1000),
    h = column(m.heading.subarray(skip), 10000);
  const v = m.speed.subarray(skip);
  return {
    first_step: m.first + skip,
    x_m: x,
    y_m: y,
    heading_rad: h,
    vx_mps: Array.from(v, (s, i) => round(s * Math.cos(h[i]), 1000)),
    vy_mps: Array.from(v, (s, i) => round(s * Math.sin(h[i]), 1000)),
  };
}

function futuresJson(f: Futures, chosen: number): AgentFuturesJson {
  return {
    chosen,
    modes: f.modes.map((m) => ({
      probability: m.probability,
      ...(m.anchor == null ? {} : { anchor: m.anchor }),
      ...m.sent,
      ...trackJson(m.motion, 1),
    })),
  };
}

/** Futures in the shape the server keeps beside a scene, so that the next request starts from what is on screen. */
export function generatedJson(
  scene: Scene,
  futures: Iterable<readonly [string, Futures]>,
  head?: Readonly<Record<string, unknown>>,
): GeneratedJson | null {
  const agents: Record<string, AgentFuturesJson> = {};
  for (const [id, f] of futures) {
    const a = scene.agents.get(id);
    if (a && f.modes.length) agents[id] = futuresJson(f, Math.min(f.modes.length - 1, a.chosen ?? f.chosen));
  }
  if (!Object.keys(agents).length) return null;
  return {
    input_sha256: '',
    stale: false,
    weights: {},
    seed: scene.seed,
    request: { steps: DEFAULTS.steps, diversity: scene.diversity },
    created_at: '1970-01-01T00:00:00Z',
    ...head,
    chosen_sample: 0,
    samples: [{ agents }],
  };
}

/** The scene as loaded with the user's changes written in; nothing else is touched. */
export function writeScene(
  raw: SceneJson,
  scene: Scene,
  generated: GeneratedJson | null,
  map?: MapJson | MapRef,
): SceneJson {
  const agents = raw.agents.map((json): AgentJson => {
    const a = scene.agents.get(json.id);
    return a ? { ...json, conditions: conditionOf(a) } : json;
  });
  return {
    ...raw,
    name: scene.name,
    map: map ?? raw.map,
    agents,
    generated,
    x_editor: {
      seed: scene.seed,
      diversity: scene.diversity,
      others: scene.others,
      length_s: scene.length,
      replan_s: scene.replan,
      ...(scene.drawn ? { drawn: scene.drawn } : {}),
      ...picks(scene),
    },
  };
}

function picks(scene: Scene): { picked?: Record<string, number> } {
  const picked = Object.fromEntries(
    [...scene.agents.values()].filter((a) => a.chosen !== null).map((a) => [a.id, a.chosen!]),
  );
  return Object.keys(picked).length ? { picked } : {};
}

/** The same scene with everybody but `keep` standing where it starts. Who would drive in later stays away. */
export function stillAgents(raw: SceneJson, scene: Scene, keep: ReadonlySet<string>): AgentJson[] {
  return raw.agents
    .filter((json) => {
      const a = scene.agents.get(json.id);
      return !a || !staysAway(scene, a);
    })
    .map((json) => {
      const a = scene.agents.get(json.id);
      const p = a && startPose(a);
      if (!p || keep.has(json.id)) return json;
      const same = (v: number) => json.track.x_m.map(() => v);
      return {
        ...json,
        track: {
          ...json.track,
          x_m: same(p.x),
          y_m: same(p.y),
          heading_rad: same(p.heading),
          vx_mps: same(0),
          vy_mps: same(0),
        },
      };
    });
}
