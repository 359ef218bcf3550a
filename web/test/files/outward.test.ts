// Export and import: packed scenes, links, the lines of broken files, and their remaining parts.
import fc from 'fast-check';
import { readFileSync, readdirSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { fit } from '../../src/app/dialogs/find';
import { dayAndTime } from '../../src/app/scenes/dates';
import { foreignKind } from '../../src/edit/tools/importing/file-kinds';
import { partAt, withoutBroken } from '../../src/edit/tools/importing/mending';
import { eventsTable } from '../../src/edit/tools/outward/events-table';
import { reduced } from '../../src/edit/document/shared-parts';
import { LinkError, MOST_LINK_BYTES, readLink, writeLink } from '../../src/edit/document/share-link';
import { isShareLink } from '../../src/edit/document/share-mark';
import { emptyScene, withoutRoadUsers } from '../../src/model/document/blank-scene';
import { openingCentre } from '../../src/model/physics/scene-centre';
import { readEvents } from '../../src/model/words/event-words';
import { emptyMotion } from '../../src/model/document/futures';
import type { SceneJson } from '../../src/model/document/scene-json';
import { lineOf, linesAround, offsetOf } from '../../src/edit/tools/importing/json-place';
import { pack, unpack } from '../../src/model/document/pack';
import { readScene } from '../../src/model/document/scene-reader';
import { withAgents } from '../../src/model/document/scene';
import type { Problem } from '../../src/net/types';
import { crossing, crossingJson } from '../helpers';

const demos = new URL('../../../assets/scenes/', import.meta.url);
const demoScenes = (): SceneJson[] =>
  readdirSync(demos)
    .filter((f) => f.endsWith('.json'))
    .map((f) => JSON.parse(readFileSync(new URL(f, demos), 'utf8')) as SceneJson);
const at = { time: 4.6, camera: { cx: 1, cy: 2, z: 8 } };
const ALL = { futures: true, words: true, start: true };

describe('a packed scene', () => {
  it('equals the original to the last bit, whatever its numbers', () => {
    const number = fc.oneof(
      fc.double({ noNaN: true, noDefaultInfinity: true }),
      fc.integer().map((n) => n / 1000),
      fc.constantFrom(-0, 0.1 + 0.2, 1e-9, 2 ** 53),
    );
    const leaf = fc.oneof(number, fc.string(), fc.boolean(), fc.constant(null));
    const json = fc.letrec((tie) => ({
      value: fc.oneof(
        leaf,
        fc.array(number, { maxLength: 12 }),
        fc.array(fc.tuple(number, number), { maxLength: 9 }),
        fc.array(tie('value'), { maxLength: 4 }),
        fc.dictionary(
          fc.string({ maxLength: 4 }).filter((k) => !/^\$|__proto__/.test(k)),
          tie('value'),
        ),
      ),
    })).value;
    fc.assert(
      fc.property(json, (v) => {
        const text = JSON.stringify(v);
        expect(JSON.stringify(unpack(JSON.parse(JSON.stringify(pack(JSON.parse(text))))))).toBe(text);
      }),
    );
  });

  it('is refused where a column is broken', () => {
    for (const broken of [{ $c: 3 }, { $c: [9, 1, 2] }, { $c: [0, 3, 1] }, { $c: [0, 1, 'x'] }, { $p: [[99, 1, 1]] }])
      expect(() => unpack(broken)).toThrow();
  });
});

describe('a link', () => {
  it('contains every demo whole, and opens as it was made', async () => {
    for (const scene of demoScenes()) {
      const { hash, bytes } = await writeLink({ scene, at });
      expect(isShareLink(hash)).toBe(true);
      expect(bytes, scene.name).toBeLessThan(MOST_LINK_BYTES);
      expect(hash).toMatch(/^#s1=[\w-]+$/);
      const back = await readLink(hash);
      expect(back.at).toEqual(at);
      expect(JSON.stringify(back.scene)).toBe(JSON.stringify(scene));
    }
  });

  it('that is truncated, foreign or endless is refused in words', async () => {
    const { hash } = await writeLink({ scene: crossingJson(), at: null });
    for (const bad of [hash.slice(0, -40), `${hash.slice(0, 200)}A${hash.slice(201)}`, '#s1=', '#s1=%%%', '#s1=AAAA'])
      await expect(readLink(bad)).rejects.toThrow(LinkError);
    await expect(readLink(`#s1=${'A'.repeat(200_000)}`)).rejects.toThrow(/too long/);
    const larger = await writeLink({ scene: { ...crossingJson(), name: 'x'.repeat(17 << 20) }, at: null });
    await expect(readLink(larger.hash)).rejects.toThrow(/limits of a scene/);
  });

  it('omits what is switched off', () => {
    const scene: SceneJson = {
      ...crossingJson(),
      meta: { notes: 'secret', tags: ['a'] },
      generated: {
        chosen_sample: 0,
        samples: [{ agents: { '1': { chosen: 1, modes: [{ name: 'A' }, { name: 'B' }] as never } } }],
      },
    };
    scene.agents[0].conditions = { goal: { x_m: 1, y_m: 2 } };
    const whole = reduced(scene, ALL);
    expect(whole.generated!.samples[0].agents['1'].modes.map((m) => m.name)).toEqual(['B']);
    expect(whole.id).toBeUndefined();
    const bare = reduced(scene, { futures: false, words: false, start: false });
    expect([bare.generated, bare.agents[0].conditions, bare.meta?.notes, bare.name]).toEqual([
      null,
      {},
      '',
      'Shared scene',
    ]);
  });
});

describe('a place in a text of JSON', () => {
  const text = '{\n "a": "x\\"{[",\n "map": {"lanes": [\n  {"id": "E1"},\n  {"id": "E2", "p/q": [1,\n 2]}\n ]}\n}';
  it('is found by its pointer', () => {
    const line = (pointer: string) => {
      const offset = offsetOf(text, pointer);
      return offset === null ? null : lineOf(text, offset);
    };
    expect(['', '/a', '/map/lanes/0', '/map/lanes/1/id', '/map/lanes/1/p~1q/1'].map(line)).toEqual([1, 2, 4, 5, 6]);
    expect(['/b', '/map/lanes/7', '/a/b', '/map/lanes/x'].map(line)).toEqual([null, null, null, null]);
    expect(linesAround(text, 4, 1)).toEqual({ from: 3, lines: text.split('\n').slice(2, 5) });
  });

  it('is inside the text, whatever that is', () => {
    fc.assert(
      fc.property(fc.string(), fc.string(), (any, pointer) => {
        const offset = offsetOf(any, `/${pointer}`);
        expect(offset === null || (offset >= 0 && offset < any.length)).toBe(true);
      }),
    );
    fc.assert(
      fc.property(fc.jsonValue(), (v) => {
        const written = JSON.stringify({ first: 1, v: [0, v] }, null, 2);
        const offset = offsetOf(written, '/v/1')!;
        expect(written.slice(offset).startsWith(JSON.stringify(v)[0])).toBe(true);
      }),
    );
  });
});

describe('a broken scene', () => {
  const problem = (...pointers: string[]): Problem => ({
    code: 'invalid-field',
    title: '',
    errors: pointers.map((pointer) => ({ pointer, code: 'invalid-field', detail: '' }) as never),
  });
  const scene: SceneJson = {
    map: {
      lanes: [
        { id: 'E1', points_m: [], successors: ['E2'] },
        { id: 'E2', points_m: [], left_neighbors: [{ lane: 'E1' }] },
      ] as never,
    },
    signals: [
      { lane: 'E1', states: [] },
      { lane: 'E2', states: [] },
    ] as never,
    agents: [{ id: '7' }, { id: '8' }] as never,
  };

  it('is named by its part, and imported without it and all references to it', () => {
    expect(partAt(scene, '/map/lanes/1/points_m')?.name).toBe('lane “E2”');
    expect(partAt(scene, '/agents/0/track/x_m/3')?.name).toBe('road user “7”');
    expect(partAt(scene, '/time/steps')).toBeNull();
    const mended = withoutBroken(scene, problem('/map/lanes/1/points_m', '/agents/0'))!;
    expect(mended.without).toEqual(['lane “E2”', 'road user “7”']);
    const { map, signals, agents } = mended.scene;
    expect([(map as { lanes: unknown }).lanes, signals!.length, agents.map((a) => a.id)]).toEqual([
      [{ id: 'E1', points_m: [], successors: [] }],
      1,
      ['8'],
    ]);
    expect(scene.agents).toHaveLength(2);
    expect(withoutBroken(scene, problem('/time'))).toBeNull();
    expect(withoutBroken(scene, problem('/agents/9'))).toBeNull();
  });

  it('with too many road users is imported with as many as allowed', () => {
    const p: Problem = { code: 'too-many-agents', title: '' };
    const agents = Array.from({ length: 257 }, (_, i) => ({ ...scene.agents[0], id: String(i) }));
    const mended = withoutBroken({ ...scene, agents }, p);
    expect(mended?.without).toEqual(['the last 1 road users']);
    expect(mended?.scene.agents.map((a) => a.id)).toEqual(agents.slice(0, 256).map((a) => a.id));
  });

  it('that is none at all is recognised by its first bytes', async () => {
    expect(await foreignKind(new Blob(['%PDF-1.7']))).toEqual({
      kind: { name: 'PDF', inSentence: 'a PDF' },
      surely: true,
    });
    // Some hold a network and a recording.
    const zip = new Blob([new Uint8Array([0x50, 0x4b, 3, 4])]);
    expect(await foreignKind(zip)).toMatchObject({ kind: { name: 'ZIP archive' }, surely: false });
    expect(await foreignKind(new Blob(['{}']))).toBeNull();
    expect(await foreignKind(new Blob([]))).toBeNull();
  });
});

describe('initial scenes', () => {
  it('have no road users, with a road or without one', () => {
    const road = readScene({ ...withoutRoadUsers(crossingJson()), id: 'x' });
    expect([road.agents.size, road.map.lanes.size]).toEqual([0, readScene(crossingJson()).map.lanes.size]);
    const plain = readScene({ ...emptyScene(), id: 'y' });
    expect([plain.agents.size, plain.map.lanes.size, plain.duration]).toEqual([0, 0, 9]);
  });

  it('open where most movement is', () => {
    for (const json of demoScenes()) {
      const s = readScene(json);
      const [cx, cy] = openingCentre(s, 80, 44);
      const moving = [...s.agents.values()].filter((a) => !a.parked && a.logStart && Math.abs(a.logStart.speed) > 2);
      const seen = moving.filter((a) => Math.abs(a.logStart!.x - cx) < 80 && Math.abs(a.logStart!.y - cy) < 44);
      expect(seen.length, s.name).toBeGreaterThan(moving.length / 4);
    }
  });
});

describe('events as a table', () => {
  it('are rows in order of time, in which no name is a formula', () => {
    const scene = crossing();
    const [one, other, third] = scene.agents.values();
    const near = { a: one.id, b: third.id, time: 3.2, distance: 0.6, ttc: null, inLog: true };
    const score = {
      ...{ collisions: [{ a: other.id, b: one.id, time: 1.5, closing: 4 }], nearMisses: [near] },
      ...{ minTtc: null, offroadShare: null },
    };
    const named = withAgents(scene, [{ ...one, name: '=1+1, "x"' }]);
    const rows = eventsTable(readEvents(named, { ...emptyMotion(''), score })).split('\r\n');
    expect(rows[0]).toBe('time_s,until_s,kind,who,whom,words,x_m,y_m,in_log');
    expect(rows[1]).toMatch(/^1\.50,1\.50,collision,/);
    expect(rows[2]).toMatch(/^3\.20,3\.20,near_miss,"'=1\+1, ""x""",[^,]+,"?Near miss, 0\.6 m/);
    expect(rows[2]).toMatch(/,true$/);
    expect(rows.slice(3)).toEqual(['']);
  });
});

describe('the palette', () => {
  it('requires all words, and prefers matches at the start', () => {
    expect(fit('Delete scene', ['scene', 'del'])).toBeGreaterThan(0);
    expect(fit('Delete scene', ['scene', 'x'])).toBe(0);
    expect(fit('Scenes', ['sc'])).toBeGreaterThan(fit('Delete scene', ['sc']));
    expect(fit('Delete scene', ['sc'])).toBeGreaterThan(fit('Obscene', ['sc']));
  });

  it('formats days in everyday words', () => {
    const now = new Date(2026, 10, 23, 12);
    expect(dayAndTime(new Date(2026, 10, 23, 0, 5).toISOString(), now)).toMatch(/^today /);
    expect(dayAndTime(new Date(2026, 10, 22, 23, 55).toISOString(), now)).toMatch(/^yesterday /);
    expect(dayAndTime(new Date(2026, 0, 2).toISOString(), now)).toMatch(/2/);
    expect(dayAndTime('nonsense', now)).toBe('');
  });
});
