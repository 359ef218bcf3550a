// The search for a case: started by words, found by trying, shown at its moment, taken as one step.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

const found = (e) =>
  e.page.locator('.case').evaluateAll((all) => all.map((el) => el.querySelector('.words b').textContent));

/** Progress in the panel, as two numbers. */
async function tried(e) {
  const words = await e.text('.seeking [role="status"]');
  const [, done, of] = /(\d+) of (\d+) tried/.exec(words);
  return [Number(done), Number(of)];
}

/** Is there a step to undo? */
const undoes = async (e) =>
  (await e.page.locator('header [data-action="undo"]').getAttribute('aria-disabled')) === null;

/** The other car nearest to a road user's path. */
async function another(e, car) {
  const others = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.id !== car.id && u.speed > 2);
  return others[0];
}

journeys('looking for a case', (stage) => {
  it('searches by a sentence, shows the results, and takes one as one step', { timeout: 120_000 }, async () => {
    const e = await stage.open();
    const searches = [];
    e.page.on('request', (r) => r.url().endsWith('/v1/search') && searches.push(JSON.parse(r.postData()).where));
    await e.begin();
    await e.key('b');
    const car = await carOnTheMove(e);
    const other = await another(e, car);
    await e.key('Control+k');
    await e.page.waitForSelector('[role="dialog"] input');
    await e.page.keyboard.type(`hard braking of ${car.name}`);
    await e.page.getByText(`Find hard braking of ${car.name} without a collision`).click();
    await e.page.waitForSelector('.seeking');
    await e.page.waitForFunction(() => /about|found/.test(document.querySelector('.seeking')?.textContent ?? ''));
    assert.match(searches[0], /brake_mps2/);
    // Another target: a gap so wide that it is found soon.
    await e.page.getByRole('button', { name: 'Close the search' }).click();
    await e.page.locator(`[data-agent="${car.id}"]`).evaluate((el) => el.click());
    await e.page
      .locator(`[data-agent="${other.id}"]`)
      .evaluate((el) => el.dispatchEvent(new MouseEvent('click', { bubbles: true, shiftKey: true })));
    await e.key('Alt+f');
    await e.page.waitForSelector('.seek');
    await e.type('limit', '10');
    assert.equal(await undoes(e), false);
    await e.page.locator('[data-action="case-search"]').click();
    await e.page.waitForFunction(
      () => document.querySelector('.case') || /Not found in/.test(document.body.textContent),
      null,
      { timeout: 90_000 },
    );
    assert.equal(await undoes(e), false, 'a search changes nothing');
    if (!(await found(e)).length) {
      assert.match(await e.text('.seeking'), /Closest: /);
      await e.page.getByRole('button', { name: 'Use the closest' }).click();
    } else {
      // It may end at any moment.
      await e.page.evaluate(() => document.querySelector('[data-action="case-stop"]')?.click());
      const [done, of] = await tried(e);
      assert.ok(done <= of);
      await e.page.locator('.case .face').first().click();
      await e.settled();
      await e.picture('case-shown');
      await e.page
        .getByRole('button', { name: /^Use case/ })
        .first()
        .click();
    }
    await e.settled();
    assert.equal(await undoes(e), true);
    assert.match(await e.text('.toast'), /Case used/);
    await e.key('Control+z');
    await e.settled();
    assert.equal(await undoes(e), false, 'one step, taken back');
  });
});
