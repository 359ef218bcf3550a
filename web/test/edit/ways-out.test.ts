// Remedies for a goal that is reached over a median: by the road, or with permission to cross it.
import { beforeEach, describe, expect, it } from 'vitest';
import { setGoal } from '../../src/model/document/commands';
import { readFutures, withNames } from '../../src/model/words/named-futures';
import type { ModeJson } from '../../src/model/document/scene-json';
import { nameIn, startPose, type Agent } from '../../src/model/document/scene';
import { Editor } from '../../src/edit/session/editor';
import { roadGoal } from '../../src/edit/moves/goal-verdict';
import { edgesInTheWay, leaveGiven, leaveToCross, roadWay } from '../../src/edit/moves/ways-out';
import { car, crossing, crossingJson } from '../helpers';
import { sixFutures } from '../standin/futures.mjs';
import { judged } from '../standin/judged.mjs';

const GOAL = [1.75, 26] as const;
/** On the lane that car 1 turns into, and on the path of its futures. */
const ROAD = { x: 1.75, y: 40, heading: Math.PI / 2, distance: 14 };

let e: Editor;
const agent = (): Agent => e.agent.peek()!;

/** The answer of a generator for the goal; with `named: false` without the ids of crossed edges. */
function answer({ mayCross = [] as string[], named = true, change = (m: ModeJson[]) => m } = {}): void {
  const goal = { x_m: GOAL[0], y_m: GOAL[1], heading_rad: Math.PI / 2 };
  const six = judged(sixFutures(crossingJson().agents[0], { goal }, 5, 5), ['2', '17'], false, mayCross);
  const modes = change(structuredClone(six) as ModeJson[]);
  if (!named) for (const m of modes) for (const f of m.faults ?? []) delete f.edge;
  const f = readFutures({ chosen: 0, modes }, startPose(agent())!, 5, 5, false);
  e.answers.showDraft('1', withNames(f, { onFoot: false, nameOf: nameIn(e.scene.peek()!) }));
}
const reach = (byRoad: typeof ROAD | null) =>
  e.answers.judge('1', { status: 'reached', nearest: null, limiting: null, needs: null, message: null, byRoad });

beforeEach(() => {
  e = new Editor();
  e.open(crossing());
  e.select('1');
  e.commits.run(setGoal(agent(), { ...agent().goal, pos: GOAL }));
});

describe('the way by the road', () => {
  it('leads to the nearest goal on the road, in one step that can be undone', () => {
    answer();
    reach(ROAD);
    const way = roadWay(e, agent())!;
    expect(way.words).toBe('By road: 14 m past the goal');
    expect(way.to).toMatchObject({ x: ROAD.x, y: ROAD.y });
    e.commits.run(way.command);
    expect(agent().goal.pos).toEqual([ROAD.x, ROAD.y]);
    e.commits.undo();
    expect(agent().goal.pos).toEqual(GOAL);
  });

  it('is nothing where the road leads to the goal itself', () => {
    answer();
    reach({ ...ROAD, y: GOAL[1] + 0.4 });
    expect(roadWay(e, agent())?.words ?? '').not.toMatch(/0 m/);
    expect(roadGoal(e, agent())).toBeNull();
  });

  it('follows the future that reaches it without leaving the road', () => {
    answer();
    reach({ ...ROAD, y: GOAL[1] });
    const { path } = roadWay(e, agent())!;
    const clean = e.reading.futures.peek()!.modes[4].motion;
    expect(path.slice(0, 20)).toEqual([...clean.x.slice(0, 20)].map((x, i) => [x, clean.y[i]]));
    expect(Math.hypot(path.at(-1)![0] - ROAD.x, path.at(-1)![1] - GOAL[1])).toBeLessThan(4);
  });

  it('follows the lanes where no future does', () => {
    answer({ change: (modes) => modes.map((m) => ({ ...m, faults: modes[0].faults })) });
    reach(ROAD);
    const { path } = roadWay(e, agent())!;
    const start = startPose(car(e.scene.peek()!))!;
    expect(Math.hypot(path[0][0] - start.x, path[0][1] - start.y)).toBeLessThan(1);
    expect(path.at(-1)).toEqual([expect.closeTo(ROAD.x, 1), expect.closeTo(ROAD.y, 1)]);
  });

  it('follows a future that keeps to the road as far as it leads, where no lane leads all the way', () => {
    answer();
    reach({ ...ROAD, x: 5.1, y: 60 });
    const { path } = roadWay(e, agent())!;
    const clean = e.reading.futures.peek()!.modes[4].motion;
    expect(path).toHaveLength(clean.x.length);
    expect(path.at(-1)).toEqual([clean.x.at(-1), clean.y.at(-1)]);
  });

  it('is the future that reaches the goal by it, where no other goal is known', () => {
    answer();
    reach(null);
    const way = roadWay(e, agent())!;
    expect([way.words, way.note, way.to]).toEqual(['By road: E', 'Stays on the road', null]);
    e.commits.run(way.command);
    expect(agent().chosen).toBe(4);
  });

  it('is not offered where the shown future breaks no rule', () => {
    answer({ mayCross: ['m0'] });
    reach(ROAD);
    expect([roadWay(e, agent()), leaveToCross(e, agent())]).toEqual([null, null]);
  });

  it('stays while the drag moves on, at its current distance from the goal', () => {
    e.drag.begin({ part: 'goal', handle: 'body' });
    answer();
    reach(ROAD);
    e.drag.preview(setGoal(agent(), { ...agent().goal, pos: [GOAL[0], GOAL[1] + 4] }));
    answer();
    expect(roadWay(e, agent())!.words).toBe('By road: 10 m past the goal');
    e.drag.cancel();
    expect(roadWay(e, agent())).toBeNull();
  });
});

describe('permission to cross an edge', () => {
  it('is stored with the goal as one step, and can be withdrawn', () => {
    answer();
    const leave = leaveToCross(e, agent())!;
    expect([leave.words, leave.command.name]).toEqual(['Allow crossing this median', 'Car 1 may cross this median']);
    expect(leaveGiven(agent())).toBeNull();
    e.commits.run(leave.command);
    expect(agent().goal).toMatchObject({ pos: GOAL, mayCross: ['m0'] });
    const given = leaveGiven(agent())!;
    expect([given.words, given.command.name]).toEqual(['Crossing allowed', 'Car 1 may no longer cross']);
    e.commits.run(given.command);
    expect(agent().goal.mayCross).toEqual([]);
    e.commits.undo();
    e.commits.undo();
    expect(agent().goal).toMatchObject({ pos: GOAL, mayCross: [] });
  });

  it('calls an edge a median only where the fault does', () => {
    answer({
      change: (modes) =>
        modes.map((m) => ({ ...m, faults: m.faults?.map((f) => ({ ...f, kind: 'off_road' as const })) })),
    });
    expect(leaveToCross(e, agent())!.words).toBe('Allow crossing this kerb');
  });

  it('is offered for edges in the answer without permission', () => {
    answer({ named: false });
    expect(leaveToCross(e, agent())).toBeNull();
    answer();
    expect(edgesInTheWay(e, agent())).toEqual(['m0']);
    e.commits.run(leaveToCross(e, agent())!.command);
    answer();
    expect(leaveToCross(e, agent())).toBeNull();
  });
});
