// Facts about futures: marks, words, names, letters, places on the picture, events.
import { describe, expect, it } from 'vitest';
import type { FaultJson, ModeJson, RelationJson } from '../../src/model/document/scene-json';
import { FAULT_KINDS, markOf, readAbout } from '../../src/model/document/future-facts';
import { setGoal } from '../../src/model/document/commands';
import { closeInTime, counted } from '../../src/model/physics/events';
import { eventsOf, readEvents, summary } from '../../src/model/words/event-words';
import { faultPlaces } from '../../src/model/physics/fault-places';
import { emptyMotion, keepVerdicts, rankOf, type Futures, type MotionSet } from '../../src/model/document/futures';
import type { Naming } from '../../src/model/words/future-names';
import { readScene } from '../../src/model/document/scene-reader';
import { naming as namingOf, readFutures, withNames, readGenerated } from '../../src/model/words/named-futures';
import { metAnew, withMeetingsOf } from '../../src/model/physics/verdict-updates';
import { heldStill } from '../../src/model/base/motion';
import { nameIn, startPose, withAgents } from '../../src/model/document/scene';
import { headline, placeWord, type Walker } from '../../src/model/words/verdict-words';
import { whyAnother, whyNotLikeliest } from '../../src/model/words/why-shown';
import { generatedJson, writeScene } from '../../src/model/document/scene-writer';
import { FrozenNames } from '../../src/edit/asking/frozen-names';
import { outcome } from '../../src/edit/asking/outcome-words';
import { markedSpan, placeSigns, SIGN } from '../../src/app/timeline/axes';
import { car, crossing, crossingJson } from '../helpers';
import { sixFutures } from '../standin/futures.mjs';
import { judged } from '../standin/judged.mjs';

const scene = crossing();
const nameOf = nameIn(scene);
const who: Walker = { type: 'vehicle', nameOf };
const naming: Naming = { onFoot: false, nameOf };
const { inLane } = namingOf(scene, car(scene));
const start = startPose(car(scene))!;

const fault = (kind: FaultJson['kind'], more: Partial<FaultJson> = {}): FaultJson => ({
  kind,
  time_s: 3.2,
  until_s: 3.9,
  x_m: 0,
  y_m: 0,
  ...more,
});
const relation = (kind: RelationJson['kind'], other: string): RelationJson => ({
  kind,
  with: other,
  time_s: 2,
  x_m: 0,
  y_m: 0,
  gap_s: 2,
});

/** Straight ahead from the start at a speed, a metre to the side for each `side`. */
function mode(more: Partial<ModeJson> & { speed?: number; side?: number; stopAt?: number } = {}): ModeJson {
  const { speed = 9, side = 0, stopAt = Infinity, ...rest } = more;
  const m: ModeJson = { probability: 1, x_m: [], y_m: [], heading_rad: [], vx_mps: [], vy_mps: [], ...rest };
  for (let i = 1; i <= 90; i++) {
    const t = Math.min(i * 0.1, stopAt);
    m.x_m.push(start.x + speed * t);
    m.y_m.push(start.y + side * Math.sin((Math.PI * i) / 90));
    m.heading_rad.push(0);
    m.vx_mps!.push(i * 0.1 < stopAt ? speed : 0);
    m.vy_mps!.push(0);
  }
  return m;
}

const futures = (modes: ModeJson[], chosen = 0): Futures =>
  withNames(readFutures({ chosen, modes }, start, 5, 5, false), naming);
const six = (hit = false): Futures => {
  const json = crossingJson().agents[0];
  return futures(judged(sixFutures(json, { goal: { x_m: 5, y_m: 26, heading_rad: 1.57 } }, 5, 5), ['2', '17'], hit));
};

