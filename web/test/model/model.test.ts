import fc from 'fast-check';
import { afterEach, describe, expect, it } from 'vitest';
import { makeLine, pointAt, project, wrapAngle, lerpAngle } from '../../src/model/base/geometry';
import { findRoute } from '../../src/model/physics/lane-routes';
import { nearestLanes } from '../../src/model/document/lanemap';
import { limitsOf, rangesOf, topSpeed } from '../../src/model/base/domain';
import { furthestReach, leastReach } from '../../src/model/physics/reach';
import {
  areaText,
  densityText,
  fromLength,
  lengthRange,
  lengthStep,
  lengthUnit,
  metres,
  num,
  parseTyped,
  roundBelow,
  speedLabel,
  toldIn,
  toLength,
} from '../../src/model/base/units';
import { endPose, lastStep, poseAt, motionFrom, straightOn } from '../../src/model/base/motion';
import { readScene, SceneError } from '../../src/model/document/scene-reader';
import { castJson, conditionOf, generatedJson, withStill, writeScene } from '../../src/model/document/scene-writer';
import { choose, setGoal, setLength, setReplan, setStart } from '../../src/model/document/commands';
import { emptyMotion, placesLike, type MotionSet } from '../../src/model/document/futures';
import { readGenerated, readFutures } from '../../src/model/words/named-futures';
import { findChanges } from '../../src/model/words/change-words';
import { motionOf, seenUntil } from '../../src/model/physics/playback';
import { localReach } from '../../src/model/words/reach-words';
import { readEvents } from '../../src/model/words/event-words';
import { freeGoal, sceneKey, startPose, touched, withAgents } from '../../src/model/document/scene';
import { giveWay, goOn, sixFutures } from '../standin/futures.mjs';
import { car, crossing, crossingJson, walker } from '../helpers';

describe('geometry', () => {
  it('wraps angles into half-open pi', () => {
    fc.assert(
      fc.property(fc.double({ min: -1000, max: 1000, noNaN: true }), (a) => {
        const w = wrapAngle(a);
        expect(w).toBeGreaterThanOrEqual(-Math.PI);
        expect(w).toBeLessThan(Math.PI + 1e-12);
        expect(Math.abs(Math.sin(w) - Math.sin(a))).toBeLessThan(1e-6);
      }),
    );
    expect(lerpAngle(3, -3, 0.5)).toBeCloseTo(-Math.PI, 5);
  });

  it('finds points by distance and distances by point', () => {
    const l = makeLine([
      [0, 0],
      [10, 0],
      [10, 10],
    ]);
    fc.assert(
      fc.property(fc.double({ min: 0, max: 20, noNaN: true }), (s) => {
        const p = pointAt(l, s);
        expect(project(l, p.x, p.y).s).toBeCloseTo(s, 6);
      }),
    );
  });
});

describe('numbers', () => {
  it('reads sums and units', () => {
    expect(parseTyped('32+5', 'km/h')).toBe(37);
    expect(parseTyped('8.9 m/s', 'km/h')).toBeCloseTo(32.04, 2);
    expect(parseTyped('30mph', 'km/h')).toBeCloseTo(48.28, 1);
    expect(parseTyped('(1+2)*3', 'length')).toBe(9);
    expect(parseTyped('−4,5', 'length')).toBe(-4.5);
    expect(parseTyped('≈ 12', 'angle')).toBe(12);
    for (const bad of ['', 'fast', '3 s', '1+', '2 m/s m', '1..2']) expect(parseTyped(bad, 'length')).toBeNull();
  });

  it('never throws and never returns NaN', () => {
    fc.assert(
      fc.property(fc.string(), (s) => {
        const v = parseTyped(s, 'length');
        expect(v === null || Number.isFinite(v)).toBe(true);
      }),
    );
  });

  it('writes a true minus and no negative zero', () => {
    expect(num(-43.94, 1)).toBe('\u221243.9');
    expect(num(-0.01, 1)).toBe('0.0');
    expect(speedLabel(8.9, 'km/h')).toBe('32 km/h');
  });
});

