// Names of futures: what each rule says, and that every name is true of one future and false of the others.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { FaultKind, Manoeuvre } from '../../src/model/document/scene-json';
import type { FutureFacts } from '../../src/model/document/future-facts';
import { distances } from '../../src/model/base/motion';
import { nameAll, nameRest, otherNamed, type Nameable } from '../../src/model/words/future-names';
import { ANSWERS, aside, drive, modesOf, motionOf, paced, related, who } from './named-lists';

const namesOf = (list: string): string[] => nameAll(modesOf(ANSWERS[list]), who).map((n) => n.name);
const names = (...modes: Nameable[]): string[] => nameAll(modes, who).map((n) => n.name);

describe('the order with another road user', () => {
  const before = [related('before', '3')];
  const after = [related('after', '3')];

  it('is named where some are before it and all others after', () => {
    expect(names(drive(paced(9, 9, 9, 9, 9, 9, 9, 9, 9, 9), before), drive(aside(6), after))).toEqual([
      'Before Car 3',
      'After Car 3',
    ]);
    const turns = drive(aside(9), after, 'left');
    expect(names(drive(aside(9), before), turns, drive(aside(6), after))).toEqual([
      'Straight on before Car 3',
      'Turns left',
      'Straight on after Car 3',
    ]);
    // The other of the two names is of no road user.
    expect(nameAll([drive(aside(9), before), drive(aside(6), after)], who).map((n) => otherNamed(n.basis))).toEqual([
      '3',
      '3',
    ]);
    expect(otherNamed('Straight on')).toBeNull();
  });

  it('is not named where all have it, or one has none', () => {
    expect(names(drive(aside(9), after), drive(aside(6), after))).toEqual(['Straight on', 'Straight on, slower']);
    const three = names(drive(aside(9), before), drive(aside(6), after), drive(aside(4)));
    expect(three).toEqual(['Straight on, covers 81 m', 'Straight on, covers 54 m', 'Straight on, covers 36 m']);
  });

  it('is not named where it is close, met, or later than the future', () => {
    const list = (more: object) => names(drive(aside(9), [related('before', '3', more)]), drive(aside(6), after));
    expect(list({ gap: 0.4 })[0]).toBe('Straight on');
    expect(list({ gap: null })[0]).toBe('Straight on');
    // Nobody sees the other pass at 10 s.
    expect(list({ time: 8, gap: 2 })[0]).toBe('Straight on');
    const hit = drive(aside(9), before);
    const faults = [
      { kind: 'near_miss' as const, time: 4, until: 5, at: [0, 0] as const, extent: 1, with: '3', edge: null },
    ];
    expect(names({ ...hit, about: { ...hit.about!, faults } }, drive(aside(6), after))[0]).toBe('Straight on');
  });

  it('is never that of following, which may end', () => {
    const follows = (other: string) => [related('follows', other)];
    expect(names(drive(aside(9), follows('3')), drive(aside(6), before))).toEqual([
      'Straight on',
      'Straight on, slower',
    ]);
  });
});

describe('a stop on the way', () => {
  /** 14 m on it stands from 3 s to 6 s. */
  const stands = paced(8, 5, 2, 0, 0, 0, 0, 3, 6, 8);
  const goes = aside(8);
  const gives = (more: object) => [related('gives_way_to', '3', { time: 7, ...more })];
  const list = (more: object): string => names(drive(goes), drive(stands, gives(more)))[1];

  it('names whom it waits for, where that one passes close by meanwhile', () => {
    expect(list({})).toBe('Waits for Car 3');
    expect(names(drive(stands, gives({})))).toEqual(['Waits for Car 3']);
    expect(names(drive(goes), drive(stands, gives({})), drive(goes, [], 'left'))[1]).toBe(
      'Straight on, waits for Car 3',
    );
  });

  it('names nobody who is far off, passes at another time, or never', () => {
    expect(list({ at: [30, 0] })).toBe('Straight on, slower');
    expect(list({ gap: 5 })).toBe('Straight on, slower');
    expect(list({ time: 9, gap: 0.5 })).toBe('Straight on, slower');
    expect(list({ gap: null })).toBe('Straight on, slower');
  });

  it('names nobody where another stands, too, but how long', () => {
    const longer = paced(8, 5, 2, 0, 0, 0, 0, 0, 0, 5);
    expect(names(drive(goes), drive(stands, gives({})), drive(longer, gives({})))).toEqual([
      'Straight on, covers 72 m',
      'Straight on, covers 24 m',
      'Straight on, covers 12 m',
    ]);
  });

  it('is none where it hardly drives on', () => {
    const creeps = paced(8, 8, 8, 4, 0, 0, 0, 0, 0.8, 0.8);
    expect(names(drive(goes), drive(creeps, gives({})))).toEqual(['Straight on', 'Stops']);
  });

  it('is a difference of those that get equally far', () => {
    const even = paced(3.5, 3.5, 3.5, 3.5, 3.5, 3.5, 3.5, 3.5, 3.5, 3.5);
    const waits = paced(3.5, 3.5, 3.5, 0, 0, 0, 3.5, 7, 7, 7);
    expect(names(drive(even), drive(waits))[1]).toMatch(/^Straight on, waits 2\.\d s$/);
  });
});