describe('verdicts', () => {
  it('give a future one mark, the worst', () => {
    const of = (...kinds: FaultJson['kind'][]) => markOf(readAbout({ faults: kinds.map((k) => fault(k)) })!);
    expect(of('goal_missed', 'near_miss', 'over_median', 'collision')).toBe('collision');
    expect(of('goal_missed', 'near_miss', 'harsh_braking')).toBe('rule');
    expect(of('goal_missed', 'near_miss')).toBe('near');
    expect(of('goal_missed')).toBe('short');
    expect(markOf(readAbout({ manoeuvre: 'left' })!)).toBe('ok');
    expect(readAbout({})).toBeNull();
  });

  it('have one word at the place', () => {
    const word = (f: FaultJson) => placeWord(readAbout({ faults: [f] })!.faults[0], nameOf);
    expect(word(fault('collision', { with: '2' }))).toBe('hits Car 2');
    expect(word(fault('near_miss', { with: '14', extent: 0.5 }))).toBe('0.5 m to Cyclist 14');
    expect(word(fault('near_miss', { with: '14', extent: 15.5 }))).toBe('near miss with Cyclist 14');
    expect(word(fault('near_miss', { with: '14', extent: 0.02 }))).toBe('under 0.1 m to Cyclist 14');
    expect(word(fault('harsh_braking', { extent: 6.2 }))).toBe('brakes at 6.2 m/s²');
    expect(word(fault('speeding', { extent: 5 }))).toBe('18 km/h over the limit');
    expect(word(fault('running', { extent: 3 }))).toBe('runs at 3.0 m/s');
    expect(word(fault('askew', { extent: 0.52 }))).toBe('ends at 30° to the lane');
    expect(word(fault('fails_to_yield', { extent: 3, with: '7' }))).toMatch(/^does not yield to /);
    expect(word(fault('forces_braking', { extent: 3.4, with: '7' }))).toMatch(/^forces .* to brake at 3\.4 m\/s²$/);
    expect(['off_map', 'on_carriageway', 'speeding'].map((k) => word(fault(k as never)))).toEqual([
      'off the map',
      'on the carriageway',
      'speeding',
    ]);
    expect(word(fault('goal_missed', { extent: 14.2 }))).toBe('14 m short');
    expect(['over_median', 'off_road', 'wrong_way', 'red_light'].map((k) => word(fault(k as never)))).toEqual([
      'over the median',
      'off the road',
      'wrong way',
      'red light',
    ]);
  });

  it('are never good in the headline while the shown one has a fault', () => {
    for (const kind of FAULT_KINDS)
      for (const goal of [8, null]) {
        const bad = mode({ faults: [fault(kind, { with: '2', extent: 3 })] });
        const said = headline(futures([mode({ manoeuvre: 'straight' }), bad]), 1, goal, who)!;
        expect(said.mark, kind).not.toBe('ok');
        expect(said.title, kind).not.toMatch(/^Reached in|^Reached$/);
        expect(said.at, kind).toBe(3.2);
      }
  });

  it('are summed up by the worst of the shown one, and by letter', () => {
    expect(headline(six(), 0, 8, who)).toEqual({
      mark: 'rule',
      title: 'Reaches the goal, but crosses the median at 3.2 s',
      words: 'A to D cross the median. E reaches the goal by road. F misses the goal.',
      at: 3.2,
    });
    expect(headline(six(true), 0, 8, who)).toMatchObject({
      mark: 'collision',
      title: 'Reaches the goal, but hits Car 2 at 5.4 s',
      words: 'A hits Car 2. B to D cross the median. E reaches the goal by road. F misses the goal.',
    });
    expect(headline(six(), 4, 8, who)).toMatchObject({ mark: 'ok', title: 'Reached in E', at: null });
    expect(headline(six(), 5, 8, who)).toMatchObject({ mark: 'short', title: '14 m short of the goal' });
  });

  it('are green only without faults', () => {
    const good = futures([mode({ manoeuvre: 'straight' }), mode({ manoeuvre: 'straight' })]);
    expect(headline(good, 0, 8, who)).toMatchObject({ mark: 'ok', title: 'Reached in all two', words: '' });
    const stops = futures([
      mode({ manoeuvre: 'straight' }),
      mode({ manoeuvre: 'straight' }),
      mode({ stopAt: 4, faults: [fault('goal_missed', { extent: 20 })] }),
    ]);
    expect(headline(stops, 0, 8, who)).toMatchObject({
      title: 'Reached in A, B',
      words: 'C stops short.',
    });
    // Unjudged futures have no headline.
    expect(headline(futures([mode()]), 0, 8, who)).toBeNull();
    expect(headline(good, 0, null, who)).toBeNull();
  });

  it('ignore a goal after the planned time', () => {
    const good = futures([mode({ manoeuvre: 'straight' }), mode({ manoeuvre: 'straight' })]);
    expect(headline(good, 0, 14, who)).toBeNull();
    const bad = futures([mode({ faults: [fault('over_median')] })]);
    expect(headline(bad, 0, 14, who)!.title).toBe('Over the median at 3.2 s');
  });

  it('use "only" where all six break the rule', () => {
    const all = futures([1, 2, 3].map(() => mode({ faults: [fault('over_median')] })));
    expect(headline(all, 0, 8, who)).toMatchObject({
      title: 'Not reachable without crossing the median (3.2 s)',
      words: 'All three cross the median.',
    });
  });

  it('keep their sentence beside a collision', () => {
    const set: MotionSet = { ...emptyMotion(''), futures: new Map([['1', six(true)]]), driving: new Set(['1']) };
    const step = { name: 'Goal of Car 1 moved', agent: '1', undo: false };
    expect(outcome(step, scene, [], readEvents(scene, set))).toBe(
      'Goal of Car 1 moved. Collision with Car 2 at 5.4 s.',
    );
    expect(outcome(step, scene, [], [])).toBe('Goal of Car 1 moved. No other road user is affected.');
    const placed = { name: '2 cars placed', agent: null, several: ['1', '9'], undo: false };
    expect(outcome(placed, scene, [], readEvents(scene, set))).toBe('2 cars placed. Collision with Car 2 at 5.4 s.');
  });

  it('are stored with the scene', () => {
    const f = six(true);
    const raw = writeScene(crossingJson(), scene, generatedJson(scene, [['1', f]]));
    const back = readGenerated(raw, readScene(raw))!.futures.get('1')!;
    expect(back.modes.map((m) => m.about)).toEqual(f.modes.map((m) => m.about));
    expect(back.modes.map((m) => m.name)).toEqual(f.modes.map((m) => m.name));
  });
});