describe('feet', () => {
  afterEach(() => void toldIn('km/h'));

  it('come with miles per hour, and go with them', () => {
    expect([metres(30.48), metres(1.5, 1), lengthUnit()]).toEqual(['30 m', '1.5 m', 'm']);
    toldIn('mph');
    expect([metres(30.48), metres(1.5, 1), metres(3.1), lengthUnit()]).toEqual(['100 ft', '4.9 ft', '10 ft', 'ft']);
    expect(areaText(4.7, 2)).toBe('15.4 × 6.6 ft');
    expect(densityText(3)).toBe('9.1 per 1000 ft of lane');
    toldIn('m/s');
    expect([metres(30.48), areaText(4.7, 2), densityText(3)]).toEqual(['30 m', '4.7 × 2.0 m', '3.0 per 100 m of lane']);
  });

  it('and metres are understood in any setting', () => {
    expect(parseTyped('30 ft', 'length')).toBeCloseTo(9.144, 6);
    expect(parseTyped('5 m', 'length')).toBe(5);
    toldIn('mph');
    expect(parseTyped('30 ft', 'length')).toBeCloseTo(30, 6);
    expect(parseTyped('30', 'length')).toBe(30);
    expect(parseTyped('5 m', 'length')).toBeCloseTo(16.404, 3);
    expect(parseTyped('20 mph', 'mph')).toBeCloseTo(20, 6);
    expect(parseTyped('(10+20) ft', 'place')).toBeCloseTo(9.144, 6);
    expect(parseTyped('12', 'place')).toBe(12);
  });

  it('are read back as typed, within their bounds', () => {
    toldIn('mph');
    fc.assert(
      fc.property(fc.integer({ min: 1, max: 10_000 }), (tenths) => {
        expect(toLength(fromLength(tenths / 10))).toBeCloseTo(tenths / 10, 4);
      }),
    );
    const [min, max] = lengthRange([0.3, 25]);
    expect(fromLength(min)).toBeGreaterThanOrEqual(0.3);
    expect(fromLength(max)).toBeLessThanOrEqual(25);
    expect([0.1, 0.5, 1, 10].map(lengthStep)).toEqual([0.2, 1, 2, 20]);
    expect([0.9, 1, 4.99, 50, 99, 1000].map(roundBelow)).toEqual([0.5, 1, 2, 50, 50, 1000]);
  });
});

describe('longer scenes', () => {
  it('continue straight without an answer, and stand where a road user stood', () => {
    const m = motionFrom({
      x_m: [0, 1, 2],
      y_m: [0, 0, 0],
      heading_rad: [0, 0, 0],
      vx_mps: [10, 10, 10],
      vy_mps: [0, 0, 0],
    });
    const on = straightOn(m, 200);
    expect(lastStep(on)).toBe(200);
    expect(endPose(on)).toEqual({ x: 200, y: 0, heading: 0, speed: 10 });
    expect(poseAt(on, 0.1)).toEqual(poseAt(m, 0.1));
    expect(straightOn(m, 200)).toBe(on);
    expect(straightOn(m, 2)).toBe(m);
    const still = motionFrom({ x_m: [5, 5], y_m: [1, 1], heading_rad: [1, 1], vx_mps: [0.1, 0.1], vy_mps: [0, 0] });
    expect(endPose(straightOn(still, 90))).toEqual({ x: 5, y: 1, heading: 1, speed: 0 });
  });

  it('play all motions to the end: generated ones as answered, the rest straight on', () => {
    const scene = setLength(crossing(), 20).apply(crossing());
    const a = car(scene);
    const json = {
      chosen: 0,
      modes: sixFutures(
        crossingJson().agents.find((j) => j.id === '1')!,
        undefined,
        5,
        5,
      ),
    };
    goOn(json.modes[0], 200);
    const futures = readFutures(json, startPose(a)!, 5, 5, false);
    expect(futures.modes.map((m) => m.motion.x.length)).toEqual([201, 91, 91, 91, 91, 91]);
    const set: MotionSet = { ...emptyMotion(''), futures: new Map([['1', futures]]), driving: new Set(['1']) };
    expect(motionOf(scene, set, a)).toBe(futures.modes[0].motion);
    for (const other of scene.agents.values())
      if (lastStep(other.log) > 80) expect(poseAt(motionOf(scene, set, other), 20), other.id).not.toBeNull();
    // A road user that left before the end of the recording stays away.
    const gone = { ...car(scene), log: { ...car(scene).log, valid: [[0, 60] as const] } };
    const left = withAgents(scene, [gone]);
    expect(poseAt(motionOf(left, emptyMotion(''), gone), 5)).not.toBeNull();
    expect(poseAt(motionOf(left, emptyMotion(''), gone), 15)).toBeNull();
    expect(seenUntil(left, emptyMotion(''), gone)).toBeCloseTo(5.9);
    expect(seenUntil(scene, emptyMotion(''), car(scene))).toBeNull();
    const nine = crossing();
    expect(motionOf(nine, set, nine.agents.get('2')!)).toBe(nine.agents.get('2')!.log);
  });

  it('are stored with the scene and sent in requests', () => {
    const scene = setReplan(6).apply(setLength(crossing(), 15).apply(crossing()));
    const back = readScene(writeScene(crossingJson(), scene, null));
    expect([back.length, back.replan, back.duration]).toEqual([15, 6, 15]);
    expect(sceneKey(back)).toBe(sceneKey(scene));
    const odd = readScene({ ...crossingJson(), x_editor: { length_s: 17, replan_s: 4 } });
    expect([odd.length, odd.replan]).toEqual([9, 9]);
  });
});

