// A map that is too large is imported in part: a circle is drawn on its picture.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { gzipSync } from 'node:zlib';
import { journeys } from '../../support/journey.js';

/** Streets of a grid, each of 90 m: a network of SUMO with two lanes for each crossing. */
const grid = (n) => {
  const lane = (id, x, y, u, v) =>
    `<edge id="${id}" from="a" to="b"><lane id="${id}_0" index="0" speed="13.9" length="90" ` +
    `shape="${x}.00,${y}.00 ${u}.00,${v}.00"/></edge>`;
  const streets = [];
  for (let i = 0; i < n; i++)
    for (let j = 0; j < n; j++) {
      const [x, y] = [100 * i, 100 * j];
      streets.push(lane(`h${i}_${j}`, x + 5, y, x + 95, y), lane(`v${i}_${j}`, x, y + 5, x, y + 95));
    }
  const box = `convBoundary="0,0,${100 * n},${100 * n}" origBoundary="0,0,1,1"`;
  const location = `<location netOffset="0.00,0.00" ${box} projParameter="!"/>`;
  return `<net version="1.16">${location}${streets.join('\n')}</net>`;
};

const PART = '.mappart';

journeys('a part of a map', (stage) => {
  it('is drawn as a circle on the picture of a map that is too large', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.drop('town.net.xml.gz', gzipSync(grid(110)));
    await e.page.waitForSelector(`${PART} svg circle`, { state: 'attached' });
    assert.match(await e.text('.dlg h2'), /Part of the map/);
    assert.match(await e.text('.dlg'), /more than 20000 lines/);
    const value = async (name) => Number(await e.page.inputValue(`${PART} [name="${name}"]`));
    assert.deepEqual(await Promise.all(['x', 'y'].map(value)), [5497.5, 5497.5]);

    // From the middle of the part to its edge: east of the map's middle.
    const { x, y, width, height } = await e.page.locator(`${PART} svg`).boundingBox();
    const from = [x + width / 2 + height / 4, y + height / 2];
    await e.drag(from, [from[0] + 6, from[1] + 8], { moves: 4 });
    await e.page.mouse.up();
    const drawn = { x: await value('x'), y: await value('y'), radius: await value('radius') };
    assert.ok(drawn.x > 7500 && drawn.x < 9500, `x ${drawn.x}`);
    assert.ok(Math.abs(drawn.y - 5497.5) < 60, `y ${drawn.y}`);
    assert.ok(drawn.radius > 300 && drawn.radius < 500, `radius ${drawn.radius}`);
    await e.picture('map-part');

    // A circle where nothing is gets the reason and another try; numbers are typed.
    const type = (name, text) => e.page.fill(`${PART} [name="${name}"]`, text);
    await type('x', '-5000');
    await e.page.click(`${PART} [type="submit"]`);
    await e.until(() => /no lane|No lane/.test(document.querySelector('.dlg')?.textContent ?? ''));
    await e.page.waitForSelector(`${PART} svg circle`, { state: 'attached' });
    await type('x', '2500');
    await type('y', '2500');
    await type('radius', '150');
    await e.page.click(`${PART} [type="submit"]`);
    await e.until(() => /town imported\./.test(document.querySelector('.toast')?.textContent ?? ''));
    await e.settled();
    const scenes = (await e.get('/v1/scenes?q=town')).scenes;
    assert.equal(scenes.length, 1);
    const { map } = await e.get(`/v1/scenes/${scenes[0].id}`);
    const far = Math.max(...map.lanes.flatMap((l) => l.points_m.map(([px, py]) => Math.hypot(px, py))));
    assert.ok(map.lanes.length > 5 && far < 151, `${map.lanes.length} lanes, the farthest ${far} m away`);
    await e.picture('map-part-imported');
  });
});
