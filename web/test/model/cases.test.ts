// Cases: conditions, attempts, and the state after a search.
import { describe, expect, it } from 'vitest';
import { NOTHING_SAID } from '../../src/model/document/future-facts';
import { conditionOn, mayBeCase, situationOf, withTry } from '../../src/model/physics/case-search';
import type { SearchBody, Try } from '../../src/model/physics/case-search';
import { alike, KINDS, momentOf, type Moment, type Sought } from '../../src/model/physics/cases';
import { emptyMotion, type MotionSet } from '../../src/model/document/futures';
import { motionFrom, type Motion } from '../../src/model/base/motion';
import { sceneKey, startPose, withAgents, type Agent, type Scene } from '../../src/model/document/scene';
import { Cases } from '../../src/edit/tools/cases/cases';
import { CaseTries } from '../../src/edit/tools/cases/tries';
import { RequestBuilder } from '../../src/edit/asking/request-builder';
import { SceneFile } from '../../src/edit/document/scene-file';
import { Client } from '../../src/net/client';
import { car, crossing } from '../helpers';
import { finalWith, InMemoryGenerator, json, Session, six } from '../edit/session';

const [ME, OTHER] = ['1', '2'];
const STEPS = 90;

/** Straight on from a place, with the speed of each step. */
function straight(x: number, y: number, heading: number, speed: (t: number) => number): Motion {
  const xs: number[] = [],
    ys: number[] = [],
    vs: number[] = [];
  let d = 0;
  for (let i = 0; i <= STEPS; i++) {
    const v = speed(i / 10);
    xs.push(x + Math.cos(heading) * d);
    ys.push(y + Math.sin(heading) * d);
    vs.push(v);
    d += v / 10;
  }
  return motionFrom({
    x_m: xs,
    y_m: ys,
    heading_rad: xs.map(() => heading),
    vx_mps: vs.map((v) => v * Math.cos(heading)),
    vy_mps: vs.map((v) => v * Math.sin(heading)),
  });
}

/** Far from all else in the scene. */
const FAR = 500;

function twoWays(scene: Scene, mine: Motion, theirs: Motion): MotionSet {
  const only = (motion: Motion) => ({
    modes: [{ probability: 1, motion, name: 'A' }],
    chosen: 0,
    step: 5,
    steps: 5,
  });
  return {
    ...emptyMotion(sceneKey(scene)),
    futures: new Map([
      [ME, only(mine)],
      [OTHER, only(theirs)],
    ]),
    driving: new Set([ME, OTHER]),
  };
}

const sought = (what: Sought['what'], limit = KINDS[what].limit, other: string | null = OTHER): Sought => ({
  what,
  who: ME,
  other,
  limit,
});

/** East at 10 m/s; the other one north across its path, `later` seconds after it. */
const crossingWays = (later: number): [Motion, Motion] => [
  straight(FAR, FAR, 0, () => 10),
  straight(FAR + 40, FAR - 40 - later * 10, Math.PI / 2, () => 10),
];