describe('scene', () => {
  it('reads names, kinds, parked and conditions', () => {
    const s = crossing();
    expect(car(s).name).toBe('Car 1');
    expect([...s.agents.values()].filter((a) => a.parked)).toHaveLength(8);
    expect([...s.agents.values()].filter((a) => a.kind === 'bus')).toHaveLength(1);
    // A queue at a red light stands still for the whole scene and is not parked.
    expect(s.agents.get('7')!.parked).toBe(false);
    // Nor is a road user of that queue that is first recorded later.
    const json = crossingJson();
    const later = json.agents.find((a) => a.id === '7')!;
    later.track.valid = [[30, later.track.x_m.length]];
    expect(readScene(json).agents.get('7')).toMatchObject({ logStart: null, parked: false });
  });

  it('writes only what was changed, and reads it back', () => {
    const json = crossingJson(),
      s = readScene(json),
      a = car(s);
    let next = setGoal(a, { ...freeGoal(8), pos: [4, 30], speed: 7, mayCross: ['e1'] }).apply(s);
    next = setStart(next.agents.get('1')!, { ...next.agents.get('1')!.start, speed: null }).apply(next);
    expect(conditionOf(next.agents.get('1')!)).toEqual({
      goal: { x_m: 4, y_m: 30, speed_mps: 7, time_s: 8, may_cross: ['e1'] },
      start: { x_m: -60, y_m: expect.any(Number), heading_rad: expect.any(Number), speed_mps: null },
    });
    const written = JSON.parse(JSON.stringify(writeScene(json, next, null)));
    const again = readScene(written);
    expect(sceneKey(again)).toBe(sceneKey(next));
    expect(written.agents.slice(1).every((x: { conditions: object }) => Object.keys(x.conditions).length === 0)).toBe(
      true,
    );
    expect(written.map).toEqual(json.map);
    expect(touched(again.agents.get('2')!)).toBe(false);
  });

  it('stores futures and picks with the scene, and drops stale ones', () => {
    const json = crossingJson(),
      s = readScene(json);
    const picked = choose(car(s), 2, 'C').apply(setGoal(car(s), { ...freeGoal(), pos: [4, 30] }).apply(s));
    const f = readFutures(
      { chosen: 1, modes: sixFutures(json.agents[0], { goal: { x_m: 4, y_m: 30 } }, 5, 5) },
      startPose(car(s))!,
      5,
      5,
      false,
    );
    const written = JSON.parse(
      JSON.stringify(writeScene(json, picked, generatedJson(picked, [['1', f]], { input_sha256: 'abc' }))),
    );
    const again = readScene(written),
      set = readGenerated(written, again)!;
    expect(car(again).chosen).toBe(2);
    expect(written.generated.input_sha256).toBe('abc');
    expect(written.generated.samples[0].agents['1'].chosen).toBe(2);
    expect([...set.driving]).toEqual(['1']);
    expect(set.futures.get('1')!.modes[0].motion.x.length).toBe(91);
    expect(set.futures.get('1')!.modes[0].motion.x[90]).toBeCloseTo(f.modes[0].motion.x[90], 3);
    expect(readGenerated({ ...written, generated: { ...written.generated, stale: true } }, again)).toBeNull();
  });

  it('reports faults of other documents', () => {
    expect(() => readScene({} as never)).toThrow(SceneError);
    expect(() => readScene({ ...crossingJson(), version: 7 })).toThrow(/newer version/);
  });

  it('interpolates tracks with their gaps', () => {
    const m = motionFrom({
      first_step: 2,
      valid: [
        [2, 4],
        [5, 6],
      ],
      x_m: [0, 1, 0, 9],
      y_m: [0, 0, 0, 0],
      heading_rad: [0, 0, 0, 0],
      vx_mps: [10, 10, 0, 10],
      vy_mps: [0, 0, 0, 0],
    });
    expect(poseAt(m, 0.25)!.x).toBeCloseTo(0.5);
    expect(poseAt(m, 0.1)).toBeNull();
    expect(poseAt(m, 0.4)).toBeNull();
    expect(poseAt(m, 0.5)!.x).toBe(9);
  });
});

