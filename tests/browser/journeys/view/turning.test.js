// The picture turned: everything under the pointer is where it appears.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { distance, turn } from '../../support/editor.js';
import { journeys } from '../../support/journey.js';

const leave = (e) => e.page.evaluate(() => document.activeElement?.blur?.());

journeys('turning', (stage) => {
  it('aligns with a road, selects, drags and undoes there, and has north up again', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    assert.equal(await e.page.locator('.compass').count(), 0, 'no compass while north is up');
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    await leave(e);
    await e.key('Alt+r');
    await e.settled();
    const start = await e.pose('Start');
    const turned = (await e.view()).turn;
    assert.ok(turn(start.heading + turned, Math.PI / 2) < 0.1, `it drives up: turned by ${turned}`);
    assert.ok(await e.shows('.compass'));

    // The middle button moves the picture, and does not paste where a browser would.
    const still = await e.page.getAttribute('main.stage', 'data-view');
    await e.page.mouse.move(400, 300);
    await e.page.mouse.down({ button: 'middle' });
    await e.page.mouse.move(430, 300, { steps: 3 });
    await e.page.mouse.up({ button: 'middle' });
    await e.until((was) => document.querySelector('.stage').dataset.view !== was, still);
    assert.equal(await e.page.locator('.toast').count(), 0);
    await e.key('Alt+r');
    await e.settled();

    // With a click, where it appears now.
    await e.letGo();
    await e.page.mouse.click(...(await e.at(start.x, start.y)));
    await e.page.waitForSelector('.fu');
    await e.settled();
    assert.match(await e.text('aside.insp h2'), new RegExp(car.name));

    // The flag follows the pointer: down the picture is back along the road.
    const goal = await e.pose('Goal');
    const foot = await e.at(goal.x, goal.y);
    const hand = (down) => [foot[0] + 9, foot[1] - 26 + down];
    const mark = e.wire.asked.length;
    await e.drag(hand(0), hand(70));
    await e.settled();
    const shown = e.wire.since(mark).flatMap((a) => a.event('final') ?? []);
    assert.equal(shown[0]?.samples[0].agents[car.id].modes.length, 6, 'futures come while the hand is down');
    await e.picture('turned-mid-drag');
    await e.release();
    const moved = await e.goal();
    const now = await e.at(moved.x, moved.y);
    // A lane may snap it to its centre.
    assert.ok(Math.abs(now[1] - foot[1] - 70) < 6 && Math.abs(now[0] - foot[0]) < 40, `${foot} to ${now}`);
    assert.equal(await e.page.locator('.fu[data-future]').count(), 6);

    // Keys move it in screen directions.
    await leave(e);
    const before = await e.at(...Object.values(await e.goal()));
    await e.key('Shift+ArrowRight');
    await e.settled();
    const after = await e.at(...Object.values(await e.goal()));
    const { zoom } = await e.view();
    assert.ok(Math.abs(after[0] - before[0] - zoom) < 2 && Math.abs(after[1] - before[1]) < 2, `${before} to ${after}`);
    await e.key('Control+z');
    await e.settled();
    assert.ok(distance(await e.goal(), moved) < 0.11);

    await e.key('Shift+PageUp');
    await e.settled();
    assert.ok(turn((await e.view()).turn, turned + Math.PI / 12) < 1e-3);
    // Undo restores the view of the step.
    await e.key('Control+z');
    await e.settled();
    assert.equal(
      await e.page.getByRole('switch', { name: 'Goal position fixed' }).getAttribute('aria-checked'),
      'false',
    );

    // The compass turns it freely, and back.
    const { turn: from } = await e.view();
    const on = await e.page.locator('.compass').boundingBox();
    const [mx, my] = [on.x + on.width / 2, on.y + on.height / 2];
    await e.drag([mx + 12, my], [mx, my - 12], { moves: 4 });
    await e.release();
    const by = turn((await e.view()).turn, from);
    assert.ok(Math.abs(by - Math.PI / 2) < 0.05, `turned by ${by}`);
    await e.page.locator('.compass [data-action="north-up"]').click();
    await e.settled();
    assert.equal((await e.view()).turn, 0);
    assert.equal(await e.page.locator('.compass').count(), 0);
  });
});
