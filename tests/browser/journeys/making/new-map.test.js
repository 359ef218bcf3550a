// A map from a template: chosen, edited, used, filled, and driven on.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { journeys } from '../../support/journey.js';
import { knobOfArm } from '../../support/maps.js';

const making = (e) => e.page.evaluate(() => document.querySelector('.stage').getAttribute('aria-busy') === 'false');

/** The last requested map is on the picture. */
async function drawn(e) {
  await e.frames(2);
  await e.until(() => /lanes? · \d+ crosswalks?$/.test(document.querySelector('.status')?.textContent ?? ''));
  await e.settled();
  assert.ok(await making(e));
}

const angle = (e) => e.value('layout-arms.angle_deg');

const checks = (e) => e.page.locator('.checks li').allTextContents();

/** The open scene, as the server has it. */
async function stored(e) {
  const id = new URL(e.page.url()).searchParams.get('scene');
  return (await e.page.request.get(new URL(`/v1/scenes/${id}`, e.page.url()).href)).json();
}

journeys('new map', (stage) => {
  it('a crossing: turned, with stop signs, used, filled, and a car dragged over it', { timeout: 180_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.key('Shift+T');
    await e.page.waitForSelector('.templates');
    await e.page.click('[data-template="roundabout"]');
    await drawn(e);
    assert.match(await e.text('.ih p'), /roundabout/);
    await e.page.click('[data-template="four-arms"]');
    await drawn(e);
    assert.equal(await e.page.locator('[data-template]').count(), 8);
    assert.ok((await checks(e)).includes('Every lane leads somewhere'));
    await e.picture('new-map');

    // The arm to the north is turned by its knob, without snapping on the way.
    await e.key(']');
    assert.equal(await angle(e), 92);
    const knob = await knobOfArm(e, 1);
    await e.drag(await knob(92), await knob(71), {
      then: async () => {
        await drawn(e);
        assert.match(await e.text('.layouts'), /was 92°/);
        await e.picture('new-map-turned');
      },
    });
    await e.release();
    await drawn(e);
    assert.equal(await angle(e), 71);

    // A way is drawn from its stop line to the exit in the east, and removed; undo restores it.
    const { arms } = await e.page.evaluate(async () => {
      const body = { template: 'four-arms', parameters: {} };
      const ask = async () =>
        (
          await fetch('/v1/map', {
            method: 'POST',
            headers: { 'Content-Type': 'application/json' },
            body: JSON.stringify(body),
          })
        ).json();
      body.parameters.arms = (await ask()).layout.parameters.arms;
      body.parameters.arms[1].angle_deg = 71;
      return ask();
    });
    const rows = e.page.locator('.ways li');
    const ways = await rows.count();
    await e.drag(await e.at(...arms[1].ins_m[0]), await e.at(...arms[0].outs_m[1]), {
      moves: 4,
      then: async () => {
        await drawn(e);
        await e.picture('new-map-connecting');
      },
    });
    await e.release();
    await drawn(e);
    assert.equal(await rows.count(), ways + 1);
    assert.match(await e.text('.ways li.on'), /Lane 1 to East, lane 2/);
    await e.key('Delete');
    await drawn(e);
    assert.equal(await rows.count(), ways);
    await e.key('Control+z');
    await drawn(e);
    assert.equal(await rows.count(), ways + 1);
    await e.page.getByRole('button', { name: 'Remove: Lane 1 to East, lane 2' }).click();
    await drawn(e);
    assert.equal(await rows.count(), ways);
    await e.page.getByLabel('Connect to').selectOption({ label: 'East, lane 2' });
    await drawn(e);
    assert.equal(await rows.count(), ways + 1);

    // Too near to the one in the east: refused in words, and the arm returns to its last drawable place.
    await e.type('layout-arms.angle_deg', '10');
    await e.until(() => /Arms need 20° between them/.test(document.querySelector('.checks').textContent));
    assert.equal(await angle(e), 71);
    await e.type('layout-arms.angle_deg', '72');
    await drawn(e);
    assert.ok(!(await checks(e)).some((text) => text.includes('20°')));
    await e.type('layout-arms.angle_deg', '71');
    await drawn(e);

    // Esc leaves the field, then the selected way, then the map; a button reopens it.
    for (let presses = 0; presses < 3; presses++) await e.key('Escape');
    await e.page.waitForSelector('.templates', { state: 'detached' });
    await e.page.getByRole('button', { name: 'Keep editing' }).click();
    await drawn(e);
    assert.equal(await e.page.locator('.ways li').count(), ways + 1);
    assert.equal(await angle(e), 71);

    // So does another scene opened in between.
    await e.key('Control+k');
    await e.page.keyboard.type('School street');
    await e.page.keyboard.press('Enter');
    await e.page.getByRole('button', { name: 'Keep editing' }).click();
    await drawn(e);
    assert.equal(await angle(e), 71);

    await e.page.getByRole('group', { name: 'Right of way' }).getByText('Uncontrolled').click();
    await drawn(e);
    await e.page.getByRole('group', { name: 'Right of way' }).getByText('Signals').click();
    await e.type('layout-kerb_radius_m', '10');
    await drawn(e);
    await e.page.click('[data-action="use-map"]');
    await e.page.waitForSelector('.nobody');
    await e.settled();
    const scene = await stored(e);
    assert.equal(scene.x_layout.template, 'four-arms');
    const { parameters } = scene.x_layout;
    assert.equal(parameters.arms[1].angle_deg, 71);
    assert.equal(parameters.kerb_radius_m, 10);
    assert.equal(parameters.control, 'signals');
    assert.deepEqual(parameters.connections.added, [{ from: 'arm2.in1', to: 'arm1.out2' }]);
    assert.ok(scene.map.lanes.some((lane) => lane.id === 'arm2.in1-arm1.out2'));
    assert.ok(scene.signals.length > 8);

    // Filled, and one car is dragged.
    await e.key('d');
    await e.page.waitForSelector('.filling');
    await e.settled();
    await e.until(() => document.querySelectorAll('[data-preview]').length > 4);
    await e.key('Enter');
    await e.settled();
    const cars = (await e.roadUsers()).filter((u) => u.kind === 'Car');
    assert.ok(cars.length > 2, `${cars.length} cars`);
    await e.key('Escape');
    await e.choose(cars.sort((a, b) => b.speed - a.speed)[0].id);
    await e.settled();
    const before = await e.pose('Goal');
    await e.type('goal-speed', '10');
    await e.settled();
    assert.ok(before && (await e.page.locator('.fu[data-future]').count()) >= 1, 'it has futures');
    await e.picture('new-map-driven');

    // The map can be edited later; the scene it was made for stays.
    await e.key('Escape');
    await e.key('Control+k');
    await e.page.keyboard.type('Change the map');
    await e.page.keyboard.press('Enter');
    await drawn(e);
    assert.match(await e.text('.ih h2'), /Change the map/);
    assert.equal(await e.value('layout-kerb_radius_m'), 10);
    await e.key('Escape');
    assert.equal(await e.shows('.templates'), false);
    assert.equal((await stored(e)).x_layout.parameters.kerb_radius_m, 10);
  });
});
