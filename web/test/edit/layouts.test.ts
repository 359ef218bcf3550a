// Single connections of a map being made: the effect of changed arms, and undo.
import { beforeEach, describe, expect, it } from 'vitest';
import { Layouts } from '../../src/edit/tools/layouts/layouts';
import { connectionOf, fitting, laneOf } from '../../src/model/document/layouts';
import type { Arm, MapReply } from '../../src/net/types';
import { crossingJson } from '../helpers';

const arm = (angle_deg: number, lanes_in = 1, lanes_out = 1): Arm => ({
  angle_deg,
  length_m: 90,
  lanes_in,
  lanes_out,
  turns: null,
  speed_limit_kmh: 50,
  cycle_lane_m: 0,
  median_m: 0,
  crosswalk_m: 3,
  main: false,
});

const way = (from: string, to: string, added = false): MapReply['ways'][number] => ({
  from,
  to,
  lane: `${from}-${to}`,
  turn: 'straight',
  added,
});

describe('connections', () => {
  let layouts: Layouts;

  const reply = (ways: MapReply['ways']): MapReply => ({
    scene: crossingJson() as unknown as MapReply['scene'],
    layout: {
      template: 'four-arms',
      parameters: layouts.parameters.peek() ?? { arms: [arm(0), arm(90, 2, 2), arm(180)] },
    } as MapReply['layout'],
    checks: [],
    arms: [],
    corners: [],
    ways,
  });

  beforeEach(() => {
    layouts = new Layouts();
    layouts.choose('four-arms');
    layouts.settle(layouts.wish.peek()!, reply([way('arm1.in1', 'arm3.out1')]), 1);
  });

  it('that cannot be drawn are dropped, without a step', () => {
    layouts.setArm(0, { angle_deg: 5 });
    layouts.settle(layouts.wish.peek()!, reply([]), 1);
    const drawn = layouts.wish.peek()!;
    layouts.setArm(1, { angle_deg: 10 });
    layouts.refuse('Arms need 20° between them');
    expect([layouts.fault.value, layouts.arms.value[1].angle_deg]).toEqual(['Arms need 20° between them', 90]);
    expect(layouts.isDrawn(layouts.wish.peek()!)).toBe(true);
    layouts.undo();
    expect(layouts.arms.value[0].angle_deg).toBe(0);
    layouts.redo();
    layouts.settle(drawn, reply([]), 1);
    // During a drag it stays, and is restored on release.
    layouts.hold();
    layouts.setArm(1, { angle_deg: 10 });
    layouts.refuse('Arms need 20° between them');
    expect(layouts.arms.value[1].angle_deg).toBe(10);
    layouts.letGo();
    expect([layouts.arms.value[1].angle_deg, layouts.canRedo.value]).toEqual([90, false]);
  });

  it('are restored where a closed map is reopened', () => {
    expect(layouts.close()).toBeNull();
    layouts.choose('four-arms');
    layouts.settle(layouts.wish.peek()!, reply([]), 1);
    layouts.setArm(0, { angle_deg: 5 });
    const reopen = layouts.close();
    expect([layouts.isOpen.value, layouts.canUndo.value]).toEqual([false, false]);
    reopen!();
    expect([layouts.arms.value[0].angle_deg, layouts.canUndo.value]).toEqual([5, true]);
  });

  it('are named by their lanes, and disappear with them', () => {
    expect(connectionOf([1, 0], [2, 1])).toEqual({ from: 'arm2.in1', to: 'arm3.out2' });
    expect(laneOf('arm2.in1')).toEqual([1, 0]);
    const all = {
      added: [connectionOf([1, 1], [2, 0]), connectionOf([2, 0], [1, 1])],
      removed: [connectionOf([0, 0], [2, 0])],
    };
    const arms = [arm(0), arm(90, 1, 2), arm(180)];
    expect(fitting(all, arms)).toEqual({ added: [all.added[1]], removed: all.removed });
    // The first arm is removed: the others move up.
    expect(fitting(all, arms.slice(1), 0)).toEqual({ added: [connectionOf([1, 0], [0, 1])], removed: [] });
  });

  it('are removed and restored, each in one step', () => {
    const usual = { from: 'arm1.in1', to: 'arm3.out1' };
    layouts.pickWay(usual);
    expect(layouts.way.value).toEqual(usual);
    layouts.removeWay(usual);
    expect(layouts.connections).toEqual({ added: [], removed: [usual] });
    layouts.settle(layouts.wish.peek()!, reply([]), 1);
    expect(layouts.way.value).toBeNull();
    layouts.addWay(usual);
    expect(layouts.connections).toEqual({ added: [], removed: [] });
    layouts.undo();
    expect(layouts.connections.removed).toEqual([usual]);
    layouts.undo();
    expect(layouts.connections.removed).toEqual([]);
    layouts.redo();
    expect(layouts.connections.removed).toEqual([usual]);
  });

  it('that were added disappear when they are removed', () => {
    const back = connectionOf([0, 0], [0, 0]);
    layouts.addWay(back);
    expect(layouts.connections.added).toEqual([back]);
    layouts.settle(layouts.wish.peek()!, reply([way(back.from, back.to, true)]), 1);
    layouts.removeWay(back);
    expect(layouts.connections).toEqual({ added: [], removed: [] });
  });

  it('follow new turn lanes, and removed arms', () => {
    layouts.removeWay({ from: 'arm2.in1', to: 'arm3.out1' });
    layouts.addWay(connectionOf([1, 1], [0, 0]));
    layouts.setTurns(1, 0, [['left'], ['right']]);
    expect(layouts.connections).toEqual({ added: [connectionOf([1, 1], [0, 0])], removed: [] });
    layouts.addWay(connectionOf([0, 0], [0, 0]));
    layouts.setArm(1, { lanes_in: 1 });
    expect(layouts.connections.added).toEqual([connectionOf([0, 0], [0, 0])]);
  });

  it('drawn by the pointer are one step, or none', () => {
    layouts.hold();
    layouts.addWay(connectionOf([0, 0], [1, 0]));
    layouts.putBack();
    layouts.addWay(connectionOf([0, 0], [1, 1]));
    layouts.letGo();
    expect(layouts.connections.added).toEqual([connectionOf([0, 0], [1, 1])]);
    layouts.undo();
    expect(layouts.connections.added).toEqual([]);
    layouts.hold();
    layouts.addWay(connectionOf([0, 0], [1, 0]));
    layouts.putBack();
    layouts.letGo();
    expect(layouts.canUndo.value).toBe(false);
  });
});
