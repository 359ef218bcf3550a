// Viewing: futures that play under the pointer, tried remedies, stored layers.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

/** The painted picture without the panels. */
const picture = async (e) =>
  (await e.page.locator('main.stage').screenshot({ animations: 'disabled' })).toString('base64');
const leave = (e) => e.page.evaluate(() => document.activeElement?.blur?.());

/** The same without the elements along its lower edge. */
const painting = async (e) => {
  const { x, y, width, height } = await e.page.locator('main.stage').boundingBox();
  const clip = { x, y, width, height: height - 64 };
  return (await e.page.screenshot({ animations: 'disabled', clip })).toString('base64');
};

async function selected(stage, options) {
  const e = await stage.open(options);
  await e.begin();
  const car = await carOnTheMove(e);
  await e.choose(car.id);
  await leave(e);
  await e.page.mouse.move(700, 120);
  await e.frames(4);
  return { e, car };
}

journeys('looking', (stage) => {
  it('plays the future under the pointer in place, from the list', { timeout: 60_000 }, async () => {
    const { e } = await selected(stage);
    const row = e.page.locator('.fu[data-future="B"]');
    await row.hover();
    const seen = new Set();
    // It runs without requests; the playhead stays, and each picture differs.
    const asked = e.wire.asked.length;
    while (seen.size < 3) {
      seen.add(await picture(e));
      await e.frames(3);
    }
    assert.equal(e.wire.asked.length, asked);
    assert.match(await e.text('.tm'), /^0\.0 s/);
    await e.page.mouse.move(700, 120);
    await e.frames(4);
    const still = await picture(e);
    await e.frames(10);
    assert.equal(await picture(e), still, 'beside it everything stands');
  });

  it('leaves no trail of a flag that went far and came back', { timeout: 60_000 }, async () => {
    const { e } = await selected(stage, { reducedMotion: 'reduce' });
    await e.page.locator('.coach button').click();
    await e.page.mouse.move(700, 120);
    await leave(e);
    await e.frames(4);
    const before = await painting(e);
    const { x, y } = await e.pose('Goal');
    const [fx, fy] = await e.at(x, y);
    await e.drag([fx, fy], [fx < 700 ? fx + 320 : fx - 320, fy < 400 ? fy + 180 : fy - 180], { moves: 16 });
    assert.notEqual(await painting(e), before);
    await e.page.keyboard.press('Escape');
    await e.page.mouse.up();
    await e.page.mouse.move(700, 120);
    await leave(e);
    await e.settled();
    await e.frames(8);
    assert.equal(await painting(e), before);
  });

  it('shows its end, without movement, with reduced motion', { timeout: 60_000 }, async () => {
    const { e } = await selected(stage, { reducedMotion: 'reduce' });
    const before = await picture(e);
    await e.page.locator('.fu[data-future="B"]').hover();
    await e.frames(6);
    const shown = await picture(e);
    assert.notEqual(shown, before);
    await e.frames(20);
    assert.equal(await picture(e), shown);
  });

  it('tries a remedy while the pointer is on it, and takes it as one step', { timeout: 90_000 }, async () => {
    const { e, car } = await selected(stage, { reducedMotion: 'reduce' });
    await e.key('g');
    await e.settled();
    await e.type('goal-time', '2');
    await leave(e);
    await e.until(() => !document.querySelector('.toast'));
    const step = () => e.page.locator('header [data-action="undo"]').getAttribute('title');
    const [goal, last, before] = [await e.goal(), await step(), await picture(e)];
    const way = e.page.locator('[data-remedy="Use nearest reachable"]');
    const mark = e.wire.asked.length;
    await way.hover();
    await e.settled();
    await e.frames(4);
    const asked = e.wire.since(mark);
    assert.equal(asked.length, 1, 'what comes of it is asked once');
    assert.notEqual(asked[0].body.conditions[car.id].goal.x_m, goal.x);
    assert.notEqual(await picture(e), before, 'and shown');
    await e.picture('remedy-tried');
    assert.deepEqual([await e.goal(), await step()], [goal, last], 'nothing is changed by a look');
    await e.page.mouse.move(560, 22);
    await e.settled();
    await e.frames(4);
    assert.equal(await picture(e), before, 'it goes with the pointer');
    await way.focus();
    await e.settled();
    await e.frames(4);
    assert.notEqual(await picture(e), before, 'the keyboard sees it too');
    await way.click();
    await e.settled();
    assert.notDeepEqual(await e.goal(), goal);
    assert.doesNotMatch(await e.text('.hint'), /Too far/);
    await leave(e);
    await e.key('Control+z');
    await e.settled();
    assert.deepEqual(await e.goal(), goal, 'one step back');
  });

  it('shows limits, reach and conflict zones, and stores the shown layers', { timeout: 60_000 }, async () => {
    const { e } = await selected(stage, { reducedMotion: 'reduce' });
    const pressed = (name) => e.page.locator(`.menu [data-action="layer-${name}"]`).getAttribute('aria-pressed');
    // The path of a turning car is crossed by others.
    const turning = (await e.roadUsers()).find((u) => u.kind === 'Car' && u.speed > 2 && /turning left/.test(u.words));
    await e.choose(turning.id);
    await leave(e);
    await e.settled();
    for (const [key, name] of [
      ['Shift+M', 'limits'],
      ['Shift+H', 'reach'],
      ['Shift+C', 'conflicts'],
      ['Shift+S', 'signals'],
    ]) {
      const before = await picture(e);
      await e.key(key);
      await e.settled();
      await e.frames(4);
      assert.notEqual(await picture(e), before, `${name} is seen`);
    }
    await e.picture('layers');
    await e.page.reload();
    await e.ready();
    await e.settled();
    await e.page.locator('[data-menu="layers"]').click();
    assert.deepEqual(await Promise.all(['limits', 'reach', 'conflicts', 'signals'].map(pressed)), [
      'true',
      'true',
      'true',
      'false',
    ]);
    // Several are switched while the menu stays open; Esc closes it.
    await e.page.locator('.menu [data-action="layer-signals"]').click();
    await e.page.locator('.menu [data-action="layer-reach"]').click();
    assert.deepEqual([await pressed('signals'), await pressed('reach')], ['true', 'false']);
    await e.key('Escape');
    await e.page.waitForSelector('.menu', { state: 'detached' });
  });
});
