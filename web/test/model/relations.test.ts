// Goals relative to another road user: typed, kept by commands, sent and stored, and asked again with the other one.
import { describe, expect, it } from 'vitest';
import { requestForChange } from '../../src/edit/asking/request-for-change';
import { readReach } from '../../src/edit/asking/read-answer';
import { readRelation } from '../../src/edit/tools/relations/typed-relation';
import { clearGoal, removeAgents, setGoal } from '../../src/model/document/commands';
import { emptyMotion } from '../../src/model/document/futures';
import { freeGoal, hasGoal, isPlaced, sceneKey, type Agent, type Scene } from '../../src/model/document/scene';
import { readScene } from '../../src/model/document/scene-reader';
import { conditionOf, writeScene } from '../../src/model/document/scene-writer';
import { relationWords } from '../../src/model/words/relation-words';
import type { Editor } from '../../src/edit/session/editor';
import type { Resolved } from '../../src/net/types';
import { crossing, crossingJson } from '../helpers';

const scene = crossing();
const of = (s: Scene, id: string): Agent => s.agents.get(id)!;
const [one, two, three] = ['1', '2', '3'].map((id) => of(scene, id));
const relation = { to: '1', ahead_m: 12, slower_mps: 4, lanes_left: 1 };
const related = (s: Scene, a: Agent, to = '1'): Scene =>
  setGoal(of(s, a.id), { ...freeGoal(5), relation: { ...relation, to } }).apply(s);

describe('a typed relation', () => {
  const read = (text: string) => readRelation(text, scene, two);
  const why = (text: string) => read(text).why ?? '';

  it('is a gap, a pace and lanes, in any order', () => {
    const all = { relation, time: 5 };
    expect(read(`12 m ahead of ${one.name} at 5 s, 4 m/s slower, one lane left`)).toEqual(all);
    expect(read(`at 5 s one lane left, slower by 14.4 km/h, ahead of ${one.name.toUpperCase()} by 12m`)).toEqual(all);
    expect(read(`8,5 m behind ${one.name}, 2 lanes right, 1 m/s faster`)).toEqual({
      relation: { to: '1', behind_m: 8.5, slower_mps: -1, lanes_left: -2 },
      time: null,
    });
  });

  it('is a time gap, or a time after or before a passing', () => {
    expect(read(`behind ${one.name} by 1.2 s`)).toEqual({ relation: { to: '1', behind_s: 1.2 }, time: null });
    const passing = (after_s: number) => ({ relation: { to: '3', after_s }, time: null });
    expect(read(`reaches the crosswalk 0.5 s after ${three.name}`)).toEqual(passing(0.5));
    expect(read(`0.5 s before ${three.name}`)).toEqual(passing(-0.5));
  });

  it('says what is missing or not possible', () => {
    expect(why('12 m ahead')).toMatch(/Name another road user/);
    // The example is no relation to itself.
    expect(readRelation('near', scene, one).why).toContain(`ahead of ${two.name}`);
    expect(why(`12 m ahead of ${two.name}`)).toMatch(/Name another road user/);
    expect(why(`close to ${one.name}`)).toMatch(/one distance or time/);
    expect(why(`12 m and 2 s behind ${one.name}`)).toMatch(/one distance or time/);
    expect(why(`900 m ahead of ${one.name}`)).toBe('0 m to 500 m is possible');
    expect(why(`9 m ahead of ${one.name}, 7 lanes left`)).toMatch(/possible/);
    expect(readRelation(`9 m ahead of ${two.name}`, related(scene, two), one).why).toMatch(/depends on this one/);
  });

  it('stands in the field as it was understood, and reads as the same', () => {
    const words = relationWords(relation, one.name, 5, 'm/s');
    expect(words).toBe(`12 m ahead of ${one.name} at 5.0 s, 4 m/s slower, 1 lane left`);
    expect(read(words)).toEqual({ relation, time: 5 });
    expect(relationWords({ to: '3', after_s: -0.5 }, three.name, 5, 'km/h')).toBe(`0.5 s before ${three.name}`);
  });
});

