// The picture of a map file before it is read.
import { gzipSync } from 'node:zlib';
import { describe, expect, it } from 'vitest';
import { outlineOf } from '../../src/edit/tools/importing/map-outline';

const net = (n: number): string => {
  const lane = (i: number) => `<lane id="a${i}_0" index="0" length="90" shape="${i * 100},0.5 ${i * 100 + 90},40.25"/>`;
  return `<net><edge id="a">${Array.from({ length: n }, (_, i) => lane(i)).join('\n')}</edge></net>`;
};

describe('the outline of a map', () => {
  it('has the lanes of a network, packed or not', async () => {
    for (const file of [new Blob([net(5)]), new Blob([gzipSync(net(5))])]) {
      const outline = (await outlineOf(file))!;
      expect(outline.degrees).toBe(false);
      expect(outline.box).toEqual({ x0: 0, y0: 0.5, x1: 490, y1: 40.25 });
      expect(outline.lines[1]).toEqual([[100, 0.5], [190, 40.25]]); // prettier-ignore
      expect(outline.lines).toHaveLength(5);
    }
  });

  it('has the geometries of an OpenDRIVE file, and the nodes of an OSM file in degrees', async () => {
    const road =
      '<planView><geometry s="0.0" x="1.0e+1" y="-20" hdg="1.5707963267948966" length="30"><line/></geometry>';
    const [[from, to]] = (await outlineOf(new Blob([road])))!.lines;
    expect(from).toEqual([10, -20]);
    expect(to[0]).toBeCloseTo(10, 9);
    expect(to[1]).toBeCloseTo(10, 9);
    const [one, two] = [
      '<node id="1" version="1" lat="48.1" lon="11.5"/>',
      '<node id="2" lat="48.2" lon="11.6"><tag/>',
    ];
    const nodes = `<osm>${one}${two}</node></osm>`;
    const osm = (await outlineOf(new Blob([nodes])))!;
    expect(osm.degrees).toBe(true);
    expect(osm.box).toEqual({ x0: 11.5, y0: 48.1, x1: 11.6, y1: 48.2 });
  });

  it('stays small for a large map, loses no corner of it, and is none for another file', async () => {
    const large = (await outlineOf(new Blob([net(60_000)])))!;
    expect(large.lines.length).toBeLessThanOrEqual(12_000);
    // Lanes that take turns are all thinned out alike.
    const odd = large.lines.filter(([[x]]) => (x / 100) % 2).length / large.lines.length;
    expect(Math.abs(odd - 0.5)).toBeLessThan(0.02);
    expect(large.box.x1).toBe(59_999 * 100 + 90);
    expect(await outlineOf(new Blob(['t,x,y\n0,1,2\n']))).toBeNull();
    expect(await outlineOf(new Blob([gzipSync(net(2000)).subarray(0, 900)]))).not.toBeNull();
  });
});
