// A drawn speed profile: a stop for some seconds, in numbers, and its result from the generator.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';

const points = (e) =>
  e.page.locator('.plot .point').evaluateAll((all) => all.map((p) => p.getAttribute('aria-valuetext')));
const dot = async (e, nth) => {
  const r = await e.page.locator('.plot .point .dot').nth(nth).boundingBox();
  return [r.x + r.width / 2, r.y + r.height / 2];
};

/** A car, with one point of its speed curve dragged to zero in the middle. */
async function stopping(stage) {
  const e = await stage.open();
  await e.begin();
  const car = await carOnTheMove(e);
  await e.choose(car.id);
  assert.equal((await points(e)).length, 2, 'start and end are there from the beginning');
  const plot = await e.page.locator('.plot').boundingBox();
  await e.page.mouse.dblclick(plot.x + plot.width * 0.5, plot.y + plot.height * 0.55);
  await e.settled();
  assert.equal((await points(e)).length, 3);
  const mark = e.wire.asked.length;
  const from = await dot(e, 1);
  await e.drag(from, [from[0], plot.y + plot.height + 2]);
  assert.ok(Number((await e.text('.pointfields .brakes')).match(/[\d.]+/)[0]) > 3, 'says at once how hard it brakes');
  await e.picture('speed-curve-in-hand');
  assert.equal(e.wire.since(mark).length, 0, 'nobody answers before the release');
  await e.release();
  return { e, car, mark };
}

/** The motion of a road user that the generator kept and judged, and its score. */
const judged = (e, id) => {
  const asked = e.wire.asked.findLast((a) => a.body.pinned?.includes(id));
  const [mode] = asked.body.scene.generated.samples[0].agents[id].modes;
  return { asked, mode, score: asked.event('final').scores[0] };
};

/** The place where the pointer shows that a stop's words can be dragged. */
async function wordsBeside(e, [x, y]) {
  for (let far = 30; far <= 120; far += 10)
    for (let turn = 0; turn < 16; turn++) {
      const at = [x + far * Math.cos((turn * Math.PI) / 8), y + far * Math.sin((turn * Math.PI) / 8)];
      await e.page.mouse.move(...at);
      if ((await e.page.getAttribute('main.stage', 'data-cursor')) === 'resize') return at;
    }
  throw new Error('no words stand beside the stop');
}

