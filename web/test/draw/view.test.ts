// World to screen and back, however the picture is turned; the object under the pointer; an animated picture.
import fc from 'fast-check';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { deg, rad, wrapAngle, type Vec } from '../../src/model/base/geometry';
import { setGoal } from '../../src/model/document/commands';
import { startPose } from '../../src/model/document/scene';
import { handlePoints } from '../../src/draw/handles';
import { Recording, Vocabulary } from '../../src/draw/recording/recording';
import { View } from '../../src/draw/view';
import { agentsAt, hitTest, type HitContext } from '../../src/edit/gestures/hit';
import { lockAll } from '../../src/edit/moves/several';
import { readLink, writeLink } from '../../src/edit/document/share-link';
import { Pointer } from '../edit/pointer';

const coordinate = fc.double({ min: -2000, max: 2000, noNaN: true });
const pixel = fc.double({ min: -500, max: 2500, noNaN: true });
const angle = fc.double({ min: -20, max: 20, noNaN: true });
const view = fc
  .record({
    cx: coordinate,
    cy: coordinate,
    z: fc.double({ min: 0.5, max: 40, noNaN: true }),
    turn: angle,
    w: fc.integer({ min: 500, max: 2000 }),
    h: fc.integer({ min: 300, max: 1400 }),
    inset: fc.constantFrom({ left: 0, right: 0, top: 0, bottom: 0 }, { left: 300, right: 20, top: 10, bottom: 90 }),
  })
  .map((v) => Object.assign(new View(), v));

const near = (a: readonly number[], b: readonly number[], by = 1e-6): void => {
  a.forEach((v, i) => expect(Math.abs(v - b[i])).toBeLessThan(by));
};

