// Every text of the page is in a table: with all of them marked, no unmarked letter is left. None is cut off when it is
// longer by a third. German appears when chosen.
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import type { Browser } from 'playwright-core';
import { buildPage, chromiumPath, Driver, launch } from './driver';

let browser: Browser;
let d: Driver;

const speaking = (language: string) => (page: import('playwright-core').Page) =>
  Promise.all([
    page.setViewportSize({ width: 1280, height: 720 }),
    page.addInitScript((l) => localStorage.setItem('dragtraffic:language', JSON.stringify(l)), language),
  ]);

/** Equal in every language: keys, units, formats, letters of futures, and texts of the server or a file. */
const SAME = [
  'DragTraffic|Ctrl|Shift|Alt|Esc|Tab|Space|Home|End|Del|Page(?:Up|Down)|[AP]M|Enter|Menu|Backspace|Delete|F\\d+',
  '[A-F]{2,6}',
  'km/h|mph|m/s²?|ft|px|KB|MB|ms|English|Deutsch|Waymo|SUMO',
  '\\.[a-z0-9.]+',
];

/** Texts, names and titles on the page with unmarked letters; and those that are cut off. */
const look = (): Promise<{ bare: string[]; cut: string[] }> =>
  d.page.evaluate((same) => {
    const known = new RegExp(`(?<![A-Za-z])(?:${same.join('|')})(?![A-Za-z])`, 'g');
    // Names belong to the scene: they are in its file.
    const names = /(?<![A-Za-z])(?:Car|Truck|Bus|Motorcycle|Cyclist|Pedestrian|Object) \d+/g;
    const bareOf = (text: string): boolean => {
      let left = text;
      for (let was = ''; was !== left;) {
        was = left;
        left = left.replace(/⟦[^⟦⟧]*⟧/g, ' ');
      }
      return /[A-Za-z]{2}/.test(left.replace(names, ' ').replace(known, ' '));
    };
    const bare = new Set<string>();
    const cut = new Set<string>();
    for (const e of document.querySelectorAll<HTMLElement>('body *')) {
      if (e.closest('[data-file-text], script, noscript, style')) continue;
      for (const name of ['aria-label', 'title', 'placeholder', 'aria-valuetext', 'alt']) {
        const said = e.getAttribute(name);
        if (said && bareOf(said)) bare.add(`${name}: ${said}`);
      }
      if (!e.checkVisibility()) continue;
      for (const n of e.childNodes)
        if (n.nodeType === Node.TEXT_NODE && bareOf(n.textContent!))
          bare.add(`${e.tagName}.${e.className}: ${n.textContent}`);
      const style = getComputedStyle(e);
      const shows =
        !e.closest('.sr') && [...e.childNodes].some((n) => n.nodeType === Node.TEXT_NODE && n.textContent!.trim());
      if (
        shows &&
        style.overflowX === 'hidden' &&
        style.textOverflow !== 'ellipsis' &&
        e.scrollWidth > e.clientWidth + 1
      )
        cut.add(`${e.tagName}.${e.className}: ${e.textContent}`);
    }
    return { bare: [...bare], cut: [...cut] };
  }, SAME);

