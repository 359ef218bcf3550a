// Details that files cannot hold, and their uses, in plain words.
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { setGoal } from '../../src/model/document/commands';
import { found, meant } from '../../src/edit/tools/outward/finding';
import { inKinds, outFormats } from '../../src/edit/tools/outward/formats';
import { lossesOf, stays } from '../../src/edit/tools/outward/losses';
import type { FormatInfo } from '../../src/net/types';
import { crossing } from '../helpers';

const CODES = [...readFileSync('../models/formats/src/loss.rs', 'utf8').matchAll(/: &str = "([a-z-]+)"/g)].map(
  (m) => m[1],
);

const format = (id: string, patch: Partial<FormatInfo> = {}): FormatInfo => ({
  id,
  name: `The ${id}`,
  extensions: [id, `${id}.gz`],
  media_type: '',
  import: true,
  export: true,
  many: false,
  takes_net: false,
  notes: '',
  loses: [],
  ...patch,
});

/** Losses without numbers, as the server sends them. */
const sent = (...codes: string[]): string => JSON.stringify(codes.map((code) => ({ code, detail: '' })));

describe('losses', () => {
  it('has words for every code that the server may send', () => {
    const scene = crossing();
    expect(CODES.length).toBeGreaterThan(30);
    for (const code of CODES) expect(lossesOf(sent(code), scene)[0].how, code).not.toBe('not in the file');
  });

  it('names details of the given scene, the worst first', () => {
    const scene = crossing();
    const a = [...scene.agents.values()].find((b) => b.kind === 'car')!;
    const changed = setGoal(a, { pos: [0, 0], heading: null, speed: null, time: 9, mayCross: [], via: [] }).apply(
      scene,
    );
    const losses = lossesOf(sent('no-notes', 'no-conditions', 'no-road-users'), changed);
    expect(losses.map((l) => l.what)).toEqual(['Road users', 'Goals', 'Names and notes']);
    expect(losses[0].how).toContain(`all ${scene.agents.size}`);
    expect(losses[1].how).toMatch(/^1 goal: /);
    expect(lossesOf(sent('no-conditions'), scene)[0].how).not.toMatch(/^\d/);
  });

  it('keeps an unknown code', () => {
    expect(lossesOf(sent('no-street-lamps', 'no-map'), crossing()).map((l) => l.what)).toEqual([
      'Road',
      'Street lamps',
    ]);
    expect(lossesOf(null, crossing())).toEqual([]);
  });

  it('contains the numbers of the server, once for each code', () => {
    const message = { code: 'loss-lanes-without-length', values: { count: 1 } };
    const losses = [
      { code: 'no-map', detail: 'links to lanes' },
      { code: 'no-map', detail: '1 lane of no length', message },
    ];
    expect(lossesOf(JSON.stringify(losses), crossing())).toEqual([{ what: 'Road', how: '1 lane of no length' }]);
  });

  it('reports what the file still contains', () => {
    const scene = crossing();
    expect(stays(lossesOf(sent('no-map'), scene), scene)).toContain(`${scene.agents.size} road users`);
    expect(stays(lossesOf(sent('no-map'), scene), scene)).not.toContain('the road,');
    expect(stays(lossesOf(sent('no-road-users'), scene), scene)).toMatch(/^the road/);
  });
});

describe('formats', () => {
  it('offers the formats of the server by purpose; one without words under its own name', () => {
    const offered = outFormats([
      format('newest'),
      format('csv'),
      format('dragtraffic'),
      format('osm', { export: false }),
    ]);
    expect(offered.map((o) => [o.id, o.wish, o.label, o.ending])).toEqual([
      ['dragtraffic', 'again', 'Saved scene', '.json'],
      ['csv', 'table', 'Table', '.csv'],
      ['newest', 'more', 'The newest', '.newest'],
    ]);
  });

  it('are found by their words, and the one with that file ending is the best match', () => {
    const all = [
      { label: 'Recording alone', ending: '.fcd.xml', says: 'As it is written.', name: 'Floating data (XML or CSV)' },
      { label: 'Table', ending: '.csv', says: 'For Excel.', name: 'Table of motion (CSV)' },
      { label: 'Report', ending: '.html', says: 'A few lines with a picture.' },
      { label: 'Image', ending: '.png', says: 'For slides.', name: 'picture, photo' },
      { label: 'Moving image', ending: '.gif', says: 'Again and again.' },
    ];
    const labels = (sought: string) => found(all, sought).map((k) => k.label);
    const first = (sought: string) => meant(found(all, sought), sought)?.label;
    expect([labels('csv'), first('csv'), first('.CSV')]).toEqual([['Recording alone', 'Table'], 'Table', 'Table']);
    expect([labels('picture'), first('picture')]).toEqual([['Report', 'Image'], 'Image']);
    expect([labels('image'), first('image')]).toEqual([['Image', 'Moving image'], 'Image']);
    expect([labels(' photo  slides '), labels('photo excel'), first('photo excel')]).toEqual([
      ['Image'],
      [],
      undefined,
    ]);
  });

  it('lists by kind what can be imported', () => {
    const kinds = inKinds([format('csv'), format('html', { import: false }), format('osm'), format('newest')]);
    expect(kinds.map((k) => [k.label, k.files.map((f) => f.id)])).toEqual([
      ['Trajectory tables', ['csv']],
      ['Maps only', ['osm']],
      ['More', ['newest']],
    ]);
  });
});