describe('a view', () => {
  it('moves just far enough to bring a rectangle out from under a cover', () => {
    const side = fc.double({ min: 1, max: 600, noNaN: true });
    fc.assert(
      fc.property(view, pixel, pixel, side, side, (v, x, y, wide, high) => {
        const box = { x0: x, y0: y, x1: x + wide, y1: y + high };
        const corners = [v.from(box.x0, box.y0), v.from(box.x1, box.y1)] as const;
        const clear = () => corners.every(([cx, cy]) => v.isClear(cx, cy, 20 - 1e-6));
        const [was, { cx, cy }] = [clear(), v.camera];
        const fits = v.panInto(box, 20);
        expect(clear()).toBe(fits);
        if (was || !fits) near([v.cx, v.cy], [cx, cy]);
        const { left, right, top, bottom } = v.inset;
        expect(fits).toBe(wide <= v.w - left - right - 40 && high <= v.h - top - bottom - 40);
      }),
    );
  });

  it('converts from the world to the screen and back', () => {
    fc.assert(
      fc.property(view, coordinate, coordinate, (v, x, y) => {
        near(v.from(...v.to(x, y)), [x, y]);
        near([v.x(x, y), v.y(x, y)], v.to(x, y));
      }),
    );
  });

  it('turns by very little, or by a quarter and very little, without a change of size', () => {
    for (const quarter of [0, 1, 2, -1])
      for (const little of [1e-10, 2e-9, 2.2e-5, 1e-3]) {
        const v = Object.assign(new View(), { z: 40, turn: (quarter * Math.PI) / 2 + little });
        const [right, up] = v.across(3, 4);
        expect(Math.abs(Math.hypot(right, up) - 5)).toBeLessThan(1e-12);
        near(v.from(...v.to(-2000, 1500)), [-2000, 1500]);
      }
  });

  it('turns ways and headings as it turns places', () => {
    fc.assert(
      fc.property(view, coordinate, coordinate, angle, (v, x, y, heading) => {
        const [px, py] = v.to(x, y);
        const [qx, qy] = v.to(x + Math.cos(heading), y + Math.sin(heading));
        const [right, down] = v.ahead(heading);
        near([qx - px, qy - py], [right * v.z, down * v.z]);
        near([Math.cos(v.angle(heading)), Math.sin(v.angle(heading))], [right, down]);
        near(v.along(...v.across(x, y)), [x, y]);
        near(v.across(...v.way(30, -20)), [30 / v.z, 20 / v.z]);
      }),
    );
  });

  it('keeps the place under the pointer where it zooms, turns and is fitted', () => {
    fc.assert(
      fc.property(view, pixel, pixel, angle, (v, x, y, turn) => {
        const at = v.from(x, y);
        v.zoomAt(x, y, 1.3);
        v.turnAt(x, y, turn);
        near(v.to(...at), [x, y], 1e-4);
        near([wrapAngle(v.turn - turn)], [0]);
        const box = { x0: at[0] - 20, x1: at[0] + 30, y0: at[1] - 10, y1: at[1] + 10 };
        v.fit(box);
        const { x0, x1, y0, y1 } = v.around(box);
        const { left, right, top, bottom } = v.inset;
        near([(x0 + x1) / 2, (y0 + y1) / 2], [(v.w + left - right) / 2, (v.h + top - bottom) / 2], 1e-4);
        if (v.z < 40) expect(Math.max(x1 - x0 - (v.w - left - right), y1 - y0 - (v.h - top - bottom))).toBeLessThan(1);
      }),
    );
  });

  it('knows which parts of the world are on screen', () => {
    fc.assert(
      fc.property(view, pixel, pixel, (v, x, y) => {
        const [wx, wy] = v.from(x, y);
        const on = x > 1 && x < v.w - 1 && y > 1 && y < v.h - 1;
        const off = x < -1 || x > v.w + 1 || y < -1 || y > v.h + 1;
        if (on || off) expect(v.shows(wx, wy)).toBe(on);
        const { x0, x1, y0, y1 } = v.box();
        if (on) expect(wx >= x0 && wx <= x1 && wy >= y0 && wy <= y1).toBe(true);
      }),
    );
  });

  it('has frames that are upright on the screen', () => {
    fc.assert(
      fc.property(view, pixel, pixel, pixel, pixel, (v, x0, y0, x1, y1) => {
        const [a, b, c, d] = v.frame(v.from(x0, y0), v.from(x1, y1)).map((p: Vec) => v.to(...p));
        const [left, right] = [Math.min(x0, x1), Math.max(x0, x1)];
        const [up, down] = [Math.min(y0, y1), Math.max(y0, y1)];
        near([...a, ...b, ...c, ...d], [left, down, right, down, right, up, left, up], 1e-4);
      }),
    );
  });

  it('has exact quarter turns, and is unchanged with none', () => {
    const v = new View();
    v.turn = rad(90);
    expect(v.along(0.1, 0)).toEqual([0, -0.1]);
    for (let i = 0; i < 6; i++) v.turn -= rad(15);
    expect([v.turn, v.along(0.1, 0.2)]).toEqual([0, [0.1, 0.2]]);
    expect([v.x(3, 7), v.y(3, 7)]).toEqual([400 + 3 * v.z, 300 - 7 * v.z]);
  });

  it('moves no further past a part of the world than now', () => {
    fc.assert(
      fc.property(view, angle, pixel, pixel, (v, turn, dx, dy) => {
        Object.assign(v, { cx: 0, cy: 0, z: 4, turn });
        const part = { x0: -200, x1: 200, y0: -150, y1: 150 };
        const before = v.around(part);
        v.panWithin(dx - 1000, dy - 1000, part);
        const { x0, x1, y0, y1 } = v.around(part);
        const beyond = (now: number, then: number): void => expect(now).toBeLessThan(Math.max(0, then) + 1e-6);
        beyond(x0, before.x0);
        beyond(y0, before.y0);
        beyond(v.w - x1, v.w - before.x1);
        beyond(v.h - y1, v.h - before.y1);
      }),
    );
  });

  it('hands pens the world as it maps it', () => {
    fc.assert(
      fc.property(view, coordinate, coordinate, (v, x, y) => {
        v.dpr = 2;
        const pen = new Recording(new Vocabulary());
        v.lay(pen);
        const [, a, b, c, d, e, f] = pen.take();
        near(
          [a * x + c * y + e, b * x + d * y + f],
          v.to(x, y).map((p) => 2 * p),
          1e-4,
        );
      }),
    );
  });
});