describe('places', () => {
  it('share a word where futures break the same rule within 8 m', () => {
    const at = (x: number, time = 0) =>
      mode({
        speed: 0,
        faults: [
          fault('over_median', { x_m: start.x + x, y_m: start.y, extent: 0.1 * x, time_s: time, until_s: time }),
        ],
        x_m: Array.from({ length: 90 }, () => start.x + x),
      });
    const f = futures([at(0), at(6), at(12), at(40)]);
    const places = faultPlaces(f, [0, 1, 2, 3], 1);
    expect(places.map((p) => p.futures)).toEqual([[0, 1, 2], [3]]);
    // Place and figure are the shown future's, as in the panel; without it those of the worst.
    expect(places[0].fault).toMatchObject({ at: [start.x + 6, start.y], extent: expect.closeTo(0.6) });
    const [others] = faultPlaces(f, [0, 1, 2], 3);
    expect(others.fault).toMatchObject({ at: [start.x + 12, start.y], extent: expect.closeTo(1.2) });
  });

  it('are one for each rule and each other, the shown future first', () => {
    const f = futures([
      mode({ faults: [fault('near_miss', { with: '2', extent: 0.7 }), fault('goal_missed')] }),
      mode({ faults: [fault('collision', { with: '3' }), fault('goal_missed')] }),
      mode({ faults: [fault('near_miss', { with: '2', extent: 0.4 })] }),
    ]);
    const places = faultPlaces(f, [0, 1, 2], 0);
    expect(places.map((p) => [p.fault.kind, p.futures])).toEqual([
      ['near_miss', [0, 2]],
      ['goal_missed', [0]],
      ['collision', [1]],
    ]);
    expect(places[0].fault.extent).toBe(0.7);
    expect(faultPlaces(f, [0, 1, 2], 1).find((p) => p.fault.with === '2')?.fault.extent).toBe(0.4);
  });
});

