// Transitions of states: the effects of press, move and release, without a page.
import { beforeEach, describe, expect, it } from 'vitest';
import { wrapAngle, type Point } from '../../src/model/base/geometry';
import { startPose } from '../../src/model/document/scene';
import { lockAll } from '../../src/edit/moves/several';
import { RAIL } from '../../src/edit/tools/tools';
import { Pointer } from './pointer';

let p: Pointer;
beforeEach(() => {
  p = new Pointer();
});

const A = { x: 300, y: 300 };
const B = { x: 340, y: 280 };
const goalBody = { kind: 'grip', grip: { part: 'goal', handle: 'body' } } as const;

describe('idle', () => {
  it('highlights the object under the pointer and shows its action', () => {
    p.hit = { kind: 'agent', id: '2', pile: ['2'] };
    p.move(A);
    expect(p.state).toBe('idle');
    expect([p.editor.hover.peek(), p.cursor]).toEqual(['2', 'grab']);
    p.chart.outside();
    expect([p.editor.hover.peek(), p.cursor]).toEqual([null, '']);
  });

  it('shows nothing with another tool than select', () => {
    p.hit = { kind: 'agent', id: '2', pile: ['2'] };
    p.editor.chooseTool('measure');
    p.move(A);
    expect([p.editor.hover.peek(), p.cursor]).toEqual([null, 'crosshair']);
  });
});

describe('pressed', () => {
  it('stays pressed while the pointer trembles, and clicks on release', () => {
    p.hit = { kind: 'agent', id: '2', pile: ['2', '3'] };
    p.down(A);
    p.move({ x: A.x + 2, y: A.y + 1 });
    expect(p.state).toBe('pressed');
    p.up(A, { timeStamp: 100 });
    expect([p.state, p.editor.selection.peek()]).toEqual(['idle', '2']);
    p.click(A, 400);
    expect(p.editor.selection.peek()).toBe('3');
  });

  it('lets a finger tremble more than a mouse', () => {
    p.down(A, { touch: true });
    p.move({ x: A.x + 6, y: A.y });
    expect(p.state).toBe('pressed');
    p.move({ x: A.x + 9, y: A.y });
    expect(p.state).toBe('panning');
  });

  it('deselects on the empty picture', () => {
    p.editor.select('1');
    p.click(A);
    expect(p.editor.selection.peek()).toBeNull();
  });

  it('is cancelled on Esc, which then keeps its usual effect', () => {
    p.down(A);
    expect(p.chart.cancel()).toBe(false);
    expect(p.state).toBe('idle');
    p.up(A);
    expect(p.state).toBe('idle');
  });
});

describe('panning', () => {
  it('moves the picture with the pointer, also with Space and the middle button over anything', () => {
    p.hit = goalBody;
    p.editor.select('1');
    p.down(A, { button: 1 });
    p.move(B);
    expect([p.state, p.cursor]).toEqual(['panning', 'grabbing']);
    expect(p.view.cx).toBeCloseTo(-40 / p.view.z);
    expect(p.view.cy).toBeCloseTo(-20 / p.view.z);
    p.up(B);
    expect([p.state, p.cursor]).toEqual(['idle', '']);
    p.chart.spaceHeld = true;
    p.down(A);
    p.move(B);
    expect(p.state).toBe('panning');
  });
});