describe('a turned picture under the pointer', () => {
  let p: Pointer;
  const context = (touch: boolean): HitContext => ({
    editor: p.editor,
    view: p.view,
    chips: [],
    timeTag: null,
    edgeTag: null,
    roadSign: null,
    toolHandleAt: () => null,
    pennants: [],
    touch,
  });
  beforeEach(() => {
    p = new Pointer();
  });

  it('finds the same as one with north up', () => {
    const places: Vec[] = [];
    for (let x = -60; x <= 60; x += 3) for (let y = -60; y <= 60; y += 3) places.push([x, y]);
    const found = (touch: boolean) => places.map((at) => hitTest(context(touch), ...p.view.to(...at)));
    p.editor.select('1');
    for (const touch of [false, true]) {
      p.view.turn = 0;
      // Flags are upright however the picture is turned.
      const body = (h: ReturnType<typeof hitTest>) => h.kind !== 'grip' || h.grip.part === 'start';
      const north = found(touch);
      p.view.turn = 0.7;
      const turned = found(touch);
      expect(turned.filter(body).length).toBeGreaterThan(100);
      turned.forEach((h, i) => body(h) && body(north[i]) && expect([places[i], h]).toEqual([places[i], north[i]]));
    }
  });

  it('takes boxes and handles where they appear', () => {
    for (const turn of [-2.4, -0.5, 0, 0.9, 3]) {
      p.view.turn = turn;
      p.editor.selectAll([]);
      for (const a of p.editor.scene.peek()!.agents.values()) {
        const s = startPose(a)!;
        expect(agentsAt(context(false), ...p.view.to(s.x, s.y))).toContain(a.id);
        p.editor.select(a.id);
        const { tip, knob } = handlePoints(p.view, a, s);
        expect(hitTest(context(false), ...knob)).toEqual({ kind: 'grip', grip: { part: 'start', handle: 'heading' } });
        expect(hitTest(context(false), ...tip)).toEqual({ kind: 'grip', grip: { part: 'start', handle: 'speed' } });
      }
    }
  });

  it('takes the flag of a locked road user, to explain the lock, and none of its handles', () => {
    const here = () => p.editor.scene.peek()!.agents.get('1')!;
    const { x, y, heading } = startPose(here())!;
    const pos: Vec = [x + 30 * Math.cos(heading), y + 30 * Math.sin(heading)];
    p.editor.commits.run(setGoal(here(), { ...here().goal, pos }));
    p.editor.select('1');
    const flag = () => hitTest(context(false), ...p.view.to(...pos));
    const free = flag();
    expect(free).toMatchObject({ kind: 'grip', grip: { part: 'goal', handle: 'body' } });
    p.editor.commits.run(lockAll([here()], true)!);
    expect(flag()).toEqual(free);
    const { knob, tip } = handlePoints(p.view, here(), startPose(here())!);
    for (const at of [knob, tip]) expect(hitTest(context(false), ...at).kind).not.toBe('grip');
  });

  it('drags the object with the pointer', () => {
    p.view.turn = rad(140);
    p.editor.select('1');
    const s = startPose(p.editor.agent.peek()!)!;
    p.hit = { kind: 'grip', grip: { part: 'start', handle: 'body' } };
    const from = p.at(s.x, s.y);
    const to = { x: from.x + 60, y: from.y - 35 };
    p.down(from);
    p.move({ x: from.x + 10, y: from.y });
    p.move(to, { alt: true });
    const moved = startPose(p.editor.agent.peek()!)!;
    near(p.view.to(moved.x, moved.y), [to.x, to.y], 1e-6);
  });

  it('pans with the pointer', () => {
    p.view.turn = 1.1;
    const at = p.view.from(300, 300);
    p.down({ x: 300, y: 300 }, { button: 1 });
    p.move({ x: 340, y: 280 });
    near(p.view.to(...at), [340, 280]);
  });

  it('takes road users in a marquee that is upright on the screen', () => {
    p.view.turn = rad(30);
    const seen = [...p.editor.scene.peek()!.agents.values()].map((a) => ({
      a,
      at: p.at(startPose(a)!.x, startPose(a)!.y),
    }));
    p.down({ x: 0, y: 0 });
    p.move({ x: 420, y: 330 });
    p.up({ x: 420, y: 330 });
    const inside = seen.filter(({ at: { x, y } }) => x > 0 && x < 420 && y > 0 && y < 330).map(({ a }) => a.id);
    expect(inside.length).toBeGreaterThan(0);
    expect(inside.length).toBeLessThan(seen.length);
    expect([...p.editor.selected.peek()].sort()).toEqual(inside.sort());
  });
});

