// Several road users, and new ones: the effects of the pointer, without a page.
import { beforeEach, describe, expect, it } from 'vitest';
import { setGoal } from '../../src/model/document/commands';
import type { Vec } from '../../src/model/base/geometry';
import { PRESETS } from '../../src/model/base/kinds';
import { readTyped } from '../../src/model/base/units';
import { startPose, type Agent } from '../../src/model/document/scene';
import { Copying, removeSelected } from '../../src/edit/moves/copying';
import { placeGhost } from '../../src/edit/gestures/placing';
import { touching } from '../../src/model/physics/boxes';
import { alongLine, overArea } from '../../src/edit/moves/placing';
import { inTheWay, standing } from '../../src/edit/moves/room';
import { View } from '../../src/draw/view';
import { copiesOf, lockAll, middleOf, mirrorAll, setDoes, swapTwo, withRoom } from '../../src/edit/moves/several';
import { requestForChange } from '../../src/edit/asking/request-for-change';
import { Pointer } from './pointer';
import { Session } from './session';

let p: Pointer;
beforeEach(() => {
  p = new Pointer();
});

const all = (): Agent[] => [...p.editor.scene.peek()!.agents.values()];
const agent = (id: string): Agent => p.editor.scene.peek()!.agents.get(id)!;
const place = (id: string) => startPose(agent(id))!;
const on = (id: string) => {
  p.hit = { kind: 'agent', id, pile: [id] };
  return p.at(place(id).x, place(id).y);
};
const ground = { kind: 'none' } as const;

describe('selecting several', () => {
  it('adds and removes with Shift', () => {
    p.click(on('1'));
    p.chart.modifiers = { shift: true, alt: false, ctrl: false };
    p.click(on('2'));
    expect(p.editor.selected.peek()).toEqual(['1', '2']);
    expect(p.editor.selection.peek()).toBeNull();
    p.click(on('1'));
    expect(p.editor.selected.peek()).toEqual(['2']);
    p.hit = ground;
    p.click({ x: 1, y: 1 });
    expect(p.editor.selected.peek()).toEqual(['2']);
  });

  /** A marquee with exactly one of two centres inside. */
  const sweep = (id: string, mods = {}) => {
    p.hit = ground;
    const { x, y } = place(id);
    const from = p.at(x - 1, y - 1),
      to = p.at(x + 1, y + 1);
    p.down(from);
    p.move(to, mods);
    const during = p.editor.sweep.peek();
    p.up(to);
    return during;
  };

  it('takes road users with their centre in the marquee, adds with Shift, removes with Alt', () => {
    const during = sweep('1');
    expect(during!.ids).toContain('1');
    expect(during!.outline).toHaveLength(4);
    expect(p.editor.selected.peek()).toEqual(during!.ids);
    expect(p.editor.sweep.peek()).toBeNull();
    sweep('2', { shift: true });
    expect(p.editor.selected.peek()).toEqual(expect.arrayContaining(['1', '2']));
    sweep('1', { alt: true });
    expect(p.editor.selected.peek()).not.toContain('1');
    expect(p.editor.selected.peek()).toContain('2');
  });

  it('restores the old selection on Esc', () => {
    p.editor.select('2');
    p.hit = ground;
    p.down(p.at(-500, -500));
    p.move(p.at(500, 500));
    expect(p.editor.sweep.peek()!.ids.length).toBeGreaterThan(2);
    expect(p.chart.cancel()).toBe(true);
    expect([p.editor.selected.peek(), p.editor.sweep.peek()]).toEqual([['2'], null]);
  });

  it('draws a lasso of any form round them', () => {
    p.editor.chooseTool('lasso');
    p.hit = ground;
    const { x, y } = place('1');
    p.down(p.at(x - 2, y - 2));
    for (const [dx, dy] of [
      [2, -2],
      [2, 2],
      [-2, 2],
    ])
      p.move(p.at(x + dx, y + dy));
    expect(p.state).toBe('lasso');
    p.up(p.at(x - 2, y + 2));
    expect(p.editor.selected.peek()).toContain('1');
  });
});

