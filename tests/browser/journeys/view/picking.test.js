// Another of the six is picked: road users that meet it react, and no others change.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carBehindAnother } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

/** Motions of all except `id` in the scene of a question; those they meet may change with `id`. */
const driving = ({ body }, id) =>
  new Map(
    Object.entries(body.scene?.generated?.samples[0].agents ?? {})
      .filter(([other]) => other !== id)
      .map(([other, f]) => [other, JSON.stringify({ ...f, modes: f.modes.map((m) => ({ ...m, faults: undefined })) })]),
  );

journeys('picking', (stage) => {
  it('requests only the picked future, and changes road users that react to it', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const { car, obstacle } = await carBehindAnother(e);
    await e.choose(car.id);
    await e.type('goal-pos', String(obstacle.end.x), 0);
    await e.type('goal-pos', String(obstacle.end.y), 1);
    await e.settled();
    let sent = driving(e.wire.last(), car.id);
    let answered = Object.keys(e.wire.last().event('final').samples[0].agents);
    for (const letter of 'CEB') {
      const mark = e.wire.asked.length;
      await e.page.locator(`.fu[data-future="${letter}"]`).click();
      await e.settled();
      const [asked, ...more] = e.wire.since(mark);
      assert.equal(more.length, 0, 'one question a pick');
      const { agents, pinned, react } = asked.body;
      assert.deepEqual([agents, pinned, react], [[car.id], [car.id], true]);
      const now = driving(asked, car.id);
      for (const [id, bytes] of now) {
        if (answered.includes(id)) continue;
        assert.equal(bytes, sent.get(id), `${id} has not answered and goes on as it did`);
      }
      const answer = Object.entries(asked.event('final').samples[0].agents).filter(([id]) => id !== car.id);
      for (const [id, f] of answer) assert.ok(f.reaction?.cause, `${id} says whom it answers`);
      // A road user that no longer reacts is listed too.
      const changes = await e.page.locator('.ch').allInnerTexts();
      const listed = changes.filter((words) => !words.includes('no longer reacts'));
      assert.ok(listed.length <= answer.length, 'who is listed has answered');
      assert.equal(await e.page.locator(`.fu[data-future="${letter}"]`).getAttribute('aria-checked'), 'true');
      sent = now;
      answered = answer.map(([id]) => id);
    }
    // A pinned future stays when others are drawn, and is taken again with its goal.
    const code = await e.code();
    assert.match(code, /^[0-9A-Z]{6}$/);
    const goal = await e.goal();
    await e.page.locator('[data-future="B"]').hover();
    await e.key('Shift+P');
    await e.page.waitForSelector('.pinb[aria-pressed="true"]');
    assert.equal(await e.code(), code, 'to pin something changes no result');
    await e.type('goal-pos', String(goal.x + 9), 0);
    await e.page.waitForSelector('.fu.pinned.misfit');
    assert.match(await e.text('.fu.pinned .why'), /from the goal/);
    assert.notEqual(await e.code(), code);
    await e.picture('pinned');
    await e.page.reload();
    await e.ready();
    await e.settled();
    await e.choose(car.id);
    await e.page.locator('.fu.pinned').click();
    await e.settled();
    assert.deepEqual(await e.goal(), goal);
    assert.deepEqual(e.wire.last().body.pinned, [car.id]);
    await e.page.waitForSelector('.fu[aria-checked="true"] + .pinb[aria-pressed="true"]');
  });
});