describe('a case', () => {
  const scene = crossing();
  const of = (s: Sought, ways: [Motion, Motion]): Moment => momentOf(scene, twoWays(scene, ...ways), s)!;

  it('is a near miss within its bound, and a collision is none', () => {
    const hit = of(sought('near', 5), crossingWays(0));
    expect([hit.found, hit.value]).toEqual([false, 0]);
    expect(of(sought('collision'), crossingWays(0)).found).toBe(true);
    const near = of(sought('near', 5), crossingWays(0.8));
    expect(near.found).toBe(true);
    expect(near.value).toBeGreaterThan(0);
    expect(near.other).toBe(OTHER);
    expect(of(sought('near', near.value - 0.01), crossingWays(0.8)).found).toBe(false);
    expect(of(sought('collision'), crossingWays(0.8)).found).toBe(false);
    // A nearer miss comes before a wider one, and a collision after all of them.
    const wide = of(sought('near', 5), crossingWays(1.2));
    expect(near.miss).toBeLessThan(wide.miss);
    expect(hit.miss).toBeGreaterThan(wide.miss);
  });

  it('is the event of the scene, with its numbers, including moments between two steps', () => {
    const told = (kind: 'collision' | 'near_miss', extent: number): Moment => {
      const set = twoWays(scene, ...crossingWays(0.8));
      const fault = { kind, time: 4.34, until: 4.4, at: [FAR, FAR] as const, extent, with: OTHER, edge: null };
      const [mode] = set.futures.get(ME)!.modes;
      const modes = [{ ...mode, about: { ...NOTHING_SAID, faults: [fault] } }];
      const futures = new Map(set.futures).set(ME, { ...set.futures.get(ME)!, modes });
      return momentOf(scene, { ...set, futures }, sought('near', 1))!;
    };
    expect(told('collision', 20)).toMatchObject({ found: false, value: 0, time: 4.34 });
    expect(told('near_miss', 0.7)).toMatchObject({ found: true, value: 0.7, time: 4.34, other: OTHER });
    // A close pass without a collision course is no near miss; wider gaps than the threshold are only measured.
    const { value } = of(sought('near', 5), crossingWays(0.7));
    expect(value).toBeLessThan(1);
    expect(of(sought('near', 1), crossingWays(0.7)).found).toBe(false);
    expect(of(sought('near', 1.1), crossingWays(0.7)).found).toBe(true);
  });

  it('is a passing order by a small margin: first, not second', () => {
    const first = of(sought('first'), crossingWays(1));
    expect(first.found).toBe(true);
    // Between the centres it is one second; the boxes take their passing time off that.
    const boxes = scene.agents.get(ME)!;
    expect(Math.abs(first.value - (1 - (boxes.length + boxes.width) / 10))).toBeLessThan(0.11);
    expect(of(sought('first'), crossingWays(-1)).found).toBe(false);
    expect(of(sought('first'), crossingWays(3)).found).toBe(false);
    const apart: [Motion, Motion] = [straight(FAR, FAR, 0, () => 5), straight(FAR, FAR + 50, 0, () => 5)];
    expect(momentOf(scene, twoWays(scene, ...apart), sought('first'))).toBeNull();
  });

  it('is hard braking without a collision', () => {
    const brakes = (rate: number) => straight(FAR, FAR, 0, (t) => Math.max(0, 12 - rate * Math.max(0, t - 2)));
    const away = straight(FAR, FAR + 100, 0, () => 5);
    const hard = of(sought('braking', 4, null), [brakes(6), away]);
    expect(hard.found).toBe(true);
    expect(hard.value).toBeCloseTo(6, 1);
    expect(of(sought('braking', 4, null), [brakes(3), away]).found).toBe(false);
    const inTheWay = straight(FAR + 20, FAR, 0, () => 0);
    expect(of(sought('braking', 4, null), [brakes(6), inTheWay]).found).toBe(false);
  });

  it('is a goal that is reached with little room, where there is a goal', () => {
    const ways = crossingWays(0.8);
    expect(momentOf(scene, twoWays(scene, ...ways), sought('goal'))).toBeNull();
    const a = car(scene);
    const at = (x: number): Scene => {
      const agents = new Map(scene.agents).set(ME, { ...a, goal: { ...a.goal, pos: [x, FAR], time: 4 } });
      return { ...scene, agents };
    };
    const reached = (x: number) => momentOf(at(x), twoWays(scene, ...ways), sought('goal', 5))!.found;
    expect(reached(FAR + 39)).toBe(true);
    expect(reached(FAR + 60)).toBe(false);
  });

  it('differs from another by time, size, side or company', () => {
    const m = of(sought('near', 5), crossingWays(0.8));
    expect(alike(m, { ...m, time: m.time + 0.1 })).toBe(true);
    for (const other of [{ time: m.time + 0.4 }, { value: m.value + 1 }, { side: 'behind' as const }, { other: '9' }])
      expect(alike({ ...m, side: 'in-front' }, { ...m, side: 'in-front', ...other })).toBe(false);
  });
});