describe('several in a drag', () => {
  beforeEach(() => p.editor.selectAll(['1', '2']));

  it('move together as one step, and are restored on Esc', () => {
    const before = { a: place('1'), b: place('2') };
    const from = on('2');
    p.down(from);
    p.move({ x: from.x + 80, y: from.y });
    expect(p.state).toBe('dragging several');
    expect(place('1').x).toBeCloseTo(before.a.x + 80 / p.view.z);
    p.chart.cancel();
    expect(place('1')).toEqual(before.a);
    p.down(from);
    p.move({ x: from.x + 80, y: from.y - 40 });
    p.up({ x: from.x + 80, y: from.y - 40 });
    for (const [id, was] of [
      ['1', before.a],
      ['2', before.b],
    ] as const) {
      expect(place(id).x).toBeCloseTo(was.x + 80 / p.view.z);
      expect(place(id).y).toBeCloseTo(was.y + 40 / p.view.z);
    }
    expect(p.editor.document.undoName.peek()).toBe('2 cars moved');
    p.editor.commits.undo();
    expect([place('1'), place('2')]).toEqual([before.a, before.b]);
    expect(p.editor.document.undoName.peek()).toBeNull();
  });

  it('leave locked ones where they are', () => {
    const was = place('1');
    p.editor.commits.run(lockAll([agent('1')], true)!);
    const from = on('2');
    p.down(from);
    p.move({ x: from.x + 50, y: from.y });
    p.up({ x: from.x + 50, y: from.y });
    expect(place('1')).toEqual(was);
    expect(p.editor.notices.toast.peek()?.text).toBe('1 locked, not changed.');
    removeSelected(p.editor);
    expect(all().map((a) => a.id)).toContain('1');
    expect(all().map((a) => a.id)).not.toContain('2');
  });

  it('change sides about their common centre, as seen by the first; twice restores them', () => {
    const ids = ['1', '2', '3'];
    const before = ids.map(place);
    const [mx, my] = middleOf(ids.map(agent));
    const axis = before[0].heading;
    /** Metres ahead and to the left of the centre. */
    const seen = ({ x, y }: { x: number; y: number }): [number, number] => {
      const [dx, dy] = [x - mx, y - my];
      return [dx * Math.cos(axis) + dy * Math.sin(axis), dy * Math.cos(axis) - dx * Math.sin(axis)];
    };
    p.editor.commits.run(mirrorAll(ids.map(agent))!);
    ids.map(place).forEach((now, i) => {
      expect(seen(now)[0]).toBeCloseTo(seen(before[i])[0], 3);
      expect(seen(now)[1]).toBeCloseTo(-seen(before[i])[1], 3);
      expect(Math.sin(now.heading - axis)).toBeCloseTo(-Math.sin(before[i].heading - axis), 4);
    });
    expect(p.editor.document.undoName.peek()).toMatch(/mirrored$/);
    p.editor.commits.undo();
    ids.map(place).forEach((now, i) => expect(now).toEqual(before[i]));
  });

  it('two change places, and keep their speeds', () => {
    const [a, b] = ['1', '2'].map((id) => ({ ...place(id) }));
    expect(swapTwo([agent('1')])).toBeNull();
    p.editor.commits.run(swapTwo(['1', '2'].map(agent))!);
    expect(place('1')).toEqual({ ...b, speed: a.speed });
    expect(place('2')).toEqual({ ...a, speed: b.speed });
    p.editor.commits.undo();
    expect(place('1')).toEqual(a);
  });

  it('a single one stays, and its goal changes sides', () => {
    const a = agent('1');
    expect(mirrorAll([a])).toBeNull();
    const { x, y, heading } = place('1');
    const beside = (left: number): Vec => [
      x + 20 * Math.cos(heading) - left * Math.sin(heading),
      y + 20 * Math.sin(heading) + left * Math.cos(heading),
    ];
    p.editor.commits.run(setGoal(a, { ...a.goal, pos: beside(3), heading: heading + 0.3 }));
    p.editor.commits.run(mirrorAll([agent('1')])!);
    const { pos, heading: to } = agent('1').goal;
    beside(-3).forEach((v, i) => expect(pos![i]).toBeCloseTo(v, 3));
    expect(to).toBeCloseTo(heading - 0.3, 4);
    expect(place('1')).toMatchObject({ x, y, heading });
  });

  it('turn about their common centre, or each about itself with Alt', () => {
    const [a, b] = [place('1'), place('2')];
    const mid = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
    p.hit = { kind: 'frame', handle: 'turn' };
    const from = p.at(mid.x, mid.y + 20);
    p.down(from);
    p.move(p.at(mid.x - 20, mid.y));
    p.up(p.at(mid.x - 20, mid.y));
    expect(place('1').heading - a.heading).toBeCloseTo(Math.PI / 2, 2);
    expect(place('1').x).toBeCloseTo(mid.x - (a.y - mid.y), 1);
    p.editor.commits.undo();
    p.down(from);
    p.move(p.at(mid.x - 20, mid.y), { alt: true });
    expect(place('1').x).toBeCloseTo(a.x);
    expect(place('1').heading - a.heading).toBeCloseTo(Math.PI / 2, 2);
    p.chart.cancel();
  });
});