describe('dragging a handle', () => {
  const take = () => {
    p.editor.select('1');
    const a = p.editor.agent.peek()!;
    p.hit = goalBody;
    const from = p.at(startPose(a)!.x + 20, startPose(a)!.y);
    p.down(from);
    return from;
  };

  it('previews the document, requests live futures, and commits one step on release', () => {
    const from = take();
    p.move({ x: from.x + 4, y: from.y });
    expect([p.state, p.cursor]).toEqual(['dragging handle', 'grabbing']);
    expect(p.editor.drag.info.peek()?.grip).toEqual(goalBody.grip);
    const to = { x: from.x + 80, y: from.y };
    p.move(to);
    expect(p.previewed).toEqual(['1', '1']);
    expect(p.editor.agent.peek()!.goal.pos).not.toBeNull();
    expect(p.editor.document.undoName.peek()).toBeNull();
    p.up(to);
    expect([p.state, p.editor.drag.info.peek()]).toEqual(['idle', null]);
    expect(p.editor.document.undoName.peek()).toMatch(/^Goal of Car 1/);
    p.editor.commits.undo();
    expect(p.editor.agent.peek()!.goal.pos).toBeNull();
  });

  it('scrolls at the edge of the picture as far as the map, and no further', () => {
    p.calm = false;
    const from = take();
    const { box } = p.editor.scene.peek()!.map;
    const { w, h } = p.view;
    p.move({ x: from.x + 50, y: from.y });
    for (const [x, y] of [
      [w - 1, 1],
      [1, h - 1],
    ]) {
      for (let s = 0; s < 20; s += 0.016) p.move({ x, y });
      const [gx, gy] = p.editor.agent.peek()!.goal.pos!;
      expect([gx > box.x0 - 31, gx < box.x1 + 31, gy > box.y0 - 31, gy < box.y1 + 31]).toEqual(Array(4).fill(true));
      const out = x > 1 ? [gx - box.x1, gy - box.y1] : [box.x0 - gx, box.y0 - gy];
      for (const d of out) expect(d).toBeGreaterThan(25);
    }
  });

  it('restores everything on Esc and drops the previews', () => {
    const from = take();
    p.move({ x: from.x + 50, y: from.y });
    expect(p.chart.cancel()).toBe(true);
    expect([p.state, p.editor.drag.info.peek(), p.dropped]).toEqual(['idle', null, 1]);
    expect(p.editor.agent.peek()!.goal.pos).toBeNull();
    p.up(from);
    expect(p.editor.document.undoName.peek()).toBeNull();
  });

  it('is cancelled by a second finger, which then pinches', () => {
    const from = take();
    p.move({ x: from.x + 50, y: from.y });
    p.down({ x: 500, y: 400 }, { id: 2 });
    expect([p.state, p.editor.drag.info.peek()]).toEqual(['pinching', null]);
  });

  it('sends a request ahead of the frame, once, and not again for the same place', () => {
    const from = take();
    p.move({ x: from.x + 50, y: from.y });
    const asked = p.previewed.length;
    const there = { x: from.x + 60, y: from.y };
    p.ahead(there);
    expect(p.previewed).toHaveLength(asked + 1);
    const goal = p.editor.agent.peek()!.goal.pos;
    p.move(there);
    expect(p.previewed).toHaveLength(asked + 1);
    expect(p.editor.agent.peek()!.goal.pos).toEqual(goal);
  });

  it('sends no more requests than frames: places in between are shown, and requested a little later', () => {
    const from = take();
    p.move({ x: from.x + 50, y: from.y });
    const asked = p.previewed.length;
    const x = () => p.editor.agent.peek()!.goal.pos![0];
    p.now += 12;
    p.ahead({ x: from.x + 60, y: from.y });
    const first = x();
    p.now += 8;
    p.ahead({ x: from.x + 64, y: from.y });
    expect([x(), p.previewed.length]).toEqual([first, asked + 1]);
    p.now -= 15;
    p.move({ x: from.x + 70, y: from.y });
    const second = x();
    expect([second > first, p.previewed.length]).toEqual([true, asked + 1]);
    p.now += 4;
    p.ahead({ x: from.x + 80, y: from.y });
    expect([x() > second, p.previewed.length]).toEqual([true, asked + 2]);
    p.now -= 10;
    p.move({ x: from.x + 90, y: from.y });
    expect(p.previewed).toHaveLength(asked + 2);
    // The pointer has stopped.
    p.frame();
    expect(p.previewed).toHaveLength(asked + 3);
    p.frame();
    expect(p.previewed).toHaveLength(asked + 3);
    p.up({ x: from.x + 90, y: from.y });
    expect(p.editor.document.undoName.peek()).not.toBeNull();
  });

  it('handles no moves ahead of the frame before the press, nor with two fingers', () => {
    p.ahead({ x: 300, y: 300 });
    expect(p.previewed).toEqual([]);
    const from = take();
    p.down({ x: 500, y: 400 }, { id: 2 });
    p.ahead({ x: from.x + 60, y: from.y });
    expect(p.previewed).toEqual([]);
  });

  it('reacts to modifier keys at once', () => {
    const from = take();
    expect(p.chart.modified({ alt: true, shift: false, ctrl: false })).toBe(false);
    p.move({ x: from.x + 50, y: from.y });
    expect(p.chart.modified({ alt: true, shift: false, ctrl: false })).toBe(true);
    p.frame(0.016);
    expect(p.previewed).toHaveLength(2);
  });

  it('takes the box of a road user as the handle of its start, only at the start of the scene', () => {
    p.hit = { kind: 'agent', id: '2', pile: ['2'] };
    p.down(A);
    p.move(B);
    expect(p.editor.selection.peek()).toBe('2');
    expect(p.editor.drag.info.peek()?.grip).toEqual({ part: 'start', handle: 'body' });
    p.chart.cancel();
    p.up(B);
    p.editor.playhead.moveTo(3);
    p.down(A);
    p.move(B);
    expect(p.state).toBe('marquee');
  });
});

describe('pinching', () => {
  it('zooms with the distance of two fingers; a single remaining one moves the picture', () => {
    const z = p.view.z;
    p.down(A);
    p.down({ x: 400, y: 300 }, { id: 2 });
    expect(p.state).toBe('pinching');
    p.move({ x: 500, y: 300 }, { id: 2 });
    expect(p.view.z).toBeCloseTo(z * 2);
    p.up(A);
    expect(p.state).toBe('panning');
    const { cx } = p.view;
    p.move({ x: 540, y: 300 }, { id: 2 });
    expect(p.view.cx).toBeCloseTo(cx - 40 / p.view.z);
    p.up(B, { id: 2 });
    expect([p.state, p.taps]).toEqual(['idle', []]);
  });
});