describe('names', () => {
  const names = (...modes: ModeJson[]) => futures(modes).modes.map((m) => m.name);

  it('are those of the manoeuvre', () => {
    expect(six().modes.map((m) => m.name)).toEqual([
      'Turns left',
      'Turns left, 0.5 s later',
      'Turns left, 0.5 s earlier',
      'Turns left, further left',
      'Stays on the road',
      'Straight on',
    ]);
    expect(
      names(
        mode({ manoeuvre: 'left', relations: [relation('follows', '4')] }),
        mode({ manoeuvre: 'lane_left' }),
        mode({ manoeuvre: 'straight', stopAt: 3 }),
      ),
    ).toEqual(['Turns left', 'Changes lane left', 'Stops']);
  });

  it('omit what all have in common', () => {
    const before = relation('before', '2');
    expect(
      names(
        mode({ manoeuvre: 'left', relations: [before, relation('before', '3')] }),
        mode({ manoeuvre: 'left', relations: [before, relation('after', '3')] }),
      ),
    ).toEqual(['Before Car 3', 'After Car 3']);
  });

  it('prefer a road user that some pass before and others after', () => {
    const [met] = names(
      mode({ relations: [relation('follows', '6'), relation('before', '3')] }),
      mode({ relations: [relation('after', '3')] }),
    );
    expect(met).toBe('Before Car 3');
  });

  it('omit a relation that one of them has not', () => {
    const same = () => ({ manoeuvre: 'straight' as const, relations: [relation('gives_way_to', '17')] });
    const list = names(mode(same()), mode({ ...same(), speed: 6 }), mode({ relations: [relation('before', '2')] }));
    expect(list).toEqual(['Straight on', 'Straight on, slower', 'Straight on, almost identical']);
  });

  it('have metres in place of a lane on whose line it ends', () => {
    const ends = (y: number) => inLane!({ x: start.x, y, heading: start.heading, speed: 9 });
    expect([ends(start.y), ends(start.y + 1.75)]).toEqual([true, false]);
  });
});

describe('names during a drag', () => {
  const list = (kind: RelationJson['kind']) =>
    futures([
      mode({ anchor: 0, manoeuvre: 'left', relations: [relation(kind, '2')] }),
      mode({ anchor: 1, manoeuvre: 'left', relations: [relation(kind === 'before' ? 'after' : 'before', '2')] }),
    ]);

  it('stay with their idea until another relation has held for 0.4 s', () => {
    const frozen = new FrozenNames();
    let shown = list('before');
    const next = (f: Futures, now: number) => (shown = frozen.keep(shown, f, naming, now)).modes.map((m) => m.name);
    expect(next(list('after'), 1000)).toEqual(['Before Car 2', 'After Car 2']);
    expect(next(list('before'), 1100)[0]).toBe('Before Car 2');
    // It came and went: the time starts again.
    expect(next(list('after'), 1300)[0]).toBe('Before Car 2');
    expect(next(list('after'), 1600)[0]).toBe('Before Car 2');
    expect(next(list('after'), 1700)[0]).toBe('After Car 2');
  });

  it('move with the idea, and new ideas differ from those that stay', () => {
    const frozen = new FrozenNames();
    const shown = futures([mode({ anchor: 4, manoeuvre: 'straight' }), mode({ anchor: 5, manoeuvre: 'left' })]);
    const next = futures([
      mode({ anchor: 5, manoeuvre: 'left' }),
      mode({ anchor: 7, manoeuvre: 'straight', speed: 5 }),
      mode({ anchor: 4, manoeuvre: 'straight' }),
    ]);
    expect(frozen.keep(shown, next, naming, 0).modes.map((m) => m.name)).toEqual([
      'Turns left',
      'Straight on, slower',
      'Straight on',
    ]);
  });
});