describe('copies', () => {
  it('are dragged away with Alt, and the originals stay', () => {
    const n = all().length;
    const was = place('1');
    const from = on('1');
    p.down(from);
    p.move({ x: from.x + 60, y: from.y }, { alt: true });
    p.move({ x: from.x + 90, y: from.y }, { alt: true });
    expect(p.state).toBe('dragging copies');
    expect(p.placement.ghosts.peek()!.all).toHaveLength(1);
    expect(all()).toHaveLength(n);
    p.up({ x: from.x + 90, y: from.y });
    expect(all()).toHaveLength(n + 1);
    const copy = p.editor.agent.peek()!;
    expect([copy.placed, copy.kind, copy.length]).toEqual([true, agent('1').kind, agent('1').length]);
    expect(copy.log.x.length).toBe(1);
    expect(place('1')).toEqual(was);
    p.editor.commits.undo();
    expect(all()).toHaveLength(n);
  });

  it('are text between scenes, and land on free ground under the pointer', () => {
    p.editor.selectAll(['1', '2']);
    const text = new Copying(p.editor).copy()!;
    const other = new Pointer();
    const there = new Copying(other.editor);
    expect(there.paste('something else', [0, 0], 8)).toBe(false);
    const before = standing(other.editor.scene.peek()!);
    expect(there.paste(text, [0, 0], 8)).toBe(true);
    const fresh = other.editor.chosenOnes;
    expect(fresh).toHaveLength(2);
    for (const a of fresh) expect(inTheWay({ ...a, pose: startPose(a)! }, before)).toBeUndefined();
    const [a, b] = fresh.map((f) => startPose(f)!);
    expect(b.x - a.x).toBeCloseTo(place('2').x - place('1').x);
    expect(b.y - a.y).toBeCloseTo(place('2').y - place('1').y);
  });

  it('are placed without overlaps, also as copies of copies', () => {
    p.editor.select('1');
    const copying = new Copying(p.editor);
    for (let i = 0; i < 6; i++) copying.duplicate();
    const boxes = standing(p.editor.scene.peek()!).filter((b) => b.agent.placed);
    expect(boxes).toHaveLength(6);
    boxes.forEach((b, i) => expect(inTheWay(b, boxes.slice(i + 1))).toBeUndefined());
    const scene = p.editor.scene.peek()!;
    const copies = copiesOf([agent('1')]);
    const [put] = withRoom(scene, copies);
    expect(touching({ ...put }, { ...copies[0] })).toBe(false);
  });
});