describe('letters of futures', () => {
  const of = (...anchors: (number | null)[]) => anchors.map((anchor) => ({ anchor }));
  const read = (anchors: (number | null)[], chosen: number, keep?: Parameters<typeof readFutures>[5]) =>
    readFutures(
      {
        chosen,
        modes: anchors.map((anchor, i) => ({
          probability: 0.5 - i * 0.05,
          x_m: [1 + (anchor ?? 9)],
          y_m: [0],
          heading_rad: [0],
          ...(anchor === null ? {} : { anchor }),
        })),
      },
      { x: 0, y: 0, heading: 0, speed: 1 },
      1,
      5,
      false,
      keep,
    );

  it('stay with their idea while probabilities change', () => {
    const before = read([3, 0, null, 5, 1, 2], 0);
    const after = read([0, 3, 5, 2, null, 1], 0, { like: before, always: false });
    expect(after.modes.map((m) => m.anchor)).toEqual([3, 0, null, 5, 1, 2]);
    // Each keeps its own probability and motion, and the choice is still the idea the generator chose.
    expect(after.modes.map((m) => m.probability)).toEqual(
      [0.45, 0.5, 0.3, 0.4, 0.25, 0.35].map((v) => expect.closeTo(v, 9)),
    );
    expect(after.modes.map((m) => m.motion.x[1])).toEqual([4, 1, 10, 6, 2, 3]);
    expect(after.modes[after.chosen].anchor).toBe(0);
  });

  it('follow the probabilities again when other ideas arrive, but not within a drag', () => {
    const before = of(3, 0, 4, 5, 1, 2),
      sent = of(0, null, 3, 5, 2, 1);
    expect(placesLike(before, sent, false)).toEqual([0, 1, 2, 3, 4, 5]);
    expect(placesLike(before, sent, true).map((i) => sent[i].anchor)).toEqual([3, 0, null, 5, 1, 2]);
  });

  it('are those of the list without ideas, and lose none', () => {
    expect(placesLike([{}, {}, {}], [{}, {}, {}], true)).toEqual([0, 1, 2]);
    const list = fc.array(fc.option(fc.integer({ min: 0, max: 5 })), { maxLength: 6 });
    fc.assert(
      fc.property(list, list, fc.boolean(), (a, b, always) => {
        expect([...placesLike(of(...a), of(...b), always)].sort()).toEqual(b.map((_, i) => i));
      }),
    );
  });

  it('are written with the scene', () => {
    const s = crossing();
    const written = generatedJson(s, [['1', read([4, null], 1)]])!.samples[0].agents['1'];
    expect(written.chosen).toBe(1);
    expect(written.modes.map((m) => m.anchor)).toEqual([4, undefined]);
  });
});