describe('verdicts of drafts', () => {
  const draft = (n = 2) =>
    futures(Array.from({ length: n }, (_, anchor) => mode({ anchor, manoeuvre: 'straight', side: anchor })));
  const judgedOnes = futures([
    mode({ anchor: 1, manoeuvre: 'straight', faults: [fault('over_median')] }),
    mode({ anchor: 0, manoeuvre: 'left' }),
  ]);

  it('stay with their idea until the answer', () => {
    const kept = keepVerdicts(judgedOnes, draft());
    expect(kept.unjudged).toBeUndefined();
    expect(kept.modes.map((m) => [m.about!.manoeuvre, m.about!.faults.map((f) => f.kind)])).toEqual([
      ['straight', []],
      ['straight', ['over_median']],
    ]);
    // Already judged drafts stay unchanged.
    expect(keepVerdicts(kept, judgedOnes)).toBe(judgedOnes);
  });

  it('are none before the first answer', () => {
    expect(keepVerdicts(null, draft()).unjudged).toBe(true);
    expect(keepVerdicts(keepVerdicts(null, draft()), draft()).unjudged).toBe(true);
  });
});

describe('letters and ranks', () => {
  it('rank by probability at rest', () => {
    const json = { chosen: 1, modes: [0.2, 0.5, 0.3].map((probability, anchor) => mode({ probability, anchor })) };
    const f = readFutures(json, start, 5, 5, false, 'rank');
    expect(f.modes.map((m) => m.anchor)).toEqual([1, 2, 0]);
    expect(f.chosen).toBe(0);
  });

  it('count from the likeliest, the earlier letter first where two are equal', () => {
    const of = (...all: number[]) => {
      const modes = all.map((probability) => ({ probability }));
      return modes.map((_, i) => rankOf(modes, i));
    };
    expect(of(0.2, 0.5, 0.3)).toEqual([3, 1, 2]);
    expect(of(0.25, 0.5, 0.25)).toEqual([2, 1, 3]);
  });

  it('report why another is shown than the one before', () => {
    const f = six(true);
    expect([whyNotLikeliest(f, 1, nameOf), whyNotLikeliest(f, 0, nameOf)]).toEqual(['B is shown: A hits Car 2', null]);
    // All likelier ones are in the reason, those without a worse fault too.
    expect(whyNotLikeliest(f, 4, nameOf)).toBe('E is shown: A hits Car 2; B to D cross the median');
    expect(whyNotLikeliest(f, 2, nameOf)).toBe('C is shown: A hits Car 2; B has a higher total cost');
    const alike = { ...f, modes: f.modes.map((m) => ({ ...m, about: f.modes[2].about })) };
    expect(whyNotLikeliest(alike, 1, nameOf)).toBe('B is shown: lower total cost than A, the most likely');
    expect(whyAnother(f, 0, 1, nameOf)).toBe('B is shown: A hits Car 2');
    expect(whyAnother(f, 3, 4, nameOf)).toBe('E is shown: A hits Car 2; B to D cross the median');
    expect(whyAnother(f, 2, 1, nameOf)).toBe('B is shown: A hits Car 2; C is less likely');
    expect(whyAnother(alike, 1, 0, nameOf)).toBe('A is shown: more likely than B');
    expect(whyAnother(f, -1, 0, nameOf)).toBe('A is shown: the previous future is gone');
    expect(whyAnother(f, 3, 3, nameOf)).toBeNull();
  });
});

