// No work is lost: a killed tab, two tabs at one scene, a full disk, two versions of a scene.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

const READ_ONLY = /This scene is open in another tab and read-only here\./;

const undo = async (e) => {
  await e.page.locator('[data-action="undo"]').first().click();
  await e.settled();
};

/** Waits until the inspector shows this goal time. */
const shows = (e, time) => e.until((t) => document.querySelector('[data-field="goal-time"]')?.value === t, time);

/** The panel's text on the selected one, and its six futures. */
const said = async (e) => [
  (await e.value('goal-pos', 0)) + (await e.text('.insp .hint')),
  ...(await e.page.locator('.fu').allInnerTexts()),
];

journeys('keeping', (stage) => {
  it('shows exactly the same futures after a killed tab', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    const flag = (share) => [0, 1].map((i) => car.to[i] + (car.from[i] - car.to[i]) * share + [9, -26][i]);
    // Many moves: each question of a drag continues from the futures shown before.
    await e.drag(flag(0), flag(0.4), { moves: 30 });
    await e.release();
    await e.settled();
    const [before, code] = [await said(e), await e.code()];
    await e.until(() => /^Saved on this computer/.test(document.querySelector('.title small').textContent));
    const again = await e.killed();
    await again.settled();
    await again.choose(car.id);
    assert.deepEqual(await said(again), before);
    assert.equal(await again.code(), code);
    assert.deepEqual(again.wire.asked.map((a) => a.body.react).filter(Boolean), [], 'nobody is asked anew');
  });

  it(
    'brings back scene, undo and redo after a killed tab, and takes back what Generate did',
    { timeout: 60_000 },
    async () => {
      const e = await stage.open();
      await e.begin();
      const car = await carOnTheMove(e);
      await e.choose(car.id);
      for (const time of ['8.0', '7.0', '6.0']) await e.type('goal-time', time);
      await undo(e);
      await e.until(() => /^Saved on this computer/.test(document.querySelector('.title small').textContent));
      const again = await e.killed();
      await again.until(() =>
        /The changes of your last session are restored/.test(document.querySelector('.toast')?.textContent),
      );
      await again.settled();
      await again.choose(car.id);
      await shows(again, '7.0');
      await again.page.locator('[data-action="redo"]').first().click();
      await shows(again, '6.0');
      for (const time of ['7.0', '8.0', '9.0']) {
        await undo(again);
        await shows(again, time);
      }
      assert.equal(await again.page.locator('[data-action="undo"]').first().getAttribute('aria-disabled'), 'true');
      // Generate is a step like any other.
      await again.page.locator('[data-action="generate"]').click();
      await again.until(() => /All road users replanned/.test(document.querySelector('.toast')?.textContent));
      await again.settled();
      assert.equal(again.wire.last().body.agents, 'all');
      await again.page.locator('.toast [data-action="undo"]').click();
      await again.until(() => /Undone: All road users replanned/.test(document.querySelector('.toast')?.textContent));
      const mark = again.wire.asked.length;
      await again.page.locator('[data-action="redo"]').first().click();
      await again.settled();
      assert.equal(again.wire.since(mark).filter((q) => q.body.agents === 'all').length, 0, 'known already');
    },
  );

  it('lets one of two tabs edit, and hands over without losing a step', { timeout: 60_000 }, async () => {
    const a = await stage.open();
    await a.begin();
    const car = await carOnTheMove(a);
    await a.choose(car.id);
    await a.type('goal-time', '8.0');
    const b = await a.beside();
    await b.until((t) => new RegExp(t).test(document.querySelector('.banner')?.textContent), READ_ONLY.source);
    await b.choose(car.id);
    await shows(b, '8.0');
    await b.type('goal-time', '5.0');
    await shows(b, '8.0');
    // Changes of one tab appear in the other.
    await a.page.bringToFront();
    await a.type('goal-time', '7.0');
    await b.page.bringToFront();
    await shows(b, '7.0');
    await b.page.getByRole('button', { name: 'Edit here' }).first().click();
    await b.page.waitForSelector('.banner', { state: 'detached' });
    await a.page.waitForSelector('.banner');
    await b.settled();
    await b.type('goal-time', '6.0');
    await a.page.bringToFront();
    await shows(a, '6.0');
    assert.match(await a.text('.banner'), READ_ONLY);
    // The remaining tab gets the scene when the other closes.
    await b.page.close();
    await a.page.waitForSelector('.banner', { state: 'detached' });
    await undo(a);
    await shows(a, '7.0');
    await undo(a);
    await shows(a, '8.0');
  });

  it('reports full storage, and saves everything when there is room again', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    const { origin } = new URL(e.page.url());
    await e.cdp.send('Storage.overrideQuotaForOrigin', { origin, quotaSize: 1 });
    await e.type('goal-time', '8.0');
    await e.page.waitForSelector('.banner');
    assert.match(await e.text('.banner'), /No space left on this computer for saving\./);
    await e.page.getByRole('button', { name: 'Export', exact: true }).last().click();
    await e.page.waitForSelector('.flyout.export');
    await e.key('Escape');
    await e.cdp.send('Storage.overrideQuotaForOrigin', { origin });
    await e.page.getByRole('button', { name: 'Free space' }).click();
    await e.page.waitForSelector('.banner', { state: 'detached' });
    const kept = await e.page.evaluate(
      () =>
        new Promise((resolve) => {
          const open = indexedDB.open('dragtraffic');
          open.onsuccess = () => {
            const all = open.result.transaction('steps').objectStore('steps').getAll();
            all.onsuccess = () => resolve(all.result.map((step) => step.name));
          };
        }),
    );
    assert.equal(kept.length, 1);
    assert.match(kept[0], new RegExp(`^Goal time of ${car.name} changed to [\\d.]+ s$`));
  });

  it('undoes in a saved copy what was done in the example', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    for (const time of ['8.0', '7.0']) await e.type('goal-time', time);
    await e.page.evaluate(() => document.activeElement?.blur?.());
    await e.key('Control+s');
    await e.until(() => document.querySelector('.title small').textContent === 'Saved');
    const name = await e.page.inputValue('.title input');
    assert.match(name, /, edited/);
    assert.equal(await e.page.inputValue('[data-field="goal-time"]'), '7.0');
    await undo(e);
    await shows(e, '8.0');
    await undo(e);
    await shows(e, '9.0');
    assert.equal(await e.page.locator('[data-action="undo"]').first().isDisabled(), true);
    await e.key('Control+y');
    await shows(e, '8.0');
    assert.equal(await e.page.inputValue('.title input'), name);
  });

  it(
    'offers both versions of a scene changed elsewhere, and brings back a deleted one',
    { timeout: 60_000 },
    async () => {
      const e = await stage.open();
      await e.begin();
      await e.key('Control+s');
      await e.until(() => /^Saved/.test(document.querySelector('.title small').textContent));
      const name = await e.page.inputValue('.title input');
      const { scenes } = await e.get('/v1/scenes');
      const own = scenes.find((s) => s.name === name);
      const renamed = await e.page.request.patch(new URL(`/v1/scenes/${own.id}`, e.page.url()).href, {
        data: JSON.stringify({ name: 'Theirs' }),
        headers: { 'content-type': 'application/merge-patch+json', 'if-match': own.etag },
      });
      assert.equal(renamed.status(), 200);
      await e.page.fill('.title input', 'Mine');
      await e.key('Enter');
      await e.page.waitForSelector('.banner');
      assert.match(await e.text('.banner'), /This scene was changed elsewhere\..*Nothing is overwritten/s);
      await e.page.getByRole('button', { name: 'Open other version' }).click();
      await e.until(() => document.querySelector('.title input').value === 'Theirs');
      await undo(e);
      assert.equal(await e.page.inputValue('.title input'), 'Mine');
      await e.until(() => /^Saved$/.test(document.querySelector('.title small').textContent));
      assert.equal((await e.get(`/v1/scenes/${own.id}`)).name, 'Mine');
      // A deleted scene can be restored unchanged.
      const { id } = own;
      const listed = async () => (await e.get('/v1/scenes')).scenes.some((s) => s.id === id);
      const before = await e.get(`/v1/scenes/${id}`);
      await e.key('Control+k');
      await e.page.keyboard.type('delete scene');
      await e.key('Enter');
      await e.until(() => /deleted\./.test(document.querySelector('.toast')?.textContent));
      assert.equal(await listed(), false);
      await e.page.locator('.toast button').click();
      await e.until(() => document.querySelector('.title input').value === 'Mine');
      const after = await e.get(`/v1/scenes/${id}`);
      assert.deepEqual({ ...after, generated: null }, { ...before, generated: null });
    },
  );
});
