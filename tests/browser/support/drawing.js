// What is written on the picture, from its export as a vector graphic.
import { readFileSync } from 'node:fs';

/** The texts of the picture, in their order. */
export async function drawnTexts(e) {
  await e.page.locator('.top [data-action="export"]').click();
  await e.page.locator('[data-kind="svg"]').click();
  const [file] = await Promise.all([
    e.page.waitForEvent('download'),
    e.page.locator('.export .dfoot .btn.pri').click(),
  ]);
  const drawing = readFileSync(await file.path(), 'utf8');
  return [...drawing.matchAll(/<text[^>]*>([^<]*)<\/text>/g)].map(([, words]) => words);
}
