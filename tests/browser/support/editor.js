// The editor as a user sees it: screen, mouse, keyboard, and the list for screen readers.
import { chromium as chromiumEngine, firefox as firefoxEngine } from 'playwright-core';
import { chromium, firefox, out } from './where.js';
import { Wire } from './wire.js';

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
const PATIENCE_MS = 15_000;

/** A browser by its name: Chromium, or a standard Firefox, which speaks WebDriver BiDi. */
export const launch = (name = 'chromium') =>
  name === 'firefox'
    ? firefoxEngine.launch({ executablePath: firefox, channel: 'moz-firefox', headless: true })
    : chromiumEngine.launch({ executablePath: chromium, args: FLAGS });

const engineOf = (context) => context.browser().browserType().name();
const number = (text) => Number(text.replace('≈', '').replace('−', '-').replace(',', '.').trim());

export class Editor {
  /** Errors of the page; a broken connection is not the page's fault. */
  errors = [];
  #listening = undefined;

  /**
   * With `stopwatch: false` the page's clock stands still. With `now` so do dates. `arrange` prepares the browser
   * before the page loads; with `scene: false` no scene is awaited. `listening` is the level of listening to the wire,
   * which costs the page time.
   */
  static async open(browser, url, { stopwatch = true, now, arrange, scene = true, listening, ...options } = {}) {
    const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, ...options });
    if (!stopwatch)
      await context.addInitScript(() => {
        performance.now = () => 0;
      });
    if (now)
      await context.addInitScript((at) => {
        const Real = Date;
        window.Date = class extends Real {
          constructor(...of) {
            super(...(of.length ? of : [at]));
          }
          static now() {
            return at;
          }
        };
      }, Date.parse(now));
    await arrange?.(context);
    return Editor.#in(context, url, [], { scene, listening });
  }

  static async #in(context, url, errors, { scene = true, listening } = {}) {
    const e = new Editor();
    e.errors = errors;
    e.#listening = listening;
    e.page = await context.newPage();
    e.page.setDefaultTimeout(PATIENCE_MS);
    // In Chromium any inline style is an error of the page; in Firefox a screenshot adds one, which is refused.
    const expected = engineOf(context) === 'firefox' ? /blocked an inline style/ : /ERR_|Failed to load resource/;
    const complain = (words) => expected.test(words) || e.errors.push(words);
    e.page.on('console', (m) => m.type() === 'error' && complain(m.text()));
    e.page.on('pageerror', (error) => complain(String(error.stack ?? error)));
    // Only Chromium gives access to the wire; elsewhere a journey depends on what the page shows.
    const listened = engineOf(context) === 'chromium';
    e.cdp = listened ? await context.newCDPSession(e.page) : null;
    e.wire = listened ? await Wire.on(e.cdp, listening) : new Wire();
    await e.page.goto(url);
    if (scene) await e.ready();
    return e;
  }

  /** Another tab of the same browser. */
  async beside(url = this.page.url()) {
    return Editor.#in(this.page.context(), url, this.errors, this.#listening);
  }

  /** The tab's process ends at once; the same page opens in a new one. */
  async killed() {
    const url = this.page.url();
    const context = this.page.context();
    const gone = new Promise((resolve) => this.page.once('crash', resolve));
    // The process that would answer is gone.
    void this.cdp.send('Page.crash').catch(() => undefined);
    await gone;
    const e = await Editor.#in(context, url, this.errors);
    await this.page.close();
    return e;
  }

  /** A reply of the server. */
  async get(path) {
    return (await this.page.request.get(new URL(path, this.page.url()).href)).json();
  }

  async ready() {
    await this.page.waitForSelector('[data-agent]', { state: 'attached' });
    await this.page.waitForSelector('main.stage[data-view]');
  }

  /** The first seconds play automatically; most journeys skip that. */
  async begin() {
    await this.key('Home');
    await this.until(() => document.querySelector('.tm').textContent.startsWith('0.0'));
    await this.settled();
  }

  async close() {
    await this.page.context().close();
  }

  until(what, argument) {
    return this.page.waitForFunction(what, argument);
  }

  picture(name) {
    return this.page.screenshot({ path: `${out}/${name}.png` });
  }

  // -------------------------------------------------------------- reading

  text(selector) {
    return this.page.locator(selector).first().innerText();
  }
  shows(selector) {
    return this.page.locator(selector).first().isVisible();
  }

  /** The list of road users: `{ id, name, kind, speed (m/s), words }`. */
  async roadUsers() {
    const rows = await this.page
      .locator('[data-agent]')
      .evaluateAll((all) => all.map((e) => [e.dataset.agent, e.textContent]));
    return rows.map(([id, words]) => {
      const [, name, value, unit] = /^(.+?), ([\d.]+) (km\/h|m\/s)/.exec(words) ?? [null, words, 'NaN', ''];
      return { id, name, kind: name.replace(/ \d+$/, ''), speed: Number(value) / (unit === 'm/s' ? 1 : 3.6), words };
    });
  }

  /** A pose from the handles' texts for screen readers. */
  async pose(part) {
    const said = (what) =>
      this.page.getByRole('slider', { name: `${part} ${what}`, exact: true }).getAttribute('aria-valuetext');
    const [x, y] = (await said('position'))
      .replaceAll('−', '-')
      .match(/-?[\d.]+/g)
      .map(Number);
    const now = (what) =>
      this.page
        .getByRole('slider', { name: `${part} ${what}`, exact: true })
        .getAttribute('aria-valuenow')
        .then(Number);
    return { x, y, heading: (await now('heading')) * (Math.PI / 180), speed: await now('speed') };
  }

  async value(field, nth = 0) {
    return number(await this.page.locator(`[data-field="${field}"]`).nth(nth).inputValue());
  }
  async goal() {
    return { x: await this.value('goal-pos', 0), y: await this.value('goal-pos', 1) };
  }

  /** Every value in the inspector, as text. */
  inspector() {
    return this.page
      .locator('aside.insp')
      .evaluate((el) => [
        el.querySelector('h2')?.textContent ?? '',
        ...[...el.querySelectorAll('input')].map((i) => `${i.getAttribute('aria-label')}: ${i.value}`),
        ...[...el.querySelectorAll('[role="switch"], [role="radio"]')].map(
          (s) => `${s.getAttribute('aria-label') ?? s.textContent}: ${s.getAttribute('aria-checked')}`,
        ),
      ]);
  }

  // -------------------------------------------------------------- positions

  async view() {
    const [cx, cy, zoom, turn = 0] = (await this.page.getAttribute('main.stage', 'data-view')).split(' ').map(Number);
    return { cx, cy, zoom, turn, box: await this.page.locator('main.stage').boundingBox() };
  }

  /** Page position of a place in the scene. */
  async at(x, y) {
    const { cx, cy, zoom, turn, box } = await this.view();
    const [c, s] = [Math.cos(turn) * zoom, Math.sin(turn) * zoom];
    const [dx, dy] = [x - cx, y - cy];
    return [box.x + box.width / 2 + dx * c - dy * s, box.y + box.height / 2 - dx * s - dy * c];
  }

  /** Is the picture, and no panel, under a page position? */
  open([x, y], margin = 24) {
    return this.page.evaluate(
      ([px, py, m]) =>
        [
          [0, 0],
          [-m, -m],
          [m, -m],
          [-m, m],
          [m, m],
        ].every(([dx, dy]) => {
          const el = document.elementFromPoint(px + dx, py + dy);
          return el instanceof HTMLCanvasElement || el?.matches('main.stage') === true;
        }),
      [x, y, margin],
    );
  }

  // -------------------------------------------------------------- actions

  key(k) {
    return this.page.keyboard.press(k);
  }

  /** Like a screen reader that activates an entry of the list. */
  async choose(id) {
    await this.page.locator(`[data-agent="${id}"]`).evaluate((el) => el.click());
    await this.page.waitForSelector('.fu');
    await this.settled();
  }

  /** The rarely typed fields of the selected road user: heading, type, size, note. */
  async moreFields() {
    const more = this.page.locator('button.more[aria-expanded="false"]');
    if (await more.count()) await more.click();
  }

  async letGo() {
    await this.page.evaluate(() => document.activeElement?.blur?.());
    await this.key('Escape');
    await this.until(() => !document.querySelector('.fu'));
    // The timeline gives its room back to the picture.
    await this.frames(2);
  }

  /** No request is under way any more, and the page shows the results. */
  async settled() {
    const end = Date.now() + PATIENCE_MS;
    for (;;) {
      const mark = this.wire.asked.length;
      await this.frames(2);
      await this.page.waitForSelector('main.stage[aria-busy="false"]');
      await this.frames(2);
      if (mark === this.wire.asked.length && this.wire.quiet()) return;
      if (Date.now() > end) throw new Error(`still busy: ${await this.text('.status')}`);
    }
  }

  /** The page has drawn this many frames. */
  async frames(n) {
    for (let i = 0; i < n; i++) await this.page.evaluate(() => new Promise(requestAnimationFrame));
  }

  async drag(from, to, { moves = 10, then } = {}) {
    const { mouse } = this.page;
    await mouse.move(...from);
    await mouse.down();
    for (let i = 1; i <= moves; i++) {
      await mouse.move(from[0] + ((to[0] - from[0]) * i) / moves, from[1] + ((to[1] - from[1]) * i) / moves);
      await this.frames(1);
      await then?.(i);
    }
  }

  /** The code of the result, from the options of Generate. */
  async code() {
    await this.page.click('[data-menu="generate"]');
    const code = await this.text('.btn.code');
    await this.key('Escape');
    return code;
  }

  async release() {
    await this.page.mouse.up();
    await this.settled();
  }

  async type(field, value, nth = 0) {
    const el = this.page.locator(`[data-field="${field}"]`).nth(nth);
    await el.click();
    await el.fill(value);
    await el.press('Enter');
    await this.settled();
  }

  /** Collects the texts of an element from now on; `said()` returns them. */
  async listen(selector) {
    const log = await this.page.evaluateHandle((s) => {
      const said = [];
      const note = () => {
        const t = document.querySelector(s)?.textContent ?? '';
        if (t !== said.at(-1)) said.push(t);
      };
      new MutationObserver(note).observe(document.querySelector(s), {
        subtree: true,
        childList: true,
        characterData: true,
      });
      note();
      return said;
    }, selector);
    return () => log.jsonValue();
  }

  /** Drops external files onto the picture: name, bytes, name, bytes … */
  async drop(...files) {
    const pairs = files.flatMap((name, i) => (i % 2 ? [] : [[name, files[i + 1].toString('base64')]]));
    const data = await this.page.evaluateHandle((all) => {
      const t = new DataTransfer();
      for (const [n, base64] of all) {
        const raw = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
        t.items.add(new File([raw], n, { type: 'application/octet-stream' }));
      }
      return t;
    }, pairs);
    for (const type of ['dragenter', 'dragover', 'drop'])
      await this.page.dispatchEvent('main.stage', type, { dataTransfer: data });
  }
}

export const distance = (a, b) => Math.hypot(a.x - b.x, a.y - b.y);
export const turn = (a, b) => Math.abs(Math.atan2(Math.sin(a - b), Math.cos(a - b)));
