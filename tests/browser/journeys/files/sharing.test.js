// A scene is exported as a link and as files, and imported from both.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';
import { brokenScene } from '../../support/maps.js';

journeys('sharing', (stage) => {
  it('opens a link in another browser, read-only and to copy', { timeout: 90_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const car = await carOnTheMove(e);
    await e.choose(car.id);
    await e.type('goal-time', '6.5');
    await e.page.locator('[data-action="share"]').click();
    await e.until(() => document.querySelector('.share input')?.value.startsWith('http'));
    assert.match(await e.text('.share'), /\d+ of 60 KB/);
    await e.picture('share');
    const link = await e.page.inputValue('.share input');
    await e.key('Escape');
    const other = await stage.visit(link);
    await other.until(() => /This scene was opened from a link/.test(document.querySelector('.banner')?.textContent));
    await other.settled();
    await other.choose(car.id);
    assert.equal(await other.value('goal-time'), 6.5);
    await other.type('goal-time', '4.0');
    assert.equal(await other.value('goal-time'), 6.5, 'read-only');
    await other.page.getByRole('button', { name: 'Make a copy' }).first().click();
    await other.page.waitForSelector('.banner', { state: 'detached' });
    await other.settled();
    await other.choose(car.id);
    assert.equal(await other.value('goal-time'), 6.5);
    await other.type('goal-time', '4.0');
    assert.equal(await other.value('goal-time'), 4);
    assert.equal(new URL(other.page.url()).hash, '');
  });

  it('reports a truncated link', { timeout: 60_000 }, async () => {
    const e = await stage.visit(`${stage.program.url}#s1=q1ZKzs8tKEotLgYA`);
    await e.until(() => /The link could not be opened/.test(document.querySelector('.banner')?.textContent));
    assert.match(await e.text('.banner'), /It may have been cut off/);
    await e.page.getByRole('button', { name: 'Close', exact: true }).click();
    await e.page.waitForSelector('.banner', { state: 'detached' });
  });

  it('saves files after listing their losses, and reads its own again', { timeout: 150_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    const save = async (kind) => {
      await e.page.locator('.top [data-action="export"]').click();
      await e.page.locator(`[data-kind="${kind}"]`).click();
      await e.until(() => !document.querySelector('.kind[aria-checked="true"] .tag').textContent.includes('…'));
      const words = await e.text('.kind[aria-checked="true"] .tag');
      const [file] = await Promise.all([
        // A moving picture takes as long as the machine is busy.
        e.page.waitForEvent('download', { timeout: 90_000 }),
        e.page.locator('.export .dfoot .btn.pri').click(),
      ]);
      return { words, name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
    };
    const saved = await save('dragtraffic');
    assert.equal(saved.words, 'lossless');
    const record = await save('womd');
    assert.match(record.words, /^\d+ details? missing$/);
    assert.equal((await save('png')).bytes.subarray(1, 4).toString(), 'PNG');
    const drawing = (await save('svg')).bytes.toString();
    assert.match(drawing, /^<svg xmlns.*<use href="#d\d+" transform.*<\/svg>\s*$/s);
    // Scale, time and north.
    for (const said of [/>\d+ m<\/text>/, />\d+\.\d s<\/text>/, />N<\/text>/]) assert.match(drawing, said);
    const moving = (await save('gif')).bytes;
    assert.equal(moving.subarray(0, 6).toString(), 'GIF89a');
    assert.equal(moving.at(-1), 0x3b, 'it is whole');
    const report = (await save('report')).bytes.toString();
    assert.match(report, /<h1>Rosa &amp; 5th<\/h1>.*data:image\/png.*Metres and seconds; x east, y north/s);
    await e.drop(saved.name, saved.bytes);
    await e.until(() => /imported\./.test(document.querySelector('.toast')?.textContent ?? ''));
    const [newest] = (await e.get('/v1/scenes')).scenes;
    const back = await e.get(`/v1/scenes/${newest.id}`);
    const first = JSON.parse(saved.bytes);
    for (const part of ['map', 'agents', 'signals', 'time']) assert.deepEqual(back[part], first[part], part);
  });

  it("lists file kinds for import, and requests the meaning of a table's columns", { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.key('Control+o');
    await e.page.waitForSelector('.inkinds li');
    assert.match(await e.text('.inkinds'), /Recorded traffic.*Trajectory tables.*\.csv.*Maps only.*\.xodr/s);
    await e.picture('import-kinds');
    const rows = Array.from({ length: 120 }, (_, i) => [i % 3, i - (i % 3), (i - (i % 3)) * 30, (i % 3) * 400, 'car']);
    const table = ['who,frame,xCm,yCm,class', ...rows.map((r) => r.join(','))].join('\n');
    await e.drop('tracks.csv', Buffer.from(table));
    await e.page.waitForSelector('.columns');
    assert.equal(await e.page.locator('.inkinds').count(), 0, 'the drop closes the list');
    assert.equal(await e.page.locator('[data-column="agent_id"]').inputValue(), '', 'nothing is guessed of it');
    assert.equal(await e.page.locator('.columns [type="submit"]').getAttribute('aria-disabled'), 'true');
    await e.page.locator('[data-column="agent_id"]').selectOption('who');
    for (const [field, column] of Object.entries({ x_m: 'xCm', y_m: 'yCm' })) {
      await e.page.locator(`[data-column="${field}"]`).selectOption(column);
      await e.page.locator(`[data-unit="${field}"]`).selectOption({ label: 'centimetres' });
    }
    await e.page.locator('[data-unit="time_s"]').selectOption({ label: 'frames, 30 per second' });
    await e.picture('import-columns');
    await e.page.locator('.columns [type="submit"]').click();
    await e.until(() => /imported\./.test(document.querySelector('.toast')?.textContent ?? ''));
    const cars = await e.roadUsers();
    assert.equal(cars.length, 3);
    // 3 frames and 90 cm for each row: 9 m/s.
    for (const c of cars) assert.ok(Math.abs(c.speed - 9) < 0.5, `${c.speed} m/s`);
    await e.page.locator('.toast .btn').click();
    assert.match(await e.text('.dlg.import .notes'), /Headings are derived from the motion/);
  });

  it('imports the usable part of a broken file, and of a too large one', { timeout: 60_000 }, async () => {
    const e = await stage.open();
    await e.begin();
    await e.drop('junction.json', Buffer.from(JSON.stringify(brokenScene, null, 1)));
    await e.page.waitForSelector('.dlg.import');
    assert.match(await e.text('.dlg.import'), /Lane “E2”: 1 point; 2 to .*Where\s+junction\.json, line \d+/s);
    assert.match(await e.text('.dlg pre .here'), /points_m/);
    await e.picture('import-in-part');
    await e.page.getByRole('button', { name: 'Import without lane “E2”' }).click();
    await e.until(() => /Two lanes imported without lane/.test(document.querySelector('.toast')?.textContent ?? ''));
    const demo = await e.get('/v1/scenes/demo-crossing');
    const crowd = Array.from({ length: 300 }, (_, i) => ({ ...demo.agents[0], id: String(i + 1) }));
    await e.drop('crowd.json', Buffer.from(JSON.stringify({ ...demo, name: 'Crowd', agents: crowd })));
    await e.page.waitForSelector('.dlg.import');
    await e.page.getByRole('button', { name: 'Import without the last 44 road users' }).click();
    await e.until(() => document.querySelectorAll('[data-agent]').length === 256);
    await e.drop('notes.json', Buffer.from('%PDF-1.7 nothing'));
    await e.page.waitForSelector('.dlg.import');
    assert.match(await e.text('.dlg.import'), /Named \.json, but it is a PDF/);
    // An archive may contain a network and a recording: only its content decides.
    await e.page.keyboard.press('Escape');
    await e.drop(
      'junction.zip',
      readFileSync(new URL('../../../../fuzz/corpus/sumo/junction.sumo.zip', import.meta.url)),
    );
    await e.until(() => /^FCD 0\.0 s imported/.test(document.querySelector('.toast')?.textContent ?? ''));
    await e.drop('photos.zip', Buffer.from('PK\x03\x04 and nothing else', 'latin1'));
    await e.page.waitForSelector('.dlg.import');
    assert.match(await e.text('.dlg.import'), /photos\.zip.+ZIP archive/s);
  });
});