describe('a red light', () => {
  const plain = crossing();
  const scene = { ...plain, signals: [{ lane: '', stop: [FAR + 20, FAR] as const, states: [[0, 'stop'] as const] }] };
  const ways = crossingWays(3);

  it('is run according to the verdict; otherwise the distance to a red one counts', () => {
    const none = momentOf(scene, twoWays(scene, ...ways), sought('red', 0, null))!;
    expect([none.found, none.value, none.time]).toEqual([false, 0, 2]);
    const set = twoWays(scene, ...ways);
    const f = set.futures.get(ME)!;
    const fault = { kind: 'red_light' as const, time: 2, until: 2, at: [FAR + 20, FAR] as const, extent: 10 };
    const about = { ...NOTHING_SAID, faults: [{ ...fault, with: null, edge: null }] };
    const judged = { ...f, modes: [{ ...f.modes[0], about }] };
    const run = momentOf(scene, { ...set, futures: new Map(set.futures).set(ME, judged) }, sought('red', 0, null))!;
    expect([run.found, run.value, run.time, run.miss]).toEqual([true, 10, 2, -10]);
    expect(momentOf(plain, twoWays(plain, ...ways), sought('red', 0, null))?.found ?? false).toBe(false);
  });
});

describe('a search in the words of the API', () => {
  const scene = crossing();
  const may = { speed: true, time: true, seed: true, place: true };
  const aimed = (): Agent => ({ ...car(scene), goal: { ...car(scene).goal, pos: [30, 0] as const, time: 7 } });

  it('has ranges of what may vary alone, within limits, beside what the document asks for', () => {
    const now = startPose(car(scene))!.speed;
    const of = situationOf(aimed(), scene, { ...may, place: false }, 20)!;
    expect(of.agents).toEqual([ME]);
    expect(of.goal).toEqual({ x_m: 30, y_m: 0, time_s: { uniform: [4, scene.duration] } });
    const { uniform } = of.start!.speed_mps as { uniform: number[] };
    expect(uniform[0]).toBeGreaterThanOrEqual(0);
    expect(uniform[0]).toBeLessThan(now);
    expect(uniform[1]).toBeGreaterThan(now);
    expect(uniform[1]).toBeLessThanOrEqual(20);
    const [no, speed] = [false, false];
    expect(situationOf(aimed(), scene, { ...may, speed, time: no }, 20)).toEqual({
      agents: [ME],
      start: { ahead_m: { uniform: [-5, 5] } },
    });
    // Without a goal there is no time to vary, and a goal with edges to cross stays whole.
    const edged = { ...aimed(), goal: { ...aimed().goal, mayCross: ['e'] } };
    for (const a of [car(scene), edged]) expect(situationOf(a, scene, { ...may, speed, place: no }, 20)).toBeNull();
  });

  it('shifts and changes the start of the document, which stays in the scene', () => {
    const a = { ...car(scene), start: { pos: [3, 4] as const, heading: 1, speed: 8 } };
    const fixed = situationOf(a, scene, { ...may, place: false, time: false }, 20)!;
    expect(fixed.start).toEqual({ speed_mps: { uniform: [4, 12] } });
    const shifted = situationOf(a, scene, { ...may, speed: false, time: false }, 20)!;
    expect(shifted.start).toEqual({ ahead_m: { uniform: [-5, 5] } });
  });

  it('has a condition for each kind, about the two or about anybody', () => {
    const all = (Object.keys(KINDS) as Sought['what'][]).map((what) => conditionOn(sought(what)));
    expect(all).toEqual([
      'pair.gap_m <= 1 && pair.gap_m > 0 && actor.collisions == 0',
      'pair.gap_m <= 0',
      'pair.pet_s <= 2 && pair.other_first == 0 && actor.collisions == 0',
      'actor.kinematic.brake_mps2 >= 4 && actor.collisions == 0',
      'actor.goal_error.position_m <= 1 && pair.gap_m <= 2 && actor.collisions == 0',
      'actor.red_lights >= 1',
    ]);
    expect(conditionOn(sought('collision', 0, null))).toBe('actor.min_distance_m <= 0');
  });

  it('makes those tries again of which another future may be a case', () => {
    const near = sought('near', 1);
    expect(mayBeCase({ miss: 0, figures: {} }, near)).toBe(true);
    expect(mayBeCase({ miss: 0.5, figures: { 'pair.gap_m': 2.9 } }, near)).toBe(true);
    expect(mayBeCase({ miss: 0.5, figures: { 'pair.gap_m': 3.1 } }, near)).toBe(false);
    expect(mayBeCase({ miss: 1, figures: {} }, near)).toBe(false);
    expect(mayBeCase({ miss: 0.5, figures: { 'pair.pet_s': 3 } }, sought('first', 2))).toBe(true);
    expect(mayBeCase({ miss: 0.5, figures: { 'pair.gap_m': 1 } }, sought('braking'))).toBe(false);
  });

  it('gives the document of a try, and leaves all others unchanged', () => {
    const p = startPose(car(scene))!;
    const [x_m, y_m] = [p.x + 2 * Math.cos(p.heading), p.y + 2 * Math.sin(p.heading)];
    const request = tryAt(9, { start: { x_m, y_m, heading_rad: p.heading + 0.1, speed_mps: 3 } }).request!;
    const tried = withTry(scene, ME, request)!;
    expect(tried.seed).toBe(9);
    expect(startPose(tried.agents.get(ME)!)).toMatchObject({
      x: x_m,
      y: y_m,
      heading: expect.closeTo(p.heading + 0.1),
      speed: 3,
    });
    for (const [id, a] of scene.agents) if (id !== ME) expect(tried.agents.get(id)).toBe(a);
    // It does not start where another road user stands.
    const blocker = { ...scene.agents.get(OTHER)!, start: { pos: [x_m, y_m] as const, heading: p.heading, speed: 0 } };
    expect(withTry(withAgents(scene, [blocker]), ME, request)).toBeNull();
    const aim = withAgents(scene, [aimed()]);
    const timed = tryAt(9, { goal: { x_m: 30, y_m: 0, time_s: 6.2468 } }).request!;
    expect(withTry(aim, ME, timed)!.agents.get(ME)!.goal).toMatchObject({ pos: [30, 0], time: 6.2 });
  });
});