describe('events', () => {
  const set = (more: Partial<MotionSet> = {}): MotionSet => ({
    ...emptyMotion(''),
    futures: new Map([['1', six(true)]]),
    driving: new Set(['1']),
    ...more,
  });
  const score = { collisions: [], nearMisses: [], minTtc: null, offroadShare: null };

  it('are all faults of followed futures, with time and extent', () => {
    const events = readEvents(scene, set());
    expect(events.map((e) => [e.kind, e.label, e.title, e.words])).toEqual([
      ['rule', 'Over the median 3.2 s', 'Car 1', 'Over the median, 0.6 m'],
      ['collision', 'Collision 5.4 s', 'Car 1 × Car 2', 'Collision, closing at 14 km/h'],
    ]);
    expect(readEvents(scene, set({ driving: new Set() }))).toEqual([]);
    expect(eventsOf(scene, set(), '1', six(), 3).map((e) => e.words)).toEqual([
      'Over the median, 0.6 m',
      'Hard braking, 6.2 m/s²',
    ]);
  });

  it('report an event once, whatever its source', () => {
    const events = readEvents(
      scene,
      set({
        score: {
          ...score,
          collisions: [{ a: '2', b: '1', time: 5.5 }],
          nearMisses: [{ a: '1', b: '2', time: 5.2, distance: 0.1, ttc: null }],
          stretches: [
            { what: 'off_road', agent: '1', time: 3.3, until: 4.1, extent: 0.5 },
            { what: 'harsh_braking', agent: '3', time: 2, until: 2.4, extent: 5 },
            { what: 'harsh_braking', agent: '3', time: 3.2, until: 3.9, extent: 6.5 },
          ],
        },
      }),
    );
    expect(events.map((e) => e.what)).toEqual(['harsh_braking', 'over_median', 'collision']);
    // Twice within a second is one event, as hard as the harder.
    expect(events[0].words).toContain('6.5 m/s²');
    expect([events[0].time, events[0].until]).toEqual([2, 3.9]);
    expect(events.map((e) => e.inLog)).toEqual([true, false, false]);
  });

  it('of conditioned road users come from their verdict, and of others from the score', () => {
    const asked = withAgents(scene, [{ ...car(scene), chosen: 0 }]);
    const stretches = [
      { what: 'harsh_steering' as const, agent: '1', time: 7, until: 7.4, extent: 4 },
      { what: 'harsh_braking' as const, agent: '3', time: 2, until: 2.4, extent: 5 },
    ];
    const nearMisses = [{ a: '3', b: '1', time: 8, distance: 0.4, ttc: null }];
    const events = (s: typeof scene) => readEvents(s, set({ score: { ...score, stretches, nearMisses } }));
    expect(events(asked).map((e) => e.what)).toEqual(['harsh_braking', 'over_median', 'collision']);
    expect(events(scene).map((e) => e.what)).toContain('harsh_steering');
    const { about } = six(true).modes[0];
    const own = events(asked).filter((e) => e.a.id === '1');
    expect(own.map((e) => e.what).sort()).toEqual(about!.faults.map((f) => f.kind).sort());
  });

  it('of a kept future are judged by the current collisions', () => {
    const [hit] = six(true).modes;
    expect(withMeetingsOf({ ...score, collisions: [{ a: '2', b: '1', time: 5.5 }] }, '1', hit)).toBe(hit);
    const spared = withMeetingsOf(score, '1', hit);
    expect(spared.about!.faults.map((f) => f.kind)).toEqual(['over_median']);
    expect(spared.sent!.faults).toHaveLength(1);
    const met = withMeetingsOf({ ...score, collisions: [{ a: '1', b: '3', time: 4, closing: 3 }] }, '1', hit);
    expect(met.about!.faults[0]).toMatchObject({ kind: 'collision', with: '3', time: 4, extent: 3 });
    const near = [{ a: '1', b: '3', time: 4, distance: 0.3, ttc: null }];
    const log = near.map((n) => ({ ...n, inLog: true }));
    const passed = withMeetingsOf({ ...score, nearMisses: near }, '1', spared);
    expect(passed.about!.faults.map((f) => f.kind)).toEqual(['over_median', 'near_miss']);
    expect(withMeetingsOf({ ...score, nearMisses: log }, '1', spared)).toBe(spared);
  });

  it('of unchanged futures are judged again when another road user comes into their way', () => {
    const own = car(scene);
    const f = futures([mode({ manoeuvre: 'straight' }), mode({ manoeuvre: 'straight', stopAt: 2 })]);
    expect(headline(f, 0, 8, who)).toMatchObject({ mark: 'ok', title: 'Reached in all two' });
    const standing = (x: number) => heldStill({ ...start, x: start.x + x, speed: 0 }, 91);
    const there = (x: number) => [{ agent: scene.agents.get('2')!, motion: standing(x) }];
    const met = metAnew(own, f, there(40));
    expect(met.modes.map((m) => m.about!.faults.map((x) => [x.kind, x.with]))).toEqual([[['collision', '2']], []]);
    expect(met.modes[0].sent!.faults).toHaveLength(1);
    expect(met.modes[1]).toBe(f.modes[1]);
    expect(headline(met, 0, 8, who)!.title).toMatch(/^Reaches the goal, but hits Car 2 at 3\.\d s$/);
    expect(headline(met, 1, 8, who)).toMatchObject({ mark: 'ok', title: 'Reached in B', words: 'A hits Car 2.' });
    // Removed again, no fault remains; an unchanged one is skipped; no road user meets itself.
    expect(metAnew(own, met, there(400)).modes[0].about!.faults).toEqual([]);
    expect(metAnew(own, met, [])).toBe(met);
    expect(metAnew(own, f, [{ agent: own, motion: f.modes[0].motion }])).toBe(f);
  });

  it('of the recording are marked and not counted', () => {
    const near = { a: '11', b: '14', time: 3.2, distance: 0.6, ttc: null };
    const driving = new Set(['11', '14']);
    const events = (inLog?: boolean) =>
      readEvents(scene, set({ futures: new Map(), driving, score: { ...score, nearMisses: [{ ...near, inLog }] } }));
    expect(events()[0]).toMatchObject({ inLog: false });
    expect(summary(events())).toBe('1 near miss');
    expect(events(true)[0]).toMatchObject({ inLog: true, words: 'Near miss, 0.6 m · in the recording' });
    expect([counted(events(true)), summary(events(true))]).toEqual([[], 'No collisions, no near misses']);
  });
});

