// A map filled with traffic: previewed before it is added, in a drawn area; pinned ones stay when others change.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { journeys } from '../../support/journey.js';
import { emptyScene } from '../../support/maps.js';

/** The preview: `{ kind, x, y, pinned, later }`, from the list for screen readers. */
const preview = (e) =>
  e.page.locator('[data-preview]').evaluateAll((all) =>
    all.map((b) => {
      const [x, y] = b.textContent
        .replaceAll('−', '-')
        .match(/-?\d+\.\d/g)
        .map(Number);
      return {
        kind: b.dataset.preview,
        x,
        y,
        pinned: b.getAttribute('aria-pressed') === 'true',
        later: b.textContent.includes('arrives at'),
      };
    }),
  );

const count = async (e) => (await e.roadUsers()).length;

const inside = (p, poly) =>
  poly.reduce((is, [ax, ay], i) => {
    const [bx, by] = poly[(i + 1) % poly.length];
    return ay > p.y !== by > p.y && p.x < ((bx - ax) * (p.y - ay)) / (by - ay) + ax ? !is : is;
  }, false);

/** The eastern arm of the crossing, clear of all panels. */
const ARM = [
  [12, -16],
  [46, -14],
  [46, 14],
  [12, 12],
];

/** Draws an outline with the mouse held down. */
async function draw(e, area) {
  const { mouse } = e.page;
  await mouse.move(...(await e.at(...area[0])));
  await mouse.down();
  for (const p of [...area.slice(1), area[0]]) {
    await mouse.move(...(await e.at(...p)), { steps: 6 });
    await e.frames(1);
  }
  await mouse.up();
  await e.settled();
}

async function slide(e, label, value) {
  await e.page.getByRole('slider', { name: label, exact: true }).fill(String(value));
  await e.settled();
}

async function begin(stage) {
  const e = await stage.open();
  await e.begin();
  await e.key('b');
  return e;
}

const start = async (e) => {
  await e.key('d');
  await e.page.waitForSelector('.filling');
  await e.settled();
};

/** Positions of all road users, by id. */
async function places(e) {
  const { agents } = await stored(e);
  return new Map(
    agents.map((a) => {
      const s = a.conditions?.start;
      return [a.id, [s?.x_m ?? a.track.x_m[0], s?.y_m ?? a.track.y_m[0]]];
    }),
  );
}

/** The open scene, as the server has it. */
async function stored(e) {
  await e.until(() => document.querySelector('.title small').textContent === 'Saved');
  const { scenes } = await e.get('/v1/scenes');
  const name = await e.page.inputValue('.title input');
  return e.get(`/v1/scenes/${scenes.find((s) => s.name === name && !s.readonly).id}`);
}

async function ownCopy(e) {
  await e.key('Control+s');
  await e.until(() => /copy|Copy|Saved/.test(document.querySelector('.title small').textContent));
  await e.until(() => document.querySelector('.title small').textContent === 'Saved');
  await e.settled();
}

