// Names of futures, on lists of generator answers: one for each example scene.
/* eslint-disable max-len -- an answer is one line */
import { describe, expect, it } from 'vitest';
import type { FaultKind, Manoeuvre, RelationKind } from '../../src/model/document/scene-json';
import type { FutureFacts } from '../../src/model/document/future-facts';
import { distances, type Motion } from '../../src/model/base/motion';
import { nameAll, nameRest, type Nameable, type Naming } from '../../src/model/words/future-names';

type Sample = readonly [manoeuvre: string, relations: readonly string[], states: readonly number[]];
interface Answered {
  readonly speed: number;
  readonly modes: readonly Sample[];
}

/** Each second: metres ahead and to the left of the start, radians to the left of it, m/s. */
// prettier-ignore
const ANSWERS: Readonly<Record<string, Answered>> = {
  arterial: {
    speed: 0,
    modes: [
      ['straight', [], [0,0,0,0,0,0,0,0,0.1,0,0.01,0.1,0.2,0,0.03,0.1,0.2,0,0.03,0,0.2,0,0.03,0,0.3,0.1,0.04,0.2,0.8,0.1,0.07,0.7,1.9,0.3,0.1,1.6]],
      ['straight', ['follows 23'], [0,0,0,0,0,0,0,0,0.1,0,-0.01,0.2,0.5,-0.1,-0.05,0.4,0.9,-0.1,-0.07,0.5,1.5,-0.2,-0.07,0.8,2.6,-0.2,-0.04,1.4,4.2,-0.2,0,1.7,5.8,-0.1,0.03,1.4]],
      ['straight', ['follows 23'], [0,0,0,0,0,0,0,0,0,0,0,0,0.1,0,0.01,0.3,0.7,0.1,0.08,1.1,2,0.3,0.12,1.3,3.1,0.4,0.09,0.7,3.7,0.4,0.06,0.7,5,0.4,0.01,2.3]],
      ['straight', ['follows 23','follows 26','follows 19'], [0,0,0,0,0,0,0,0,0,0,0,0,0,0,-0.01,0.1,0.4,-0.1,-0.07,0.8,1.7,-0.3,-0.12,1.8,4.1,-0.2,0.04,3,7.4,0.6,0.25,3.8,11.3,1.1,0.04,4.3]],
      ['straight', ['follows 19','follows 23'], [0,0,0,0,0,0,0,0,0,0,0,0,0.1,0.1,0.04,0.4,1.2,0.4,0.19,2,4.1,0.9,0.14,4,9,0.5,-0.12,5.7,15.4,-0.5,-0.14,7.2,23.1,-1.5,-0.15,8.4]],
      ['lane_left', ['before 31','before 24','after 48','follows 19'], [0.7,-0.1,-0.08,1.4,2.7,0.2,0.17,2.9,5.5,2.5,0.69,4.4,9.8,5.5,0.49,6.1,16.5,6.2,0.03,7.6,25,5.9,-0.05,9.4,35.4,5.6,-0.02,11.5,47.8,5.7,0.02,13.4,62,6.2,0.04,15]],
    ],
  },
  crossing: {
    speed: 4,
    modes: [
      ['straight', ['before 1','gives_way_to 3','gives_way_to 30','gives_way_to 4'], [2.9,0.9,0.3,2.2,4.4,1.8,0.49,1.5,5.5,2.7,0.56,1.4,6.7,3.2,0.5,1.2,7.8,3.6,0.4,1,8.6,3.8,0.35,0.8,9.3,4.1,0.36,0.7,9.9,4.4,0.41,0.6,10.2,4.7,0.47,0.3]],
      ['left', ['before 1','after 3','before 6','before 30'], [4,0.7,0.22,4.2,7.7,2.9,0.6,4.4,10.5,6.2,0.88,4.1,12.8,9.4,0.92,4,15.5,12.3,0.82,4,18.2,15.1,0.82,3.8,20.1,18.3,1.07,3.6,20.9,21.8,1.35,3.9,21.6,26.3,1.39,5.2]],
      ['left', ['before 1','gives_way_to 4','gives_way_to 3'], [3.7,0.5,0.16,3.4,6.5,1.5,0.32,2.4,8.2,2.3,0.44,1.5,9.2,3,0.54,1.1,10,3.8,0.66,1.2,10.7,4.8,0.81,1.3,11.4,6.1,0.97,1.5,12.2,7.6,1.06,1.9,13.4,9.5,1,2.6]],
      ['left', ['before 1','after 3','before 6','after 31'], [3.3,0.4,0.14,3,6.2,1.4,0.34,3.2,9,3.3,0.58,3.4,11.4,5.6,0.76,3.2,13.4,7.9,0.89,3,14.9,10.4,1.02,2.9,16,13,1.14,2.8,16.9,15.5,1.21,2.6,17.8,17.7,1.21,2.3]],
      ['left', ['after 3','before 4','after 31','after 32'], [4,0.9,0.26,4.4,8.1,3.3,0.57,5.1,12,7,0.83,5.6,15,11.8,1.05,5.6,17.1,16.8,1.18,5.2,18.9,21.3,1.18,4.4,20.5,25,1.16,3.7,22.1,28.2,1.14,3.6,23.7,31.7,1.14,4.3]],
      ['left', ['before 1','before 4','before 30','after 32'], [5.1,0.2,0.11,6.3,11.5,3.3,0.55,7.9,17.2,9.4,0.97,8.8,20.2,18,1.32,9.5,22,27.7,1.39,10.5,24.5,38.6,1.32,11.9,28,50.8,1.28,13.6,32.3,64.6,1.26,15.4,37.3,80.1,1.26,17]],
    ],
  },
  motorway: {
    speed: 21.9,
    modes: [
      ['straight', ['follows 11'], [21.8,0.1,0,21.8,43.6,0.1,0,21.8,65.5,0.1,0,21.9,87.3,0.2,0,21.7,108.9,0.3,0,21.4,130.2,0.4,0.01,21.3,151.6,0.7,0.01,21.6,173.4,1,0.01,21.8,195.1,1.3,0.02,21.4]],
      ['straight', ['follows 11'], [21,1.1,0.04,20.5,41.5,0.6,-0.06,20.7,62.4,-0.5,-0.02,21.1,83.1,-0.3,0.01,20,102.1,-0.4,-0.01,18.1,119.6,-0.6,-0.01,17.1,136.7,-0.8,-0.01,17.2,154,-0.8,0,17.2,170.9,-0.8,0,16.4]],
      ['straight', ['follows 11'], [22.5,0,0,22.9,45.6,-0.1,-0.01,23.1,68.7,-0.2,0,23.1,91.8,-0.1,0,23.2,115,0,0,23.2,138.2,0.1,0.01,23.2,161.4,0.5,0.02,23.2,184.7,0.8,0.02,23.3,208.1,1.2,0.02,23.6]],
      ['lane_right', ['follows 11'], [20.4,1,0.04,19.6,40.6,0.6,-0.05,21.5,63.8,-0.5,-0.02,24.7,88.9,-0.3,0.01,25,113,-0.5,-0.01,23.1,135.3,-0.8,-0.01,21.8,156.7,-0.9,0,21.1,177.6,-0.8,0.01,20.6,197.8,-0.7,0.01,20]],
      ['straight', ['follows 11'], [19.8,-0.9,-0.04,18.6,38.8,-0.8,0.04,20.2,60.7,0.2,0.03,23.5,84.8,0.3,0.01,24.1,108.2,0.7,0.02,22.6,130.1,1,0.01,21.3,151.1,1.3,0.01,20.6,171.3,1.5,0.01,19.9,190.8,1.7,0.01,19.1]],
      ['lane_left', ['before 9','before 13'], [19.7,-0.1,0.1,17.9,36.3,3,0.13,16.5,53.2,3.2,0.01,17.4,71.1,4.1,0.05,18.5,90,4.7,0.02,19.2,109.6,4.8,0,20.1,130.1,4.7,-0.01,21,151.3,4.5,-0.01,21.1,171.9,4.2,-0.02,19.9]],
    ],
  },
  residential: {
    speed: 9.3,
    modes: [
      ['straight', [], [9.4,-0.2,-0.01,9.7,19.6,-0.1,0.01,10.8,30.9,0,0.01,11.5,42.4,0.1,0,11.3,53.4,0.1,0.01,10.9,64.1,0.2,0.01,10.4,74.3,0.4,0.01,10,84,0.5,0.01,9.5,93.2,0.6,0.01,8.9]],
      ['straight', [], [10.1,-0.1,-0.01,10.6,21,-0.1,0,11.3,32.4,-0.2,0,11.4,43.8,-0.1,0.01,11.4,55.2,0,0.01,11.3,66.4,0.2,0.02,11.2,77.5,0.4,0.02,11,88.4,0.6,0.01,10.7,99,0.7,0.01,10.4]],
      ['straight', [], [9.4,0,0,9.5,19,0,0,9.9,29.1,0,0,10.1,38.9,0,0,9.6,48,0,0.01,8.6,56.1,0.1,0.01,7.6,63.4,0.2,0.01,6.8,69.9,0.3,0.02,6.2,75.7,0.4,0.01,5.6]],
      ['straight', [], [10.4,0,0,11.4,22.4,0,0,12.5,35.1,-0.1,0,12.8,47.8,0,0.01,12.6,60.3,0.2,0.01,12.5,72.7,0.4,0.01,12.3,84.9,0.5,0.01,12.1,96.9,0.7,0.01,11.8,108.6,0.9,0.01,11.6]],
      ['straight', [], [9.6,-0.1,-0.01,9.6,19,-0.1,0,9,27.4,-0.1,0,7.8,34.8,0,0.01,7.1,41.8,0,0.01,7.1,48.9,0.1,0.01,7.2,56.1,0.1,0.01,7.1,63.1,0.2,0.01,6.8,69.6,0.3,0.01,6.3]],
      ['straight', [], [8.6,0,0.01,8,15.9,0.1,0.01,6.6,21.9,0.2,0.02,5.4,26.7,0.3,0.01,4.1,30,0.2,-0.01,2.6,31.9,0.2,-0.02,1.4,32.9,0.2,-0.02,0.8,33.7,0.2,-0.03,0.8,34.5,0.1,-0.04,1]],
    ],
  },
  roundabout: {
    speed: 5.4,
    modes: [
      ['right', [], [6.2,-1.4,-0.3,7.3,13.3,-5.1,-0.54,8.6,20.8,-10.4,-0.65,9.7,28.7,-16.9,-0.69,10.8,37.4,-24,-0.69,11.6,46.6,-31.5,-0.69,12.2,56.1,-39.4,-0.69,12.4,65.7,-47.3,-0.69,12.4,75.2,-55.2,-0.69,12.3]],
      ['right', [], [5.2,-1.2,-0.28,5.5,10.8,-3.8,-0.48,7,17.6,-8.1,-0.6,9,25.4,-14,-0.66,10.5,34.1,-20.9,-0.68,11.5,43.1,-28.3,-0.68,11.8,52.1,-35.7,-0.68,11.4,60.7,-42.6,-0.69,10.5,68.3,-48.9,-0.69,9.2]],
      ['left', ['before 7','gives_way_to 15','gives_way_to 3','gives_way_to 17'], [5,1.2,0.27,5,9.4,3.3,0.55,4.8,11.4,7.1,1.27,3.6,10.8,9.6,1.78,1.7,10.4,10.7,1.85,1,10.2,11.8,1.8,1.3,10,13.4,1.72,2,9.9,15.8,1.62,2.6,10.4,18.4,1.36,2.7]],
      ['left', ['before 7','gives_way_to 15','after 3','gives_way_to 17'], [5.2,0.5,0.19,5.1,9.4,2.8,0.59,4.4,11.4,5.9,1.11,3,11.3,8.1,1.57,1.5,10.8,9.1,1.83,0.8,10.5,9.7,1.91,0.8,10.3,10.7,1.81,1.4,10.3,12.6,1.64,2.3,9.9,15.4,1.72,3.4]],
      ['left', ['after 1','before 7','after 15','after 3'], [5.2,-0.3,-0.03,5.4,10.6,1.3,0.49,6,12.4,6.5,1.55,5.3,10.5,10.2,2.05,3,9.9,12.4,1.81,1.7,10.1,14.1,1.56,2,10.3,16.8,1.51,3.4,10.6,21,1.48,5.1,12,26.7,1.26,6.6]],
      ['turn_round', ['before 5','before 7','after 3','after 9'], [5.1,-0.1,0.04,5.1,9.9,2.7,0.76,6.4,11.1,9.4,1.64,7.4,9.2,16.4,1.78,7.1,8.5,22.9,1.71,6,6.3,28.1,2.11,5.5,2.2,31.8,2.45,5.8,-3.4,34.2,2.92,6.7,-10.5,33.6,-3.05,7.6]],
    ],
  },
};