describe('close in time', () => {
  it('is reported for road users that do not only replay the recording', () => {
    const petOf = new Map([
      ['1', 0.3],
      ['2', 0.1],
      ['3', 1.4],
    ]);
    const score = { collisions: [], nearMisses: [], minTtc: null, offroadShare: null, petOf };
    const least = (...driving: string[]) => closeInTime({ ...emptyMotion(''), driving: new Set(driving), score });
    expect([least('1', '3'), least('3'), least(), least('1', '2')]).toEqual([0.3, null, null, 0.1]);
  });

  it("has the score's time for a near miss", () => {
    const s = crossing();
    const [one, other] = s.agents.values();
    const met = mode({ faults: [{ ...fault('near_miss'), with: other.id }] });
    const scored = { a: other.id, b: one.id, time: fault('near_miss').time_s, distance: 4.1, ttc: 0.8 };
    const only = { collisions: [], nearMisses: [scored], minTtc: 0.8, offroadShare: null };
    const own = new Map([[one.id, futures([met])]]);
    const asked = setGoal(one, { ...one.goal, pos: [10, 10] }).apply(s);
    const set: MotionSet = { ...emptyMotion(''), futures: own, driving: new Set([one.id]), score: only };
    const near = readEvents(asked, set).filter((e) => e.kind === 'near');
    expect(near.map((e) => e.facts.find(([what]) => what === 'TTC')?.[1])).toEqual(['0.8 s']);
  });

  it('of a near miss by time is no gap', () => {
    const near = { a: '11', b: '14', time: 3.2, distance: 12.6, ttc: null };
    const only = { collisions: [], nearMisses: [near], minTtc: null, offroadShare: null };
    const [event] = readEvents(crossing(), { ...emptyMotion(''), driving: new Set(['11', '14']), score: only });
    expect(event.words).toBe('Near miss');
    expect(event.facts.map(([what]) => what)).not.toContain('Closest gap');
  });
});

describe('signs on the timeline', () => {
  it('are at their times, with words where there is room', () => {
    const at = [100, 110, 160, 300, 880].map((x, i) => ({ at: x, w: 80, rank: i === 1 ? 0 : 1 }));
    const placed = placeSigns(at, 50, 900);
    expect(placed.map((p) => [p.x, p.items])).toEqual([
      [110, [0, 1]],
      [160, [2]],
      [300, [3]],
      [880, [4]],
    ]);
    expect(placed.map((p) => p.words)).toEqual([null, 'right', 'right', 'left']);
    for (const [i, p] of placed.entries()) if (i) expect(p.x - placed[i - 1].x).toBeGreaterThanOrEqual(2 * SIGN);
  });

  it('are shaded within the plot', () => {
    expect(markedSpan(9, 9, 0.8, 9)).toEqual([8.6, 9]);
    expect(markedSpan(0.1, 0.1, 0.8, 9)[0]).toBe(0);
    expect(markedSpan(3, 5, 0.8, 9)).toEqual([3, 5]);
  });
});