describe('others held still', () => {
  it('get no late arrivals', () => {
    const json = crossingJson();
    const late = {
      ...json.agents[1],
      id: 'late',
      track: { ...json.agents[1].track, valid: [[20, 91]] as [number, number][] },
    };
    const s = readScene({ ...json, agents: [...json.agents, late], x_editor: { others: 'still' } });
    const a = s.agents.get('late')!;
    expect(a.logStart).toBeNull();
    expect(poseAt(motionOf(s, emptyMotion(''), a), 5)).toBeNull();
    expect(withStill(s, castJson(s), new Set(['1'])).map((x) => x.id)).not.toContain('late');
    expect(
      readEvents(s, {
        ...emptyMotion(''),
        score: { collisions: [{ a: '1', b: 'late', time: 5 }], nearMisses: [], minTtc: null, offroadShare: null },
      }),
    ).toEqual([]);
  });
});

describe('lanes and reach', () => {
  const s = crossing();
  const road = (l: { kind: string }) => l.kind === 'road';

  it('finds the route through the crossing', () => {
    const from = nearestLanes(s.map, -60, -1.75, 0, 2, road)[0],
      to = nearestLanes(s.map, 1.75, 40, Math.PI / 2, 2, road)[0];
    const r = findRoute(s.map, from, to)!;
    expect(r.lanes.map((l) => l.id)).toEqual(['in20', 'x_in20_out10', 'out10']);
    expect(r.length).toBeGreaterThan(80);
    expect(r.length).toBeLessThan(105);
  });

  it('bounds what is reachable', () => {
    const l = limitsOf({ type: 'vehicle', subtype: 'car' });
    fc.assert(
      fc.property(fc.double({ min: 0, max: 38, noNaN: true }), fc.double({ min: 0.5, max: 9, noNaN: true }), (v, t) => {
        expect(leastReach(l, v, t)).toBeLessThanOrEqual(v * t + 1e-9);
        expect(furthestReach(l, v, t)).toBeGreaterThanOrEqual(v * t - 1e-9);
      }),
    );
  });

  it('never calls a goal unreachable that the hard limits allow', () => {
    const a = car(s);
    const kinds = fc.constantFrom(
      ...(['car', 'truck', 'bus', 'trailer', 'motorcycle', null] as const).map((subtype) => ({
        type: 'vehicle' as const,
        subtype,
      })),
      { type: 'cyclist' as const, subtype: null },
      { type: 'pedestrian' as const, subtype: null },
    );
    fc.assert(
      fc.property(
        kinds,
        fc.double({ min: 0, max: 45, noNaN: true }),
        fc.double({ min: 1, max: 20, noNaN: true }),
        fc.double({ min: -Math.PI, max: Math.PI, noNaN: true }),
        fc.double({ min: 0, max: 1, noNaN: true }),
        (who, speed, time, bearing, share) => {
          const start = { ...startPose(a)!, speed };
          const { accel_mps2: accel, speed_mps: top } = limitsOf(who);
          // The furthest possible place: full acceleration up to top speed, then constant.
          const rise = Math.min(time, Math.max(0, top - speed) / accel);
          const furthest = speed * time + (accel * rise * rise) / 2 + accel * rise * (time - rise);
          const d = share * furthest;
          const pos = [start.x + d * Math.cos(bearing), start.y + d * Math.sin(bearing)] as const;
          const goal = { ...freeGoal(time), pos };
          const verdict = localReach(s.map, { ...a, ...who, goal }, start, goal, 'km/h');
          expect(verdict!.kind).not.toBe('far');
        },
      ),
      { numRuns: 400 },
    );
  });

  it('takes its limits from the table that the server is built with', () => {
    expect(limitsOf({ type: 'vehicle', subtype: null }).accel_mps2).toBe(4);
    expect(limitsOf({ type: 'vehicle', subtype: 'bus' }).speed_mps).toBe(32);
    expect(limitsOf({ type: 'pedestrian', subtype: 'bus' }).curvature_per_m).toBeNull();
    expect(rangesOf({ type: 'other' })).toEqual(rangesOf({ type: 'vehicle' }));
    expect(topSpeed({ type: 'pedestrian', subtype: null })).toBe(6);
    expect(topSpeed({ type: 'vehicle', subtype: 'car' })).toBe(40);
  });

  it('gives the reason and a remedy', () => {
    const a = { ...car(s), goal: { ...freeGoal(4), pos: [1.75, 90] as const, heading: Math.PI / 2 } };
    const r = localReach(s.map, a, startPose(a)!, a.goal, 'km/h')!;
    expect(r.kind).toBe('far');
    expect(r.words).toMatch(/along the lane\. Starting at 32 km\/h, this car covers at most \d+ m in 4\.0 s\./);
    expect(r.nearest).not.toBeNull();
    const near = localReach(
      s.map,
      { ...a, goal: { ...a.goal, pos: [1.75, 20], time: 9 } },
      startPose(a)!,
      { ...a.goal, pos: [1.75, 20], time: 9 },
      'km/h',
    )!;
    expect(near.kind).toBe('ok');
    expect(localReach(s.map, a, startPose(a)!, freeGoal(), 'km/h')).toBeNull();
  });
});