const who: Naming = { onFoot: false, nameOf: (id) => `Car ${id}` };

/** States each 0.1 s between those of each second. */
function motionOf(speed: number, states: readonly number[]): Motion {
  const all = [0, 0, 0, speed, ...states];
  const column = (k: number): Float64Array =>
    Float64Array.from({ length: 91 }, (_, i) => {
      const a = Math.min(8, Math.floor(i / 10));
      const part = i / 10 - a;
      return all[a * 4 + k] * (1 - part) + all[a * 4 + 4 + k] * part;
    });
  return { first: 0, x: column(0), y: column(1), heading: column(2), speed: column(3), valid: [[0, 91]] };
}

const modesOf = ({ speed, modes }: Answered): Nameable[] =>
  modes.map(([manoeuvre, relations, states]) => {
    const about: FutureFacts = {
      faults: [],
      manoeuvre: manoeuvre as Manoeuvre,
      relations: relations.map((r) => {
        const [kind, other] = r.split(' ');
        return { kind: kind as RelationKind, with: other, time: 9 };
      }),
    };
    return { motion: motionOf(speed, states), about };
  });
const namesOf = (list: string): string[] => nameAll(modesOf(ANSWERS[list]), who).map((n) => n.name);

/** Straight on at the speed of each second. */
const paced = (...speeds: number[]): Motion => {
  let x = 0;
  return motionOf(
    speeds[0],
    speeds.slice(1).flatMap((v) => [(x += v), 0, 0, v]),
  );
};