journeys('filling', (stage) => {
  it('previews road users in a drawn area, and adds them as one step', { timeout: 90_000 }, async () => {
    const e = await begin(stage);
    const before = await count(e);
    await start(e);
    const everywhere = await preview(e);
    assert.ok(everywhere.length > 20, `${everywhere.length} on the whole map`);
    await draw(e, ARM);
    await slide(e, 'Density', 6);
    const few = await preview(e);
    await slide(e, 'Density', 10);
    const many = await preview(e);
    assert.ok(few.length >= 3 && many.length > few.length, `${few.length}, then ${many.length}`);
    assert.ok(
      many.every((p) =>
        inside(
          p,
          ARM.map(([x, y]) => [x + Math.sign(x - 29) * 2, y + Math.sign(y) * 2]),
        ),
      ),
    );
    assert.equal(await count(e), before, 'nobody is added before Enter');
    assert.match(await e.text('.status'), /nothing added yet/);
    await e.picture('filling');
    // Only pedestrians and cyclists.
    for (const kind of ['Cars', 'Trucks, buses', 'Motorcycles']) await slide(e, kind, 0);
    const soft = await preview(e);
    assert.ok(soft.length > 0 && soft.every((p) => ['cyclist', 'pedestrian'].includes(p.kind)), JSON.stringify(soft));
    await slide(e, 'Cars', 70);
    await slide(e, 'Trucks, buses', 70);
    const heavy = (await preview(e)).filter((p) => ['truck', 'bus'].includes(p.kind));
    assert.ok(heavy.length >= 1, 'as many trucks as cars are wanted');
    const shown = await preview(e);
    await e.key('Enter');
    await e.settled();
    assert.equal(await count(e), before + shown.length);
    assert.equal(await e.shows('.filling'), false);
    await e.key('Control+z');
    await e.settled();
    assert.equal(await count(e), before, 'one step back and they are gone');
  });

  it(
    'keeps those that are pinned and draws the others anew; the seed brings a draw back',
    { timeout: 90_000 },
    async () => {
      const e = await begin(stage);
      await ownCopy(e);
      const before = await count(e);
      await start(e);
      await draw(e, ARM);
      await slide(e, 'Density', 10);
      const first = await preview(e);
      const seed = await e.page.inputValue('[aria-label="Seed for filling"]');
      const good = first.find((p) => p.x > 15 && p.x < 44 && p.y > -12 && p.y < 10);
      assert.ok(good, 'somebody stands well inside');
      await e.page.mouse.click(...(await e.at(good.x, good.y)));
      assert.deepEqual(
        (await preview(e)).filter((p) => p.pinned),
        [{ ...good, pinned: true }],
      );
      await e.picture('pinned');
      await e.key('r');
      await e.settled();
      const second = await preview(e);
      const same = second.filter((p) => first.some((q) => q.x === p.x && q.y === p.y));
      assert.deepEqual(
        same.filter((p) => p.pinned),
        [{ ...good, pinned: true }],
      );
      assert.ok(same.length < first.length, 'the others stand elsewhere');
      assert.ok(second.length > first.length / 2, 'the arm is filled again');
      // Unpinned, with the first seed typed in, it is the first draw again.
      await e.page.mouse.click(...(await e.at(good.x, good.y)));
      const field = e.page.locator('[aria-label="Seed for filling"]');
      await field.fill(seed);
      await field.press('Enter');
      await e.settled();
      const text = (all) => new Set(all.map(({ kind, x, y }) => `${kind} ${x} ${y}`));
      assert.deepEqual(text(await preview(e)), text(first));
      await e.page.mouse.click(...(await e.at(good.x, good.y)));
      await e.key('r');
      await e.settled();
      const last = await preview(e);
      await e.key('Enter');
      await e.settled();
      assert.equal(await count(e), before + last.length);
      const there = [...(await places(e)).values()];
      assert.ok(
        there.some(([x, y]) => Math.abs(x - good.x) < 0.06 && Math.abs(y - good.y) < 0.06),
        'the pinned one came',
      );
    },
  );

  it('replaces road users on request, except locked ones', { timeout: 90_000 }, async () => {
    const e = await begin(stage);
    await ownCopy(e);
    const was = await places(e);
    const ids = async () => new Set((await e.roadUsers()).map((u) => u.id));
    const present = await ids();
    const here = [...was].filter(([, [x, y]]) => inside({ x, y }, ARM));
    assert.ok(here.length >= 2, 'there is traffic on the arm');
    const [[locked]] = here;
    await e.page.locator(`[data-agent="${locked}"]`).evaluate((el) => el.click());
    await e.key('Control+l');
    await e.letGo();
    await start(e);
    await draw(e, ARM);
    await e.page.getByRole('switch', { name: 'Keep existing' }).click();
    await e.settled();
    assert.match(await e.text('.filling .note'), new RegExp(`^${here.length - 1} removed`));
    const shown = await preview(e);
    await e.key('Enter');
    await e.settled();
    const now = await places(e);
    assert.deepEqual(now.get(locked), was.get(locked));
    for (const [id] of here.slice(1)) assert.ok(!now.has(id), `${id} has made room`);
    assert.equal(now.size, was.size - (here.length - 1) + shown.length);
    await e.key('Control+z');
    await e.settled();
    assert.deepEqual(await ids(), present);
  });

  it('fills an empty map, corner by corner and as a whole', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const { bytes } = await emptyScene(e);
    await e.drop('nobody.json', bytes);
    await e.page.waitForSelector('.nobody');
    await e.page.locator('.nobody [data-action="tool-fill"]').click();
    await e.page.waitForSelector('.filling');
    await e.settled();
    const everywhere = await preview(e);
    assert.ok(everywhere.length > 20);
    // Three corners by clicks; Enter closes the area, and the next Enter adds.
    for (const p of [ARM[0], ARM[1], ARM[2]]) {
      await e.page.mouse.click(...(await e.at(...p)));
      await e.frames(2);
    }
    await e.key('Enter');
    await e.settled();
    const part = await preview(e);
    assert.ok(part.length > 0 && part.length < everywhere.length / 2, `${part.length} of ${everywhere.length}`);
    assert.equal(await count(e), 0);
    await e.key('Enter');
    await e.settled();
    assert.equal(await count(e), part.length);
    assert.ok((await e.text('.status')).length > 0);
    await start(e);
    await e.key('Escape');
    await e.until(() => !document.querySelector('.filling'));
    assert.equal(await count(e), part.length, 'Esc adds nobody');
  });

  it(
    'lets traffic come in by an arm that is dragged outward, and parks cars, in one step',
    { timeout: 90_000 },
    async () => {
      const e = await stage.open();
      await e.begin();
      const { bytes } = await emptyScene(e);
      await e.drop('nobody.json', bytes);
      await e.page.waitForSelector('.nobody');
      await e.page.locator('.nobody [data-action="tool-fill"]').click();
      await e.page.waitForSelector('.filling .arms');
      await e.key('PageDown');
      await slide(e, 'Density', 0);
      assert.deepEqual(await preview(e), []);
      const said = await e.page.request.post(new URL('/v1/place', e.page.url()).href, {
        data: { scene_id: 'demo-crossing', density: { per_lane_km: 0 } },
      });
      const { arms } = await said.json();
      assert.equal(await e.page.locator('.filling .arms input').count(), arms.length);
      // The knob of an arm without traffic is 34 px inside the map's edge; 55 px outward is half of its capacity.
      const arm = arms.find((a) => a.id === 'east');
      const [x, y] = await e.at(arm.x_m, arm.y_m);
      const [ox, oy] = [-Math.cos(arm.heading_rad), Math.sin(arm.heading_rad)];
      const knob = [x - 34 * ox, y - 34 * oy];
      await e.drag(knob, [knob[0] + 55 * ox, knob[1] + 55 * oy]);
      await e.release();
      const rate = await e.value('fill-arm-east');
      assert.ok(Math.abs(rate - arm.most_per_hour / 2) <= 40, `${rate} of ${arm.most_per_hour}`);
      const came = await preview(e);
      assert.ok(came.length > 0, 'somebody comes in');
      await e.type('fill-arm-north', '900');
      await slide(e, 'Parked cars', 100);
      await e.type('fill-fastest', '30');
      const shown = await preview(e);
      assert.ok(shown.length > came.length);
      await e.picture('arms');
      await e.page.locator('.filling [data-action="fill-add"]').click();
      await e.settled();
      // The list has only present road users: the others arrive during playback.
      assert.ok(shown.some((p) => p.later));
      assert.equal(await count(e), shown.filter((p) => !p.later).length);
      await e.key('Control+z');
      await e.settled();
      assert.equal(await count(e), 0, 'one step');
    },
  );
});
