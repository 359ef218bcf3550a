// A server whose scenes have owners: one user shares a scene from the editor, and another finds it.
import assert from 'node:assert/strict';
import { it } from 'node:test';
import { journeys } from '../../support/journey.js';
import { Program } from '../../support/program.js';

journeys('owners', (stage) => {
  it('share a scene where it is shared as a link, and go on editing it', { timeout: 90_000 }, async () => {
    const program = await Program.start(undefined, ['--owners', '--trust-proxy', '127.0.0.1']);
    // The proxy before the server names the user.
    const visit = async (name) => {
      const extraHTTPHeaders = { 'X-Forwarded-User': name };
      const e = await stage.visit(new URL('/scenes/demo-crossing', program.url).href, { extraHTTPHeaders });
      await e.begin();
      return e;
    };
    try {
      const anna = await visit('anna');
      const access = anna.page.getByRole('radiogroup', { name: 'Access on this server' });
      const share = async () => {
        await anna.page.locator('[data-action="share"]').click();
        await anna.until(() => document.querySelector('.share input')?.value.startsWith('http'));
      };
      await share();
      assert.equal(await access.count(), 0, 'an example has no owner');
      await anna.key('Escape');

      await anna.key('Control+s');
      await anna.until(() => /Saved as/.test(document.querySelector('.toast')?.textContent));
      await anna.settled();
      const found = async (e) => (await e.get('/v1/scenes')).scenes.filter((s) => s.owner === 'anna');
      const [{ id }] = await found(anna);
      await share();
      const chosen = () => access.locator('[aria-checked="true"]').innerText();
      assert.equal(await chosen(), 'Owner only');
      assert.match(await anna.text('.share'), /Owner: anna/);
      await access.getByRole('radio', { name: 'Everyone can view' }).click();
      await anna.until(
        () => document.querySelector('.share [aria-checked="true"]').textContent === 'Everyone can view',
      );
      await anna.picture('access');
      await anna.key('Escape');

      // The version of the server is that of the page: the next change is no conflict.
      const [{ id: someone }] = (await anna.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 0);
      await anna.choose(someone);
      const saved = anna.page.waitForResponse((r) => r.request().method() === 'PUT');
      await anna.type('goal-time', '6.5');
      assert.equal((await saved).status(), 200);

      const maria = await visit('maria');
      assert.deepEqual(
        (await found(maria)).map((s) => [s.id, s.shared]),
        [[id, 'read']],
      );
    } finally {
      await program.stop();
    }
  });
});
