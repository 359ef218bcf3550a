// One program and one browser for a file of journeys; a new visitor for each journey.
import assert from 'node:assert/strict';
import { after, afterEach, before, describe } from 'node:test';
import { Editor, launch } from './editor.js';
import { Program } from './program.js';
import { missing } from './where.js';

/**
 * `tell(stage)` declares the journeys. `stage.open(options)` opens the editor, `stage.visit(url)` another address; open
 * pages are closed after each journey, which fails when a page has reported an error. `browser`: a browser other than
 * Chromium.
 */
export function journeys(name, tell, { browser = 'chromium' } = {}) {
  describe(name, { skip: missing(browser) }, () => {
    const stage = {
      program: null,
      editors: [],
      open(options) {
        return stage.visit(stage.program.url, options);
      },
      /** A visitor with a separate browser context. */
      async visit(url, options) {
        const e = await Editor.open(stage.browser, url, options);
        stage.editors.push(e);
        return e;
      },
    };
    before(
      async () => {
        stage.program = await Program.start();
        stage.browser = await launch(browser);
      },
      { timeout: 40_000 },
    );
    after(
      async () => {
        await stage.browser?.close();
        await stage.program?.stop();
      },
      { timeout: 20_000 },
    );
    afterEach(
      async () => {
        const all = stage.editors.splice(0);
        for (const e of all) await e.close();
        assert.deepEqual(
          all.flatMap((e) => e.errors),
          [],
        );
      },
      { timeout: 10_000 },
    );
    tell(stage);
  });
}
