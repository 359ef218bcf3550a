// The page of a batch: cases are sorted, filtered and played from a file, ten thousand of them too, without a network.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, it } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { launch } from '../../support/editor.js';
import { missing, program } from '../../support/where.js';

const SCENES = fileURLToPath(new URL('../../../../assets/scenes/', import.meta.url));
const PLAN = `
scenes = ["${SCENES}demo-motorway.json", "${SCENES}demo-crossing.json"]
seeds = 6
where = "collisions == 0"
[generate]
horizon_s = 4
steps = 1
[[situations]]
template = "cut-in"
[[situations]]
template = "brake"
`;
const MANY = 10_000;

/** The text of a script element of the page. */
const scriptOf = (page, id) => new RegExp(`(<script id="${id}"[^>]*>)(.*?)(</script>)`, 's').exec(page);

/** The page with its cases repeated until there are so many, each with a code of its own. */
function repeated(page, count) {
  const data = JSON.parse(scriptOf(page, 'data')[2]);
  const motions = scriptOf(page, 'motions')[2].trim().split('\n');
  const at = Array.from({ length: count }, (_, i) => i % data.cases.length);
  const cases = at.map((from, i) => {
    const [scene, unit, [, ...body]] = data.cases[from];
    return [scene, unit, [`N${i}`, ...body]];
  });
  const text = JSON.stringify({ ...data, kept: count, cases }).replaceAll('<', '\\u003c');
  const put = (into, id, content) =>
    into.replace(scriptOf(into, id)[0], (found) => `${/^<[^>]*>/.exec(found)[0]}${content}</script>`);
  return put(put(page, 'data', text), 'motions', at.map((from) => motions[from]).join('\n'));
}

describe('the page of a batch', { skip: missing() }, () => {
  const folder = mkdtempSync(join(tmpdir(), 'dragtraffic-cases-'));
  const [small, large] = [join(folder, 'out/index.html'), join(folder, 'many.html')];
  let browser;
  before(
    async () => {
      const run = (...options) => execFileSync(program, ['-q', 'batch', ...options], { cwd: folder });
      writeFileSync(join(folder, 'plan.toml'), PLAN);
      run('plan.toml', '-o', 'out');
      run('report', 'out');
      writeFileSync(large, repeated(readFileSync(small, 'utf8'), MANY));
      browser = await launch();
    },
    { timeout: 120_000 },
  );
  after(async () => {
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
  });

  async function open(file) {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    const seen = { asked: [], errors: [] };
    page.on('request', (r) => seen.asked.push(r.url()));
    page.on('pageerror', (e) => seen.errors.push(String(e)));
    page.on('console', (m) => m.type() === 'error' && seen.errors.push(m.text()));
    const url = pathToFileURL(file).href;
    await page.goto(url);
    await page.locator('.row').first().waitFor();
    const settle = async () => {
      assert.deepEqual(seen.errors, []);
      assert.deepEqual(seen.asked, [url]);
      await page.close();
    };
    return { page, settle };
  }
  const column = async (page, name) => {
    const titles = await page.locator('#head [role=columnheader]').allTextContents();
    const at = titles.findIndex((title) => title.startsWith(name));
    const rows = await page.locator('.row').all();
    const cells = await Promise.all(
      rows.map(async (row) => [
        Number(await row.getAttribute('aria-rowindex')),
        await row.locator('[role=gridcell]').nth(at).textContent(),
      ]),
    );
    return cells.sort((a, b) => a[0] - b[0]).map(([, text]) => text);
  };

  it('sorts, filters, plays and shows what is covered', { timeout: 60_000 }, async () => {
    const { page, settle } = await open(small);
    const times = (await column(page, 'TTC')).filter((text) => text !== '–').map(Number);
    assert.ok(times.length > 1, String(times));
    assert.deepEqual(
      times,
      times.toSorted((a, b) => a - b),
      'the hardest case stands first',
    );
    await page.getByRole('button', { name: 'TTC s' }).click();
    const falling = (await column(page, 'TTC')).filter((text) => text !== '–').map(Number);
    assert.deepEqual(
      falling,
      falling.toSorted((a, b) => b - a),
    );

    const count = () => page.locator('#count').textContent();
    const all = Number.parseInt(await count(), 10);
    await page.getByLabel('Situation').selectOption('brake');
    const brakes = Number.parseInt(await count(), 10);
    assert.ok(brakes > 0 && brakes < all, `${brakes} of ${all}`);
    assert.deepEqual(new Set(await column(page, 'Situation')), new Set(['brake']));
    await page.getByRole('button', { name: 'Clear filters' }).click();
    const [code] = await column(page, 'Code');
    await page.getByLabel('Search').fill(code);
    assert.equal(await count(), `1 of ${all} cases`);
    assert.match(await page.locator('#commands').textContent(), new RegExp(`dragtraffic replay OUT ${code} `));
    assert.match(await page.locator('#editor').getAttribute('href'), /\?scene=file-/);

    const clock = () => page.locator('#clock').textContent();
    await page.locator('#time').fill('0');
    assert.equal(await clock(), '0.0 / 4.0 s');
    await page.getByRole('button', { name: 'Play' }).click();
    await page.waitForFunction(() => Number(document.querySelector('#time').value) > 1);
    await page.getByRole('button', { name: 'Pause' }).click();
    const colours = await page.locator('#view').evaluate((canvas) => {
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      const seen = new Set();
      for (let i = 0; i < data.length; i += 4) seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      return [seen.has(0x2f68d8), seen.has(0xd2d6db)];
    });
    assert.deepEqual(colours, [true, true], 'vehicles and asphalt are painted');

    await page.getByRole('tab', { name: 'Coverage' }).click();
    await page.getByText('Diversity before and after generation').waitFor();
    const situations = page.locator('table.buckets').first();
    assert.match(await situations.textContent(), /brake.*cut-in/);
    await situations
      .getByRole('row', { name: /^brake/ })
      .getByRole('button')
      .click();
    assert.equal(await count(), `${brakes} of ${all} cases`, 'the bucket is the filter');
    await settle();
  });

  it('scrolls through ten thousand cases with the rows in view alone', { timeout: 60_000 }, async () => {
    const { page, settle } = await open(large);
    assert.equal(await page.locator('#count').textContent(), '10,000 cases');
    const rows = () => page.locator('.row').count();
    assert.ok((await rows()) < 40, `${await rows()} rows exist`);
    await page.getByRole('grid').focus();
    await page.keyboard.press('End');
    await page.locator(`.row[aria-rowindex="${MANY + 1}"][aria-selected=true]`).waitFor();
    assert.ok((await rows()) < 40, `${await rows()} rows exist`);
    // Sorted and filtered, it still makes the rows in view alone; how long that takes is no matter of a test.
    await page.locator('#head button').first().click();
    assert.ok((await rows()) < 40, `${await rows()} rows exist`);
    await page.locator('#search').fill('n99');
    assert.equal(await page.locator('#count').textContent(), '111 of 10,000 cases');
    assert.ok((await rows()) < 40, `${await rows()} rows exist`);
    await settle();
  });
});
