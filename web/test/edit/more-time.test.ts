// More time as a remedy for a goal that is too far for its time, and less for one that is too near.
import { beforeEach, describe, expect, it } from 'vitest';
import { localReach } from '../../src/model/words/reach-words';
import { setGoal, setStart } from '../../src/model/document/commands';
import type { Fault, FaultKind } from '../../src/model/document/future-facts';
import type { Futures } from '../../src/model/document/futures';
import { readFutures } from '../../src/model/words/named-futures';
import { startPose, type Agent } from '../../src/model/document/scene';
import { Editor } from '../../src/edit/session/editor';
import { lessTime, moreTime, remedies } from '../../src/edit/moves/remedies';
import { crossing, crossingJson } from '../helpers';
import { sixFutures } from '../standin/futures.mjs';

let e: Editor;
const agent = (): Agent => e.agent.peek()!;
const goalAt = (pos: readonly [number, number], time: number): void =>
  e.commits.run(setGoal(agent(), { ...agent().goal, pos, time }));

/** Futures that all have this fault, or none. */
function answer(kind: FaultKind | null): void {
  const six = sixFutures(crossingJson().agents[0], {}, 5, 5);
  const f = readFutures({ chosen: 0, modes: six }, startPose(agent())!, 5, 5, false);
  const fault: Fault = { kind: kind ?? 'running', time: 1, until: 1, at: [0, 0], extent: null, with: null, edge: null };
  const about = { faults: kind ? [fault] : [], relations: [], manoeuvre: null };
  const judged: Futures = { ...f, modes: f.modes.map((m) => ({ ...m, about })) };
  e.answers.showDraft('1', judged);
  const known = { nearest: null, limiting: null, needs: null, message: null, byRoad: null };
  e.answers.judge('1', { ...known, status: 'reached' });
}

beforeEach(() => {
  e = new Editor();
  e.reading.layReach(localReach);
  e.open(crossing());
  e.select('1');
});

describe('more time', () => {
  it('is the first remedy of a goal out of reach', () => {
    goalAt([1.75, 90], 4);
    const more = moreTime(e, agent())!;
    expect(more).toMatchObject({ label: 'Allow more time', primary: true });
    expect(remedies(e, agent())[0]).toMatchObject({ label: 'Use nearest reachable', primary: false });
    e.commits.run(more.command);
    const { time } = agent().goal;
    expect(time).toBeGreaterThan(4);
    expect(more.note.startsWith(`${time.toFixed(1)} s`)).toBe(true);
    expect(moreTime(e, agent())).toBeNull();
  });

  it('makes the planned time longer where the goal is later than its end', () => {
    goalAt([1.75, 110], 9);
    answer('speeding');
    const more = moreTime(e, agent())!;
    e.commits.run(more.command);
    const scene = e.scene.peek()!;
    expect(scene.length).toBeGreaterThan(9);
    expect(agent().goal.time).toBeLessThanOrEqual(scene.length);
    expect(more.note).toBe(`${agent().goal.time.toFixed(1)} s, scene ${scene.length} s`);
    e.commits.undo();
    expect([e.scene.peek()!.length, agent().goal.time]).toEqual([9, 9]);
  });

  it.each<[FaultKind | null, boolean]>([
    ['speeding', true],
    ['harsh_steering', true],
    ['wrong_way', true],
    ['off_road', true],
    ['near_miss', false],
    ['red_light', false],
    [null, false],
  ])('for a goal reached by %s: %s', (kind, offered) => {
    goalAt([1.75, 60], 4);
    answer(kind);
    expect(moreTime(e, agent()) !== null).toBe(offered);
  });

  it('is not offered where there is enough of it', () => {
    goalAt([1.75, 40], 9);
    answer('off_road');
    expect(moreTime(e, agent())).toBeNull();
  });
});

describe('less time', () => {
  /** The first future drives at these speeds, m/s, evenly changed over the goal's time, and has no fault. */
  const drives = (...speeds: number[]): void => {
    answer(null);
    const f = e.answers.draft.peek()!.futures;
    const [first, ...others] = f.modes;
    const speed = first.motion.speed.map((_, i) => {
      const at = Math.min(speeds.length - 1, (i / 90) * (speeds.length - 1));
      const [low, share] = [Math.floor(at), at % 1];
      return speeds[low] + share * ((speeds[low + 1] ?? 0) - speeds[low]);
    });
    e.answers.showDraft('1', { ...f, modes: [{ ...first, motion: { ...first.motion, speed } }, ...others] });
  };

  it.each([
    ['slows for the time alone', [12, 4, 14], true],
    ['keeps its speed', [12, 11, 12], false],
    ['slows for its goal', [12, 8, 4], false],
    ['stops on the way', [12, 0, 14], false],
  ])('is offered for a goal where the road user %s: %s', (_, speeds, offered) => {
    e.commits.run(setStart(agent(), { ...agent().start, speed: 12 }));
    goalAt([20, -1.75], 9);
    drives(...(speeds as number[]));
    const less = lessTime(e, agent());
    expect(less !== null).toBe(offered);
    if (!less) return;
    e.commits.run(less.command);
    expect(agent().goal.time).toBeLessThan(8.5);
    expect(less.label).toBe(`Reach it in ${agent().goal.time.toFixed(1)} s`);
    expect(less.note).toBe('without slowing to 14 km/h');
  });
});
