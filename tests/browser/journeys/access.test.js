// By keys alone; in the dark; on a smaller screen.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../support/casting.js';
import { journeys } from '../support/journey.js';

/** What lies around and over the picture. Pairs of these must not cover each other. */
const PANELS = ['header.top', 'aside.insp', 'footer.time', '.rail', '.tr .card', '.bl .status', '.bl .scale', '.zoom', '.helpbar', '.coach', '.toast', '.drawer', '.banner'];

journeys('access', (stage) => {
  it('sets a goal by keys alone', { timeout: 60_000 }, async () => {
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
    assert.ok(Math.abs(goal.y - before.y - 3) < 0.11 && Math.abs(goal.x - before.x - 0.4) < 0.11, `${JSON.stringify(before)} to ${JSON.stringify(goal)}`);
    const asked = e.wire.since(mark).filter((a) => a.body.react === true);
    assert.ok(asked.length && asked.length < 6, `repeats of a key are gathered: ${asked.length} requests`);
    assert.ok((await focused()).startsWith(name), 'the focus stays');
    const slider = e.page.getByRole('slider', { name: 'Goal speed', exact: true });
    await slider.focus();
    await slider.press('ArrowUp');
    await e.settled();
    assert.match(await slider.getAttribute('aria-valuetext'), /fixed$/);
    const spoken = await e.page.locator('[aria-live="polite"]').textContent();
    assert.ok(spoken.length > 5, spoken);
  });

  for (const [scheme, width, height] of [['light', 1440, 900], ['dark', 1440, 900], ['light', 1280, 720], ['dark', 1280, 720]]) {
    it(`keeps every panel in its place, ${scheme}, ${width} × ${height}`, { timeout: 60_000 }, async () => {
      const e = await stage.open({ viewport: { width, height }, colorScheme: scheme });
      await e.begin();
      assert.equal(await e.page.getAttribute('html', 'data-theme'), scheme);
      await places(e, 'nothing selected');
      await e.picture(`${scheme}-${width}x${height}`);
      const car = await carOnTheMove(e);
      await e.page.mouse.click(...car.from);
      await e.page.waitForSelector('.fu');
      await e.settled();
      await places(e, 'selected');
      const to = [car.to[0] + (car.from[0] - car.to[0]) * 0.25 + 9, car.to[1] + (car.from[1] - car.to[1]) * 0.25 - 26];
      await e.drag([car.to[0] + 9, car.to[1] - 26], to, { moves: 6 });
      await places(e, 'dragging');
      await e.release();
      await places(e, 'released');
      await e.picture(`${scheme}-${width}x${height}-selected`);
    });
  }
});

/** Every panel lies within the window and none covers another. */
async function places(e, when) {
  const { boxes, width, height } = await e.page.evaluate((panels) => ({
    width: innerWidth, height: innerHeight,
    boxes: panels.flatMap((s) => [...document.querySelectorAll(s)].map((el) => ({ s, r: el.getBoundingClientRect() })).filter(({ r }) => r.width && r.height).map(({ s: name, r }) => ({ name, x0: r.left, y0: r.top, x1: r.right, y1: r.bottom }))),
  }), PANELS);
  const words = (b) => `${b.name} [${[b.x0, b.y0, b.x1, b.y1].map(Math.round)}]`;
  for (const b of boxes) assert.ok(b.x0 >= -0.5 && b.y0 >= -0.5 && b.x1 <= width + 0.5 && b.y1 <= height + 0.5, `${when}: ${words(b)} leaves the window`);
  for (const [i, a] of boxes.entries()) {
    for (const b of boxes.slice(i + 1)) {
      const over = Math.min(a.x1, b.x1) - Math.max(a.x0, b.x0) > 0.5 && Math.min(a.y1, b.y1) - Math.max(a.y0, b.y0) > 0.5;
      assert.ok(!over, `${when}: ${words(a)} and ${words(b)} overlap`);
    }
  }
}