describe('two fingers', () => {
  const middle = { x: 400, y: 300 };
  const finger = (degrees: number, way: 1 | -1) => ({
    x: middle.x + way * 100 * Math.cos(rad(degrees)),
    y: middle.y - way * 100 * Math.sin(rad(degrees)),
  });
  const turnedBy = (p: Pointer, ...to: number[]): number => {
    p.down(finger(0, 1), { id: 1, touch: true });
    p.down(finger(0, -1), { id: 2, touch: true });
    for (const d of to) {
      p.move(finger(d, 1), { id: 1 });
      p.move(finger(d, -1), { id: 2 });
    }
    p.up(finger(to.at(-1)!, 1), { id: 1 });
    p.up(finger(to.at(-1)!, -1), { id: 2 });
    return deg(p.view.turn);
  };

  it('turn the picture with them about the point between them', () => {
    const p = new Pointer();
    const at = p.view.from(middle.x, middle.y);
    expect(turnedBy(p, 4, 10, 30, 60)).toBeGreaterThan(50);
    near(p.view.to(...at), [middle.x, middle.y], 1);
    expect(turnedBy(p, -4, -10, -60)).toBeLessThan(10);
  });

  it('do not turn it for a slightly crooked pinch', () => {
    expect(turnedBy(new Pointer(), 3, 6, 7, -5)).toBe(0);
  });

  it('snap to north', () => {
    const p = new Pointer();
    expect(turnedBy(p, 10, 40, 8, 4)).toBe(0);
  });
});

describe('an animated picture', () => {
  it('turns about a fixed point, and ends at its target', async () => {
    vi.stubGlobal('matchMedia', () => ({ matches: false }));
    const now = vi.spyOn(performance, 'now').mockReturnValue(0);
    const { Glide } = await import('../../src/draw/glide');
    const v = Object.assign(new View(), { cx: 40, cy: -10, z: 6 });
    const glide = new Glide(v, () => undefined);
    const at = v.from(120, 500);
    glide.by((end) => {
      end.zoomAt(120, 500, 1.7);
      end.turnAt(120, 500, rad(-170));
    });
    for (const t of [30, 90, 150, 180]) {
      now.mockReturnValue(t);
      glide.frame();
      near(v.to(...at), [120, 500], 1e-6);
    }
    expect([glide.going, Math.round(deg(v.turn))]).toEqual([false, -170]);
    // Past half a turn the other direction is shorter.
    glide.by((end) => end.turnAt(120, 500, rad(170)));
    now.mockReturnValue(230);
    glide.frame();
    expect(Math.abs(deg(v.turn))).toBeGreaterThan(170);
    vi.unstubAllGlobals();
    now.mockRestore();
  });
});

describe('a link', () => {
  it('contains the turn of the picture; one without means north up', async () => {
    const scene = { agents: [] } as never;
    const sent = async (camera: { cx: number; cy: number; z: number; turn?: number }) =>
      (await readLink((await writeLink({ scene, at: { time: 1, camera } })).hash)).at;
    const v = new View();
    v.look((await sent({ cx: 1, cy: 2, z: 8, turn: 0.25 }))!.camera);
    expect(v.camera).toEqual({ cx: 1, cy: 2, z: 8, turn: 0.25 });
    v.look((await sent({ cx: 1, cy: 2, z: 8 }))!.camera);
    expect(v.turn).toBe(0);
    expect(await sent({ cx: 1, cy: 2, z: 8, turn: 'x' as never })).toBeNull();
  });
});
