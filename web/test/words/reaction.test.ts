// Reactions: road users, sizes, and words.
import { describe, expect, it } from 'vitest';
import { emptyMotion, type Future, type MotionSet } from '../../src/model/document/futures';
import type { ReactionJson } from '../../src/model/document/scene-json';
import { motionFrom, poseAt, type Motion } from '../../src/model/base/motion';
import { answersAhead, type Reaction } from '../../src/model/physics/reaction';
import { findChanges, reactionWords } from '../../src/model/words/change-words';
import { crossing, walker } from '../helpers';

const scene = crossing();
const agent = (id: string) => scene.agents.get(id)!;

/** Straight east at speeds by time, from a place. */
function along(speedAt: (t: number) => number, x0 = 0, y = 0): Motion {
  const n = 91;
  const x = new Float64Array(n).fill(x0),
    speed = new Float64Array(n);
  for (let i = 0; i < n; i++) {
    speed[i] = speedAt(i / 10);
    if (i) x[i] = x[i - 1] + speed[i] * 0.1;
  }
  return { first: 0, x, y: new Float64Array(n).fill(y), heading: new Float64Array(n), speed, valid: [[0, n]] };
}

const following = (motions: Record<string, Motion>, reactions: Record<string, ReactionJson> = {}): MotionSet => ({
  ...emptyMotion('k'),
  futures: new Map(
    Object.entries(motions).map(([id, motion]) => {
      const modes: Future[] = [{ probability: 1, motion, name: '' }];
      return [id, { modes, chosen: 0, step: 5, steps: 5 }];
    }),
  ),
  driving: new Set(Object.keys(motions)),
  answering: new Map(Object.entries(reactions).map(([id, said]) => [id, { said }])),
});

const steady = along(() => 10);
const asked = along(() => 8, 20);
const changes = (to: Motion, reaction?: ReactionJson) =>
  findChanges(
    scene,
    following({ '1': steady, '2': steady }),
    following({ '1': asked, '2': to }, reaction ? { '2': reaction } : {}),
    new Set(['1']),
  );

describe('a change', () => {
  it('is more than half a metre or half a second', () => {
    const behind = (m: number) => along((t) => (t < 1 ? 10 - m : 10));
    expect(changes(behind(0.4))).toEqual([]);
    expect(changes(behind(0.7))).toHaveLength(1);
    const crawling = (until: number) => along((t) => (t < until ? 0 : 0.5));
    const late = findChanges(
      scene,
      following({ '1': steady, '2': crawling(1) }),
      following({ '1': asked, '2': crawling(1.8) }),
      new Set(['1']),
    );
    expect(late).toHaveLength(1);
    expect(late[0].size).toBeLessThan(0.5);
  });

  it('has the place and the cause given by the generator', () => {
    const [c] = changes(
      along((t) => (t < 3 ? 10 - 3 * t : 1)),
      { kind: 'waits', cause: '1', delay_s: 2, time_s: 3, x_m: 16.5, y_m: 0.5, speed_mps: 0.2 },
    );
    expect(c).toMatchObject({
      words: 'waits 2 s behind Car 1',
      lost: 2,
      at: 3,
      place: { x: 16.5, y: 0.5, heading: 0 },
    });
  });

  it('is explained by its shape without a given reason', () => {
    const waits = along((t) => (t < 2 ? 10 - 5 * t : t < 5 ? 0 : 5));
    expect(changes(waits)[0]).toMatchObject({ reaction: { kind: 'waits', cause: { id: '1' } } });
    expect(changes(waits)[0].at).toBeCloseTo(2, 1);
    const slows = along((t) => (t > 2 && t < 4 ? 3 : 10));
    expect(changes(slows)[0].words).toMatch(/^slows to 11 km\/h (behind|for) Car 1$/);
    expect(changes(along(() => 14))[0].words).toBe('speeds up ahead of Car 1');
  });

  it('is that a road user does not appear where another one is', () => {
    const nowhere = motionFrom({ first_step: 1, x_m: [], y_m: [], heading_rad: [] });
    const out = { kind: 'stays_out', cause: '1', delay_s: 0, time_s: 2, x_m: 20, y_m: 0, speed_mps: 0 } as const;
    expect(poseAt(nowhere, 2)).toBeNull();
    expect(changes(nowhere, out)).toMatchObject([
      { words: 'does not appear: Car 1 is in its place', place: { x: 20 } },
    ]);
  });

  it('names no cause without conditions', () => {
    const all = findChanges(scene, following({ '2': steady }), following({ '2': asked }), new Set());
    expect(all.map((c) => [c.words, c.reaction])).toEqual([['replanned', null]]);
  });
});

describe('words', () => {
  const said = (r: Partial<Reaction>, who = agent('2')) =>
    reactionWords(who, {
      kind: 'waits',
      cause: { id: '7', name: 'Car 7' },
      delay: 2,
      time: 3,
      place: { x: 0, y: 0, heading: 0, speed: 2.2 },
      ahead: false,
      ...r,
    });

  it('have the verb first and the other one last', () => {
    expect(said({})).toBe('waits 2 s for Car 7');
    expect(said({ ahead: true, delay: 1.4 })).toBe('waits 1.5 s behind Car 7');
    expect(said({ delay: 0.2 })).toBe('waits for Car 7');
    expect(said({ kind: 'slows', ahead: true })).toBe('slows to 8 km/h behind Car 7');
    expect(said({ kind: 'slows' }, walker(scene))).toBe('slows to 2.2 m/s for Car 7');
    expect(said({ kind: 'slows', place: { x: 0, y: 0, heading: 0, speed: 0.1 } })).toBe('stops briefly for Car 7');
    expect(said({ kind: 'speeds_up' })).toBe('speeds up ahead of Car 7');
    expect(said({ kind: 'keeps_clear' })).toBe('keeps clear of Car 7');
    expect(said({ kind: 'keeps_clear', ahead: true })).toBe('stays behind Car 7');
  });

  it('distinguish a cause ahead on the same path from a crossing one', () => {
    expect(
      answersAhead(
        steady,
        along(() => 10, 15),
        2,
      ),
    ).toBe(true);
    expect(
      answersAhead(
        steady,
        along(() => 10, -15),
        2,
      ),
    ).toBe(false);
    expect(
      answersAhead(
        steady,
        along(() => 10, 15, 6),
        2,
      ),
    ).toBe(false);
    const crossingIt: Motion = { ...along(() => 10, 15), heading: new Float64Array(91).fill(Math.PI / 2) };
    expect(answersAhead(steady, crossingIt, 2)).toBe(false);
  });
});