describe('placing', () => {
  const road = () => {
    const lane = [...p.editor.scene.peek()!.map.lanes.values()].find((l) => l.kind === 'road' && l.line.length > 30)!;
    const [a, b] = lane.line.pts;
    return { lane, heading: Math.atan2(b[1] - a[1], b[0] - a[0]), pts: lane.line.pts };
  };
  const free = () => {
    const scene = p.editor.scene.peek()!;
    const { pts } = road();
    return pts.find(([x, y]) => !inTheWay({ pose: { x, y, heading: 0 }, length: 8, width: 8 }, standing(scene)))!;
  };

  it('shows a ghost on the lane and puts a car there, several in a row', () => {
    p.editor.chooseTool('place-car');
    const [x, y] = free();
    p.move(p.at(x + 0.4, y + 0.4));
    const ghost = p.placement.ghosts.peek()!.all[0];
    expect(ghost.fits).toBe(true);
    expect(Math.hypot(ghost.who.pose.x - x, ghost.who.pose.y - y)).toBeLessThan(1);
    const n = all().length;
    p.click(p.at(x, y));
    expect(all()).toHaveLength(n + 1);
    const a = p.editor.agent.peek()!;
    expect([a.placed, a.length]).toEqual([true, PRESETS.car[0].length]);
    expect(p.editor.tool.peek()).toBe('place-car');
  });

  it('offers a free place further on where a road user stands', () => {
    p.editor.chooseTool('place-car');
    const { x, y } = place('1');
    const n = all().length;
    p.click(p.at(x, y));
    expect(all()).toHaveLength(n);
    const toast = p.editor.notices.toast.peek()!;
    expect(toast.text).toMatch(/^Car 1 is already here/);
    expect([toast.action?.label, toast.second?.label]).toEqual(['Place ahead', 'Place here']);
    toast.action!.run();
    expect(all()).toHaveLength(n + 1);
    const put = p.editor.agent.peek()!;
    const others = standing(p.editor.scene.peek()!).filter((b) => b.agent.id !== put.id);
    expect(inTheWay({ ...put, pose: startPose(put)! }, others)).toBeUndefined();
    p.editor.commits.undo();
    toast.second!.run();
    const there = startPose(p.editor.agent.peek()!)!;
    expect(Math.hypot(there.x - x, there.y - y)).toBeLessThan(2.5);
  });

  it('turns the ghost with the pointer and with keys', () => {
    p.editor.chooseTool('place-pedestrian');
    const from = p.at(80, 80);
    p.down(from);
    p.move({ x: from.x, y: from.y - 30 });
    expect(p.state).toBe('turning');
    expect(p.placement.ghosts.peek()!.all[0].who.pose.heading).toBeCloseTo(Math.PI / 2);
    p.up({ x: from.x, y: from.y - 30 });
    expect(startPose(p.editor.agent.peek()!)!.heading).toBeCloseTo(Math.PI / 2);
    p.move(p.at(90, 80));
    const scene = p.editor.scene.peek()!;
    expect(p.placement.turnBy(scene, 0.5)).toBe(true);
    expect(p.placement.again(scene, 1, 0)).toBe(true);
    placeGhost(p.editor, p.placement);
    expect(startPose(p.editor.agent.peek()!)!.heading).toBeCloseTo(0.5);
  });

  it('spreads many over an area or along a line with one drag, one step, without overlaps', () => {
    for (const [spread, to] of [
      ['area', [100, 100]],
      ['line', [110, 70]],
    ] as const) {
      p.editor.chooseTool('place-pedestrian');
      p.placement.choose('pedestrian', { spread, count: 20 });
      const n = all().length;
      p.down(p.at(80, 80));
      p.move(p.at(90, 90));
      p.move(p.at(to[0], to[1]));
      expect(p.placement.ghosts.peek()!.words).toBe('20 pedestrians');
      p.up(p.at(to[0], to[1]));
      expect(all()).toHaveLength(n + 20);
      expect(p.editor.selected.peek()).toHaveLength(20);
      const boxes = standing(p.editor.scene.peek()!).filter((b) => b.agent.placed);
      boxes.forEach((b, i) => expect(inTheWay(b, boxes.slice(i + 1))).toBeUndefined());
      expect(p.editor.document.undoName.peek()).toBe('20 pedestrians placed');
      p.editor.commits.undo();
      expect(all()).toHaveLength(n);
    }
  });

  it('puts nobody from an area or a line into a road user, nor where a moving one cannot stop', () => {
    const scene = p.editor.scene.peek()!;
    const { x, y, heading, speed } = startPose(agent('1'))!;
    expect(speed).toBeGreaterThan(8);
    const ahead = (d: number) => [x + d * Math.cos(heading), y + d * Math.sin(heading)] as const;
    const choice = { kind: 'pedestrian', size: PRESETS.pedestrian[0], count: 30 } as const;
    const put = [
      ...overArea(scene, { ...choice, spread: 'area' }, new View().frame([x - 12, y - 12], [x + 12, y + 12]), 10),
      ...alongLine(scene, { ...choice, spread: 'line' }, ahead(-10), ahead(20), 10),
    ];
    expect(put.length).toBeGreaterThan(20);
    const most = speed ** 2 / (2 * 3.8) + agent('1').length / 2;
    for (const n of put) {
      const along = (n.pose.x - x) * Math.cos(heading) + (n.pose.y - y) * Math.sin(heading);
      const aside = Math.abs((n.pose.y - y) * Math.cos(heading) - (n.pose.x - x) * Math.sin(heading));
      expect(inTheWay(n, standing(scene))).toBeUndefined();
      expect(along < 0 || along > most || aside > agent('1').width / 2).toBe(true);
    }
  });

  it('reports how many fit where not all do', () => {
    p.editor.chooseTool('place-bus');
    p.placement.choose('bus', { spread: 'area', count: 50 });
    p.down(p.at(80, 80));
    p.move(p.at(90, 90));
    p.up(p.at(100, 100));
    const placed = p.editor.selected.peek().length;
    expect(placed).toBeLessThan(50);
    if (placed) expect(p.editor.document.undoName.peek()).toMatch(/of 50 buses placed: no room for more/);
    else expect(p.editor.notices.toast.peek()?.text).toBe('No room here.');
  });
});

