import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import type { Browser, Page } from 'playwright-core';
import { buildPage, chromiumPath, Driver, launch } from './driver';
import { buildCrossing } from '../standin/crossing.mjs';

let browser: Browser;
let d: Driver;

/** Share of the pixels that differ visibly between two pictures of one size. */
const differing = (page: Page, a: Buffer, b: Buffer): Promise<number> =>
  page.evaluate(
    async (pictures) => {
      const [p, q] = await Promise.all(
        pictures.map(async (base64) => {
          const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
          const image = await createImageBitmap(new Blob([bytes]));
          const g = new OffscreenCanvas(image.width, image.height).getContext('2d')!;
          g.drawImage(image, 0, 0);
          return g.getImageData(0, 0, image.width, image.height).data;
        }),
      );
      let n = 0;
      for (let i = 0; i < p.length; i += 4) if ([0, 1, 2].some((k) => Math.abs(p[i + k] - q[i + k]) > 24)) n++;
      return n / (p.length / 4);
    },
    [a, b].map((picture) => picture.toString('base64')),
  );

describe.skipIf(!chromiumPath)('editor', { timeout: 40_000 }, () => {
  beforeAll(async () => {
    await buildPage();
    browser = await launch();
  }, 60_000);
  afterAll(() => browser?.close());
  afterEach(async () => {
    expect(d.errors).toEqual([]);
    await d.close();
  });

  it('opens the example, ready to drag, under the security policy', async () => {
    d = await (await Driver.open(browser)).ready();
    expect(await d.text('.status')).toContain('29 road users');
    expect(await d.page.locator('.scn').count()).toBe(2);
    expect(await d.text('.coach')).toContain('Click a car');
  });

  it('shows the scene before its tools are loaded, and the picture stays unchanged', async () => {
    let scene = (): void => undefined;
    let tools = (): void => undefined;
    const allowed = (allow: (go: () => void) => void) => new Promise<void>((go) => allow(() => go()));
    const [sceneMay, toolsMay] = [allowed((go) => (scene = go)), allowed((go) => (tools = go))];
    d = await Driver.open(browser, {}, '/', async (page) => {
      await page.route('**/v1/scenes/*', (r) => sceneMay.then(() => r.continue()));
      await page.route('**/assets/desk-*.js', (r) => toolsMay.then(() => r.continue()));
    });
    await d.page.waitForSelector('main.stage canvas');
    // Outside all later panels.
    const box = (await d.page.locator('main.stage').boundingBox())!;
    const clip = { x: box.x + 420, y: box.y + 120, width: 480, height: 320 };
    const picture = () => d.page.screenshot({ clip });
    const ground = await picture();
    scene();
    await expect.poll(async () => differing(d.page, ground, await picture())).toBeGreaterThan(0.1);
    const bar = d.page.locator('header.top');
    expect(await bar.innerText()).toBe('DragTraffic');
    expect(await bar.getByRole('button').count()).toBe(0);
    const barBox = await bar.boundingBox();
    const early = await picture();
    tools();
    await d.ready();
    await d.page.getByRole('button', { name: 'Close the hint' }).click();
    await d.settled();
    expect(await differing(d.page, early, await picture())).toBeLessThan(0.01);
    expect(await d.page.locator('main.stage').boundingBox()).toEqual(box);
    expect(await bar.count()).toBe(1);
    expect(await bar.boundingBox()).toEqual(barBox);
  });

  it('reports a part that did not load, and fetches it on the next request', async () => {
    let reachable = false;
    d = await Driver.open(browser, {}, '/', (page) =>
      page.route('**/assets/agent-panel-*.js*', (r) => (reachable ? r.continue() : r.abort())),
    );
    await d.ready();
    await d.page.locator('[data-agent="1"]').evaluate((e: HTMLElement) => e.click());
    const said = d.page.locator('.insp [role="alert"]');
    await said.waitFor();
    expect(await said.innerText()).toContain('did not load. Nothing is lost.');
    reachable = true;
    await said.getByRole('button', { name: 'Try again' }).click();
    await d.page.waitForSelector('.fu');
    expect(await said.count()).toBe(0);
  });

  it('reports that its tools did not load', async () => {
    d = await Driver.open(browser, {}, '/', (page) => page.route('**/assets/desk-*.js', (r) => r.abort()));
    const said = d.page.locator('main.stage [role="alert"]');
    await said.waitFor();
    expect(await said.innerText()).toContain('Your scenes are safe.');
    await d.page.unroute('**/assets/desk-*.js');
    await said.getByRole('button', { name: 'Reload' }).click();
    await d.ready();
  });

  it('drags a goal: six live futures, reactions on release, undo and redo', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('1');
    expect(await d.page.locator('.fu[data-future]').count()).toBe(6);
    const before = await d.goal();
    const [x, y] = await d.at(...before);
    await d.drag([x + 8, y - 26], [x + 8, y - 120]);
    const previews = () => d.server.log.filter((l) => l.react === false && l.conditions['1']?.goal);
    await expect.poll(() => previews().length).toBeGreaterThan(2);
    expect(await d.text('.helpbar')).toContain('where others would wait');
    await d.release();
    // Whether sent during the drag or on release: the request has the same goal.
    const last = d.server.log.filter((l) => l.react).at(-1)!;
    expect(last).toMatchObject({ react: true, agents: ['1'] });
    expect(last.conditions['1'].goal).toEqual(previews().at(-1)!.conditions['1'].goal);
    expect(await d.text('.toast')).toMatch(/Goal of Car 1 moved\. \d others changed\./);
    expect(await d.page.locator('.ch').count()).toBeGreaterThan(0);
    const moved = await d.goal();
    expect(moved[1]).toBeGreaterThan(before[1] + 5);
    const asked = d.server.log.length;
    await d.key('Control+z');
    expect(await d.text('.goalsec h3')).toContain('chosen by the generator');
    await d.key('Control+Shift+z');
    await d.settled();
    expect(await d.goal()).toEqual(moved);
    // Undo and redo show known answers without a new request.
    expect(d.server.log.slice(asked).filter((l) => l.react)).toEqual([]);
  });

  it('shows reactions during the drag, and takes them over on release', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('1');
    const [x, y] = await d.at(...(await d.goal()));
    await d.drag([x + 8, y - 26], [x + 8, y - 120]);
    await d.settled();
    expect(await d.text('.previewed h3')).toMatch(/^\d others would change\s+on release$/);
    const causes = await d.page.locator('.previewed .ch').allInnerTexts();
    for (const c of causes) expect(c).toMatch(/^\w+ \d+\s+\S.* Car 1$/);
    await d.key('h');
    await expect.poll(() => d.text('.helpbar')).toContain('show others’ reactions');
    await d.key('h');
    await expect.poll(() => d.text('.helpbar')).toContain('hide others’ reactions');
    const asked = d.server.log.filter((l) => l.react).length;
    await d.release();
    expect(d.server.log.filter((l) => l.react).length).toBe(asked);
    expect(await d.page.locator('.previewed').count()).toBe(0);
    expect(await d.page.locator('.ch').allInnerTexts()).toEqual(causes);
  });

  it('restores everything on Esc, without an undo step', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('1');
    const [x, y] = await d.at(...(await d.goal()));
    await d.drag([x + 8, y - 26], [x + 60, y - 90]);
    await d.key('Escape');
    await d.page.mouse.up();
    await d.settled();
    expect(await d.text('.goalsec h3')).toContain('chosen by the generator');
    expect(await d.page.locator('[data-action="undo"]').first().getAttribute('aria-disabled')).toBe('true');
  });

  it('touches only the overlay while a handle is dragged', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('1');
    const [x, y] = await d.at(...(await d.goal()));
    await d.page.evaluate(() => {
      const w = window as unknown as { painted: Record<string, number> };
      w.painted = {};
      const proto = Worker.prototype,
        real = proto.postMessage;
      proto.postMessage = function (this: Worker, message: object, ...rest: never[]) {
        const layers = 'picture' in message ? (message.picture as { layers: object }).layers : {};
        for (const name of Object.keys(layers)) w.painted[name] = (w.painted[name] ?? 0) + 1;
        (real as (...a: unknown[]) => void).call(this, message, ...rest);
      };
    });
    await d.drag([x + 8, y - 26], [x + 30, y - 140], 30);
    const painted = await d.page.evaluate(() => (window as unknown as { painted: Record<string, number> }).painted);
    await d.release();
    expect(painted.overlay).toBeGreaterThan(15);
    expect(painted.agents ?? 0).toBeLessThanOrEqual(2);
  });

  it('paints the same without a worker', async () => {
    const picture = async (setup?: (p: Page) => Promise<void>) => {
      d = await (await Driver.open(browser, {}, '/', setup)).ready();
      await d.select('1');
      await d.settled();
      // The middle of the picture, between the panels and below the words at the flag: text may differ by fractions of
      // a pixel.
      const middle = { clip: { x: 420, y: 230, width: 560, height: 330 } };
      // Through a worker a picture may come a frame later.
      let last = await d.page.screenshot(middle);
      await expect.poll(async () => last.equals((last = await d.page.screenshot(middle)))).toBe(true);
      return last;
    };
    const byWorker = await picture();
    expect(d.errors).toEqual([]);
    await d.close();
    const onPage = await picture(async (p) => {
      await p.addInitScript(() => {
        delete (HTMLCanvasElement.prototype as Partial<HTMLCanvasElement>).transferControlToOffscreen;
      });
    });
    expect(await differing(d.page, onPage, byWorker)).toBeLessThan(5e-5);
  });

  it('turns a cyclist by its tiller, changes its speed by the arrow, moves its start', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('14');
    await d.page.click('button.more');
    await d.key('z');
    await d.settled();
    const z = await d.zoom();
    const p: [number, number] = [await d.value('start-pos', 0), await d.value('start-pos', 1)];
    const [x, y] = await d.at(...p);
    const half = Math.max(1.8 * z, 17) / 2;
    await d.drag([x - half - 24, y], [x - half - 20, y + 14]);
    await d.release();
    expect(Math.abs(await d.value('start-heading'))).toBeGreaterThan(8);
    await d.key('Control+z');
    const v = (await d.value('start-speed')) / 3.6;
    const tip = x + half + 5 + v * 2 * z;
    await d.drag([tip, y], [tip + 2 * z * (10 / 3.6), y]);
    await d.release();
    expect(await d.value('start-speed')).toBeCloseTo(Math.round(v * 3.6) + 10, -1);
    await d.key('Control+z');
    await d.drag([x, y], [x + 4 * z, y]);
    await d.release();
    expect(await d.value('start-pos', 0)).toBeCloseTo(p[0] + 4, 0);
    expect(d.last().conditions['14'].start).toBeDefined();
  });

  it('takes typed values, frees and fixes single fields', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('17');
    const f = d.page.locator('[data-field="goal-speed"]');
    await f.fill('1.2+0.4');
    await f.press('Enter');
    await d.settled();
    expect(d.last().conditions['17'].goal).toEqual({ time_s: 9, speed_mps: 1.6 });
    await d.page.locator('[aria-label="Goal speed fixed"]').click();
    await d.settled();
    expect(await d.page.locator('[aria-label="Goal speed fixed"]').getAttribute('aria-checked')).toBe('false');
    await d.page.locator('[aria-label="Goal position fixed"]').click();
    await d.settled();
    expect(Object.keys(d.last().conditions['17'].goal!).sort()).toEqual(['time_s', 'x_m', 'y_m']);
    await f.fill('nonsense');
    await f.press('Enter');
    expect(await d.page.locator('.field.bad').count()).toBe(1);
    await f.press('Escape');
  });

  it('lets the user pick another future; the others react to it', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('1');
    await d.key('Alt+2');
    await d.settled();
    expect(await d.page.locator('.fu[aria-checked="true"]').getAttribute('data-future')).toBe('B');
    expect(d.last().agents).toEqual(['1']);
    expect(d.last().pinned).toEqual(['1']);
    expect(d.last().scene).toBe('inline');
    await d.key('Control+z');
    await d.settled();
    expect(await d.text('.fu[aria-checked="true"] .nm')).toBe('As recorded');
  });

  it('reports an unreachable goal with the reason, and offers three remedies', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('1');
    for (const [field, n, v] of [
      ['goal-pos', 0, '1.75'],
      ['goal-pos', 1, '80'],
      ['goal-time', 0, '4'],
    ] as const) {
      const el = d.page.locator(`[data-field="${field}"]`).nth(n);
      await el.fill(v);
      await el.press('Enter');
      await d.settled();
    }
    expect(await d.text('.hint')).toContain('Too far for 4.0 s');
    const offered = await d.page.locator('.opt').allInnerTexts();
    expect(offered.map((words) => words.split('\n')[0])).toEqual([
      'Allow more time',
      'Use nearest reachable',
      'Start faster',
    ]);
    await d.page.locator('.opt').nth(1).click();
    await d.settled();
    expect(await d.text('.toast')).toContain('nearest reachable');
  });

  it('keeps working while the generator is unreachable, and catches up', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('1');
    d.server.options.away = true;
    const [x, y] = await d.at(...(await d.goal()));
    await d.drag([x + 8, y - 26], [x + 8, y - 100]);
    await d.page.mouse.up();
    await d.page.waitForSelector('.banner');
    expect(await d.text('.banner')).toContain('Nothing is lost');
    expect(await d.text('.insp')).toContain('Futures are out of date');
    d.server.options.away = false;
    await d.page.waitForSelector('.banner', { state: 'detached', timeout: 15_000 });
    await d.settled();
    expect(d.last().react).toBe(true);
    expect(d.last().conditions['1'].goal).toBeDefined();
  });

  it('notices during a drag that the generator hangs', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('1');
    const [x, y] = await d.at(...(await d.goal()));
    await d.drag([x + 8, y - 26], [x + 8, y - 60]);
    d.server.options.hang = true;
    await d.drag([x + 8, y - 60], [x + 8, y - 120]);
    await d.page.waitForFunction(
      () =>
        /longer than usual \(\d\.\d s\)\. You can keep dragging/.test(document.querySelector('.status')!.textContent!),
      null,
      { timeout: 5000 },
    );
    await d.page.waitForSelector('.banner', { timeout: 9000 });
    // During a drag the panels follow a moment later.
    await d.page.waitForFunction(() => document.querySelector('.status')!.textContent!.includes('Generator offline'));
    await d.page.waitForFunction(() => !document.querySelector('.fu'));
    await d.page.mouse.up();
    await d.page.waitForFunction(() => /1 change waiting/.test(document.querySelector('.status')!.textContent!));
    d.server.options.hang = false;
    await d.page.waitForSelector('.fu', { timeout: 12_000 });
    await d.settled();
    expect(await d.page.locator('.banner').count()).toBe(0);
  });

  it('leaves keys and focus where they are expected', async () => {
    d = await (await Driver.open(browser)).ready();
    const focus = () =>
      d.page.evaluate(
        () =>
          (document.activeElement as HTMLElement).dataset.agent ??
          (document.activeElement as HTMLElement).dataset.field ??
          document.activeElement!.tagName,
      );
    // Enter selects in the list; a further Enter moves to the inspector.
    await d.page.locator('[data-agent="1"]').focus();
    await d.key('Enter');
    await d.page.waitForSelector('.fu');
    expect(await focus()).toBe('1');
    // Events change; the buttons of the list stay.
    d.server.options.collision = true;
    await d.key('g');
    await d.key('Shift+ArrowUp');
    await d.page.waitForSelector('.plot .badge');
    expect(await focus()).toBe('1');
    await d.key('Enter');
    expect(await focus()).toBe('goal-speed');
    // Undo is the editor's once typed text is committed.
    await d.page.locator('[data-field="goal-time"]').fill('4');
    await d.key('Enter');
    await d.settled();
    await d.key('Control+z');
    expect(await d.value('goal-time')).toBe(9);
    expect(await focus()).toBe('goal-time');
    const plays = () => d.page.locator('[data-action="play"]').getAttribute('aria-pressed');
    // In a field with a committed number Space starts playback.
    await d.key('Space');
    expect(await plays()).toBe('true');
    await d.key('Space');
    expect(await d.value('goal-time')).toBe(9);
    // After a mouse click Space starts playback.
    await d.page.locator('.fu[data-future="C"]').click();
    await d.settled();
    await d.key('Space');
    expect(await plays()).toBe('true');
    await d.key('Space');
    // Without a selection the status does not mention futures.
    await d.page.locator('.card.chipbar .btn').first().focus();
    await d.key('Escape');
    await d.key('Escape');
    await d.settled();
    expect(await d.page.locator('.ih h2').innerText()).toBe('Scene');
    expect(await d.text('.status')).not.toMatch(/futures/);
  });

  it('imports files with a verdict for each', async () => {
    d = await (await Driver.open(browser)).ready();
    const good = {
      name: 'mine.json',
      mimeType: 'application/json',
      buffer: Buffer.from(JSON.stringify(buildCrossing('x', 'Mine').scene)),
    };
    await d.page.setInputFiles('input[type="file"]', [
      good,
      { name: 'notes.pdf', mimeType: 'application/pdf', buffer: Buffer.from('%PDF') },
    ]);
    await d.page.waitForSelector('.dlg.import');
    expect(await d.text('.dlg.import')).toMatch(/2 files: 1 imported, 1 not readable/);
    expect(await d.text('.dlg.import')).toContain('“notes.pdf” is not a scene: it is a PDF.');
    await d.key('Escape');
    expect(await d.page.inputValue('.title input')).toBe('Mine');
  });

  it('reports many files in a few rows, with the faulty ones among them, and all on request', async () => {
    d = await (await Driver.open(browser)).ready();
    const scenes = Array.from({ length: 15 }, (_, i) => ({
      name: `mine-${i}.json`,
      mimeType: 'application/json',
      buffer: Buffer.from(JSON.stringify(buildCrossing(`x${i}`, `Mine ${i}`).scene)),
    }));
    const wrong = { name: 'notes.pdf', mimeType: 'application/pdf', buffer: Buffer.from('%PDF') };
    await d.page.setInputFiles('input[type="file"]', [...scenes, wrong]);
    await d.page.waitForSelector('.dlg.import .filepart');
    expect(await d.page.locator('.filepart').count()).toBe(12);
    expect(await d.page.locator('.filepart').last().innerText()).toContain('notes.pdf');
    await d.page.getByRole('button', { name: 'Show all 16' }).click();
    expect(await d.page.locator('.filepart').count()).toBe(16);
    expect(await d.page.getByRole('button', { name: /Show all/ }).count()).toBe(0);
  });

  it('saves own scenes after every step and offers both versions on a conflict', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.key('Control+s');
    await d.page.waitForFunction(() => document.querySelector('.title small')?.textContent === 'Saved');
    const own = [...d.server.scenes.values()].find((s) => !s.readonly)!;
    await d.select('1');
    await d.key('g');
    await d.settled();
    await d.page.waitForFunction(() => document.querySelector('.title small')?.textContent === 'Saved');
    const id = own.scene as unknown as { id: string };
    const stored = d.server.scenes.get(id.id)!;
    expect(stored.rev).toBeGreaterThan(1);
    expect(JSON.stringify(stored.scene.agents[0].conditions)).toContain('x_m');
    // "Saved" stays from the previous save until the next one begins: the stored futures are decisive.
    await expect.poll(() => stored.scene.generated?.samples[0].agents['1']).toBeDefined();
    // A reopened scene has its futures without a request.
    const asked = d.server.log.length;
    await d.page.reload();
    await d.ready();
    await d.settled();
    expect(d.server.log.length).toBe(asked);
    await d.select('1');
    expect(await d.text('.goalsec h3')).not.toContain('chosen by the generator');
    d.server.scenes.get(id.id)!.etag = '"9-other"';
    await d.key('Shift+G');
    await d.page.waitForSelector('.banner');
    expect(await d.text('.banner')).toContain('changed elsewhere');
    await d.page.getByText('Keep this version').click();
    await d.page.waitForSelector('.banner', { state: 'detached' });
  });

  it('keeps edits of examples in this browser', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.select('1');
    await d.key('g');
    await d.settled();
    await d.page.reload();
    await d.ready();
    expect(await d.text('.toast')).toContain('restored');
  });

  it('works by keys only', async () => {
    d = await (await Driver.open(browser)).ready();
    await d.page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
    await d.key('Tab');
    await d.page.waitForSelector('.fu');
    await d.settled();
    const name = await d.text('.ih h2');
    await d.key('g');
    for (let i = 0; i < 5; i++) await d.key('Shift+ArrowUp');
    await d.settled();
    expect(await d.text('.toast')).toContain(`Goal of ${name} moved`);
    await d.key('Shift+f');
    await d.settled();
    const id = (d.last().agents as string[])[0];
    expect(d.last().conditions[id].goal).toHaveProperty('speed_mps');
    // Five repeats in quick succession are one step.
    await d.key('Control+z');
    await d.key('Control+z');
    expect(await d.page.locator('.goalsec [aria-checked="true"]').count()).toBe(1);
    await d.key('Control+k');
    await d.page.keyboard.type('loop');
    await d.key('Enter');
    await d.page.click('[data-menu="playback"]');
    expect(await d.page.locator('.menu [data-action="loop"]').getAttribute('aria-pressed')).toBe('false');
    await d.key('Escape');
    expect(await d.page.locator('[role="slider"][aria-label="Goal time"]').getAttribute('aria-valuetext')).toBe(
      '9.0 seconds',
    );
  });

  it('shows collisions on the timeline and in the list', async () => {
    d = await (await Driver.open(browser, { collision: true })).ready();
    await d.select('1');
    await d.key('g');
    await d.page.waitForSelector('.badge');
    expect(await d.page.locator('.badge').count()).toBe(2);
    await d.key('e');
    const told = d.page.locator('.insp');
    await told.getByText('Motorcycle 11, Cyclist 14').waitFor();
    await d.key('e');
    await told.getByText('Collision at 5.4 s').waitFor();
    expect(await d.text('.tm')).toContain('5.4 s');
  });

  it('reports faults of futures, by row and in one line, and offers the way by the road', async () => {
    d = await (await Driver.open(browser, { judged: true })).ready();
    await d.select('1');
    const [x, y] = await d.at(...(await d.goal()));
    await d.drag([x + 8, y - 26], [x + 40, y - 60]);
    await d.page.waitForSelector('.hint.near');
    expect(await d.text('.hint')).toBe(
      'Reaches the goal, but crosses the median at 3.2 s\n' +
        'A to D cross the median. E reaches the goal by road. F misses the goal.',
    );
    const marks = () =>
      d.page.locator('.fu .mk').evaluateAll((all) => all.map((e) => e.className.replace('mk', '').trim()));
    expect(await marks()).toEqual(['rule', 'rule', 'rule', 'rule', 'ok', 'short']);
    await d.page.waitForSelector('.badge[aria-label^="Over the median 3.2 s"]');
    await d.release();
    expect(await d.text('.fu[data-future="E"] .nm')).toBe('Stays on the road');
    await d.page.locator('.hint .to').click();
    expect(await d.text('.tm')).toContain('3.2 s');
    const goal = await d.goal();
    const byRoad = async (take: () => Promise<void>) => {
      await take();
      await d.settled();
      const moved = await d.goal();
      expect(Math.hypot(moved[0] - goal[0], moved[1] - goal[1])).toBeCloseTo(14, 0);
      await d.key('Control+z');
      await d.settled();
      expect(await d.goal()).toEqual(goal);
      return moved;
    };
    const moved = await byRoad(() => d.page.locator('.opt.pri').click());
    await byRoad(() => d.key('Enter'));
    const [hollowX, hollowY] = await d.at(...moved);
    await byRoad(() => d.page.mouse.click(hollowX + 8, hollowY - 26));

    // Permission to cross the median is stored with the goal, is one step, and can be withdrawn.
    await d.page.getByRole('button', { name: 'Allow crossing this median' }).click();
    await d.settled();
    expect(d.last().conditions['1'].goal!.may_cross).toEqual(['m0']);
    expect(await marks()).toEqual(['ok', 'ok', 'ok', 'rule', 'ok', 'short']);
    expect(await d.text('.leave')).toContain('Crossing allowed');
    await d.page.getByRole('button', { name: 'Undo: Crossing allowed' }).click();
    await d.settled();
    expect(await d.page.locator('.leave').count()).toBe(0);
    expect(await marks()).toEqual(['rule', 'rule', 'rule', 'rule', 'ok', 'short']);
    await d.key('Alt+Enter');
    await d.settled();
    expect(await d.page.locator('.leave').count()).toBe(1);
    for (let i = 0; i < 3; i++) {
      await d.key('Control+z');
      await d.settled();
    }
    expect(await d.page.locator('.leave').count()).toBe(0);
    expect(await d.goal()).toEqual(goal);
    // Events of the recording are listed, but do not count.
    expect(await d.page.locator('.badge.log').count()).toBe(1);
    await d.key('e');
    expect(await d.text('.insp')).toMatch(/6 in these 9 s · 1 in the recording/);
  });

  it('plans 20 s: the timeline stretches, the set length is sent, playback runs to the end', async () => {
    d = await (await Driver.open(browser)).ready();
    expect(await d.text('.tm')).toContain('/ 9.0 s');
    await d.page.click('[data-menu="generate"]');
    await d.page.locator('[data-action="length-20"]').click();
    await d.settled();
    expect(await d.text('.tm')).toContain('/ 20.0 s');
    expect(d.last()).toMatchObject({ agents: [], react: true, horizon_s: 20, replan_interval_s: 9 });
    await d.page.locator('[data-action="replan-3"]').click();
    await d.settled();
    expect(d.last()).toMatchObject({ horizon_s: 20, replan_interval_s: 3 });
    await d.key('Escape');
    await d.select('1');
    expect(await d.page.locator('.plot text').allTextContents()).toContain('20 s');
    const time = d.page.locator('[data-field="goal-time"]');
    await d.key('g');
    await d.settled();
    await time.fill('25');
    await time.press('Enter');
    await d.settled();
    // A time past the end is refused, and not clamped silently.
    expect(await d.text('.field .why')).toBe('1 to 20 s');
    expect(d.last().conditions['1'].goal!.time_s).toBe(9);
    await time.fill('+11');
    await time.press('Enter');
    await d.settled();
    expect(await d.value('goal-time')).toBe(20);
    expect(d.last().conditions['1'].goal!.time_s).toBe(20);
    await d.page.evaluate(() => (document.activeElement as HTMLElement).blur());
    await d.key('p');
    await d.key('End');
    for (let i = 0; i < 5; i++) await d.key(',');
    expect(await d.text('.tm')).toContain('19.5 s');
    await d.key('Space');
    await d.page.waitForFunction(() => document.querySelector('.tm')?.textContent?.startsWith('20.0 s'));
    await d.page.click('[data-menu="generate"]');
    await d.page.locator('[data-action="length-12"]').click();
    await d.settled();
    expect(await d.value('goal-time')).toBe(12);
    expect(await d.text('.tm')).toMatch(/12\.0 s\s+\/ 12\.0 s/);
    await d.key('Control+z');
    await d.settled();
    expect(await d.value('goal-time')).toBe(20);
    expect(await d.text('.tm')).toContain('/ 20.0 s');
  });

  it('starts empty without a scene, and waits without a server', async () => {
    d = await Driver.open(browser, { away: false }, '/', async (p) => {
      await p.route('**/v1/scenes?*', (r) => r.fulfill({ json: { scenes: [], next: null } }));
    });
    await d.page.waitForSelector('.empty');
    expect(await d.text('.empty')).toContain('Import a scene');
  });
});