type TryBody = NonNullable<Try['request']>;

/** A try that satisfies its condition, unless it says by how much not. */
const tryAt = (seed: number, conditions: TryBody['conditions'][string] = {}, miss = 0): Try => ({
  number: seed,
  outcome: miss ? 'left-out' : 'kept',
  drawn: {},
  figures: {},
  miss,
  code: 'AAAAAA',
  request: {
    agents: [ME],
    conditions: { [ME]: conditions },
    seed,
    diversity: 0.5,
    horizon_s: 9,
    modes: 6,
    react: true,
    start_s: 0,
    steps: 5,
  },
});

/** Answers at once with the same six futures, and each time with another one chosen; the score is empty. */
class Prompt extends InMemoryGenerator {
  /** Always this one, where it is given. */
  choice: number | null = null;

  override ask(q: Parameters<InMemoryGenerator['ask']>[0]): void {
    super.ask(q);
    const all = six(ME);
    const chosen = this.choice ?? this.asked.length % all.modes.length;
    queueMicrotask(() => q.on.final(finalWith({ [ME]: { ...all, chosen } }), 1));
  }
}

interface Searched {
  readonly body: SearchBody;
  readonly signal: AbortSignal;
}

/** Answers each search with as many tries as were asked for, each with this miss; `hold` leaves the stream open. */
class SearchServer {
  readonly searched: Searched[] = [];
  miss: (number: number) => number = () => 0;
  hold = false;
  problem: string | null = null;