describe('menus', () => {
  it('open on the right button and on a resting finger, for the object there', () => {
    p.hit = ground;
    p.down({ x: 50, y: 50 }, { button: 2 });
    p.up({ x: 50, y: 50 });
    const at = on('2');
    p.down(at, { button: 2 });
    p.up(at);
    expect(p.editor.selection.peek()).toBe('2');
    p.editor.selectAll(['1', '2']);
    p.down(at, { button: 2 });
    p.up(at);
    expect(p.editor.selected.peek()).toEqual(['1', '2']);
    p.hit = { kind: 'pennant', id: '1' };
    p.down(at, { button: 2 });
    p.up(at);
    p.hit = { kind: 'agent', id: '3', pile: ['3'] };
    p.down(at, { touch: true });
    for (let i = 0; i < 40; i++) p.frame(0.016);
    expect(p.state).toBe('asked');
    p.up(at);
    expect(p.state).toBe('idle');
    expect(p.menus).toEqual(['ground', 'road-user', 'several', 'goal', 'road-user']);
  });

  it('do not open where the right button moves the picture', () => {
    p.hit = ground;
    p.down({ x: 50, y: 50 }, { button: 2 });
    p.move({ x: 90, y: 50 });
    expect(p.state).toBe('panning');
    p.up({ x: 90, y: 50 });
    expect(p.menus).toEqual([]);
  });
});