journeys('the speed curve', (stage) => {
  it(
    'a point pulled to the ground stops the car there, and the generator judges that motion',
    { timeout: 60_000 },
    async () => {
      const { e, car } = await stopping(stage);
      const said = (await points(e))[1];
      assert.match(said, /^0 km\/h for 1\.0 s at \d\.\d s$/);
      const { asked, mode, score } = judged(e, car.id);
      assert.ok(asked.body.react, 'others answer it');
      // It is exactly at rest, for the requested time.
      const still = mode.x_m.filter((x, i) => i && x === mode.x_m[i - 1] && mode.y_m[i] === mode.y_m[i - 1]).length;
      assert.ok(still >= 9 && still < 20, `stands for ${still} steps`);
      const speeds = mode.vx_mps.map((vx, i) => Math.hypot(vx, mode.vy_mps[i]));
      assert.ok(score.agents[car.id].kinematic.violations === 0, 'within what a car can do');
      assert.equal(await e.text('.fu[aria-checked="true"] .nm'), 'At your speed');
      assert.ok(Math.min(...speeds) === 0 && speeds.at(-1) > 0.5, 'and goes on');
      assert.match(await e.text('.toast'), new RegExp(`Speed curve of ${car.name} changed`));
      // The words on the canvas are painted; the fields have the same values.
      assert.equal(await e.value('point-speed'), 0);
      await e.picture('speed-curve-stop');
      await e.type('point-hold', '3');
      assert.match((await points(e))[1], /for 3\.0 s/);
      const longer = judged(e, car.id).mode;
      const stands = longer.x_m.filter((x, i) => i && x === longer.x_m[i - 1]).length;
      assert.ok(stands >= 29, `stands for ${stands} steps`);
      assert.match(await e.text('.pointfields .brakes'), /brakes at up to \d+\.\d m\/s²/);
      await e.picture('speed-curve-three-seconds');
      // Hard braking is reported; with a later stop it is not needed, and the result is reported.
      assert.match(await e.text('.insp .hint'), /Brakes at up to \d\.\d m\/s²/);
      await e.type('point-time', '5.3');
      assert.match(await e.text('.insp .hint'), /^Stops for 3\.0 s, then continues\s+Brakes at up to 2\.\d m\/s²\.$/);
      await e.key('Escape');
      await e.key('Control+z');
      await e.settled();
      await e.key('Control+z');
      await e.settled();
      assert.match((await points(e))[1], /for 1\.0 s/);
    },
  );

  it(
    'the end of a hold, a time and a speed are dragged and typed; Del takes a point away',
    { timeout: 60_000 },
    async () => {
      const { e } = await stopping(stage);
      const bar = await e.page.locator('.plot .holdend .holdbar').boundingBox();
      const plot = await e.page.locator('.plot').boundingBox();
      await e.drag([bar.x + 3, bar.y + 4], [bar.x + 3 + plot.width / 9, bar.y + 4]);
      await e.release();
      assert.match((await points(e))[1], /for (1\.9|2\.[01]) s/);
      await e.type('point-time', '3');
      assert.match((await points(e))[1], /at 3\.0 s$/);
      await e.type('point-speed', '20');
      assert.match((await points(e))[1], /^20 km\/h/);
      const slider = e.page.locator('.plot .point').nth(1);
      await slider.focus();
      await slider.press('ArrowUp');
      await e.settled();
      assert.match((await points(e))[1], /^21 km\/h/);
      await e.page.locator('.plot .point').nth(1).press('Delete');
      await e.settled();
      assert.equal((await points(e)).length, 2);
      await e.page.locator('.plot .point').nth(1).focus();
      await e.page.getByRole('button', { name: 'Clear curve' }).click();
      await e.settled();
      assert.equal(await e.page.locator('.fu[data-future]').count(), 6);
    },
  );

  it('Esc restores a point during its drag', { timeout: 60_000 }, async () => {
    const { e } = await stopping(stage);
    const before = await points(e);
    const from = await dot(e, 1);
    await e.drag(from, [from[0] + 80, from[1] - 40]);
    assert.notDeepEqual(await points(e), before);
    await e.key('Escape');
    await e.page.mouse.up();
    await e.settled();
    assert.deepEqual(await points(e), before);
  });

  it(
    'a curve that cannot be driven says what limits it, and its buttons show and do what they say',
    { timeout: 60_000 },
    async () => {
      const { e } = await stopping(stage);
      assert.ok(await e.page.locator('.misfit').isHidden(), 'this one can be driven');
      await e.type('point-time', '0.4');
      const time = (said) => Number(/at ([\d.]+) s$/.exec(said)[1]);
      assert.equal(time((await points(e))[1]), 0.4);
      assert.match(await e.text('.misfit p'), /^Cannot stop by 0\.4 s: still at \d+ km\/h\.$/);
      const later = e.page.locator('.misfit [data-way="later"]');
      const more = Number(/^Allow ([\d.]+) s more$/.exec(await later.innerText())[1]);
      const mark = e.wire.asked.length;
      await later.hover();
      await e.until(
        () => !document.querySelectorAll('.plot .point')[1].getAttribute('aria-valuetext').endsWith('at 0.4 s'),
      );
      assert.equal(time((await points(e))[1]).toFixed(1), (0.4 + more).toFixed(1), 'shown under the pointer');
      await e.picture('speed-curve-remedy-shown');
      await e.page.mouse.move(5, 5);
      await e.frames(2);
      assert.equal(time((await points(e))[1]), 0.4, 'and gone beside it');
      assert.equal(e.wire.since(mark).length, 0, 'pointing changes nothing');
      await later.click();
      await e.settled();
      assert.equal(time((await points(e))[1]).toFixed(1), (0.4 + more).toFixed(1));
      assert.ok(await e.page.locator('.misfit').isHidden(), 'it can be driven now');
      assert.ok(e.wire.since(mark).length > 0, 'others answer it');
      // With the button still under the pointer it would be previewed again.
      await e.page.mouse.move(5, 5);
      await e.key('Control+z');
      await e.settled();
      assert.equal(time((await points(e))[1]), 0.4, 'one step');
    },
  );

  it('a stop is moved as a whole on the timeline, and its bar on the road', { timeout: 60_000 }, async () => {
    const { e, car } = await stopping(stage);
    const [, hold, at] = /for ([\d.]+) s at ([\d.]+) s$/.exec((await points(e))[1]);
    const line = await e.page.locator('.plot .holdline').boundingBox();
    const plot = await e.page.locator('.plot').boundingBox();
    const middle = [line.x + line.width / 2, line.y + line.height / 2];
    await e.drag(middle, [middle[0] + plot.width / 18, middle[1]]);
    assert.match(await e.text('.plot'), /dashed: before/, 'what it was is dashed meanwhile');
    await e.release();
    const [, held, later] = /for ([\d.]+) s at ([\d.]+) s$/.exec((await points(e))[1]);
    assert.equal(held, hold, 'as long as before');
    assert.ok(Number(later) > Number(at) + 0.3, `${later} s after ${at} s`);
    // The bar is before the standing box: its place is read from the kept motion in the request.
    const { mode } = judged(e, car.id);
    const i = mode.x_m.findIndex((x, k) => k && x === mode.x_m[k - 1] && mode.y_m[k] === mode.y_m[k - 1]);
    const ahead = (k) => [Math.cos(mode.heading_rad[i]) * k, Math.sin(mode.heading_rad[i]) * k];
    const place = (k) => e.at(mode.x_m[i] + ahead(k)[0], mode.y_m[i] + ahead(k)[1]);
    await e.drag(await place(2.8), await place(-1));
    await e.picture('speed-curve-bar-in-hand');
    await e.release();
    const [, , sooner] = /for ([\d.]+) s at ([\d.]+) s$/.exec((await points(e))[1]);
    assert.ok(Number(sooner) < Number(later), `${sooner} s before ${later} s`);
    // The words beside the bar are dragged sideways for the duration.
    const words = await wordsBeside(e, await place(1));
    await e.drag(words, [words[0] + 40, words[1]]);
    await e.release();
    const [, longer] = /for ([\d.]+) s at/.exec((await points(e))[1]);
    assert.equal((Number(longer) - Number(held)).toFixed(1), '1.0', 'a tenth of a second for four pixels');
    assert.match(await e.text('.sect.curve'), new RegExp(`for ${longer} s`), 'the inspector says it, too');
  });

  it('the curve is restored after a reload', { timeout: 60_000 }, async () => {
    const { e, car } = await stopping(stage);
    const before = await points(e);
    await e.page.reload();
    await e.ready();
    await e.begin();
    await e.choose(car.id);
    assert.deepEqual(await points(e), before);
  });
});