describe('a relation in the document', () => {
  it('is sent and stored in place of a place', () => {
    const next = related(scene, two);
    expect(conditionOf(of(next, '2')).goal).toEqual({ time_s: 5, relation });
    const again = readScene(writeScene(crossingJson(), next, null));
    expect(of(again, '2').goal).toEqual(of(next, '2').goal);
    expect(hasGoal(of(again, '2').goal) && isPlaced(of(again, '2').goal)).toBe(true);
    expect(sceneKey(related(scene, two, '3'))).not.toBe(sceneKey(next));
  });

  it('gives the time of a passing', () => {
    const goal = { ...freeGoal(), pos: [3, 4] as const, relation: { to: '1', after_s: 0.5 } };
    const next = setGoal(two, goal).apply(scene);
    expect(conditionOf(of(next, '2')).goal).toEqual({ x_m: 3, y_m: 4, relation: { to: '1', after_s: 0.5 } });
    const away = setGoal(of(next, '2'), { ...of(next, '2').goal, pos: null }).apply(next);
    expect(of(away, '2').goal.relation).toBeUndefined();
  });

  it('ends with a place of its own, with the goal, and with the other road user', () => {
    const next = related(scene, two);
    const a = of(next, '2');
    expect(of(setGoal(a, { ...a.goal, pos: [1, 2] }).apply(next), '2').goal.relation).toBeUndefined();
    expect(of(clearGoal(a).apply(next), '2').goal.relation).toBeUndefined();
    const remove = removeAgents(next, ['1'], '');
    const without = remove.apply(next);
    expect([without.agents.has('1'), hasGoal(of(without, '2').goal)]).toEqual([false, false]);
    const back = remove.invert(next).apply(without);
    expect(of(back, '2').goal.relation).toEqual(relation);
    expect(sceneKey(back)).toBe(sceneKey(next));
  });

  it('leaves its own speed out where the goal has one', () => {
    const next = related(scene, two);
    const a = of(next, '2');
    const fast = of(setGoal(a, { ...a.goal, speed: 9 }).apply(next), '2');
    expect(conditionOf(fast).goal).toEqual({
      time_s: 5,
      speed_mps: 9,
      relation: { to: '1', ahead_m: 12, slower_mps: null, lanes_left: 1 },
    });
  });
});

describe('a change of the other road user', () => {
  it('asks for those whose goals are relative to it, one after the other', () => {
    const next = related(related(scene, two), three, '2');
    const known = new Map(['1', '2', '3'].map((id) => [id, { modes: [{}], chosen: 0 }]));
    const set = { ...emptyMotion(sceneKey(next)), futures: known as never };
    const editor = { answers: { motion: { peek: () => set } } } as unknown as Editor;
    const moved = setGoal(of(next, '1'), { ...freeGoal(), pos: [5, 5] }).apply(next);
    const asked = requestForChange(editor, moved, { name: '', agent: '1', undo: false });
    expect(asked).toMatchObject({ agents: ['1', '2', '3'] });
    expect(requestForChange(editor, next, { name: '', agent: '3', undo: false })).toMatchObject({ agents: ['3'] });
  });

  it('reads the new place from the answer', () => {
    const field = (value: number, from = 'relation') => ({ value, from });
    const goal = { x_m: field(1), y_m: field(2), heading_rad: field(0), speed_mps: field(6), time_s: field(5, 'user') };
    const resolved = (reach: object) => ({ goal, reach }) as unknown as Resolved;
    const place = { x: 1, y: 2, heading: 0, speed: 6, time: 5 };
    expect(readReach(resolved({ status: 'reached' }))?.relative).toEqual(place);
    const nearest = { x_m: 9, y_m: 9, heading_rad: 0, speed_mps: 0 };
    const nowhere = readReach(resolved({ status: 'unreachable', limiting: 'relation', nearest }));
    expect([nowhere?.relative, nowhere?.nearest]).toEqual([null, null]);
  });
});