describe('a lane', () => {
  const shifted = (side: number) =>
    drive(
      motionOf(9, Array.from({ length: 9 }, (_, k) => [9 * (k + 1), (side * (k + 1)) / 9, 0, 9]).flat()),
      [],
      'lane_left',
    );

  it('is named only of one that ends clear of its lines; else metres', () => {
    const list = [drive(aside(9)), shifted(1.8), shifted(3.5)];
    const clear = { ...who, inLane: (p: { y: number }) => p.y > 3 };
    expect(nameAll(list, clear).map((n) => n.name)).toEqual([
      'Straight on',
      'Straight on, further left',
      'Changes lane left',
    ]);
    expect(nameAll(list, { ...who, inLane: () => false }).map((n) => n.name)).toEqual([
      'Straight on',
      'Straight on, 1.8 m further left',
      'Straight on, 3.4 m further left',
    ]);
  });
});

describe('what tells those of one manoeuvre apart', () => {
  it('is one measure for all of them where one suffices', () => {
    expect(names(drive(aside(9)), drive(aside(7)), drive(aside(11, 2)))).toEqual([
      'Straight on',
      'Straight on, slower',
      'Straight on, faster',
    ]);
  });

  it('is a measure in which no other has the same', () => {
    // The second is beside the first and third, the third behind both.
    expect(names(drive(aside(9)), drive(aside(9, 2)), drive(aside(7)))).toEqual([
      'Straight on',
      'Straight on, further left',
      'Straight on, slower',
    ]);
  });

  it('is true of each, with numbers', () => {
    /** Over to the side within 20 m, whatever its speed. */
    const over = (speed: number, side: number) =>
      motionOf(
        speed,
        Array.from({ length: 9 }, (_, k) => speed * (k + 1)).flatMap((x) => [x, side * Math.min(1, x / 20), 0, speed]),
      );
    const one = fc.record({
      speed: fc.double({ min: 3, max: 15, noNaN: true }),
      side: fc.double({ min: -4, max: 4, noNaN: true }),
    });
    fc.assert(
      fc.property(fc.array(one, { minLength: 2, maxLength: 6 }), (list) => {
        const motions = list.map((m) => over(m.speed, m.side));
        const named = names(...motions.map((m) => drive(m)));
        const gone = motions.map((m) => distances(m)[90]);
        expect(named[0]).toMatch(/^Straight on(, covers \d+ m)?$/);
        named.forEach((name, i) => {
          expect(name.length).toBeLessThanOrEqual(36);
          const covers = /covers (\d+) m$/.exec(name);
          const off = gone[i] - gone[0];
          if (covers) expect(Math.abs(gone[i] - Number(covers[1]))).toBeLessThanOrEqual(0.51);
          if (/faster$/.test(name)) expect(off).toBeGreaterThan(1);
          if (/slower$/.test(name)) expect(off).toBeLessThan(-1);
          const side = /([\d.]+) m further (left|right)$/.exec(name);
          // Smaller differences of the made ways are within the steps of a second.
          const left = list[i].side - list[0].side;
          if (side && Math.abs(left) > 0.8) expect(left * (side[2] === 'left' ? 1 : -1)).toBeGreaterThan(0);
        });
      }),
      { numRuns: 300 },
    );
  });
});

describe("names of a generator's answer", () => {
  it('contain the manoeuvre, then the difference', () => {
    expect(Object.fromEntries(Object.keys(ANSWERS).map((list) => [list, namesOf(list)]))).toEqual({
      arterial: [
        'Rolls forward',
        'Straight on, covers 6 m',
        'Straight on, 0.5 s earlier',
        'Straight on, covers 11 m',
        'Straight on, covers 23 m',
        'Changes lane left',
      ],
      crossing: [
        'Stops',
        'Turns left, covers 36 m',
        'Turns left, covers 18 m',
        'Turns left, covers 27 m',
        'Turns left, covers 42 m',
        'Turns left, covers 94 m',
      ],
      motorway: [
        'Straight on',
        'Straight on, slower',
        'Straight on, faster',
        'Changes lane right',
        'Straight on, further right',
        'Changes lane left',
      ],
      residential: [
        'Straight on, covers 93 m',
        'Straight on, covers 99 m',
        'Straight on, covers 76 m',
        'Straight on, covers 109 m',
        'Straight on, covers 70 m',
        'Straight on, covers 35 m',
      ],
      roundabout: [
        'Turns right',
        'Turns right, slower',
        'Turns left',
        'Turns left, slower',
        'Turns left, faster',
        'U-turn',
      ],
    });
  });
});

