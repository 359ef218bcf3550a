// A real browser against the stand-in server. Skipped, with the reason printed, where there is no Chromium; where
// CHROMIUM names one that is not there, they fail.
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { chromium, type Browser, type Page } from 'playwright-core';
import { build } from 'vite';
import { View } from '../../src/draw/view';
import { startStandIn, type StandIn, type StandInOptions } from '../standin/server.mjs';

const FLAGS = [
  '--headless',
  '--no-sandbox',
  '--disable-gpu',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];
const PLACES = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];

const named = process.env.CHROMIUM || null;
if (named && !existsSync(named)) throw new Error(`CHROMIUM is ${named}, and no such program exists.`);
export const chromiumPath = named ?? PLACES.find((p) => existsSync(p)) ?? null;
if (!chromiumPath) console.log('Browser tests are skipped: no Chromium found (set CHROMIUM to its path).');

const WEB = fileURLToPath(new URL('../..', import.meta.url));
/** The built page, a folder for each worker: what builds the program may write web/dist meanwhile. */
const PAGE = `${WEB}node_modules/.page-${process.env.VITEST_POOL_ID ?? 0}`;

export async function buildPage(): Promise<void> {
  // The test uses the shipped build; under the runner's own NODE_ENV it would be a development build.
  process.env.NODE_ENV = 'production';
  await build({ root: WEB, logLevel: 'error', build: { outDir: PAGE, emptyOutDir: true } });
}

export const launch = (): Promise<Browser> => chromium.launch({ executablePath: chromiumPath!, args: FLAGS });

export class Driver {
  readonly errors: string[] = [];
  constructor(
    readonly page: Page,
    readonly server: StandIn,
  ) {
    page.on('console', (m) => {
      if (m.type() === 'error' && !/ERR_|Failed to load resource/.test(m.text())) this.errors.push(m.text());
    });
    page.on('pageerror', (e) => this.errors.push(String(e.stack ?? e)));
  }

  static async open(
    browser: Browser,
    options: StandInOptions = {},
    path = '/',
    setup?: (p: Page) => Promise<unknown>,
  ): Promise<Driver> {
    const server = await startStandIn({ port: 0, delay: 4, page: PAGE, ...options });
    const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, reducedMotion: 'reduce' });
    const page = await context.newPage();
    const d = new Driver(page, server);
    await setup?.(page);
    await page.goto(server.url + path);
    return d;
  }

  async ready(): Promise<this> {
    await this.page.waitForSelector('[data-agent="1"]', { state: 'attached' });
    await this.page.waitForFunction(() => !!document.querySelector<HTMLElement>('main.stage')?.dataset.view);
    return this;
  }

  async close(): Promise<void> {
    await this.page.context().close();
    await this.server.close();
  }

  /** Screen position of a world point. */
  async at(x: number, y: number): Promise<[number, number]> {
    const [cx, cy, z, turn] = (await this.page.getAttribute('main.stage', 'data-view'))!.split(' ').map(Number);
    const b = (await this.page.locator('main.stage').boundingBox())!;
    const view = Object.assign(new View(), { w: b.width, h: b.height });
    view.look({ cx, cy, z, turn });
    const [px, py] = view.to(x, y);
    return [b.x + px, b.y + py];
  }

  async zoom(): Promise<number> {
    return Number((await this.page.getAttribute('main.stage', 'data-view'))!.split(' ')[2]);
  }

  async select(id: string): Promise<void> {
    await this.page.locator(`[data-agent="${id}"]`).evaluate((e: HTMLElement) => e.click());
    await this.page.waitForSelector('.fu');
    await this.settled();
  }

  /** All requests are answered, and the page shows the results. */
  async settled(): Promise<void> {
    await this.frames(2);
    await this.page.waitForSelector('main.stage[aria-busy="false"]');
    await this.frames(2);
  }

  /** The page has drawn this many frames. */
  async frames(n: number): Promise<void> {
    for (let i = 0; i < n; i++) await this.page.evaluate(() => new Promise(requestAnimationFrame));
  }

  async value(field: string, n = 0): Promise<number> {
    return Number(
      (await this.page.locator(`[data-field="${field}"]`).nth(n).inputValue()).replace('≈', '').replace('−', '-'),
    );
  }

  async goal(): Promise<[number, number]> {
    return [await this.value('goal-pos', 0), await this.value('goal-pos', 1)];
  }

  async drag(from: [number, number], to: [number, number], steps = 10): Promise<void> {
    const { mouse } = this.page;
    await mouse.move(...from);
    await mouse.down();
    for (let i = 1; i <= steps; i++) {
      await mouse.move(from[0] + ((to[0] - from[0]) * i) / steps, from[1] + ((to[1] - from[1]) * i) / steps);
      await this.frames(1);
    }
  }

  async release(): Promise<void> {
    await this.page.mouse.up();
    await this.settled();
  }

  text(selector: string): Promise<string> {
    return this.page.locator(selector).first().innerText();
  }
  key(k: string): Promise<void> {
    return this.page.keyboard.press(k);
  }
  last(): StandIn['log'][number] {
    return this.server.log.at(-1)!;
  }
}