describe.skipIf(!chromiumPath)('texts on the page', { timeout: 60_000 }, () => {
  beforeAll(async () => {
    await buildPage();
    browser = await launch();
  }, 60_000);
  afterAll(() => browser?.close());
  afterEach(async () => {
    expect(d.errors).toEqual([]);
    await d.close();
  });

  it('come from the tables, all of them, and none is cut off', async () => {
    d = await Driver.open(browser, {}, '/', speaking('qps'));
    await d.ready();
    const found: Record<string, { bare: string[]; cut: string[] }> = {};
    const state = async (name: string): Promise<void> => {
      await d.settled();
      const { bare, cut } = await look();
      if (bare.length + cut.length) found[name] = { bare, cut };
    };
    await state('first view');
    await d.select('1');
    await state('selected');
    const flag = await d.at(...(await d.goal()));
    await d.drag(flag, [flag[0] - 40, flag[1] + 10]);
    await state('drag');
    await d.release();
    await state('after it');
    for (const [name, open, close] of [
      ['menu', () => d.page.locator('[data-menu="file"]').click(), 'Escape'],
      ['palette', () => d.key('Control+k'), 'Escape'],
      ['shortcuts', () => d.key('?'), 'Escape'],
      ['export', () => d.page.locator('[data-action="export"]').first().click(), 'Escape'],
      ['share', () => d.page.locator('[data-action="share"]').first().click(), 'Escape'],
      ['road users', () => d.key('w'), 'w'],
      ['history', () => d.key('Control+h'), 'Control+h'],
      ['rounds', () => d.key('k'), 'Escape'],
      ['variants', () => d.key('v'), 'v'],
    ] as const) {
      await open();
      await state(name);
      await d.key(close);
    }
    expect(found).toEqual({});
  });

  it('show lengths in feet where speeds are in miles per hour', async () => {
    d = await Driver.open(browser, { judged: true }, '/', (page) =>
      page.addInitScript(() => {
        localStorage.setItem('dragtraffic:speed-unit', '"mph"');
        // Texts on the picture are sent to its painter.
        const painted: string[] = ((window as unknown as { painted: string[] }).painted = []);
        const send = Worker.prototype.postMessage as (this: Worker, ...all: unknown[]) => void;
        Worker.prototype.postMessage = function (this: Worker, ...all: unknown[]) {
          const [said] = all as [{ picture?: { news: { texts: string[] } } } | null];
          painted.push(...(said?.picture?.news.texts ?? []));
          send.apply(this, all);
        };
      }),
    );
    await d.ready();
    const found: Record<string, string[]> = {};
    const feet = new Set<string>();
    const state = async (name: string): Promise<void> => {
      await d.settled();
      const texts = await d.page.evaluate(() => {
        // Positions are in metres, as in the file, with their unit; so are the steps of the keys that move them.
        const metric = '[data-file-text], script, noscript, style, .field:has([data-field$="-pos"])';
        const read = [...document.querySelectorAll<HTMLElement>('body *')].flatMap((e) => {
          if (e.closest(metric)) return [];
          const own = [...e.childNodes].filter((n) => n.nodeType === Node.TEXT_NODE).map((n) => n.textContent!);
          const said = ['aria-label', 'title', 'aria-valuetext'].map((a) => e.getAttribute(a) ?? '');
          return [...(e.checkVisibility() ? [own.join('')] : []), ...said];
        });
        return [...read, ...(window as unknown as { painted: string[] }).painted.splice(0)];
      });
      for (const t of texts) if (/(?:^|\d )(?:ft|feet)\b/.test(t)) feet.add(t);
      const bare = texts.filter((t) => /^ ?m$|\d ?m(?!\w)|km\/h|m\/s/.test(t));
      if (bare.length) found[name] = bare;
    };
    await state('first view');
    await d.select('1');
    await state('selected');
    const flag = await d.at(...(await d.goal()));
    await d.drag(flag, [flag[0] + 400, flag[1] + 10]);
    await state('drag');
    await d.release();
    await state('after it');
    for (const [name, open, close] of [
      ['all', () => d.key('Control+a'), 'Escape'],
      ['place', () => d.key('1'), 'Escape'],
      ['fill', () => d.key('d'), 'v'],
      ['measure', async () => (await d.key('m'), d.drag([500, 300], [700, 420])), 'v'],
      ['rounds', () => d.key('Shift+k'), 'Escape'],
    ] as const) {
      await open();
      await d.page.mouse.move(600, 400);
      await state(name);
      await d.page.mouse.up();
      await d.key(close);
    }
    expect(found).toEqual({});
    for (const words of [
      /^\d+ ft$/,
      /smallest gap .* ft/,
      /ft × .* ft/,
      /per 1000 ft of lane/,
      /^[\d.]+ × [\d.]+ ft/,
      /[\d.]+ ft\/s(?!²)/,
    ])
      expect(
        [...feet].some((t) => words.test(t)),
        String(words),
      ).toBe(true);
  });

  it("are German when chosen, and so is the page's language attribute", async () => {
    d = await (await Driver.open(browser, {}, '/', speaking('de'))).ready();
    expect(await d.page.getAttribute('html', 'lang')).toBe('de');
    expect(await d.text('.coach')).toContain('Auf einen Pkw klicken');
    expect(await d.page.locator('[data-action="undo"]').getAttribute('aria-label')).toBe('Rückgängig');
    await d.select('1');
    await d.settled();
    expect(await d.text('[data-action="set-goal"]')).toContain('Ziel setzen');
    // Numbers have a comma, and are read with comma or point.
    const time = d.page.locator('[data-field="goal-time"]');
    for (const typed of ['4,5', '4.5']) {
      await time.fill(typed);
      await time.press('Enter');
      expect(await time.inputValue()).toBe('4,5');
    }
    await d.page.locator('[data-menu="file"]').click();
    expect(await d.text('[data-action="language"]')).toContain('Sprache: English');
    expect(await d.page.locator('[data-action="share"]').first().getAttribute('title')).toBe('Teilen (Strg ⇧ C)');
  });
});
