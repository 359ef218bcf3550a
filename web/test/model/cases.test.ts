// Cases: conditions, attempts, and the state after a search.
import { describe, expect, it } from 'vitest';
import { NOTHING_SAID } from '../../src/model/document/future-facts';
import { attempt, withAttempt } from '../../src/model/physics/attempts';
import { alike, KINDS, momentOf, type Moment, type Sought } from '../../src/model/physics/cases';
import { emptyMotion, type MotionSet } from '../../src/model/document/futures';
import { motionFrom, type Motion } from '../../src/model/base/motion';
import { sceneKey, startPose, withAgents, type Scene } from '../../src/model/document/scene';
import { Cases } from '../../src/edit/tools/cases/cases';
import { RequestBuilder } from '../../src/edit/asking/request-builder';
import { SceneFile } from '../../src/edit/document/scene-file';
import { Maker } from '../../src/edit/asking/take-maker';
import { car, crossing } from '../helpers';
import { finalOf, InMemoryGenerator, json, Session } from '../edit/session';

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

describe('attempts', () => {
  const scene = crossing();
  const may = { speed: true, time: true, seed: true, place: true };

  it('begin with the scene as it is, and change only what may change, within limits', () => {
    const a = { ...car(scene), goal: { ...car(scene).goal, pos: [30, 0] as const } };
    expect(attempt(a, scene, may, 0, 20)).toEqual({ seed: scene.seed, speed: null, time: null, ahead: null });
    for (let n = 1; n < 200; n++) {
      const t = attempt(a, scene, may, n, 20);
      expect(t.speed).toBeGreaterThanOrEqual(0);
      expect(t.speed).toBeLessThanOrEqual(20);
      expect(t.time).toBeGreaterThanOrEqual(1);
      expect(t.time).toBeLessThanOrEqual(scene.duration);
      expect(attempt(a, scene, { ...may, speed: false, seed: false, place: false }, n, 20)).toEqual({
        seed: scene.seed,
        speed: null,
        time: t.time,
        ahead: null,
      });
      expect(Math.abs(t.ahead!)).toBeLessThanOrEqual(5);
    }
  });

  it('leave all others unchanged', () => {
    const tried = withAttempt(scene, ME, { seed: 9, speed: 3, time: null, ahead: 2 });
    expect(tried.seed).toBe(9);
    expect(startPose(tried.agents.get(ME)!)!.speed).toBe(3);
    for (const [id, a] of scene.agents) if (id !== ME) expect(tried.agents.get(id)).toBe(a);
    const [p, q] = [scene, tried].map((s) => startPose(s.agents.get(ME)!)!);
    expect(Math.hypot(q.x - p.x, q.y - p.y)).toBeCloseTo(2, 1);
    // It does not start where another road user stands.
    const blocker = { ...scene.agents.get(OTHER)!, start: { pos: [q.x, q.y] as const, heading: q.heading, speed: 0 } };
    const full = withAgents(scene, [blocker]);
    const beside = startPose(withAttempt(full, ME, { seed: 9, speed: 3, time: null, ahead: 2 }).agents.get(ME)!)!;
    expect(Math.hypot(beside.x - p.x, beside.y - p.y)).toBeLessThan(1.5);
  });
});

/** Answers at once with the same six futures; the score is empty. */
class Prompt extends InMemoryGenerator {
  override ask(q: Parameters<InMemoryGenerator['ask']>[0]): void {
    super.ask(q);
    queueMicrotask(() => q.on.final(finalOf(ME), 1));
  }
}

describe('a search', () => {
  function begin() {
    const s = new Session();
    const file = new SceneFile(s.editor);
    file.adopt(json, {} as never, true);
    const line = new Prompt();
    const maker = new Maker(s.editor, new RequestBuilder(s.editor, file), line, file);
    const cases = new Cases(s.editor, maker, () => line.cancel());
    cases.open('near', [ME, OTHER]);
    return { editor: s.editor, cases, line };
  }

  it('ends by itself, changes nothing, and reports the closest attempt', async () => {
    const { editor, cases, line } = begin();
    const before = editor.scene.peek();
    cases.seek({ ...cases.sought.peek()!, limit: 0.1 });
    await cases.run();
    expect(cases.state.peek()).toBe('done');
    expect(cases.progress.peek().tried).toBe(cases.progress.peek().of);
    expect(line.asked.length).toBeGreaterThan(40);
    expect(editor.scene.peek()).toBe(before);
    expect(editor.document.undoName.peek()).toBeNull();
    expect(cases.found.peek().length + (cases.closest.peek() ? 1 : 0)).toBeGreaterThan(0);
  });

  it('finds a case, shows it beside the scene, and takes it in one step that can be undone', async () => {
    const { editor, cases } = begin();
    const before = editor.scene.peek()!;
    cases.seek({ ...cases.sought.peek()!, limit: 10 });
    await cases.run();
    const [first] = cases.found.peek();
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

  it('sends no request during a drag', async () => {
    const { editor, cases, line } = begin();
    editor.select(ME);
    editor.drag.begin({ part: 'start', handle: 'body' });
    const going = cases.run();
    await new Promise((done) => setTimeout(done, 120));
    expect(line.asked).toHaveLength(0);
    editor.drag.cancel();
    await going;
    expect(cases.state.peek()).toBe('done');
  });

  it('stops at once, and resumes where it was', async () => {
    const { cases, line } = begin();
    cases.seek({ ...cases.sought.peek()!, limit: 0.1 });
    const going = cases.run();
    await Promise.resolve();
    cases.stop();
    await going;
    const { tried } = cases.progress.peek();
    expect(cases.state.peek()).toBe('paused');
    expect(line.cancelled).toBe(1);
    await cases.run();
    expect(cases.progress.peek().tried).toBeGreaterThan(tried);
    expect(cases.state.peek()).toBe('done');
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
