// One program and one browser for a file of journeys; a fresh visitor for each journey.
import assert from 'node:assert/strict';
import { after, afterEach, before, describe } from 'node:test';
import { Editor, launch } from './editor.js';
import { Program } from './program.js';
import { missing } from './where.js';

/**
 * `tell(stage)` declares the journeys. `stage.open(options)` opens the editor; what is open is closed after each
 * journey, which fails when the page complained about anything.
 */
export function journeys(name, tell) {
  describe(name, { skip: missing() }, () => {
    const stage = {
      program: null,
      editor: null,
      async open(options) {
        stage.editor = await Editor.open(stage.browser, stage.program.url, options);
        return stage.editor;
      },
    };
    before(
      async () => {
        stage.program = await Program.start();
        stage.browser = await launch();
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
        const e = stage.editor;
        stage.editor = null;
        await e?.close();
        assert.deepEqual(e?.errors ?? [], []);
      },
      { timeout: 10_000 },
    );
    tell(stage);
  });
}