describe('the speed words of a name', () => {
  const givingWay = (motion: Motion): Nameable => {
    const about: FutureFacts = {
      faults: [],
      manoeuvre: 'straight',
      relations: [{ kind: 'gives_way_to', with: '3', time: 5 }],
    };
    return { motion, about };
  };

  it('report waiting only for a stop for another road user, or nearly one', () => {
    const named = (...speeds: number[]) => nameAll([givingWay(paced(...speeds))], who)[0].name;
    expect(named(8, 6, 3, 0.5, 0, 0, 2, 4, 6, 8)).toBe('Waits for Car 3');
    expect(named(8, 7, 5, 4, 4, 5, 6, 7, 8, 8)).toBe('Slows for Car 3');
    // A later stop has another cause.
    expect(named(8, 7, 5, 4, 4, 5, 3, 1, 0, 0)).toBe('Slows for Car 3');
  });

  it('report no softer braking without braking', () => {
    const about: FutureFacts = { faults: [], manoeuvre: 'straight', relations: [] };
    const list = [paced(8, 8, 5, 4, 6, 9, 9, 9, 9, 9), paced(8, 8, 8, 8, 8, 7.8, 7.6, 7.5, 7.4, 7.4)];
    const names = nameAll(
      list.map((motion) => ({ motion, about })),
      who,
    ).map((n) => n.name);
    expect(names.join()).not.toContain('brakes less');
  });
});