describe('futures', () => {
  const json = crossingJson(),
    s = readScene(json);
  const futures = (id: string, goal?: object) =>
    readFutures(
      {
        chosen: 0,
        modes: sixFutures(
          json.agents.find((a) => a.id === id)!,
          goal && { goal },
          5,
          5,
        ),
      },
      startPose(s.agents.get(id)!)!,
      5,
      5,
      false,
    );

  it('start at the start and have names of their own', () => {
    const f = futures('1');
    expect(f.modes).toHaveLength(6);
    expect(f.modes[0].motion.first).toBe(0);
    expect(f.modes[0].motion.x[0]).toBe(-60);
    expect(f.modes.every((m) => m.name.length > 3)).toBe(true);
    expect(f.modes[0].name).toMatch(/left/);
  });

  it('report each reaction in a sentence', () => {
    const before = emptyMotion('a');
    const late = readFutures(
      { chosen: 0, modes: [giveWay(json.agents[1], 2.2)] },
      startPose(s.agents.get('2')!)!,
      5,
      5,
      false,
    );
    const after: MotionSet = {
      ...before,
      key: 'b',
      futures: new Map([
        ['1', futures('1')],
        ['2', late],
      ]),
      driving: new Set(['1', '2']),
    };
    const changes = findChanges(s, before, after, new Set(['1']));
    expect(changes.map((c) => c.id)).toEqual(['2']);
    expect(changes[0].words).toMatch(/^(waits|slows|stops) .*Car 1$/);
    expect(changes[0].lost).toBeGreaterThan(0.5);
  });

  it('become events with facts', () => {
    const set: MotionSet = {
      ...emptyMotion('a'),
      score: {
        collisions: [
          { a: '1', b: '2', time: 5.4 },
          { a: '2', b: '1', time: 5.5 },
        ],
        nearMisses: [
          { a: '1', b: '2', time: 5, distance: 0.1, ttc: 0.2 },
          { a: '11', b: walker(s).id, time: 3.2, distance: 0.6, ttc: null },
          { a: '99', b: '1', time: 1, distance: 1, ttc: 1 },
        ],
        minTtc: null,
        offroadShare: null,
      },
    };
    const ev = readEvents(s, set);
    expect(ev.map((e) => [e.kind, e.inLog])).toEqual([
      ['near', true],
      ['collision', true],
    ]);
    expect(ev[1].facts.map(([k]) => k)).toEqual(['Car 1', 'Car 2', 'Closing speed', 'Source']);
    const said = (unit: 'km/h' | 'mph') => readEvents(s, set, unit)[1].facts.map(([, v]) => v);
    expect(said('km/h')[2]).toMatch(/^\d+ km\/h$/);
    expect(said('mph').join()).not.toMatch(/km\/h/);
    expect(said('mph')[2]).toMatch(/^\d+ mph$/);
    // As soon as one of the two does not replay, the event counts.
    const own = readEvents(s, { ...set, driving: new Set(['1']) });
    expect(own.map((e) => e.inLog)).toEqual([true, false]);
  });
});
