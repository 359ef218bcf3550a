// By keys only; with the dark theme; on a smaller screen.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

/** Elements around and over the picture. No two of these may overlap. */
const PANELS = [
  'header.top',
  'aside.insp',
  'footer.time',
  '.rail',
  '.tr .card',
  '.bl .status',
  '.bl .scale',
  '.zoom',
  '.helpbar',
  '.coach',
  '.toast',
  '.drawer',
  '.banner',
];

journeys('access', (stage) => {
  it('sets a goal by keys only', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.key('Tab');
    await e.page.waitForSelector('.fu');
    await e.settled();
    const name = await e.text('.ih h2');
    const focused = () => e.page.evaluate(() => document.activeElement.textContent);
    assert.ok((await focused()).startsWith(name), 'the focus is on the road user');
    await e.key('Tab');
    await e.settled();
    const next = await e.text('.ih h2');
    assert.notEqual(next, name);
    await e.key('Shift+Tab');
    await e.settled();
    assert.equal(await e.text('.ih h2'), name);
    const mark = e.wire.asked.length;
    await e.key('g');
    await e.settled();
    const before = await e.goal();
    for (let i = 0; i < 3; i++) await e.key('Shift+ArrowUp');
    for (let i = 0; i < 4; i++) await e.key('ArrowRight');
    await e.settled();
    await e.page.waitForSelector('.toast');
    assert.match(await e.text('.toast'), new RegExp(`Goal of ${name} moved`));
    const goal = await e.goal();
    assert.ok(
      Math.abs(goal.y - before.y - 3) < 0.11 && Math.abs(goal.x - before.x - 0.4) < 0.11,
      `${JSON.stringify(before)} to ${JSON.stringify(goal)}`,
    );
    const asked = e.wire.since(mark).filter((a) => a.body.react === true);
    assert.ok(asked.length && asked.length < 6, `repeats of a key are gathered: ${asked.length} requests`);
    const slider = e.page.getByRole('slider', { name: 'Goal speed', exact: true });
    await slider.focus();
    await slider.press('ArrowUp');
    await e.settled();
    assert.match(await slider.getAttribute('aria-valuetext'), /fixed$/);
    const spoken = await e.page.locator('[aria-live="polite"]').textContent();
    assert.ok(spoken.length > 5, spoken);
  });

  it('leaves the focus on the road user while answers arrive', { timeout: 30_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.key('Tab');
    await e.page.waitForSelector('.fu');
    await e.key('g');
    for (let i = 0; i < 3; i++) await e.key('Shift+ArrowUp');
    await e.settled();
    assert.ok(await e.page.evaluate(() => document.activeElement.matches('[data-agent][aria-pressed="true"]')));
  });

  for (const scheme of ['light', 'dark']) {
    it(
      `keeps every panel in its place, ${scheme}, on a small screen and on a larger one`,
      { timeout: 60_000 },
      async () => {
        const e = await stage.open({ viewport: { width: 1280, height: 720 }, colorScheme: scheme });
        await e.begin();
        assert.equal(await e.page.getAttribute('html', 'data-theme'), scheme);
        await places(e, 'nothing selected');
        await e.picture(`${scheme}-1280x720`);
        await e.key('b');
        await e.page.waitForSelector('.drawer');
        await places(e, 'with the scenes');
        await e.key('b');
        const car = await carOnTheMove(e);
        await e.page.mouse.click(...car.from);
        await e.page.waitForSelector('.fu');
        await e.settled();
        await places(e, 'selected');
        const to = [
          car.to[0] + (car.from[0] - car.to[0]) * 0.25 + 9,
          car.to[1] + (car.from[1] - car.to[1]) * 0.25 - 26,
        ];
        await e.drag([car.to[0] + 9, car.to[1] - 26], to, { moves: 6 });
        await places(e, 'dragging');
        await e.release();
        await places(e, 'released');
        await e.picture(`${scheme}-1280x720-selected`);
        await e.page.setViewportSize({ width: 1440, height: 900 });
        await e.settled();
        await places(e, 'released, larger');
        await e.picture(`${scheme}-1440x900-selected`);
      },
    );
  }
});

/** Every panel is within the window and none covers another. */
async function places(e, when) {
  await e.page.evaluate(() =>
    Promise.allSettled(
      document
        .getAnimations()
        .filter((a) => a.effect.getComputedTiming().endTime < 10_000)
        .map((a) => a.finished),
    ),
  );
  const { boxes, width, height } = await e.page.evaluate(
    (panels) => ({
      width: innerWidth,
      height: innerHeight,
      boxes: panels.flatMap((s) =>
        [...document.querySelectorAll(s)]
          .map((el) => ({ s, r: el.getBoundingClientRect() }))
          .filter(({ r }) => r.width && r.height)
          .map(({ s: name, r }) => ({ name, x0: r.left, y0: r.top, x1: r.right, y1: r.bottom })),
      ),
    }),
    PANELS,
  );
  const words = (b) => `${b.name} [${[b.x0, b.y0, b.x1, b.y1].map(Math.round)}]`;
  for (const b of boxes)
    assert.ok(
      b.x0 >= -0.5 && b.y0 >= -0.5 && b.x1 <= width + 0.5 && b.y1 <= height + 0.5,
      `${when}: ${words(b)} leaves the window`,
    );
  for (const [i, a] of boxes.entries()) {
    for (const b of boxes.slice(i + 1)) {
      const over =
        Math.min(a.x1, b.x1) - Math.max(a.x0, b.x0) > 0.5 && Math.min(a.y1, b.y1) - Math.max(a.y0, b.y0) > 0.5;
      assert.ok(!over, `${when}: ${words(a)} and ${words(b)} overlap`);
    }
  }
}