describe("names of a generator's answer", () => {
  it('contain the other road user, else the manoeuvre and its manner', () => {
    expect(namesOf('arterial')).toEqual([
      'Straight on',
      'Behind Car 23',
      'Behind Car 23, more left',
      'Behind Car 23, faster',
      'Behind Car 19',
      'Left lane, before Car 31',
    ]);
    expect(namesOf('crossing')).toEqual([
      'Waits for Car 3',
      'Left, after Car 3',
      'Left, waits for Car 4',
      'Left, after Car 3, slower',
      'Left, after Car 3, faster',
      'Left, before Car 4',
    ]);
    expect(namesOf('motorway')).toEqual([
      'Behind Car 11',
      'Behind Car 11, slower',
      'Behind Car 11, faster',
      'Right lane, behind Car 11',
      'Behind Car 11, more right',
      'Left lane, before Car 9',
    ]);
    expect(namesOf('residential')).toEqual([
      'Straight on',
      'Straight on, 6 m further',
      'Straight on, 18 m shorter',
      'Straight on, 15 m further',
      'Straight on, 24 m shorter',
      'Straight on, 59 m shorter',
    ]);
    expect(namesOf('roundabout')).toEqual([
      'Turns right',
      'Turns right, slower',
      'Left, waits for Car 15',
      'Left, after Car 3',
      'Left, after Car 15',
      'U-turn, after Car 3',
    ]);
  });

  it.each(Object.keys(ANSWERS))('of %s are short, without ordinals and untruths', (list) => {
    const modes = modesOf(ANSWERS[list]);
    const named = nameAll(modes, who);
    for (const { name } of named) {
      expect(name.length).toBeLessThanOrEqual(26);
      expect(name).not.toMatch(/second|third|fourth|fifth|sixth/);
    }
    const gone = modes.map((m) => distances(m.motion));
    const words = named.map((n) => n.name.split(', ')[1] ?? '');
    named.forEach(({ basis }, i) => {
      const first = named.findIndex((n) => n.basis === basis);
      const [end, half] = [90, 45].map((k) => gone[i][k] - gone[first][k]);
      if (/faster$/.test(words[i])) expect(end).toBeGreaterThan(1);
      if (/slower$/.test(words[i])) expect(end).toBeLessThan(-1);
      if (words[i] === 'earlier') expect(half).toBeGreaterThan(0.5);
      if (words[i] === 'later') expect(half).toBeLessThan(-0.5);
      const by = /^(\d+) m (further|shorter)$/.exec(words[i]);
      if (by) expect(Math.abs(end - Number(by[1]) * (by[2] === 'further' ? 1 : -1))).toBeLessThan(0.6);
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
  const names = (...modes: Nameable[]) => nameAll(modes, who).map((n) => n.name);

  it('are the same where nothing differs', () => {
    expect(names(drives(0), drives(0), drives(9), drives(0))).toEqual([
      'Stands still',
      'Stands still',
      'Straight on',
      'Stands still',
    ]);
    expect(names(drives(9), drives(9.02), drives(7), drives(9.01, { side: 1.2 }))).toEqual([
      'Straight on',
      'Straight on',
      'Straight on, slower',
      'Straight on, more left',
    ]);
  });

  it('prefer a small true difference, in numbers', () => {
    expect(names(drives(9), drives(8.97), drives(9.06, { side: 0.3 }), drives(9))).toEqual([
      'Straight on',
      'Straight on',
      'Straight on, more left',
      'Straight on',
    ]);
    expect(names(drives(9), drives(9.4))).toEqual(['Straight on', 'Straight on, faster']);
    // 0.1 s at half time is noise.
    expect(names(drives(9), drives(9.2))).toEqual(['Straight on', 'Straight on']);
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
    expect([called(null), called('near_miss')]).toEqual(['By road', 'By road']);
    for (const kind of ['collision', 'red_light', 'harsh_steering', 'goal_missed'] as const)
      expect(called(kind)).toBe('Straight on, slower');
    expect(names({ ...rolls, about: about(null, 'lane_left') }, drives(9))[0]).toBe('To the left lane');
    expect(names({ ...drives(9, { at: 30 }), about: about(null, 'lane_left') }, drives(9))[0]).toBe('Stops');
  });

  it('distinguish places of stops, and creeping from standing', () => {
    expect(names(drives(9, { at: 40 }), drives(9, { at: 30 }), drives(9))).toEqual([
      'Stops',
      'Stops, sooner',
      'Straight on',
    ]);
    expect(names(drives(0), drives(0.1), drives(9))).toEqual(['Stands still', 'Rolls forward', 'Straight on']);
  });

  it('have numbers for several visible levels of pace', () => {
    expect(names(drives(8), drives(9), drives(10), drives(11), drives(7), drives(5))).toEqual([
      'Straight on',
      'Straight on, 9 m further',
      'Straight on, 18 m further',
      'Straight on, 27 m further',
      'Straight on, 9 m shorter',
      'Straight on, 27 m shorter',
    ]);
  });

  it('are assigned beside names that stay', () => {
    const shown = [{ name: 'Straight on', basis: 'Straight on' }, null, null];
    const list = nameRest([drives(9), drives(5), drives(5, { at: 20 })], who, shown);
    expect(list.map((n) => n.name)).toEqual(['Straight on', 'Straight on, slower', 'Stops']);
  });
});
