// A scene as one page: it plays from a file, without a server and without a network.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, it } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { launch } from '../../support/editor.js';
import { missing, program } from '../../support/where.js';

const SCENE = fileURLToPath(new URL('../../../../assets/scenes/demo-crossing.json', import.meta.url));

describe('a page that plays', { skip: missing() }, () => {
  const folder = mkdtempSync(join(tmpdir(), 'dragtraffic-page-'));
  const file = join(folder, 'scene.html');
  let browser;
  before(
    async () => {
      execFileSync(program, ['-q', 'convert', SCENE, '--to', 'html', '-o', file]);
      browser = await launch();
    },
    { timeout: 60_000 },
  );
  after(async () => {
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
  });

  it('plays, pauses and is scrubbed by keys, without any request', { timeout: 60_000 }, async () => {
    const page = await browser.newPage();
    const asked = [];
    const errors = [];
    page.on('request', (r) => asked.push(r.url()));
    page.on('pageerror', (e) => errors.push(String(e)));
    page.on('console', (m) => m.type() === 'error' && errors.push(m.text()));
    await page.goto(pathToFileURL(file).href);
    const clock = () => page.locator('#clock').textContent();
    assert.equal(await clock(), '0.0 / 9.0 s');
    assert.equal(await page.locator('h1').textContent(), await page.title());
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    assert.equal(await clock(), '0.2 / 9.0 s');
    await page.keyboard.press('End');
    assert.equal(await clock(), '9.0 / 9.0 s');
    await page.keyboard.press('Home');
    await page.keyboard.press('Space');
    await page.waitForFunction(() => Number(document.querySelector('#time').value) > 3);
    assert.equal(await page.locator('#play').textContent(), 'Halt');
    await page.locator('#play').click();
    assert.equal(await page.locator('#play').getAttribute('aria-pressed'), 'false');
    await page.keyboard.press('Home');
    const colours = () =>
      page.evaluate(() => {
        const c = document.querySelector('canvas');
        const { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
        const seen = new Set();
        for (let i = 0; i < data.length; i += 4) seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
        return [seen.has(0x2f68d8), seen.has(0xd2d6db), seen.has(0xe6eae1)];
      });
    assert.deepEqual(await colours(), [true, true, true], 'vehicles, asphalt and ground are painted');
    assert.deepEqual(errors, []);
    assert.deepEqual(asked, [pathToFileURL(file).href]);
    await page.close();
  });
});