  readonly fetcher = (_: unknown, init?: RequestInit): Promise<Response> => {
    const body = JSON.parse(init!.body as string) as SearchBody;
    this.searched.push({ body, signal: init!.signal! });
    const seeds = body.seeds as number[];
    const tries = Array.from({ length: body.tries! * seeds.length }, (_, i): Try => {
      const seed = seeds[i % seeds.length];
      if (this.problem) return { number: i, outcome: 'failed', drawn: {}, figures: {}, problem: this.problem };
      return { ...tryAt(seed, { start: { speed_mps: 5 + (i % 50) / 10 } }, this.miss(i)), number: i };
    });
    const lines = tries.map((of) => `${JSON.stringify({ event: 'try', ...of })}\n`);
    const stream = new ReadableStream<Uint8Array>({
      start: (to) => {
        for (const line of lines) to.enqueue(new TextEncoder().encode(line));
        if (!this.hold) to.close();
        init!.signal!.addEventListener('abort', () => this.hold && to.error(init!.signal!.reason));
      },
    });
    return Promise.resolve(new Response(stream));
  };
}

describe('a search', () => {
  function begin() {
    const s = new Session();
    const file = new SceneFile(s.editor);
    file.adopt(json, {} as never, true);
    const line = new Prompt();
    const server = new SearchServer();
    const tries = new CaseTries({
      editor: s.editor,
      file,
      client: new Client('', server.fetcher as typeof fetch),
      generator: () => line,
      questions: () => new RequestBuilder(s.editor, file),
    });
    const cases = new Cases(s.editor, tries);
    cases.open('near', [ME, OTHER]);
    return { editor: s.editor, cases, line, server };
  }

  it('ends by itself, changes nothing, and reports the closest try', async () => {
    const { editor, cases, line, server } = begin();
    const before = editor.scene.peek();
    cases.seek({ ...cases.sought.peek()!, limit: 0.1 });
    server.miss = (n) => 1 / (n + 1);
    await cases.run();
    expect(cases.state.peek()).toBe('done');
    expect(cases.progress.peek().tried).toBe(cases.progress.peek().of);
    expect(server.searched.map(({ body }) => body.tries! * (body.seeds as number[]).length)).toEqual(
      Array.from({ length: 5 }, () => 60),
    );
    // Of the tries that miss, only those that come nearer than all before are made again.
    expect(line.asked).toHaveLength(60);
    expect(editor.scene.peek()).toBe(before);
    expect(editor.document.undoName.peek()).toBeNull();
    expect(cases.found.peek().length + (cases.closest.peek() ? 1 : 0)).toBeGreaterThan(0);
  });

  it('asks for the ranges, the condition and other seeds each time, with the conditions of the scene', async () => {
    const { editor, cases, server } = begin();
    server.miss = () => 1;
    await cases.run();
    const [one, two] = server.searched.map(({ body }) => body);
    expect(one.where).toBe(conditionOn(cases.sought.peek()!));
    expect(one.situation).toMatchObject({
      agents: [ME],
      start: { speed_mps: { uniform: [expect.any(Number), expect.any(Number)] } },
      with: OTHER,
    });
    expect(one.generate!.react).toBe(true);
    expect(one.scene!.agents!.map((a) => a.id)).toEqual([...editor.scene.peek()!.agents.keys()]);
    expect([one.seed, two.seed]).toEqual([0, 1]);
    const seeds = server.searched.flatMap(({ body }) => body.seeds as number[]);
    expect(new Set(seeds).size).toBe(seeds.length);
    expect(seeds[0]).toBe(editor.scene.peek()!.seed);
  });

  it('finds a case, shows it beside the scene, and takes it in one step that can be undone', async () => {
    const { editor, cases, server } = begin();
    const before = editor.scene.peek()!;
    cases.seek({ ...cases.sought.peek()!, limit: 10 });
    server.miss = (n) => n % 10;
    await cases.run();
    const [first] = cases.found.peek();
    expect(first.like).toBeGreaterThan(0);
    cases.show(first.id);
    expect(editor.view.beside.peek()?.meeting?.who).toEqual([ME, OTHER]);
    expect(editor.playhead.time.peek()).toBeCloseTo(first.moment.time);
    expect(editor.scene.peek()).toBe(before);
    cases.take(first);
    expect(sceneKey(editor.scene.peek()!)).toBe(sceneKey(first.take.scene));
    expect(editor.view.beside.peek()).toBeNull();
    editor.commits.undo();
    expect(sceneKey(editor.scene.peek()!)).toBe(sceneKey(before));
    expect(editor.document.undoName.peek()).toBeNull();
  });

  it('follows another future of a try that would be a case, with the reactions to it', async () => {
    const { cases, line, server } = begin();
    cases.seek({ ...cases.sought.peek()!, limit: 10 });
    line.choice = 0;
    server.miss = (n) => n;
    await cases.run();
    const [first] = cases.found.peek();
    const { chosen } = first.take.scene.agents.get(ME)!;
    expect(chosen).toBeGreaterThan(0);
    const [own, ...others] = line.asked.map(({ options }) => options.pinned);
    expect(own).toBeUndefined();
    expect(others).toContainEqual([ME]);
  });

  it('sends no request during a drag', async () => {
    const { editor, cases, line, server } = begin();
    server.miss = (n) => n;
    editor.select(ME);
    editor.drag.begin({ part: 'start', handle: 'body' });
    const going = cases.run();
    await new Promise((done) => setTimeout(done, 120));
    expect(line.asked.length + server.searched.length).toBe(0);
    editor.drag.cancel();
    await going;
    expect(cases.state.peek()).toBe('done');
  });

  it('stops at once, and resumes where it was with other seeds', async () => {
    const { cases, line, server } = begin();
    cases.seek({ ...cases.sought.peek()!, limit: 0.1 });
    server.miss = () => 1;
    server.hold = true;
    const going = cases.run();
    await expect.poll(() => cases.progress.peek().tried).toBe(60);
    cases.stop();
    await going;
    expect(cases.state.peek()).toBe('paused');
    expect(line.cancelled).toBe(1);
    expect(server.searched[0].signal.aborted).toBe(true);
    server.hold = false;
    await cases.run();
    expect(cases.progress.peek().tried).toBe(300);
    expect(cases.state.peek()).toBe('done');
    const [one, two] = server.searched.map(({ body }) => body);
    expect(two.seeds).not.toEqual(one.seeds);
  });

  it('makes one try where nothing can differ', async () => {
    const { cases, server } = begin();
    for (const what of ['speed', 'seed'] as const) cases.toggleMay(what);
    server.miss = () => 1;
    await cases.run();
    expect([cases.state.peek(), cases.progress.peek().tried]).toEqual(['done', 1]);
    expect(server.searched.map(({ body }) => body.tries)).toEqual([1]);
  });

  it('reports why no try has a result', async () => {
    const { cases, server } = begin();
    server.problem = 'start-missing';
    await cases.run();
    expect(server.searched).toHaveLength(1);
    expect(cases.state.peek()).toBe('paused');
    expect(cases.problem.peek()).toMatch(/start-missing/);
  });

  it('reports a missing setting before it begins', () => {
    const { cases } = begin();
    expect(cases.obstacle.peek()).toBeNull();
    cases.open('near', [ME]);
    expect(cases.obstacle.peek()).toMatch(/two road users/);
    cases.open('goal', [ME]);
    expect(cases.obstacle.peek()).toMatch(/no goal/);
  });
});