describe('names of nearly equal futures', () => {
  const drives = (speed: number, more: Partial<Record<'at' | 'side', number>> = {}): Nameable => {
    const states = Array.from({ length: 9 }, (_, k) => [
      Math.min(speed * (k + 1), more.at ?? Infinity),
      (more.side ?? 0) * Math.sin((Math.PI * (k + 1)) / 9),
      0,
      speed * (k + 1) < (more.at ?? Infinity) ? speed : 0,
    ]).flat();
    return { motion: motionOf(speed, states) };
  };
  it('say so where nothing differs', () => {
    expect(names(drives(0), drives(0), drives(9), drives(0))).toEqual([
      'Stands still',
      'Stands still, almost identical',
      'Straight on',
      'Stands still, almost identical',
    ]);
    expect(names(drives(9), drives(9.02), drives(7), drives(9.01, { side: 1.2 }))).toEqual([
      'Straight on',
      'Straight on, almost identical',
      'Straight on, slower',
      'Straight on, further left',
    ]);
  });

  it('give the figure that differs most where the eye sees no difference', () => {
    expect(names(drives(9), drives(8.97), drives(9.06, { side: 0.3 }), drives(9))).toEqual([
      'Straight on',
      'Straight on, almost identical',
      'Straight on, 0.3 m further left',
      'Straight on, almost identical',
    ]);
    expect(names(drives(9), drives(9.4))).toEqual(['Straight on', 'Straight on, faster']);
    expect(names(drives(9), drives(9.2))).toEqual(['Straight on, covers 81 m', 'Straight on, covers 83 m']);
    // Those that come to one place at one time are told by their speed there.
    const arriving = (speed: number): Nameable =>
      drive({ ...motionOf(9, Array.from({ length: 9 }, (_, k) => [9 * (k + 1), 0, 0, k === 8 ? speed : 9]).flat()) });
    expect(names(arriving(3), arriving(4.5))).toEqual(['Straight on', 'Straight on, ends at 16 km/h']);
  });

  it('do not mention the road or a stop where that is false', () => {
    const rolls = drives(0.4, { at: 20 });
    const about = (kind: FaultKind | null, manoeuvre: Manoeuvre = 'straight'): FutureFacts => ({
      faults: kind ? [{ kind, time: 1, until: 2, at: [0, 0], extent: 1, with: null, edge: null }] : [],
      relations: [],
      manoeuvre,
    });
    const called = (kind: FaultKind | null) =>
      names({ ...drives(9), about: about('off_road') }, { ...drives(7), about: about(kind) })[1];
    expect([called(null), called('near_miss')]).toEqual(['Stays on the road', 'Stays on the road']);
    for (const kind of ['collision', 'red_light', 'harsh_steering', 'goal_missed'] as const)
      expect(called(kind)).toBe('Straight on, slower');
    expect(names({ ...rolls, about: about(null, 'lane_left') }, drives(9))[0]).toBe('Changes lane left');
    expect(names({ ...drives(9, { at: 30 }), about: about(null, 'lane_left') }, drives(9))[0]).toBe('Stops');
  });

  it('distinguish places of stops, and creeping from standing', () => {
    expect(names(drives(9, { at: 40 }), drives(9, { at: 30 }), drives(9))).toEqual([
      'Stops after 40 m',
      'Stops after 30 m',
      'Straight on',
    ]);
    expect(names(drives(0), drives(0.1), drives(9))).toEqual(['Stands still', 'Rolls forward', 'Straight on']);
  });

  it('have numbers for several visible levels of pace', () => {
    expect(names(drives(8), drives(9), drives(10), drives(11), drives(7), drives(5))).toEqual([
      'Straight on, covers 72 m',
      'Straight on, covers 81 m',
      'Straight on, covers 90 m',
      'Straight on, covers 99 m',
      'Straight on, covers 63 m',
      'Straight on, covers 45 m',
    ]);
  });

  it('are assigned beside names that stay', () => {
    const shown = [{ name: 'Straight on', basis: 'Straight on' }, null, null];
    const list = nameRest([drives(9), drives(5), drives(5, { at: 20 })], who, shown);
    expect(list.map((n) => n.name)).toEqual(['Straight on', 'Straight on, slower', 'Stops']);
  });
});