describe('two fingers on the selected road user', () => {
  /** Both beside the box, this many pixels to its left and right, turned about its middle. */
  const pair = (angle: number, apart = 40): [Point, Point] => {
    const { x, y } = startPose(p.editor.agent.peek()!)!;
    const c = p.at(x, y);
    const [dx, dy] = [Math.cos(angle) * apart, -Math.sin(angle) * apart];
    return [
      { x: c.x - dx, y: c.y - dy },
      { x: c.x + dx, y: c.y + dy },
    ];
  };
  const press = (): void => {
    p.editor.select('1');
    const [a, b] = pair(0);
    p.down(a, { touch: true });
    p.down(b, { id: 2, touch: true });
  };
  const heading = (): number => startPose(p.editor.scene.peek()!.agents.get('1')!)!.heading;

  it('turn it, live, and the release is one step', () => {
    press();
    expect(p.state).toBe('turning by fingers');
    const [before, z] = [heading(), p.view.z];
    for (let k = 1; k <= 10; k++) {
      const [a, b] = pair(0.06 * k);
      p.move(a);
      p.move(b, { id: 2 });
    }
    expect(wrapAngle(heading() - before)).toBeCloseTo(0.6, 1);
    expect([p.view.z, p.previewed.at(-1)]).toEqual([z, '1']);
    p.up(pair(0.6)[0]);
    p.up(pair(0.6)[1], { id: 2 });
    expect([p.state, p.editor.drag.active.peek()]).toEqual(['idle', false]);
    expect(p.editor.document.undoName.peek()).toMatch(/^Heading of .* changed$/);
    p.editor.commits.undo();
    expect(heading()).toBeCloseTo(before);
  });

  it('zoom the picture when moved apart', () => {
    press();
    const [before, z] = [heading(), p.view.z];
    for (let k = 1; k <= 10; k++) {
      const [a, b] = pair(0, 40 + 6 * k);
      p.move(a);
      p.move(b, { id: 2 });
    }
    expect(p.state).toBe('pinching');
    expect(p.view.z).toBeGreaterThan(1.5 * z);
    expect(heading()).toBe(before);
  });

  it('zoom the picture elsewhere, and over a locked road user', () => {
    press();
    p.chart.cancel();
    p.editor.commits.run(lockAll([p.editor.agent.peek()!], true)!);
    p.up(pair(0)[0]);
    p.up(pair(0)[1], { id: 2 });
    press();
    expect(p.state).toBe('pinching');
  });
});

describe('fingers', () => {
  const C = { x: 500, y: 420 };
  const tap = (n: 2 | 3, { apart = 0, ends = 200 } = {}): void => {
    const places = [A, B, C].slice(0, n);
    places.forEach((at, i) => p.down(at, { id: i + 1, touch: true, timeStamp: 0 }));
    p.move({ x: A.x + apart, y: A.y }, { id: 1 });
    places.forEach((at, i) => p.up(at, { id: i + 1, timeStamp: ends }));
  };

  it('are tapped two or three at once, shortly and without moving', () => {
    tap(2);
    tap(3);
    expect(p.taps).toEqual([2, 3]);
    tap(2, { apart: 30 });
    tap(2, { ends: 900 });
    expect([p.taps, p.state]).toEqual([[2, 3], 'idle']);
  });

  it('have a loupe over the dragged object, which a mouse has not', () => {
    p.editor.select('1');
    p.hit = goalBody;
    for (const touch of [true, false]) {
      p.down(A, { touch });
      p.move(B);
      expect(p.magnified !== null).toBe(touch);
      p.up(B);
      expect(p.magnified).toBeNull();
    }
  });

  it('drag the road user under them, and pan beside one', () => {
    const [agent, pile] = ['2', ['2']];
    p.hit = { kind: 'agent', id: agent, pile, beside: true };
    p.down(A, { touch: true });
    p.move(B);
    expect([p.state, p.editor.selection.peek()]).toEqual(['panning', null]);
    p.up(B);
    p.hit = { kind: 'agent', id: agent, pile };
    p.down(A, { touch: true });
    p.move(B);
    expect([p.state, p.editor.selection.peek()]).toEqual(['dragging handle', '2']);
  });
});

describe('measuring', () => {
  it('draws a line that stays until the next click', () => {
    p.editor.chooseTool('measure');
    p.down(A);
    p.move({ x: A.x + 80, y: A.y });
    expect(p.state).toBe('measuring');
    p.up(A);
    const { a, b } = p.editor.measure.peek()!;
    expect(b[0] - a[0]).toBeCloseTo(80 / p.view.z);
    p.click(A);
    expect(p.editor.measure.peek()).toBeNull();
  });
});

describe('tools', () => {
  it('each have a name, a key and words of their own', () => {
    for (const of of ['name', 'key', 'label', 'help'] as const)
      expect(new Set(RAIL.map((t) => t[of])).size).toBe(RAIL.length);
  });
});