describe('a pennant', () => {
  it('selects its road user, and adds it with Shift', () => {
    p.hit = { kind: 'pennant', id: '2' };
    p.move({ x: 40, y: 40 });
    expect([p.editor.hover.peek(), p.cursor]).toEqual(['2', 'pointer']);
    p.click({ x: 40, y: 40 });
    expect(p.editor.selection.peek()).toBe('2');
    p.hit = { kind: 'pennant', id: '1' };
    p.chart.modifiers = { shift: true, alt: false, ctrl: false };
    p.click({ x: 40, y: 40 });
    expect(p.editor.selected.peek()).toEqual(['2', '1']);
  });
});

describe('a locked road user', () => {
  it('refuses drags and explains how to unlock it', () => {
    p.editor.commits.run(lockAll([agent('1')], true)!);
    const was = place('1');
    const at = on('1');
    p.down(at);
    p.move({ x: at.x + 40, y: at.y });
    p.up({ x: at.x + 40, y: at.y });
    expect(place('1')).toEqual(was);
    expect(p.editor.notices.toast.peek()?.text).toBe('Locked. Ctrl L unlocks.');
  });
});

describe('typed text', () => {
  it('is a value, a change or invalid', () => {
    const read = (text: string, now: number) => readTyped(text, 'km/h')?.(now) ?? null;
    expect(read('50/3.6', 1)).toBeCloseTo(13.889, 3);
    expect(read('+5', 30)).toBe(35);
    expect(read('-=5', 30)).toBe(25);
    expect(read('×1.1', 30)).toBeCloseTo(33);
    expect(read('/2', 30)).toBe(15);
    expect(read('30 mph', 0)).toBeCloseTo(48.28, 2);
    expect(read('−5', 30)).toBe(-5);
    expect(read('abc', 30)).toBeNull();
    expect(read('', 30)).toBeNull();
    expect(read('/0', 30)).toBeNull();
  });
});

describe('a request to the generator', () => {
  const roster = (s: Session) => s.editor.scene.peek()!;

  it('covers all added road users, with the whole scene while the server lacks them', () => {
    const s = new Session();
    const copying = new Copying(s.editor);
    s.editor.selectAll(['1', '2']);
    copying.duplicate();
    const fresh = s.editor.selected.peek();
    const asked = requestForChange(s.editor, roster(s), { name: '', agent: null, several: fresh, undo: false });
    expect(asked).toMatchObject({ agents: [...fresh], react: true });
    s.generation.generateAll();
    const { scene, options } = s.generator.last;
    const sent = scene() as { scene: { agents: { id: string; track: { x_m: number[] } }[] } };
    const put = sent.scene.agents.find((a) => a.id === fresh[0])!;
    expect(put.track.x_m).toHaveLength(1);
    expect(options.conditions[fresh[0]].start).toMatchObject({ speed_mps: expect.any(Number) });
  });

  it('no longer has a removed road user', () => {
    const s = new Session();
    s.generation.generateAll();
    expect(s.generator.last.scene()).toEqual({ id: roster(s).id });
    s.editor.select('2');
    removeSelected(s.editor);
    s.generation.generateAll();
    const sent = s.generator.last.scene() as { scene: { agents: { id: string }[] } };
    expect(sent.scene.agents.map((a) => a.id)).not.toContain('2');
    // The generation since is a separate step.
    s.editor.commits.undo();
    s.editor.commits.undo();
    s.generation.generateAll();
    expect(s.generator.last.scene()).toEqual({ id: roster(s).id });
  });

  it('sets single road users to react, and stands those that hold still', () => {
    const s = new Session();
    const scene = roster(s);
    const still = setDoes(scene, [scene.agents.get('2')!], 'still')!;
    s.editor.commits.run(still);
    s.editor.select('1');
    const asked = requestForChange(s.editor, roster(s), { name: '', agent: '1', undo: false });
    expect(asked).toBe('nothing');
    s.generation.generateAll();
    const sent = s.generator.last.scene() as { scene: { agents: { id: string; track: { x_m: number[] } }[] } };
    const held = sent.scene.agents.find((a) => a.id === '2')!;
    expect(new Set(held.track.x_m).size).toBe(1);
  });
});
